-- Angles are degrees, exact where the value is a number that can be written down.
assert(sin(30) == 0.5 and cos(60) == 0.5 and sin(90) == 1 and cos(90) == 0 and sin(180) == 0)
assert(tan(45) == 1 and tan(-45) == -1 and sin(-30) == -0.5 and cos(720) == 1)
assert(asin(0.5) == 30 and acos(0.5) == 60 and atan(1) == 45 and atan2(1, 1) == 45 and atan2(-1, -1) == -135)
assert(sind(30) == sin(30) and cosd(10) == cos(10) and tand(10) == tan(10) and asind(0.3) == asin(0.3))
assert(acosd(0.3) == acos(0.3) and atand(3) == atan(3) and atan2d(1, 2) == atan2(1, 2))
assert(math.sin(math.pi / 2) == 1) -- Lua's own stays in radians
assert(math.abs(sin(45) - math.sqrt(0.5)) < 1e-16 and sin(45) == cos(45))

-- Quarter turns are exact, whichever way they are written.
local box = cube(1, 2, 3)
local turned = box:rotate(0, 0, 90)
for _, form in ipairs{box:rotate(90), box:rotate{z = 90}, box:rz(90), box:rotate(90, {0, 0, 5}), box:rotate(-270),
                      rotate(90) * box, rotate(30) * rotate(60) * box, box:multmatrix{{0, -1}, {1, 0}}} do
  assert(form:size()[1] == 2 and form:size()[2] == 1)
end
assert(box:rotate(90, 0, 0) == box:rx(90) and box:rotate(0, 90, 0) == box:ry(90))
assert(box:rotate(10, 20, 30) == box:rx(10):ry(20):rz(30))
assert(box:mirror(1, 0, 0):mirror(1, 0, 0) == box and box:mirror(0, 0, 0) == box)
assert(box:mirror{1, 1, 0}:size()[1] == 2)
return turned
