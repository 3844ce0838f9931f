--- Putting parts beside, onto and around one another by their bounding boxes.
---
---   local layout = require "csg.layout"
---   emit(layout.row({box, lid, knob}, {gap = 5}))
---   local tower = union(layout.stack{base, drum, cap})
---   local lamp  = base + layout.attach(shade, base, "top")
---
--- Works on solids. Functions that distribute give a list, for union(), emit() or a loop; the arrays
--- that are built in (linear_array, grid_array, polar_array) give the union.

local options = require "csg.options"

local layout = {}

local kAxes = {x = 1, y = 2, z = 3}

local function solid_of(name, part)
  if type(part) ~= "userdata" then error(name .. ": wants a solid, got " .. tostring(part), 3) end
end

-- How far a list goes: to its last entry, also behind a hole, where ipairs ends. `what` the list is
-- stands in the message about names in it.
local function length_of(name, what, list)
  local length = 0
  for key in pairs(list) do
    if math.type(key) ~= "integer" or key < 1 then
      error(name .. ": " .. what .. " must be a list without names, got the key '" .. tostring(key)
            .. "'", 4)
    end
    length = math.max(length, key)
  end
  return length
end

local function list_of(name, parts)
  if type(parts) ~= "table" then
    error(name .. ": wants a list of solids, got " .. tostring(parts), 3)
  end
  for i = 1, length_of(name, "what it places", parts) do
    local part = parts[i]
    if type(part) ~= "userdata" then
      error(name .. ": part " .. i .. " must be a solid, got " .. tostring(part), 3)
    end
    if part:is_empty() then error(name .. ": part " .. i .. " is empty", 3) end
  end
  return parts
end

local function count_of(name, count)
  local whole = type(count) == "number" and math.tointeger(count)
  if not whole or whole < 1 then
    error(name .. ": wants how many, a whole number from 1, got " .. tostring(count), 3)
  end
  return whole
end

-- The functions of the same names that are built in.
layout.anchor, layout.attach, layout.align, layout.centered = anchor, attach, align, centered

--- The part, moved so that its anchor ("top left", "center"; sides as anchor() has them) lies in a
--- point {x, y, z}.
---@param part Solid
---@param where string
---@param point number[]
---@return Solid
function layout.place(part, where, point)
  solid_of("layout.place", part)
  if type(point) ~= "table" then
    error("layout.place: wants a point {x, y, z}, got " .. tostring(point), 2)
  end
  local from = anchor(part, where)
  for i = 1, #from do
    local number = point[i]
    if number == nil and i == 3 then number = 0 end
    if type(number) ~= "number" then
      error("layout.place: wants a point {x, y, z}, but entry " .. i .. " is " .. tostring(number), 2)
    end
  end
  return part:translate(point[1] - from[1], point[2] - from[2], (point[3] or 0) - (from[3] or 0))
end

local function row(name, parts, o)
  local axis, placed = kAxes[o.axis], {}
  local next_start = nil
  for i, part in ipairs(parts) do
    local box, move = part:bbox(), {0, 0, 0}
    if not box.min[axis] then
      error(name .. ": part " .. i .. " must be a solid, got a shape, which has no z", 3)
    end
    if next_start then move[axis] = next_start - box.min[axis] end
    next_start = box.max[axis] + move[axis] + o.gap
    for other = 1, 3 do
      if other ~= axis and o.align ~= "none" and box.min[other] and parts[1]:bbox().min[other] then
        local direction = o.align == "min" and -1 or o.align == "max" and 1 or 0
        local function at(b)
          return direction == -1 and b.min[other] or direction == 1 and b.max[other]
              or (b.min[other] + b.max[other]) / 2
        end
        move[other] = at(parts[1]:bbox()) - at(box)
      end
    end
    placed[i] = part:translate(move)
  end
  return placed
end

local kAlign = {"none", choices = {"none", "min", "center", "max"}}

--- The parts one after another along an axis; the first stays where it is. Options: gap [5 mm],
--- axis ["x"], align ["none"; "min", "center" or "max": where they stand across the row, as the
--- first].
---@param parts Solid[]
---@param given? table
---@return Solid[]
function layout.row(parts, given)
  list_of("layout.row", parts)
  return row("layout.row", parts, options("layout.row", given or {}, {
    gap = {5}, axis = {"x", choices = {"x", "y", "z"}}, align = kAlign,
  }))
end

--- The parts on top of one another, with their middles above the middle of the first. Options: gap
--- [0 mm], align ["center"].
---@param parts Solid[]
---@param given? table
---@return Solid[]
function layout.stack(parts, given)
  list_of("layout.stack", parts)
  local o = options("layout.stack", given or {}, {
    gap = {0}, align = {"center", choices = kAlign.choices},
  })
  o.axis = "z"
  return row("layout.stack", parts, o)
end

--- The parts in rows along X, rows along -Y, each in a cell as large as the largest part. Options:
--- columns [as many as make a square], gap [5 mm]. The first part stays where it is.
---@param parts Solid[]
---@param given? table
---@return Solid[]
function layout.grid(parts, given)
  list_of("layout.grid", parts)
  local o = options("layout.grid", given or {}, {
    columns = {math.max(1, math.ceil(math.sqrt(#parts))), min = 1, whole = true}, gap = {5},
  })
  local cell = {0, 0}
  for _, part in ipairs(parts) do
    local size = part:size()
    cell = {math.max(cell[1], size[1]), math.max(cell[2], size[2])}
  end
  local placed, origin = {}, parts[1] and anchor(parts[1], "center")
  for i, part in ipairs(parts) do
    local column, line = (i - 1) % o.columns, (i - 1) // o.columns
    local middle = anchor(part, "center")
    placed[i] = part:translate(origin[1] + column * (cell[1] + o.gap) - middle[1],
                               origin[2] - line * (cell[2] + o.gap) - middle[2], 0)
  end
  return placed
end

--- `count` copies, each moved by `step` {x, y, z} from the one before; or, with the option to =
--- {x, y, z}, evenly from where the part is to there.
---@param part Solid
---@param count integer
---@param given table
---@return Solid[]
function layout.line(part, count, given)
  solid_of("layout.line", part)
  count = count_of("layout.line", count)
  local o = options("layout.line", given, {
    step = {type = "table", optional = true}, to = {type = "table", optional = true},
  })
  if (o.step == nil) == (o.to == nil) then
    error("layout.line: wants either step = {x, y, z} or to = {x, y, z}", 2)
  end
  local step = o.step or {}
  local to = o.to or {}
  for i = 1, length_of("layout.line", "option 'to'", to) do
    if type(to[i]) ~= "number" then
      error("layout.line: option 'to' must be {x, y, z}, but entry " .. i .. " is " .. tostring(to[i]), 2)
    end
    step[i] = to[i] / math.max(count - 1, 1)
  end
  return part:linear_array{count, step, list = true}
end

--- `count` copies around Z. Options: radius [0: how far along X the part is moved first], angle
--- [360: of the whole; less than a full turn has a copy at each end], start [0 degrees], turn
--- [true: the copies turn along; false: they keep their direction].
---@param part Solid
---@param count integer
---@param given? table
---@return Solid[]
function layout.ring(part, count, given)
  solid_of("layout.ring", part)
  count = count_of("layout.ring", count)
  local o = options("layout.ring", given or {}, {
    radius = {0}, angle = {360, min = -360, max = 360}, start = {0}, turn = {true},
  })
  if o.turn then
    return part:translate(o.radius, 0, 0):rotate(o.start):polar_array{count, o.angle, list = true}
  end
  local gaps = math.abs(o.angle) == 360 and count or math.max(count - 1, 1)
  local copies = {}
  for i = 1, count do
    local angle = o.start + o.angle * (i - 1) / gaps
    copies[i] = part:translate(o.radius * cos(angle), o.radius * sin(angle), 0)
  end
  return copies
end

--- A copy at each point {x, y, z} of a list.
---@param part Solid
---@param points number[][]
---@return Solid[]
function layout.at(part, points)
  solid_of("layout.at", part)
  if type(points) ~= "table" then
    error("layout.at: wants a list of points {x, y, z}, got " .. tostring(points), 2)
  end
  local copies = {}
  for i = 1, length_of("layout.at", "the points", points) do
    local point = points[i]
    if type(point) ~= "table" then
      error("layout.at: point " .. i .. " must be {x, y, z}, got " .. tostring(point), 2)
    end
    for k = 1, length_of("layout.at", "point " .. i, point) do
      if point[k] == nil then
        error("layout.at: point " .. i .. " must be {x, y, z}, but entry " .. k .. " is nil", 2)
      end
    end
    copies[i] = part:translate(point[1] or 0, point[2] or 0, point[3] or 0)
  end
  return copies
end

return layout
