local part, a, b, plate, hole, slot, lid = cube(3), cube(1), cube(2), cube(4), cube(1), cube(2), cube(5)
local v = polyhedron{points = {{0,0,0},{1,0,0},{0,1,0},{0,0,1}}, faces = {{0,1,2},{0,3,1},{0,2,3},{1,3,2}}}
return type(v) == "solid" and v or cube(1)
