-- A plate for a door, with raised letters, a sunken border and countersunk holes. It grows with its text.

local threads = require "csg.threads"

local label  = param("label", "WORKSHOP", {doc = "what stands on it"})
local height = param("height", 12, {min = 4, max = 60, doc = "of the capitals, mm"})
local screw  = param("screw", "M4", {choices = {"M3", "M4", "M5"}})

local thickness, relief, margin = 4, 1.2, height * 0.8
local letters = text(label, {size = height, halign = "center", valign = "center", fn = 32})
local width = letters:size()[1] + 2 * margin + 24

local function rounded(inset)
  return square{width - 2 * inset, height * 2.4 - 2 * inset, center = true, r = 5 - inset, fn = 48}
end

local plate = rounded(0):linear_extrude(thickness)
local groove = (rounded(2) - rounded(2.8)):linear_extrude(relief):up(thickness - relief)
local hole = threads.hole{size = screw, depth = thickness, head = "flat"}:up(thickness)
local holes = hole:right(width / 2 - 9) + hole:left(width / 2 - 9)

return {
  plate = (plate - groove - holes):color("saddlebrown"),
  letters = letters:linear_extrude(relief):up(thickness):color("gold"),
}
