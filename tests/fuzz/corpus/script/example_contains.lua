local part, a, b, plate, hole, slot, lid = cube(3), cube(1), cube(2), cube(4), cube(1), cube(2), cube(5)
local v = part:contains(0, 0, 5)
return type(v) == "solid" and v or cube(1)
