-- A box for a week: seven trays in a row with sliding lids, letters sunk into them.

local layout = require "csg.layout"

local days = param("days", "MTWTFSS", {doc = "a letter for each tray"})
local tray = param("tray", 22, {min = 10, max = 80, doc = "inside, mm"})
local wall = param("wall", 1.6, {min = 0.8, max = 5})
local play = param("play", 0.2, {min = 0, max = 1})

local pitch, height = tray + wall, tray * 0.8
local lid_h = 2 * wall

-- Lids slide in grooves of dovetail form along Y: wide below, narrow above.
local function slide(extra)
  local w = tray / 2 + wall / 2 - extra
  return polygon{{-w, 0}, {w, 0}, {w - lid_h * 0.5, lid_h}, {-w + lid_h * 0.5, lid_h}}
end

local body = cube(#days * pitch + wall, tray + 2 * wall, height + lid_h + wall)
local lids = {}
for i = 1, #days do
  local x = wall + (i - 1) * pitch
  body = body - cube(tray, tray, height):translate(x, wall, wall)
              - slide(0):linear_extrude(tray + wall):rotate(90, 0, 0)
                :translate(x + tray / 2, tray + wall, wall + height)
  local letter = text(days:sub(i, i), {size = tray * 0.5, halign = "center", valign = "center", fn = 24})
  lids[i] = (slide(play):linear_extrude(tray + wall - play):rotate(90, 0, 0):translate(0, tray + wall, 0)
             - letter:linear_extrude(0.8):translate(0, tray / 2, lid_h - 0.8)):translate(0, 0, 0)
end

emit(body:color("lightblue"), {name = "box"})
for i, lid in ipairs(layout.row(lids, {gap = 3})) do
  emit(lid:translate(tray / 2 + wall, tray + 6 * wall, 0):color("white"), {name = "lids/" .. i .. days:sub(i, i)})
end
