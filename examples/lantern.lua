-- A lantern for a tea light: a bellied vase with a wall of even thickness, pierced in a spiral.
--
-- Each hole is a cone from the axis, so it narrows inwards and lets the light fan out. Holes of a row
-- lie between those of the row below; their size follows the belly.

local height = param("height", 90, {min = 40, max = 300, doc = "mm"})
local foot   = param("foot", 28, {min = 20, max = 100, doc = "radius at the bottom"})
local belly  = param("belly", 14, {min = 0, max = 60, doc = "how far it bulges"})
local wall   = param("wall", 2.4, {min = 0.8, max = 10})
local rows   = param("rows", 7, {min = 1, max = 20, step = 1, doc = "of holes"})
local around = param("around", 15, {min = 3, max = 40, step = 1, doc = "holes in a row"})
local light  = param("light", 39, {min = 10, max = 80, doc = "diameter of the tea light"})

-- The radius of the vase at a height: a belly below, a neck above, a lip that opens again.
local function radius(z)
  local t = z / height
  return foot + belly * sin(200 * t) + 7 * t * t
end

local outline, steps = {{0, 0}}, 32
for i = 0, steps do
  local z = height * i / steps
  outline[#outline + 1] = {radius(z), z}
end
for i = steps, 0, -1 do
  local z = wall + (height - wall) * i / steps
  outline[#outline + 1] = {radius(z) - wall, z}
end
outline[#outline + 1] = {0, wall}
local vase = polygon(outline):rotate_extrude{fn = 96}:rotate(180 / 96)

-- A low rim keeps the tea light in the middle.
local rim = (circle{d = light + 2 * wall, fn = 96} - circle{d = light, fn = 96}):linear_extrude(wall + 3)

local first, last = height * 0.24, height * 0.86
local holes = {}
for row = 0, rows - 1 do
  local z = rows > 1 and first + (last - first) * row / (rows - 1) or (first + last) / 2
  local r = radius(z)
  local mouth = math.min(2 * math.pi * r / around, (last - first) / rows) * 0.42
  local cone = cylinder{h = r * 1.2, r1 = 0, r2 = mouth * 1.2, fn = 24}:rotate(0, 90, 0):up(z)
  for i = 1, around do
    holes[#holes + 1] = cone:rotate(360 / around * (i + row / 2))
  end
end

local lantern = vase + rim - union(holes)
assert(lantern:genus() == #holes, "holes run into one another")

return lantern:color("seashell")
