-- An angle bracket: two plates with rounded corners, a fillet and ribs between them, countersunk
-- holes in the foot and a slot in the wall.
--
--   csgrun examples/bracket.lua -o bracket.glb
--   csgrun examples/bracket.lua -D width=80 -D screw=5 -o wide.stl

local width     = param("width", 60, {min = 30, max = 200, doc = "along X, mm"})
local depth     = param("depth", 40, {min = 25, max = 200, doc = "of the foot, along Y"})
local height    = param("height", 50, {min = 30, max = 200, doc = "of the wall, along Z"})
local thickness = param("thickness", 5, {min = 2, max = 12, doc = "of both plates"})
local screw     = param("screw", 4, {min = 2, max = 8, doc = "diameter of the screws"})
local corner    = param("corner", 8, {min = 1, max = 12, doc = "radius of the corners"})

csg.fn = 64

-- A rectangle from (0, 0) whose two far corners are rounded.
local function plate_outline(w, d)
  return union{
    square(w, d - corner),
    square{w - 2 * corner, d}:translate(corner, 0),
    circle(corner):translate(corner, d - corner),
    circle(corner):translate(w - corner, d - corner),
  }
end

-- A screw hole from above, through a plate whose top is at z = 0: the shaft, and a cone for the head.
local function countersunk_hole()
  local shaft = cylinder{h = thickness, d = screw}:down(thickness)
  local head  = cylinder{h = screw / 2, d1 = screw, d2 = 2 * screw}:down(screw / 2)
  return shaft + head
end

local foot = plate_outline(width, depth):linear_extrude(thickness)
local wall = plate_outline(width, height):linear_extrude(thickness):rotate(90, 0, 0):back(thickness)

-- The inner edge: a square bar less a cylinder. Its faces lie in those of the plates, and nothing
-- has to overlap by a little: what touches exactly is joined exactly.
local radius = thickness
local fillet = (square(radius) - circle(radius):translate(radius, radius))
  :linear_extrude(width)
  :multmatrix{{0, 0, 1, 0}, {1, 0, 0, thickness}, {0, 1, 0, thickness}}

-- A rib: a triangle that leans on both plates.
local function rib(x)
  local leg = math.min(depth, height) - thickness - corner
  return polygon{{0, 0}, {leg, 0}, {0, leg}}
    :linear_extrude(thickness)
    :multmatrix{{0, 0, 1, x - thickness / 2}, {1, 0, 0, thickness}, {0, 1, 0, thickness}}
end

local body = foot + wall + fillet + rib(thickness / 2) + rib(width / 2) + rib(width - thickness / 2)

local holes = {}
for _, x in ipairs{width / 4, width * 3 / 4} do
  for _, y in ipairs{thickness + (depth - thickness) * 0.35, thickness + (depth - thickness) * 0.75} do
    holes[#holes + 1] = countersunk_hole():translate(x, y, thickness)
  end
end

-- The slot lets the wall be adjusted: two cylinders and the box between them.
local function slot(x)
  local shaft = cylinder{h = thickness, d = screw}
  local travel = height / 4
  local outline = shaft + shaft:back(travel) + cube(screw, travel, thickness):left(screw / 2)
  return outline:rotate(90, 0, 0):translate(x, thickness, height * 0.55)
end

return body - union(holes) - slot(width / 4) - slot(width * 3 / 4)
