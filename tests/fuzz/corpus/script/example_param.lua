local part, a, b, plate, hole, slot, lid = cube(3), cube(1), cube(2), cube(4), cube(1), cube(2), cube(5)
local v = param("hole_radius", 4, {min = 1, max = 10})
return type(v) == "solid" and v or cube(1)
