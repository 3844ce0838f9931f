-- Operations on 2D shapes: each option once, against closed formulas.
local function near(value, wanted, tolerance)
  assert(math.abs(value - wanted) <= (tolerance or 1e-6) * math.max(1, math.abs(wanted)),
         value .. " instead of " .. wanted)
end
local function polygon_area(n, r) return n / 2 * math.sin(2 * math.pi / n) * r * r end

local s = square(10)
near(s:offset(2, {fn = 16}):area(), 100 + 80 + polygon_area(16, 2))
near(offset(s, {r = 2, fn = 16}):area(), 100 + 80 + polygon_area(16, 2))
near(offset{s, r = -2}:area(), 36)
near(s:offset{delta = 2}:area(), 196)
near(s:offset{delta = -2}:area(), 36)
near(s:offset{r = 1, delta = 5, fn = 8}:area(), 140 + polygon_area(8, 1)) -- r counts
near(s:offset{delta = 2, chamfer = true}:area(), 196 - 2 * (2 * (2 - math.sqrt(2))) ^ 2)
near(s:offset{delta = 2, chamfer = false}:area(), 196)
assert(s:offset(-5):is_empty())
assert(#s:offset(1, {fa = 45, fs = 0.01}):points() == 4 * 3) -- 8 fragments, 2 for a corner

near(hull(square(1), square(1):translate(5, 5)):area(), 11)
near(hull{square(1), square(1):translate(5, 5)}:area(), 11)
near(square(1):hull(square(1):translate(5, 5)):area(), 11)
near((square(4) - square(2)):hull():area(), 14)
near(minkowski(s, square(2, 4)):area(), 12 * 14)
near(s:minkowski(square(2), square(1)):area(), 13 * 13)
near((square(4) - square(2, {center = true}):translate(2, 2)):fill():area(), 16)
near(fill(circle(3) - circle(1)):area(), circle(3):area())

near(s:resize(20, 0):area(), 200)
near(s:resize({20, 0}, {auto = true}):area(), 400)
near(s:resize{newsize = {0, 5}, auto = {true, false}}:area(), 25)
near(s:resize{size = {1, 2, 0}}:area(), 2)
near(resize(s, 3, 4):area(), 12)

near(square{10, 10, r = 2, fn = 16}:area(), 100 - 16 + polygon_area(16, 2))
near(regular_polygon(6, 2):area(), polygon_area(6, 2))
near(regular_polygon{n = 5, d = 4}:area(), polygon_area(5, 2))
near(regular_polygon(4, {side = 3}):area(), 9)
near(regular_polygon(6, {across = 10}):area(), 50 * math.sqrt(3))

local ring = square(20, true) - square(10, true)
near(ring:perimeter(), 120)
assert(#ring:points() == 8 and #ring:paths() == 2 and #ring:outlines() == 2)
assert(ring:paths()[2][1] == 4 and ring:outlines()[2][1][1] == -5)
assert(polygon(ring:points(), ring:paths()) == ring)
local two = ring + square(4, true)
assert(two:components() == 2 and #two:decompose() == 2)
near(two:decompose()[2]:area(), 16)
assert(s:color("red"):offset(1):linear_extrude(1):volume() > 100)

-- Rounded edges run together where lines are thin; fonts have edges that vanish at once.
local word = text("R&B", 20)
local worn = word:linear_extrude{5, round = {0.4, 1}}
assert(worn:genus() == word:linear_extrude(5):genus() and worn:bbox().size[3] == 5)
assert((worn - word:linear_extrude(5)):volume() < 1e-3)
-- Some edges of this one are opposite but for the last digit: the corner between them runs far.
local wide, parts = text("4O", 20):rotate(330.92064456686541):offset{r = 1.197413979769101}, 0
for _, part in ipairs(wide:decompose()) do parts = parts + part:roof("straight"):volume() end
near(wide:roof("straight"):volume(), parts, 1e-4)

-- What is made of them is a solid like any other.
return two:offset{delta = 0.5}:linear_extrude(3)
