csg.grid = 0.25
local s = cube(1.1)
csg.grid = "2^-10mm"
return s - cube(1.05):translate(0.05, 0.05, 0.05)
