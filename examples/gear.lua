-- A spur gear with involute teeth, a bore with a keyway, and holes that save weight.
--
-- The teeth are one solid turned about Z again and again. They are as high as the disc, and every
-- turn keeps their tops in its top exactly, so the gear has one flat face above and one below.

local involute = require "involute"  -- csgrun_modules/involute.lua

local teeth    = param("teeth", 24, {min = 12, max = 80, step = 1})
local modul    = param("module", 2, {min = 0.5, max = 10, doc = "pitch diameter / teeth"})
local width    = param("width", 8, {min = 1, max = 100, doc = "of the teeth, mm"})
local bore     = param("bore", 8, {min = 1, max = 100, doc = "diameter of the shaft"})
local pressure = param("pressure", 20, {min = 14.5, max = 30, doc = "angle, degrees"})
local holes    = param("holes", 6, {min = 0, max = 12, step = 1, doc = "that save weight"})

local gear  = {teeth = teeth, modul = modul, pressure = pressure}
local radii = involute.radii(gear)

local tooth = involute.tooth(gear):linear_extrude(width)
local body  = cylinder{h = width, r = radii.root, fn = 4 * teeth}
for i = 1, teeth do
  body = body + tooth:rotate(360 / teeth * i)
end

-- A hub on one side, as wide as twice the shaft; the keyway is a quarter of the shaft wide.
local hub   = cylinder{h = width * 1.5, r = bore, fn = 64}
local shaft = cylinder{h = width * 1.5, d = bore, fn = 64}
local key   = cube(bore * 0.7, bore / 4, width * 1.5):translate(0, -bore / 8, 0)
local part  = body + hub - shaft - key

-- The holes fill the web between hub and teeth, as far as they leave a module of wall.
local middle = (radii.root + bore) / 2
local room = math.min(radii.root - bore, 2 * middle * sin(180 / math.max(holes, 2))) - modul
if room >= modul then
  local hole = cylinder{h = width, d = room, fn = 48}:right(middle)
  for i = 1, holes do
    part = part - hole:rotate(360 / holes * (i + 0.5))
  end
end

return part:color("burlywood")
