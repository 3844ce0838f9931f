-- A large octahedron, built of small octahedra and tetrahedra that fill it without a gap.
--
-- The tetrahedra touch one another in edges and corners only, and so do the octahedra. Nothing has to
-- overlap by a little: each piece comes out closed, as a component of its own, and together they are
-- the large octahedron, exactly. The script checks that itself.

local count = param("count", 4, {min = 1, max = 8, step = 1, doc = "pieces along an edge"})
local unit  = param("unit", 10, {min = 1, max = 100, doc = "from the centre of a piece to its tip"})

-- Two pyramids, base to base.
local function octahedron(radius)
  local pyramid = cylinder{h = radius, r1 = radius, r2 = 0, fn = 4}
  return pyramid + pyramid:mirror(0, 0, 1)
end

-- A tetrahedron in every second corner of a cube, and its mirror image in the other four.
local left = polyhedron{
  points = {{0, 0, 0}, {unit, unit, 0}, {unit, 0, unit}, {0, unit, unit}},
  faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}},
}
local right = left:mirror(1, 0, 0):right(unit)
local small = octahedron(unit)

-- The farthest that a piece of cube (x, y, z) reaches, as |x| + |y| + |z|.
local function reach(x, y, z, corners)
  local farthest = 0
  for _, c in ipairs(corners) do
    farthest = math.max(farthest, math.abs(x + c[1]) + math.abs(y + c[2]) + math.abs(z + c[3]))
  end
  return farthest
end

local left_corners  = {{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}
local right_corners = {{1, 1, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}

local tetrahedra, octahedra = {}, {}
for x = -count, count do
  for y = -count, count do
    for z = -count, count do
      local place = {x * unit, y * unit, z * unit}
      local even = (x + y + z + count) % 2 == 0
      if reach(x, y, z, even and left_corners or right_corners) <= count then
        tetrahedra[#tetrahedra + 1] = (even and left or right):translate(place)
      end
      if not even and math.abs(x) + math.abs(y) + math.abs(z) < count then
        octahedra[#octahedra + 1] = small:translate(place)
      end
    end
  end
end

local orange, blue = union(tetrahedra), union(octahedra)
assert((orange * blue):is_empty())
assert(((orange + blue) ~ octahedron(count * unit)):is_empty())
assert(orange:components() == #tetrahedra and blue:components() == #octahedra)

return {tetrahedra = orange:color("darkorange"), octahedra = blue:color("slateblue")}
