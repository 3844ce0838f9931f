-- A planetary gear set: sun, planets, ring and carrier, in mesh, each a part with its own name.
--
-- The teeth are phased by calculation. The script proves that nothing collides: what two parts have
-- in common must be empty, and csgrun decides that exactly.

local involute = require "involute"  -- csgrun_modules/involute.lua

local sun_teeth    = param("sun_teeth", 24, {min = 12, max = 60, step = 1})
local planet_teeth = param("planet_teeth", 18, {min = 12, max = 60, step = 1})
local planets      = param("planets", 4, {min = 2, max = 8, step = 1})
local modul        = param("module", 1.5, {min = 0.5, max = 5, doc = "pitch diameter / teeth"})
local width        = param("width", 8, {min = 2, max = 50, doc = "of the gears, mm"})
local backlash     = param("backlash", 0.1, {min = 0.05, max = 0.5, doc = "of each gear, mm"})
local turn         = param("turn", 0, {doc = "of the sun, degrees; the others follow"})

local ring_teeth = sun_teeth + 2 * planet_teeth
if (sun_teeth + ring_teeth) % planets ~= 0 then
  error(("%d planets cannot be spaced evenly: they must divide %d"):format(
    planets, sun_teeth + ring_teeth))
end

local function gear(teeth, internal)
  return involute.gear{teeth = teeth, modul = modul, backlash = backlash, internal = internal}
end

local distance = modul * (sun_teeth + planet_teeth) / 2
local reach = modul * ring_teeth / 2
local axle  = circle{r = modul * planet_teeth * 0.2, fn = 48}

local sun  = (gear(sun_teeth) - circle{d = modul * 6, fn = 6}):linear_extrude(width):rotate(turn)
local ring = (circle{r = reach + 4 * modul, fn = 180} - gear(ring_teeth, true))
  :linear_extrude(width):rotate(180 * (planet_teeth - 1) / ring_teeth)

-- The carrier turns by the sun's share of all teeth; the planets roll on the sun, the ring stands.
-- In `at` a gap of the planet faces the sun's tooth.
local carried = turn * sun_teeth / (sun_teeth + ring_teeth)
local wheel = (gear(planet_teeth) - axle):linear_extrude(width)
local wheels, axles = {}, {}
for i = 1, planets do
  local at = 360 / planets * i + carried
  local spin = at + 180 + (sun_teeth * (at - turn) - 180) / planet_teeth
  wheels[i] = wheel:rotate(spin - at):right(distance):rotate(at)
  axles[i] = axle:linear_extrude(width):right(distance):rotate(at)
end

-- The axles fill the bores of the planets; their ends lie in the planets' tops.
local plate = circle{r = distance + modul * planet_teeth * 0.3, fn = 96} - circle{d = modul * 8, fn = 64}
local carrier = plate:linear_extrude(3):down(3) + union(axles)

local all_wheels = union(wheels)
assert(all_wheels:components() == planets, "the planets touch one another")
assert((all_wheels * sun):is_empty(), "planets and sun collide")
assert((all_wheels * ring):is_empty(), "planets and ring collide")

return {
  sun     = sun:color("goldenrod"),
  planets = all_wheels:color("steelblue"),
  ring    = ring:color("dimgray"),
  carrier = carrier:color("firebrick"),
}
