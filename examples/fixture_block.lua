-- A block of a clamping fixture: edges are chosen by where they are, and cut. The upright edges are
-- rounded first, then the rim of the top is chamfered all round, with the mouth of each hole on it.
--
--   csgrun examples/fixture_block.lua -o fixture_block.glb

local size    = param("size", 60, {min = 40, max = 200, doc = "of the base, along X"})
local round   = param("round", 8, {min = 3, max = 15, doc = "radius of the upright edges"})
local chamfer = param("chamfer", 1.5, {min = 0.5, max = 2.5, doc = "of the rims"})

csg.fn = 48

local depth, height = size * 2 / 3, 20
local base = cube(size, depth, height):fillet(round, {edges = "z"})

-- A step at the back, whose inner edge is concave and stays sharp.
local step = cube(size / 3, depth, 10):fillet(round, {edges = {along = "z", on = "left"}})
local body = base + step:up(height)

-- Holes in the lower level, a pocket for a nut between them.
for _, y in ipairs{depth / 4, depth * 3 / 4} do
  body = body - cylinder{h = 3 * height, r = 4, center = true}:translate(size * 0.75, y, 0)
end
body = body - cube{10, 10, 12, center = true}:translate(size / 2, depth / 2, height)

-- The faces that look up: the rim of the step, and the lower one with its holes and its pocket.
return body
  :chamfer(chamfer, {edges = {normal = {0, 0, 1}}})
  :fillet(1, {edges = {on = "bottom"}, fn = 16})
