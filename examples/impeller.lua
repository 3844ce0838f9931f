-- The impeller of a pump: curved blades on a disc, one blade turned about the axis again and again.
--
-- Seven blades are turned by angles that no computer can write down, and still all of them begin in
-- the plane of the disc's back: there is one flat face below, and no sliver.

local blades   = param("blades", 7, {min = 3, max = 15, step = 1})
local diameter = param("diameter", 80, {min = 30, max = 300, doc = "of the disc, mm"})
local height   = param("height", 22, {min = 8, max = 100, doc = "of the blades at the hub"})
local rim      = param("rim", 9, {min = 2, max = 100, doc = "height of the blades at the rim"})
local plate    = param("plate", 3, {min = 1, max = 20, doc = "thickness of the disc"})
local blade    = param("blade", 2.4, {min = 0.8, max = 10, doc = "thickness of a blade"})
local shaft    = param("shaft", 8, {min = 2, max = 60, doc = "across the flats of the shaft"})

csg.fn = 120

local r = diameter / 2
local tip = r - plate / 2  -- where the blades end
local hub = math.max(r * 0.28, shaft)

-- Half of the cross-section, from the axis outwards: what a blade may fill, and the hub with the disc.
local envelope = polygon{
  {0, 0}, {tip, 0}, {tip, plate + rim}, {r * 0.7, plate + rim + (height - rim) * 0.25},
  {hub, plate + height}, {0, plate + height},
}:rotate_extrude()

local nose = {{0, 0}, {hub, 0}}
for angle = 0, 90, 10 do
  nose[#nose + 1] = {hub * cos(angle), plate + height - hub * 0.6 + hub * sin(angle)}
end
local core = polygon(nose):rotate_extrude() + cylinder{h = plate, r = r}

-- A blade is a strip of a ring that begins in the hub and sweeps outwards.
local sweep = r * 0.72
local arc = circle(sweep + blade / 2) - circle(sweep - blade / 2)
local strip = (arc:translate(0, sweep) * square(2 * r, 2 * sweep)):linear_extrude(height + plate)

local body = core
for i = 1, blades do
  body = body + (strip * envelope):rotate(360 / blades * i)
end

-- The shaft is a hexagon.
local bore = cylinder{h = plate + height + hub, d = shaft / cos(30), fn = 6}
return body:color("lightsteelblue") - bore:color("dimgray")
