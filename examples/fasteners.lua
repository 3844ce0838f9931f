-- Nuts and washers from M3 to M12, made from one table: a family of parts, in two groups.
--
--   csgrun examples/fasteners.lua -o fasteners.glb         nodes nuts/M3, nuts/M4, ... washers/M3 ...
--   csgrun examples/fasteners.lua -o 'out/%s.stl'          a file for each part

local gap = param("gap", 4, {min = 0, max = 50, doc = "between neighbours, mm"})
local play = param("play", 0.2, {min = 0, max = 1, doc = "added to the diameter of every hole"})

-- ISO 4032 and ISO 7089: across the flats and height of the nut; diameter, thickness of the washer.
local sizes = {
  {name = "M3",  thread = 3,  flats = 5.5, nut = 2.4,  washer = {7, 0.5}},
  {name = "M4",  thread = 4,  flats = 7,   nut = 3.2,  washer = {9, 0.8}},
  {name = "M5",  thread = 5,  flats = 8,   nut = 4.7,  washer = {10, 1}},
  {name = "M6",  thread = 6,  flats = 10,  nut = 5.2,  washer = {12, 1.6}},
  {name = "M8",  thread = 8,  flats = 13,  nut = 6.8,  washer = {16, 1.6}},
  {name = "M10", thread = 10, flats = 16,  nut = 8.4,  washer = {20, 2}},
  {name = "M12", thread = 12, flats = 18,  nut = 10.8, washer = {24, 2.5}},
}

csg.fn = 64

-- The upper and lower corners of a nut are turned off: it is a prism in two cones.
local function nut(size)
  local corners = size.flats / cos(30)
  local half = size.nut / 2
  local cone = cylinder{h = half, r1 = size.flats / 2 + half, r2 = size.flats * 0.475}
  local lens = cone + cone:mirror(0, 0, 1)
  local prism = cylinder{h = size.nut, d = corners, center = true, fn = 6}
  local hole = cylinder{h = size.nut, d = size.thread + play, center = true}
  return (prism * lens - hole):up(half)
end

local function washer(size)
  local diameter, thickness = size.washer[1], size.washer[2]
  return (circle{d = diameter} - circle{d = size.thread * 1.07 + play}):linear_extrude(thickness)
end

local x = 0
for _, size in ipairs(sizes) do
  local step = size.washer[1] + gap
  x = x + step / 2
  emit(nut(size):translate(x, 0, 0):color("goldenrod"), {name = "nuts/" .. size.name})
  emit(washer(size):translate(x, -26, 0):color("silver"), {name = "washers/" .. size.name})
  x = x + step / 2
end
