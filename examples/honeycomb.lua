-- A ventilation grille: a frame filled with a honeycomb, drawn in two dimensions and extruded.
--
-- Cells that the frame would cut are cut by it: their walls end in the frame without a gap, and the
-- whole outline is one shape before it becomes a solid.

local width  = param("width", 90, {min = 20, max = 500, doc = "along X, mm"})
local height = param("height", 60, {min = 20, max = 500, doc = "along Y, mm"})
local depth  = param("depth", 4, {min = 0.5, max = 50})
local cell   = param("cell", 8, {min = 2, max = 50, doc = "across the flats of a cell"})
local wall   = param("wall", 1.2, {min = 0.2, max = 10, doc = "between two cells"})
local frame  = param("frame", 6, {min = 1, max = 50, doc = "width of the frame"})
local screw  = param("screw", 3.2, {min = 1, max = 10, doc = "diameter of the holes in the corners"})

local outer = square{width, height, center = true}
local inner = square{width - 2 * frame, height - 2 * frame, center = true}

-- A hexagon with flats at the left and the right.
local hexagon = circle{d = cell / cos(30), fn = 6}:rotate(30)

-- Rows of cells about the middle; every second row is moved by half a step.
local step_x = cell + wall
local step_y = step_x * cos(30)
local cells = {}
for row = -math.ceil(height / 2 / step_y), math.ceil(height / 2 / step_y) do
  for column = -math.ceil(width / 2 / step_x), math.ceil(width / 2 / step_x) do
    local x = (column + row % 2 / 2) * step_x
    cells[#cells + 1] = hexagon:translate(x, row * step_y)
  end
end

local holes = {}
for _, x in ipairs{-1, 1} do
  for _, y in ipairs{-1, 1} do
    holes[#holes + 1] = circle{d = screw, fn = 32}
      :translate(x * (width - frame) / 2, y * (height - frame) / 2)
  end
end

local outline = outer - inner * union(cells) - union(holes)
return outline:linear_extrude(depth):color("darkslategray")
