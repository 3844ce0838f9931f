-- Edges of solids: which there are, and solids with some of them cut off, against closed forms.
local function near(a, b, relative)
  assert(math.abs(a - b) <= (relative or 1e-12) * math.max(1, math.abs(b)), a .. " for " .. b)
end

-- What there is, and how it is chosen.
local box = cube(10, 20, 30)
assert(#box:edges() == 12 and #box:edges("top") == 4 and #box:edges{along = "z"} == 4)
assert(#box:edges{on = "top", along = "x"} == 2 and #box:edges{on = {0, 0, -1}, along = {0, 3, 0}} == 2)
assert(#box:edges{near = {5, 0, 31}} == 1 and #box:edges{near = {0, 0, 0}} == 3)
assert(#box:edges{normal = {1, 0, 0}} == 4 and #box:edges{through = {10, 20, 5}} == 7)
assert(#box:edges{turn = 91} == 0)
local edge = box:edges{near = {5, 0, 31}}[1]
assert(edge.length == 10 and edge.convex and edge.turn == 90 and edge.from[1] == 0 and edge.to[1] == 10)
assert(edge.from[3] == 30 and edge.normals[1][3] + edge.normals[2][3] == 1)
local steps = cube(20, 20, 5) + cube(8, 20, 15)
assert(#steps:edges() == 18 and #steps:edges("top") == 4 and #steps:edges{normal = {0, 0, 1}} == 8)
local concave = steps:edges{near = {8, 10, 5}}
assert(#concave == 1 and not concave[1].convex)
-- Facets of what is round have none; its rims have.
assert(#cylinder{h = 10, r = 5, fn = 24}:edges() == 48 and #cylinder{h = 10, r = 5, fn = 24}:edges{turn = 0} == 48)

-- Chamfers. All of a cube: twelve prisms; of each corner a sixth of a cube stays.
local a, d = 10, 1.5
local c = cube(a)
near(c:chamfer(d):volume(), a ^ 3 - 6 * d ^ 2 * (a - 2 * d) - 8 * 5 / 6 * d ^ 3)
near(c:chamfer(5):volume(), 1000 / 6)
assert(c:chamfer(1.5):components() == 1 and #c:chamfer(1.5):faces() == 26)
near(c:chamfer(2, "z"):volume(), 1000 - 4 * 2 * 10)
assert(c:chamfer(2, "|Z") == linear_extrude(square(10):offset{delta = 2} - square(14):translate(-2, -2), 1) +
  linear_extrude(polygon{{2, 0}, {8, 0}, {10, 2}, {10, 8}, {8, 10}, {2, 10}, {0, 8}, {0, 2}}, 10))
assert(c:chamfer(2, "top") == hull(cube(10, 10, 8), cube(6, 6, 10):translate(2, 2, 0)))
assert(chamfer(c, 2, {edges = "top"}) == c:chamfer{2, edges = {on = "top"}})
near(c:chamfer(1, {edges = {near = {5, 0, 10}}}):volume(), 995)
near(box:chamfer(1, {edges = function(e) return e.length == 20 end}):volume(), 6000 - 40)
near(box:chamfer(1, {edges = {"x", {on = "top", along = "y"}}}):volume(),
  6000 - 4 * 5 - 2 * 10 + 4 / 3) -- what two have at a mitre goes once
assert(box:chamfer(1, {edges = box:edges("top")}) == box:chamfer(1, "top"))
-- Up to walls, and around corners that point inwards.
local l = cube(10, 10, 5) - cube(5, 5, 5):translate(5, 5, 0)
near(l:chamfer(1, "top"):volume(), 375 - (40 / 2 - 4 / 3))
near(steps:chamfer(1, {edges = {along = "x", normal = {0, 0, 1}}}):volume(), 3600 - 2 * 0.5 * (8 + 12))
-- The mouth of a hole of 30 facets, and the rim of a plate.
local plate = cube(60, 40, 5) - cylinder{h = 20, r = 3, fn = 30, center = true}:translate(20, 20, 0)
local rho = 3 * cos(6)
near(plate:chamfer(1, "top"):volume(), plate:volume() - (200 / 2 - 4 / 3)
  - 30 * tan(6) * (rho + 1 / 3), 1e-8)
-- Rims of a cylinder.
local disc = cylinder{h = 10, r = 5, fn = 60}
local r = 5 * cos(3)
near(disc:chamfer(1, "top"):volume(), 60 * tan(3) * (9 * r ^ 2 + (r ^ 3 - (r - 1) ^ 3) / 3), 1e-8)

-- Fillets. Upright ones leave squares less quarters of a polygon; all of them are the round cube.
near(c:fillet(2, {edges = "z", fn = 32}):volume(), 10 * (100 - 4 * (4 - 8 * 2 * sin(90 / 8))), 1e-8)
assert(c:fillet(2, {fn = 32}) == cube(10, {r = 2, fn = 32}))
assert(c:fillet{r = 2, fa = 12, fs = 0.1} == cube(10, {r = 2, fn = 32}))
assert(c:fillet(5, {fn = 16}) == cube(10, {r = 5, fn = 16}))
near(fillet(c, 2, "top", {fn = 16}):volume(), c:fillet{r = 2, edges = {on = "top"}, fn = 16}:volume())
-- Turned, it is the same up to the rounding of corners that have no place on the grid.
local turned = c:rotate(20, 30, 40):fillet(2, {fn = 32})
near(turned:volume(), c:fillet(2, {fn = 32}):volume(), 1e-8)
assert(#c:rotate(20, 30, 40):chamfer(1.5):faces() == 26)
assert(#cylinder{h = 10, r = 5, fn = 60}:fillet(1, {edges = "top", fn = 24}):faces() == 62 + 60 * 6)
assert(turned:components() == 1 and turned:genus() == 0)
-- One after another: the rim of upright edges that are round. Each layer is a polygon.
local tower = cube(20, 20, 10):fillet(3, {edges = "z", fn = 32})
local rim, turn = tower:fillet(2, {edges = "top", fn = 32}), 90 / 8
assert(rim:components() == 1 and rim:genus() == 0 and rim:volume() < tower:volume())
local function area(s) -- of the outline, moved inwards by s
  local side = 2 * 3 * sin(turn / 2)
  local perimeter, bends = 4 * 14 + 32 * side, 4 * (7 * tan(turn / 2) + 2 * tan(turn / 4))
  return tower:slice(5):area() - s * perimeter + s ^ 2 * bends
end
local missing = 0
for k = 0, 7 do -- from the side of the rim to its top, in facets
  local s0, s1 = 2 * (1 - cos(k * turn)), 2 * (1 - cos((k + 1) * turn))
  local h = 2 * (sin((k + 1) * turn) - sin(k * turn))
  missing = missing + h * (area(0) - (area(s0) + 4 * area((s0 + s1) / 2) + area(s1)) / 6)
end
near(rim:volume(), tower:volume() - missing, 1e-7)
-- A corner of three edges that are not upright on one another.
local tent = polyhedron{points = {{0, 0, 0}, {10, 0, 0}, {0, 12, 0}, {3, 2, 9}},
  faces = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}}
local ball = tent:fillet(0.5, {fn = 24})
assert(ball:components() == 1 and ball:genus() == 0)
-- It is what a ball of that radius sweeps inside, up to the facets.
local smaller = tent:offset(-0.5, {fn = 60})
near(ball:volume(), minkowski(smaller, sphere{r = 0.5, fn = 60}):volume(), 5e-3)

-- A corner of more edges: the tip goes by the plane through the points where the lines on the sides meet, and what is
-- left is convex. On a side of an octahedron these are 2 from its corner, at 60 degrees.
local function top(solid) return solid:bbox().max.z end
local octahedral = octahedron(10):chamfer(1)
near(top(octahedral), 10 - 4 / sqrt(6), 1e-6)
near(octahedral:volume(), hull(octahedral):volume(), 1e-6)
assert(#octahedral:faces{normal = {0, 0, 1}} == 1)
near(octahedron(10):rotate(10, 20, 30):chamfer(1):volume(), octahedral:volume(), 1e-5)
for _, n in ipairs{4, 5, 6} do
  -- Sides that meet in a tip: the lines beside two edges of one meet as far from it as the angle between these tells.
  local spike = cylinder{h = 8, r1 = 7, r2 = 0, fn = n}
  local flank, step = sqrt(7 ^ 2 + 8 ^ 2), 7 * 2 * sin(180 / n)
  local half = asin(step / 2 / flank) -- between an edge and the middle of a side
  local along = 1 / sin(half) -- from the tip, in the middle of the side
  local drop = along * 8 / sqrt(8 ^ 2 + (7 * cos(180 / n)) ^ 2)
  for _, how in ipairs{"chamfer", "fillet"} do
    local cut = spike[how](spike, 1)
    assert(cut:components() == 1 and cut:genus() == 0)
    if how == "chamfer" then near(top(cut), 8 - drop, 1e-6) else assert(top(cut) > 6 and top(cut) < 7.7) end
  end
  local cut = spike:chamfer(1)
  near(cut:volume(), hull(cut):volume(), 1e-6)
end

-- Where the tip is aslant: what goes is as near to an edge as its setback, or in the hull of the tip and these points.
local skew = polyhedron{points = {{10, 0, 0}, {0, 10, 0}, {-10, 1, 0}, {1, -10, 0}, {6, 5, 7}},
  faces = {{0, 1, 2, 3}, {1, 0, 4}, {2, 1, 4}, {3, 2, 4}, {0, 3, 4}}}
local tip, flanks = vec(6, 5, 7), {}
for _, e in ipairs(skew:edges()) do if e.to.z + e.from.z > 1 then flanks[#flanks + 1] = e end end
assert(#flanks == 4)
for _, how in ipairs{"chamfer", "fillet"} do
  local cut, spent, ways = skew[how](skew, 0.5, {edges = flanks}), {}, {}
  for i, e in ipairs(flanks) do
    local foot = vec(e.from.x, e.from.y, e.from.z)
    if foot.z > 1 then foot = vec(e.to.x, e.to.y, e.to.z) end
    local setback = how == "chamfer" and 0.5 or 0.5 * tan(e.turn / 2)
    ways[i] = {u = (foot - tip) / norm(foot - tip), setback = setback, around = atan2(foot.y, foot.x)}
    local function ball(p) return sphere{r = 1.06 * setback, fn = 24}:translate(p.x, p.y, p.z) end
    spent[i] = hull(ball(foot), ball(tip))
  end
  table.sort(ways, function(a, b) return a.around < b.around end)
  local corners = {cube(1e-4):translate(tip.x, tip.y, tip.z)}
  for i, a in ipairs(ways) do
    local b = ways[i % 4 + 1]
    local m = tip + (b.setback * a.u + a.setback * b.u) / norm(cross(a.u, b.u)) * 1.01
    corners[#corners + 1] = cube(1e-4):translate(m.x, m.y, m.z)
  end
  spent[#spent + 1] = hull(corners)
  assert((skew - cut - union(spent)):volume() < 1e-4)
  -- And nothing stays at the tip.
  assert((cut * sphere{r = 0.2, fn = 12}:translate(tip.x, tip.y, tip.z)):volume() == 0)
  assert(cut:components() == 1 and cut:genus() == 0 and (cut - skew):volume() == 0)
end

-- What a notch leaves of a facet is shorter than the cut: its neighbours close over it, as in an offset of the outline.
local function rim(outline, d)
  local part, flat = outline:linear_extrude(8), outline:area()
  local cut, rounded = part:chamfer(d, {edges = "top"}), part:fillet(d, {edges = "top", fn = 24})
  for _, k in ipairs{0.3, 0.95} do
    local in_by = d * k
    near(cut:slice(8 - d + in_by):area(), outline:offset{delta = -in_by}:area(), 1e-6)
    -- An arc of chords, so no more than the true one has, and more than the chamfer.
    local area = rounded:slice(8 - d + in_by):area()
    assert(area > cut:slice(8 - d + in_by):area())
    assert(area < outline:offset{delta = sqrt(d ^ 2 - in_by ^ 2) - d}:area() + 1e-4)
  end
  assert(cut:components() == 1 and cut:genus() == 0 and rounded:components() == 1 and rounded:genus() == 0)
  assert(#cut:faces{normal = {0, 0, 1}} == 1)
  return cut
end
for _, fn in ipairs{24, 64, 200} do rim(circle(10, {fn = fn}) - square(3, 20):translate(-1.5, 7), 0.5) end
rim(circle(3, {fn = 48}) - square(6, 6):translate(-3, 2), 0.4) -- a shaft with a flat
for seed = 1, 3 do
  local numbers = rands(0, 1, 9, seed)
  local outline = circle(10, {fn = floor(8 + 30 * numbers[1])}):rotate(360 * numbers[2])
  for i = 3, 6 do outline = outline * square(40):translate(-20, -36 + 4 * numbers[i]):rotate(360 * numbers[i + 3]) end
  rim(outline, 0.2 + numbers[2])
end
assert(not pcall(rim, circle(10, {fn = 64}), 10.1)) -- all of it would go
assert(not pcall(rim, square(10), 5.1))
assert(not pcall(rim, polygon{{0, 0}, {10, 0}, {0, 10}}, 2.95)) -- its inscribed circle has 2.93

-- Blocks at random: walls, corners that point inwards, vertices of many faces. What goes is near to the cross-section of
-- the cut along all edges, and nothing comes apart, opens or stays behind at their ends.
for seed = 1, 6 do
  local numbers, blocks = rands(0, 12, 36, seed), union{}
  for i = 0, 5 do
    local function n(k) return floor(numbers[6 * i + k]) end
    blocks = blocks + cube(3 + n(1) % 5, 3 + n(2) % 5, 3 + n(3) % 5):translate(n(4), n(5), n(6))
  end
  local length = 0
  for _, e in ipairs(blocks:edges()) do length = length + (e.convex and e.length or 0) end
  for how, section in pairs{chamfer = 1 / 2, fillet = 4 * (1 / 4 - 1 / 8 * 2 * sin(45))} do
    local cut = blocks[how](blocks, 0.25)
    local ratio = (blocks:volume() - cut:volume()) / (length * 0.25 ^ 2 * section)
    assert(ratio > 0.9 and ratio < 1.1, ratio)
    assert(cut:components() == blocks:components() and cut:genus() == blocks:genus())
  end
end

-- Turned parts have their corners wherever the grid is: cuts that follow one another leave no edges shorter than that,
-- and all corners have as many facets.
for _, angle in ipairs{1, 17, 30, 36.87, 45, 60} do
  local bar = square(20, 10):rotate(angle):linear_extrude(10)
  local round, flat = bar:fillet(1, {edges = "z", fn = 24}), bar:chamfer(0.5, {edges = "top"})
  assert(#round:faces() == 6 + 4 * 6 and #round:edges("top") == 4 + 4 * 6)
  local both = round:chamfer(0.5, {edges = "top"})
  assert(#both:faces() == 6 + 4 + 2 * 4 * 6 and both:components() == 1 and both:genus() == 0)
  near(both:volume(), cube(20, 10, 10):fillet(1, {edges = "z", fn = 24}):chamfer(0.5, "top"):volume(), 1e-7)
  assert(#flat:edges() == 4 + 3 * 4 + 4 and #flat:fillet(1, {edges = "z", fn = 24}):faces() == 10 + 4 * 6 + 4)
end
-- So do corners of any angle; sharp ones leave nothing of their edges behind.
for seed = 1, 4 do
  local numbers, points = rands(0, 1, 12, seed), {}
  for i = 1, 4 + seed % 2 do
    local a, r = 360 * (i + 0.4 * numbers[i]) / (4 + seed % 2), 15 + 10 * numbers[i + 6]
    points[i] = {r * cos(a), r * sin(a)}
  end
  local part, n = polygon(points):linear_extrude(8), #points
  local flat = part:chamfer(0.5, {edges = "top"})
  near(flat:slice(7.75):area(), polygon(points):offset{delta = -0.25}:area(), 1e-7)
  assert(#flat:edges() == 5 * n and #flat:faces() == 2 * n + 2)
  for _, k in ipairs{part:fillet(1, {edges = "z", fn = 24}):chamfer(0.5, {edges = "top"}),
      flat:fillet(0.5, {edges = "z", fn = 24})} do
    assert(k:components() == 1 and k:genus() == 0 and (k - part):volume() == 0)
  end
end

-- Rims of holes: at each height the outline, moved outwards by what the arc has gone in there; and as many faces as
-- the arcs have facets.
local function mouth(outline, r, facets)
  local plate, quarter = linear_extrude(square(60, true), 8) - linear_extrude(outline, 8), facets / 4
  local cut = plate:fillet(r, {fn = facets, edges = function(e)
    return math.max(math.abs(e.from[1]), math.abs(e.from[2])) < 29 and e.from[3] == 8 and e.to[3] == 8
  end})
  for i = 1, quarter do
    local low, high = 90 * (i - 1) / quarter, 90 * i / quarter -- in the middle of each facet
    local down, wide = r * (1 - (cos(low) + cos(high)) / 2), r * (1 - (sin(low) + sin(high)) / 2)
    near(cut:slice(8 - down):area(), 3600 - outline:offset{delta = wide}:area(), 2e-7)
  end
  assert(#cut:faces() == #plate:faces() + quarter * #outline:points())
  assert(cut:components() == 1 and cut:genus() == 1 and (cut - plate):volume() == 0)
end
for _, n in ipairs{3, 4, 6, 48, 200} do mouth(circle(5, {fn = n}), 1, 24) end
mouth(square(10, true):rotate(17), 1.3, 16)
mouth(polygon{{-10, 0}, {10, -1}, {10, 1}}, 0.4, 24)
mouth(circle(0.2, {fn = 32}), 3, 8) -- a wide mouth of a narrow hole
-- Chamfers of such, too, and corners of pockets that are rounded by less than what is cut.
for _, n in ipairs{6, 8, 12} do
  local bored, deep = cube(40, 40, 8) - cylinder{h = 8, r = 0.2, fn = n}:translate(20, 20, 0), 2
  local function is_mouth(e) return math.abs(e.from[1] - 20) < 1 and e.from[3] == 8 and e.to[3] == 8 end
  local sunk = bored:chamfer(deep, {edges = is_mouth})
  near(bored:volume() - sunk:volume(), n * tan(180 / n) * (0.2 * cos(180 / n) * deep ^ 2 + deep ^ 3 / 3), 1e-6)
  assert(#sunk:faces() == #bored:faces() + n)
end
local cross = square(11.4, 7.4, true):offset{r = 0.3, fn = 24} + square(3.4, 13.4, true):offset{r = 0.3, fn = 24}
local pocketed = (square(60, true) - cross):linear_extrude(8)
for how, size in pairs{chamfer = 1.5, fillet = 1} do
  local cut = pocketed[how](pocketed, size, {fn = how == "fillet" and 24 or nil, edges = function(e)
    return math.max(math.abs(e.from[1]), math.abs(e.from[2])) < 29 and e.from[3] == 8 and e.to[3] == 8
  end})
  local down = how == "fillet" and size * (1 - (cos(30) + cos(45)) / 2) or 0.5
  local wide = how == "fillet" and size * (1 - (sin(30) + sin(45)) / 2) or size - down
  local missed = cross:offset{delta = wide} ~ (square(60, true) - cut:slice(8 - down))
  assert(missed:area() < 1e-4, missed:area())
end
-- An upright hole in a slanted face: its walls are not equally steep there. What stays is what one of the four blocks
-- around it has, with one edge rounded each.
local roof = polygon{{-20, 0}, {20, 0}, {20, 44}, {-20, 16}}:linear_extrude(40, {center = true}):rotate(90, 0, 0)
local steep, blocks = roof - cube(8, 8, 90):translate(-4, -4, -20), {}
local function is_at_hole(p) return p[3] > 3 and math.abs(p[1]) < 5 and math.abs(p[2]) < 5 end
local blunt = steep:fillet(1, {fn = 16, edges = function(e) return is_at_hole(e.from) and is_at_hole(e.to) end})
for _, x in ipairs{{-20, -20, -4, 20}, {4, -20, 20, 20}, {-20, -20, 20, -4}, {-20, 4, 20, 20}} do
  local block = roof * cube(x[3] - x[1], x[4] - x[2], 100):translate(x[1], x[2], -20)
  local axis, at = x[3] - x[1] < 40 and 1 or 2, math.min(math.abs(x[1]), math.abs(x[2]), math.abs(x[3]), math.abs(x[4]))
  blocks[#blocks + 1] = block:fillet(1, {fn = 16, edges = function(e)
    return e.from[3] > 3 and e.to[3] > 3 and math.abs(e.from[axis]) == at and e.from[axis] == e.to[axis]
  end})
end
assert((blunt - union(blocks)):volume() < 1e-5 and (union(blocks) - blunt):volume() < 0.2)
assert(blunt:components() == 1 and blunt:genus() == 1)
-- What stands in the hole stays.
local well = cube(20, 20, 5) - cylinder{h = 5, r = 6, fn = 24}:translate(10, 10, 0)
local post = cylinder{h = 5, r = 4, fn = 24}:translate(10, 10, 0)
local around = function(e) return math.abs(norm{e.from[1] - 10, e.from[2] - 10} - 6) < 1 end
near((well + post):fillet(0.5, {fn = 16, edges = around}):volume(),
  well:fillet(0.5, {fn = 16, edges = around}):volume() + post:volume(), 1e-9)

-- A cut has the colour of a face beside it.
assert(c:color("red"):chamfer(1) == c:chamfer(1):color("red"))
assert(c:color("red"):fillet(1) == c:fillet(1):color("red"))
return c:chamfer(1)
