-- A flat gasket for a cylinder head, drawn in two dimensions: a solid for the printer, or a drawing
-- for the cutter.
--
--   csgrun examples/gasket.lua -D thickness=0 -o gasket.svg        or .dxf

local bores     = param("bores", 3, {min = 1, max = 8, step = 1})
local bore      = param("bore", 48, {min = 10, max = 200, doc = "diameter, mm"})
local thickness = param("thickness", 1, {min = 0, max = 10, doc = "0: a drawing"})

csg.fn = 72
local pitch, ring, bolt = bore * 1.25, bore * 0.12, bore * 0.09

local discs, holes, bosses = {}, {}, {}
for i = 0, bores - 1 do
  discs[#discs + 1] = circle{d = bore + 2 * ring}:translate(i * pitch, 0)
  holes[#holes + 1] = circle{d = bore}:translate(i * pitch, 0)
end
for i = 0, bores do
  for _, side in ipairs{-1, 1} do
    local x, y = (i - 0.5) * pitch, side * (bore / 2 + ring * 0.4)
    bosses[#bosses + 1] = circle{d = bolt * 2.6}:translate(x, y)
    holes[#holes + 1] = circle{d = bolt}:translate(x, y)
  end
end

-- Moved out and in again, the outline gets rounded inner corners.
local body = union{discs, bosses, square((bores - 1) * pitch, bore):translate(0, -bore / 2)}
body = body:offset(4):offset(-4)
local gasket = body - union(holes)

return thickness > 0 and gasket:linear_extrude(thickness) or gasket
