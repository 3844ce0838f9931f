-- The picture of every textbook on constructive solid geometry: a cube and a ball, what they share,
-- less three cylinders that cross in the middle.
--
-- A face keeps the colour of the solid that it comes from, also where that solid was the tool: red
-- is left of the cube, blue of the ball, green is what the cylinders cut.

local size = param("size", 40, {min = 1, max = 500, doc = "edge of the cube, mm"})
local bore = param("bore", 0.5, {min = 0.1, max = 0.9, doc = "diameter of the bores / size"})

csg.fn = 96

local box  = cube(size, {center = true}):color("crimson")
local ball = sphere(size * 0.66):color("royalblue")

-- The cylinders are exactly as long as the cube; they need not stick out.
local rod   = cylinder{h = size, d = size * bore, center = true}
local cross = (rod + rod:rx(90) + rod:ry(90)):color("limegreen")

return box * ball - cross
