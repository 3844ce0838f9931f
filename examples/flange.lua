-- A pipe flange with its bolts, nuts and washers, from the shipped library of fasteners.

local threads = require "csg.threads"
local layout  = require "csg.layout"

local bore  = param("bore", 40, {min = 10, max = 300, doc = "inside of the pipe, mm"})
local bolts = param("bolts", 6, {min = 3, max = 24, step = 1})
local size  = param("size", "M6", {choices = {"M4", "M5", "M6", "M8", "M10"}})

csg.fn = 96
local m = threads.size(size)
local wall, thickness = bore * 0.08, 1.6 * m.d
local circle_radius = bore / 2 + wall + m.socket[1]
local outside = circle_radius + 1.2 * m.d

local hole = threads.hole{size = size, depth = thickness}:up(thickness)
local half = cylinder{h = thickness, r = outside}
           + cylinder{h = thickness + bore * 0.6, r = bore / 2 + wall}
           - cylinder{h = thickness + bore * 0.6, d = bore}
half = half - union(layout.ring(hole, bolts, {radius = circle_radius}))

-- Two halves, face to face; a bolt through both with a washer at each end.
local washer = threads.washer{size = size}
local reach = 2 * thickness + 2 * m.d / 5
local bolt = threads.bolt{size = size, length = reach + m.nut + m.pitch, threaded = 2 * m.d, head = "socket",
                          clearance = 0.05, facets = 24}
local stack = bolt:mirror(0, 0, 1):up(m.d + reach) + washer + washer:up(reach - m.d / 5)
local nut = threads.nut{size = size, facets = 24, clearance = 0.05}

local function around(part) return union(layout.ring(part, bolts, {radius = circle_radius})) end
local bottom = -thickness - m.d / 5
return {
  lower = half:mirror(0, 0, 1):color("steelblue"),
  upper = half:color("lightsteelblue"),
  bolts = around(stack:up(bottom) - nut:up(bottom - m.nut)):color("dimgray"),
  nuts = around(nut:up(bottom - m.nut)):color("gray"),
}
