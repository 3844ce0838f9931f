-- What is flush stays flush: turned by odd angles, the combinatorics are those of what was not turned.
local function look(solid) return ("%d components, genus %d"):format(solid:components(), solid:genus()) end

local plate = cube{20, 20, 5}
local hole = cylinder(5, 4, {fn = 24}):translate(10, 10, 0) -- flush with both faces
local drilled = plate - hole
local odd = (plate - hole):rotate(20, 30, 40)
assert(look(drilled) == "1 components, genus 1" and look(odd) == look(drilled))
assert(math.abs(odd:volume() / drilled:volume() - 1) < 1e-10)
assert(look(plate:rotate(20, 30, 40) - hole:rotate(20, 30, 40)) == look(drilled))

-- Parts turned about Z are flush along Z.
local wheel = cylinder(3, 10, {fn = 48})
for i = 1, 17 do wheel = wheel + cube(4, 2, 3):translate(8, -1, 0):rotate(i * 360 / 17) end
assert(look(wheel) == "1 components, genus 0" and wheel:size()[3] == 3)

-- Towers of cubes by decimal steps.
local tower = cube(.1)
for i = 1, 9 do tower = tower + cube(.1):translate(0, 0, i * .1) end
assert(tower == cube(.1, .1, 1))
return wheel
