-- A pair of herringbone gears, as 3D printers like them: they need no thrust bearing.

local gears = require "csg.gears"

local modul  = param("module", 2, {min = 0.5, max = 8, doc = "pitch diameter / teeth"})
local large  = param("large", 36, {min = 12, max = 90, step = 1, doc = "teeth of the wheel"})
local small  = param("small", 15, {min = 10, max = 60, step = 1, doc = "teeth of the pinion"})
local width  = param("width", 14, {min = 4, max = 60})
local helix  = param("helix", 28, {min = 0, max = 45, doc = "degrees"})
local at     = param("at", 25, {min = -180, max = 180, doc = "where the pinion stands, degrees"})

local function gear(teeth, angle)
  return gears.spur{teeth = teeth, module = modul, width = width, helix = angle, herringbone = true,
                    bore = 6, backlash = 0.1 * modul}
end

local wheel = gear(large, helix)
local radii = gears.radii{teeth = large, module = modul}
local window = cylinder{h = width, d = radii.root * 0.42, fn = 48}:right(radii.root * 0.62)
for i = 0, 4 do wheel = wheel - window:rotate(72 * i) end

local pinion = gears.meshed(gear(small, -helix), large, small, {module = modul, at = at})
assert((wheel * pinion):is_empty(), "the teeth collide")

return {wheel = wheel:color("darkorange"), pinion = pinion:color("slategray")}
