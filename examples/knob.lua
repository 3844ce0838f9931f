-- A knob with a diamond knurl for a potentiometer's D-shaft, and an inlaid pointer.
--
-- The knurl is what two prisms have in common that are twisted in opposite directions. The pointer's
-- pocket is the pointer itself, so that it fits without a gap, for a print in two colours.

local diameter = param("diameter", 24, {min = 12, max = 80, doc = "over the knurl, mm"})
local height   = param("height", 16, {min = 10, max = 60})
local ridges   = param("ridges", 30, {min = 8, max = 72, step = 1, doc = "of the knurl, each way"})
local rows     = param("rows", 6, {min = 2, max = 40, step = 1, doc = "of half diamonds"})
local deep     = param("deep", 0.8, {min = 0.2, max = 2, doc = "depth of the knurl"})
local shaft    = param("shaft", 6, {min = 3, max = 10, doc = "diameter of the shaft"})

-- A grid of a micrometre: where the ridges of both prisms meet, they meet in the very same points.
csg.grid = 0.001

local r = diameter / 2
local bevel = 1.5

-- A star: the outline of the knurl.
local points = {}
for i = 0, 2 * ridges - 1 do
  local radius = i % 2 == 0 and r or r - deep
  local angle = 180 / ridges * i
  points[#points + 1] = {radius * cos(angle), radius * sin(angle)}
end
local star = polygon(points)

-- A layer turns by half a ridge, so the ridges of the two prisms cross exactly between two layers.
local turn = rows * 180 / ridges
local knurl = star:linear_extrude(height, {twist = turn, slices = rows, segments = 0})
            * star:linear_extrude(height, {twist = -turn, slices = rows, segments = 0})

-- The body: bevelled edges, and a foot that is not knurled.
local body = polygon{
  {0, 0}, {r, 0}, {r, 2}, {r + 1, 3}, {r + 1, height - bevel - 1}, {r - bevel, height}, {0, height},
}:rotate_extrude{fn = 96}
local foot = cylinder{h = 3, r = r - deep, fn = 96}

-- The shaft's cross-section is a D: a circle less what lies beyond its flat.
local d_shape = circle{d = shaft, fn = 48} - square(shaft, shaft):translate(shaft / 4, -shaft / 2)
local bore = d_shape:linear_extrude(height * 0.7)

local pointer = cube(r - bevel - 3, 1.6, 1):translate(3, -0.8, height - 1)

return {
  knob    = ((knurl * body + foot) - bore - pointer):color("#30343c"),
  pointer = pointer:color("white"),
}
