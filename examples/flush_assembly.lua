-- Parts that lie flush with one another, turned together by odd angles.
--
-- A tray with a lid that fills its recess, pins that end in its faces, a label let into the lid. No
-- face is moved "by a little" to make it work: the assembly is turned by (20, 30, 40) degrees, and
-- what was flush before is flush after, to the last bit. Each part is a node of its own in the GLB.

local turn = param("turn", {20, 30, 40}, {doc = "angles about X, Y and Z"})

local wall, floor_z = 3, 4
local inside = cube(60, 40, 20)

local tray = cube(60 + 2 * wall, 40 + 2 * wall, 20 + floor_z)
  - inside:translate(wall, wall, floor_z)

-- The lid fills the opening and its top lies in the rim's plane.
local lid = cube(60, 40, 5):translate(wall, wall, 20 + floor_z - 5)

-- The pins go through the wall and end in its two faces.
local pins = {}
for i = 1, 3 do
  pins[i] = cylinder{h = wall, r = 2, fn = 24}:rotate(0, 90, 0):translate(0, wall + 10 * i, 10)
end
local all_pins = union(pins)

-- The label lies in the lid like an inlay: as deep as its pocket.
local label = polygon{{0, 0}, {24, 0}, {30, 6}, {24, 12}, {0, 12}}
  :linear_extrude(1)
  :translate(18, 17, 20 + floor_z - 1)

local function placed(part) return part:rotate(turn) end

return {
  tray  = placed(tray - all_pins):color("steelblue"),
  lid   = placed(lid - label):color("gold"),
  pins  = placed(all_pins):color("dimgray"),
  label = placed(label):color("firebrick"),
}
