-- A ball with three bores and the rods that would fit them: the sign of constructive solid geometry.

local size = param("size", 50, {min = 10, max = 200, doc = "diameter of the ball, mm"})

csg.fn = 100
local rod = cylinder{h = size * 1.25, d = size * 0.5, center = true}
local ball = sphere{d = size} - rod - rod:rotate(90, 0, 0) - rod:rotate(0, 90, 0)

local half = cylinder{h = size * 0.625, d = size * 0.46}
return {
  ball = ball:color("gold"),
  z = (half - sphere{d = size * 0.6}):color("crimson"),
  x = (half:rotate(0, 90, 0) - sphere{d = size * 0.6}):color("crimson"),
}
