-- A sheet of chainmail that comes off the printer in one piece: flat rings on a grid, and upright
-- rings that hold neighbours together.
--
-- Rings hang in one another and must not touch. The script counts the pieces to prove it: when the
-- wire is too thick for the pitch, it stops and says so.

local columns = param("columns", 5, {min = 1, max = 20, step = 1})
local rows    = param("rows", 4, {min = 1, max = 20, step = 1})
local radius  = param("radius", 6, {min = 2, max = 50, doc = "of a ring, to the middle of its wire"})
local wire    = param("wire", 2, {min = 0.5, max = 10, doc = "thickness of the wire"})
local pitch   = param("pitch", 17, {min = 5, max = 150, doc = "from ring to ring"})

local ring = circle{d = wire, fn = 12}:right(radius):rotate_extrude{fn = 32}
local flat = ring:color("silver")
local link = ring:rx(90):color("goldenrod")

local rings = {}
local function add(one, x, y) rings[#rings + 1] = one:translate(x * pitch, y * pitch) end

for x = 0, columns - 1 do
  for y = 0, rows - 1 do
    add(flat, x, y)
    if x < columns - 1 then add(link, x + 0.5, y) end
    if y < rows - 1 then add(link:rz(90), x, y + 0.5) end
  end
end

local mail = union(rings)
local pieces = mail:components()
if pieces ~= #rings then
  error(("the %d rings came out as %d pieces: they touch"):format(#rings, pieces))
end
return mail
