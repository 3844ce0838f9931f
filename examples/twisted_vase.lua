-- A vase whose star-shaped walls turn and widen as they rise; the inside is the same shape, smaller.

local points = param("points", 9, {min = 3, max = 24, step = 1, doc = "of the star"})
local radius = param("radius", 30, {min = 10, max = 100, doc = "at the foot, mm"})
local height = param("height", 120, {min = 20, max = 300})
local wall   = param("wall", 2, {min = 0.8, max = 6})
local turn   = param("turn", 80, {min = -360, max = 360, doc = "over the whole height, degrees"})

local outline = {}
for i = 0, 2 * points - 1 do
  local r = radius * (i % 2 == 0 and 1 or 0.8)
  outline[#outline + 1] = {r * cos(180 * i / points), r * sin(180 * i / points)}
end
local foot = polygon(outline):offset{r = 4, fn = 32}:offset{r = -4, fn = 32}

local function rising(shape, from)
  local options = {height = height, twist = -turn, scale = 1.35, slices = 60, segments = 0}
  return shape:linear_extrude(options) - (from > 0 and cube{400, 400, 2 * from, center = true} or union{})
end

return (rising(foot, 0) - rising(foot:offset{delta = -wall}, 3)):color("cadetblue")
