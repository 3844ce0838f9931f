csg.fn = 5
local p = polygon{{1, 0}, {3, 0}, {2, 1}}
return p:rotate_extrude(200), p:linear_extrude{height = 2, scale = 0}
