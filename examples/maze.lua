-- A marble maze: every cell is reached, on one way only. The seed decides which maze it is.

local columns = param("columns", 12, {min = 2, max = 60, step = 1})
local rows    = param("rows", 9, {min = 2, max = 60, step = 1})
local seed    = param("seed", 7, {step = 1})
local cell    = param("cell", 8, {min = 3, max = 40, doc = "width of a way, mm"})

local wall, depth, floor_height = 1.6, cell * 0.7, 2
math.randomseed(seed)

-- From a cell to a random one that was not seen yet, until all were seen; and back where there is none.
local pitch = cell + wall
local ways, seen, trail = {}, {["0 0"] = true}, {{0, 0}}
local steps = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}}
while #trail > 0 do
  local x, y = trail[#trail][1], trail[#trail][2]
  local open = {}
  for _, s in ipairs(steps) do
    local nx, ny = x + s[1], y + s[2]
    if nx >= 0 and nx < columns and ny >= 0 and ny < rows and not seen[nx .. " " .. ny] then
      open[#open + 1] = {nx, ny}
    end
  end
  if #open == 0 then
    table.remove(trail)
  else
    local to = open[math.random(#open)]
    seen[to[1] .. " " .. to[2]] = true
    trail[#trail + 1] = to
    -- The way between two cells is one slot, as long as both; slots meet in their cells.
    ways[#ways + 1] = square(math.abs(to[1] - x) * pitch + cell, math.abs(to[2] - y) * pitch + cell)
      :translate(math.min(x, to[1]) * pitch, math.min(y, to[2]) * pitch)
  end
end

local plate = square(columns * pitch + wall, rows * pitch + wall):translate(-wall, -wall)
local exit_slot = square(wall, cell):translate(columns * pitch - wall, (rows - 1) * pitch)
local paths = union(ways) + exit_slot
assert(#paths:outlines() == 1 , "a way that is not connected, or a loop")

return plate:linear_extrude(floor_height) + (plate - paths):linear_extrude(depth):up(floor_height)
