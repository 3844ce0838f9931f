-- Hulls, Minkowski sums, sections and parts of solids.
local function near(a, b, relative)
  assert(math.abs(a - b) <= (relative or 1e-12) * math.max(1, math.abs(b)), a .. " for " .. b)
end

-- hull: as function of values or lists, and as method.
local a, b = cube(2), cube(2):translate(4, 0, 0)
for _, form in ipairs{hull(a, b), hull{a, b}, a:hull(b), hull(a:hull(), b)} do
  assert(form == cube(6, 2, 2))
end
assert(rotate(20, 30, 40) * a:hull(b) == (rotate(20, 30, 40) * a):hull(rotate(20, 30, 40) * b))
assert(hull(square(2), square(2):translate(4, 0)) == square(6, 2))
assert(hull(cube(9) - cube(9, 3, 3):translate(0, 3, 3)) == cube(9))

-- minkowski: sums in any order; an empty operand does not count.
local frame = cube(10, 10, 2) - cube(4, 4, 4):translate(3, 3, -1)
local grown = cube(11, 11, 3) - cube(3, 3, 5):translate(4, 4, -1)
for _, form in ipairs{minkowski(frame, cube(1)), minkowski{cube(1), frame}, frame:minkowski(cube(1)),
                      minkowski(frame, union{}, cube(1))} do
  assert(form == grown)
end
assert(minkowski(frame, frame) == cube(20, 20, 4) and minkowski{frame} == frame)
assert(minkowski(square(2), square(3)) == square(5))
-- Steiner's formula for a ball: volume, surface, edges by outer angle, corners.
local ball = minkowski(cube(10), sphere{r = 1, fn = 64})
near(ball:volume(), 1000 + 600 + 30 * math.pi + 4 / 3 * math.pi, 1e-3) -- its facets are inscribed

-- resize: lengths of the bounding box; 0 stays, or follows the longest with auto.
assert(cube(1, 2, 3):resize(2, 0, 6) == cube(2, 2, 6))
assert(cube(1, 2, 3):resize({2, 0, 0}, {auto = true}) == cube(2, 4, 6))
assert(cube(1, 2, 3):resize{newsize = {2, 0, 0}, auto = {false, false, true}} == cube(2, 2, 6))
assert(resize(square(1, 2), 3, 0) == square(3, 2))
assert(resize{cube(1), {2, 2, 2}} == cube(2))

-- Shadows and sections.
assert(cube(3):project() == square(3) and cube(3):projection() == square(3))
local hollow = cube{size = 10, center = true} - cube{6, 6, 20, center = true}
assert(hollow:project() == square{size = 10, center = true} - square{size = 6, center = true})
assert(hollow:slice(1) == hollow:project() and hollow:projection{cut = true} == hollow:slice())
assert(hollow:slice(5):is_empty() and hollow:slice(-5):area() == 64) -- what is above the plane
near(cylinder(10, 5, 0, {fn = 100}):slice(4):area(), circle(3, {fn = 100}):area(), 1e-6)
near(sphere(5, {fn = 50}):rotate(10, 20, 30):slice(1):area(), 24 * math.pi, 1e-2)
-- A shadow is that of all that is above and below: of a leaning bar, and of two apart.
assert((cube(4) + cube(4):translate(2, 2, 9)):project() == square(4) + square(4):translate(2, 2))

-- split and trim.
local top, bottom = cube(10):split({0, 0, 1}, 4)
assert(top == cube(10, 10, 6):up(4) and bottom == cube(10, 10, 4) and top + bottom == cube(10))
assert(cube(10):trim({0, 0, 5}, 4) == top and trim(cube(10), {0, 0, -1}, -4) == bottom)
assert(cube(10):trim{normal = {1, 0, 0}, point = {3, 99, 0}} == cube(7, 10, 10):right(3))
assert(cube(10):trim{normal = {1, 1, 1}, point = {5, 5, 5}}:volume() == 500)
-- A slanting cut fits what was made with the same slope.
local wedge = polygon{{0, 0}, {5, 0}, {0, 5}}:linear_extrude(10):rotate(90, 0, 0):translate(0, 10, 0)
local slanting = cube(10):trim({1, 0, 1}, {point = {0, 0, 5}})
assert(slanting:volume() == 875 and slanting + wedge == cube(10) and slanting == cube(10) - wedge)
-- Cuts have the colour of what is cut.
assert(cube(10):color("red"):trim({1, 0, 1}, 3) == cube(10):trim({1, 0, 1}, 3):color("red"))
local _, behind = cube(10):color("red"):split({0, 0, 1}, 3)
assert(behind == cube(10, 10, 3):color("red"))
assert(cube(10):trim({1, 0, 0}, 10):is_empty() and cube(10):trim({1, 0, 0}, -1) == cube(10))
local left, right = frame:split({1, 2, 0}, 11)
near(left:volume() + right:volume(), frame:volume())

-- decompose: voids stay with what is around them.
local shell = cube(10) - cube(8):translate(1, 1, 1)
local parts = (cube(2):left(5) + shell + cube(2):translate(4, 4, 4) + cube(1):right(15)):decompose()
assert(#parts == 4)
assert(parts[1] == cube(2):left(5) and parts[2] == shell and parts[3] == cube(2):translate(4, 4, 4)
       and parts[4] == cube(1):right(15))
assert(#(cube(1) + cube(1):translate(1, 1, 0)):decompose() == 2) -- an edge does not connect
assert(#union{}:decompose() == 0 and #cube(1):decompose() == 1)
assert(#(square(1) + square(1):right(3)):decompose() == 2)
return shell
