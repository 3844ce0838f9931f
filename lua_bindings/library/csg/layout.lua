--- Putting parts beside, onto and around one another by their bounding boxes.
---
---   local layout = require "csg.layout"
---   emit(layout.row({box, lid, knob}, {gap = 5}))
---   local tower = union(layout.stack{base, drum, cap})
---   local lamp  = base + layout.attach(shade, "bottom", base, "top")
---
--- Works on solids. Functions that distribute give a list, for union(), emit() or a loop.

local options = require "csg.options"

local layout = {}

local kAxes = {x = 1, y = 2, z = 3}
local kSides = {
  left = {1, -1}, right = {1, 1}, front = {2, -1}, back = {2, 1}, bottom = {3, -1}, top = {3, 1},
  center = {},
}

local function list_of(name, parts)
  if type(parts) ~= "table" then
    error(name .. ": wants a list of solids, got " .. tostring(parts), 3)
  end
  for i, part in ipairs(parts) do
    if part:is_empty() then error(name .. ": part " .. i .. " is empty", 3) end
  end
  return parts
end

local function count_of(name, count)
  if math.type(count) ~= "integer" or count < 1 then
    error(name .. ": wants how many, a whole number from 1, got " .. tostring(count), 3)
  end
  return count
end

-- -1, 0 and 1 along each axis, from "top left", "center" or a list.
local function direction_of(name, where)
  local direction = {0, 0, 0}
  if type(where) == "table" and #where == 3 then
    for i = 1, 3 do
      if type(where[i]) ~= "number" or math.abs(where[i]) > 1 then
        error(name .. ": an anchor has three numbers from -1 to 1, got " .. tostring(where[i]), 3)
      end
      direction[i] = where[i]
    end
    return direction
  end
  if type(where) ~= "string" then
    error(name .. ": an anchor is a text such as \"top left\" or a list {x, y, z}, got "
          .. tostring(where), 3)
  end
  for word in where:gmatch("%a+") do
    local side = kSides[word]
    if not side then
      error(name .. ": there is no side '" .. word
            .. "'; there are left, right, front, back, bottom, top and center", 3)
    end
    if side[1] then
      if direction[side[1]] ~= 0 then
        error(name .. ": '" .. where .. "' names two sides of one axis", 3)
      end
      direction[side[1]] = side[2]
    end
  end
  return direction
end

local function point_at(part, direction)
  local box, point = part:bbox(), {}
  for i = 1, 3 do
    -- Corners are the box's own numbers: no rounding comes between parts that are to touch.
    local low, high, d = box.min[i], box.max[i], direction[i]
    point[i] = d == -1 and low or d == 1 and high or (low + high) / 2 + d * (high - low) / 2
  end
  return point
end

--- The point {x, y, z} of a solid's bounding box that is meant: "top", "bottom left", "center", or
--- {x, y, z} from -1 (least) to 1 (greatest) along each axis.
function layout.anchor(part, where)
  return point_at(part, direction_of("layout.anchor", where))
end

--- The part, moved so that its anchor lies in a point.
function layout.place(part, where, point)
  local from = point_at(part, direction_of("layout.place", where))
  return part:translate(point[1] - from[1], point[2] - from[2], (point[3] or 0) - from[3])
end

--- The part, moved so that its anchor `from` lies in the anchor `to` of the target. `gap` moves it
--- on, away from that side of the target.
function layout.attach(part, from, target, to, given)
  local o = options("layout.attach", given or {}, {gap = {0}})
  local start = point_at(part, direction_of("layout.attach", from))
  local side = direction_of("layout.attach", to)
  local goal = point_at(target, side)
  return part:translate(goal[1] + side[1] * o.gap - start[1],
                        goal[2] + side[2] * o.gap - start[2],
                        goal[3] + side[3] * o.gap - start[3])
end

local function row(parts, o)
  local axis, placed = kAxes[o.axis], {}
  local next_start = nil
  for i, part in ipairs(parts) do
    local box, move = part:bbox(), {0, 0, 0}
    if next_start then move[axis] = next_start - box.min[axis] end
    next_start = box.max[axis] + move[axis] + o.gap
    for other = 1, 3 do
      if other ~= axis and o.align ~= "none" then
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
function layout.row(parts, given)
  list_of("layout.row", parts)
  return row(parts, options("layout.row", given or {}, {
    gap = {5}, axis = {"x", choices = {"x", "y", "z"}}, align = kAlign,
  }))
end

--- The parts on top of one another, with their middles above the middle of the first. Options: gap
--- [0 mm], align ["center"].
function layout.stack(parts, given)
  list_of("layout.stack", parts)
  local o = options("layout.stack", given or {}, {
    gap = {0}, align = {"center", choices = kAlign.choices},
  })
  o.axis = "z"
  return row(parts, o)
end

--- The parts in rows along X, rows along -Y, each in a cell as large as the largest part. Options:
--- columns [as many as make a square], gap [5 mm]. The first part stays where it is.
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
  local placed, origin = {}, parts[1] and layout.anchor(parts[1], "center")
  for i, part in ipairs(parts) do
    local column, line = (i - 1) % o.columns, (i - 1) // o.columns
    local middle = layout.anchor(part, "center")
    placed[i] = part:translate(origin[1] + column * (cell[1] + o.gap) - middle[1],
                               origin[2] - line * (cell[2] + o.gap) - middle[2], 0)
  end
  return placed
end

--- `count` copies, each moved by `step` {x, y, z} from the one before; or, with the option to =
--- {x, y, z}, evenly from where the part is to there.
function layout.line(part, count, given)
  count_of("layout.line", count)
  local o = options("layout.line", given, {
    step = {type = "table", optional = true}, to = {type = "table", optional = true},
  })
  if (o.step == nil) == (o.to == nil) then
    error("layout.line: wants either step = {x, y, z} or to = {x, y, z}", 2)
  end
  local vector, parts = o.step or o.to, count - 1
  local copies = {}
  for i = 0, count - 1 do
    local t = o.step and i or parts > 0 and i / parts or 0
    copies[i + 1] = part:translate((vector[1] or 0) * t, (vector[2] or 0) * t, (vector[3] or 0) * t)
  end
  return copies
end

--- `count` copies around Z. Options: radius [0: how far along X the part is moved first], angle
--- [360: of the whole; less than a full turn has a copy at each end], start [0 degrees], turn
--- [true: the copies turn along; false: they keep their direction].
function layout.ring(part, count, given)
  count_of("layout.ring", count)
  local o = options("layout.ring", given or {}, {
    radius = {0}, angle = {360, min = -360, max = 360}, start = {0}, turn = {true},
  })
  local full = math.abs(o.angle) == 360
  local gaps = full and count or math.max(count - 1, 1)
  local copies = {}
  for i = 0, count - 1 do
    local angle = o.start + o.angle * i / gaps
    if o.turn then
      copies[i + 1] = part:translate(o.radius, 0, 0):rotate(angle)
    else
      copies[i + 1] = part:translate(o.radius * cos(angle), o.radius * sin(angle), 0)
    end
  end
  return copies
end

--- A copy at each point {x, y, z} of a list.
function layout.at(part, points)
  if type(points) ~= "table" then
    error("layout.at: wants a list of points {x, y, z}, got " .. tostring(points), 2)
  end
  local copies = {}
  for i, point in ipairs(points) do
    if type(point) ~= "table" then
      error("layout.at: point " .. i .. " must be {x, y, z}, got " .. tostring(point), 2)
    end
    copies[i] = part:translate(point[1] or 0, point[2] or 0, point[3] or 0)
  end
  return copies
end

return layout
