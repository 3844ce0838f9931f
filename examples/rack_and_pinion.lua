-- A rack and its pinion, at any place along the way: -D travel=30 moves the one and turns the other.

local gears = require "csg.gears"

local modul  = param("module", 2, {min = 0.5, max = 8})
local teeth  = param("teeth", 18, {min = 10, max = 60, step = 1, doc = "of the pinion"})
local length = param("length", 16, {min = 4, max = 80, step = 1, doc = "of the rack, in teeth"})
local travel = param("travel", 0, {doc = "of the rack, mm"})
local width  = param("width", 8, {min = 2, max = 50})

local pitch = math.pi * modul
local rack = gears.rack{teeth = length, module = modul, width = width, backlash = 0.1}
  :translate(travel - pitch * (length // 2), 0, 0)
-- With a tooth of the rack below its axis, the pinion has a gap there: half a pitch from a tooth.
local radius = modul * teeth / 2
local pinion = gears.spur{teeth = teeth, module = modul, width = width, backlash = 0.1, bore = 5}
  :rotate(-90 + 180 / teeth + math.deg(travel / radius)):translate(0, radius, 0)

assert((rack * pinion):is_empty(), "the teeth collide")
return {rack = rack:color("dimgray"), pinion = pinion:color("peru")}
