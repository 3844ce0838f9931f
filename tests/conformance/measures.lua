-- What the measuring methods say, of solids and of shapes.
local function near(a, b, tolerance) return math.abs(a - b) <= (tolerance or 1e-12) * math.max(1, math.abs(b)) end
local function same(list, expected)
  assert(#list == #expected)
  for i = 1, #expected do assert(list[i] == expected[i], ("entry %d is %.17g"):format(i, list[i])) end
end

local box = cube{10, 20, 30}
assert(box:volume() == 6000 and box:area() == 2200)
same(box:bbox().min, {0, 0, 0})
same(box:bbox().max, {10, 20, 30})
same(box:size(), {10, 20, 30})
assert(tostring(box:bbox()) == "{min = vec(0, 0, 0), max = vec(10, 20, 30)}")
same(box:centroid(), {5, 10, 15})
assert(box:components() == 1 and box:genus() == 0 and not box:is_empty())

-- contains: inside and on the boundary, exactly.
assert(box:contains(5, 5, 5) and box:contains(10, 20, 30) and box:contains{0, 7, 7})
assert(not box:contains(10.001, 5, 5) and not box:contains(-1e-5, 5, 5))
local drilled = box - cylinder(30, 2, {fn = 4}):translate(5, 10, 0)
assert(not drilled:contains(5, 10, 15) and drilled:contains(7, 10, 15) and not drilled:contains(6.999, 10, 15))

assert(drilled:genus() == 1 and drilled:components() == 1 and drilled:volume() == 6000 - 8 * 30)
assert((cube(1) + cube(1):translate(5, 0, 0)):components() == 2)
assert((cube(1) + cube(1):translate(1, 1, 0)):components() == 2) -- they share an edge only
assert((cube(3) - cube(1):translate(1, 1, 1)):components() == 2) -- outside and void
assert((cube(1) - cube(1)):is_empty() and (cube(1) - cube(1)):volume() == 0)
assert((cube(1) * cube(1):translate(1, 0, 0)):is_empty())
assert(not pcall(function() return (cube(1) - cube(1)):bbox() end))

-- The decimal grid: 0.1 + 0.2 is 0.3 here.
assert((cube(.3) + cube(.3):translate(.1 + .2, 0, 0)):size()[1] == .6)

-- Shapes.
local square_ring = square(10) - square(4):translate(3, 3)
assert(square_ring:area() == 84 and near(square_ring:centroid()[1], 5))
same(square_ring:bbox().max, {10, 10})
same(square_ring:size(), {10, 10})
assert(tostring(square_ring:bbox()) == "{min = vec(0, 0), max = vec(10, 10)}")
assert(square_ring:contains(1, 1) and not square_ring:contains(5, 5))
assert((square(1) - square(1)):is_empty())
assert(square_ring:linear_extrude(2):volume() == 168)
assert(square_ring:linear_extrude(2):genus() == 1)
local turned = square(1):translate(2, 0):rotate_extrude{fn = 64}
assert(near(turned:volume(), 64 / 2 * sin(360 / 64) * (9 - 4), 1e-6) and turned:genus() == 1)

-- Equality is of geometry, whatever it was made from.
assert(cube(10) == cube{size = {10, 10, 10}})
assert(cube(10) ~= cube(11) and cube(10) ~= 5)
assert(cube(10) + cube(5) == cube(10))
assert(cube(2):scale(0.5) == cube(1))
assert(cube(1):translate(1, 0, 0):translate(-1, 0, 0) == cube(1))
assert(cube(1) ~= cube(1):color("red"))
assert(square(2) * square(1) == square(1))

-- What is measured is a vector, and a list all the same.
do
  local part = cube(1, 2, 3):translate(10, 20, 30)
  local size, b, c = part:size(), part:bbox(), part:centroid()
  assert(size.x == 1 and size.y == 2 and size.z == 3 and size[3] == 3 and #size == 3)
  assert(size == vec(1, 2, 3) and b.max - b.min == size and b.min + size / 2 == c)
  local sum = 0
  for _, x in ipairs(size) do sum = sum + x end
  assert(sum == 6 and tostring(size) == "vec(1, 2, 3)")
  assert(part:translate(-b.min) == cube(1, 2, 3))
  local flat = square(4, 2):translate(1, 1)
  local s, f = flat:size(), flat:bbox()
  assert(s.x == 4 and s.y == 2 and s.z == nil and #s == 2 and tostring(s) == "vec(4, 2)")
  assert(f.max - f.min == s and #(f.min + s / 2) == 2 and f.min + s / 2 == flat:centroid())
  assert(polygon{f.min, f.max, 2 * f.max}:area() >= 0)
end

return box
