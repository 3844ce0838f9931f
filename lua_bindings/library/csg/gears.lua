--- Gears with involute teeth.
---
---   local gears = require "csg.gears"
---   local wheel  = gears.spur{teeth = 40, module = 1.5, width = 8, bore = 6}
---   local pinion = gears.spur{teeth = 13, module = 1.5, width = 8, bore = 4, shift = 0.3}
---
--- Gears lie on z = 0 with their axis in Z, and with the middle of a tooth along X. Two gears mesh
--- when their module and pressure angle are equal, their axes gears.distance(...) apart, and where
--- one has a tooth the other has a gap: gears.meshed(...) places the second.
---
--- Options of the teeth: teeth, module (pitch diameter / teeth, mm), pressure [20 degrees], shift
--- [0: of the profile outwards, in modules; avoids undercut where teeth are few], backlash [0 mm: how
--- much thinner each tooth is at the pitch circle], clearance [0.25: between tip and root, in
--- modules], steps [8: pieces of a flank]. A number that cannot be made (a tooth that comes to a
--- point below its tip) is an error.

local options = require "csg.options"

local gears = {}

local kTeeth = {
  teeth = {type = "number", min = 3, whole = true},
  module = {type = "number", above = 0},
  pressure = {20, above = 0, max = 45},
  shift = {0, min = -1, max = 1},
  backlash = {0, min = 0},
  clearance = {0.25, min = 0, max = 1},
  steps = {8, min = 1, max = 200, whole = true},
}

local function with_teeth(more)
  local rules = {}
  for name, rule in pairs(kTeeth) do rules[name] = rule end
  for name, rule in pairs(more) do rules[name] = rule end
  return rules
end

-- inv(a) of a circle of radius base at radius r, degrees: how far the involute has turned there.
local function unrolled_angle(base, r)
  if r <= base then return 0 end
  local unrolled = math.sqrt((r / base) ^ 2 - 1)
  return math.deg(unrolled) - atan(unrolled)
end

local function radii_of(o, internal)
  local pitch = o.module * o.teeth / 2
  local add, ded = o.module * (1 + o.shift), o.module * (1 + o.clearance - o.shift)
  if internal then add, ded = o.module * (1 + o.clearance + o.shift), o.module * (1 - o.shift) end
  return {pitch = pitch, tip = pitch + add, root = pitch - ded, base = pitch * cos(o.pressure)}
end

-- The outline, as points; `internal` is the hole of a ring gear.
local function outline_of(name, o, internal)
  local radii = radii_of(o, internal)
  local thinner = internal and -o.backlash or o.backlash
  -- Half the angle of a tooth where its involute begins. The tooth is half a pitch wide at the pitch
  -- circle, and 2 x tan(pressure) modules wider by the shift x.
  local half = math.deg((math.pi / 2 + 2 * o.shift * tan(o.pressure)) / o.teeth
                        - thinner / 2 / radii.pitch) + unrolled_angle(radii.base, radii.pitch)
  local start = math.max(radii.base, radii.root)
  if radii.root <= 0 then error(name .. ": the roots of the teeth reach the axis", 3) end
  if half <= unrolled_angle(radii.base, radii.tip) then
    error(name .. ": the teeth come to a point below their tips: take less shift, less backlash or a "
          .. "smaller pressure angle", 3)
  end
  if half - unrolled_angle(radii.base, start) >= 180 / o.teeth then
    error(name .. ": the teeth leave no gap at their roots: take less shift or more backlash", 3)
  end
  local points = {}
  local function add(r, angle) points[#points + 1] = {r * cos(angle), r * sin(angle)} end
  for tooth = 0, o.teeth - 1 do
    local middle = 360 * tooth / o.teeth
    local foot = half - unrolled_angle(radii.base, start)
    if radii.root < start then add(radii.root, middle - foot) end
    for i = 0, o.steps do
      local r = start + (radii.tip - start) * i / o.steps
      add(r, middle - half + unrolled_angle(radii.base, r))
    end
    add(radii.tip, middle)
    for i = o.steps, 0, -1 do
      local r = start + (radii.tip - start) * i / o.steps
      add(r, middle + half - unrolled_angle(radii.base, r))
    end
    if radii.root < start then add(radii.root, middle + foot) end
    add(radii.root, middle + 180 / o.teeth)
  end
  return points
end

--- The radii of the circles {pitch, tip, root, base} of a gear; options: those of the teeth.
---@param given table
---@return {pitch: number, tip: number, root: number, base: number}
function gears.radii(given)
  return radii_of(options("gears.radii", given, kTeeth), false)
end

--- The outline of a gear, a shape. Options: those of the teeth.
---@param given table
---@return Shape
function gears.outline(given)
  return polygon(outline_of("gears.outline", options("gears.outline", given, kTeeth), false))
end

-- The extruded outline with helical teeth: right-handed for a positive angle.
local function with_helix(shape, o, pitch_radius)
  local turn = math.deg(o.width * tan(o.helix) / pitch_radius)
  if not o.herringbone then return shape:linear_extrude{height = o.width, twist = -turn} end
  local lower = shape:linear_extrude{height = o.width / 2, twist = -turn / 2}
  return lower + lower:mirror(0, 0, 1):up(o.width)
end

local kBody = {
  width = {type = "number", above = 0},
  helix = {0, min = -60, max = 60},
  herringbone = {false},
}

local function with_body(more)
  for name, rule in pairs(kBody) do more[name] = rule end
  return with_teeth(more)
end

--- A spur gear, or a helical one. Options: those of the teeth, and width, bore [0: its diameter],
--- helix [0 degrees at the pitch circle; a positive one is right-handed], herringbone [false: the
--- upper half of the teeth leans the other way].
---@param given table
---@return Solid
function gears.spur(given)
  local o = options("gears.spur", given, with_body{bore = {0, min = 0}})
  local outline = outline_of("gears.spur", o, false)
  local radii = radii_of(o, false)
  if o.bore / 2 >= radii.root then
    error("gears.spur: option 'bore' must be less than " .. 2 * radii.root
          .. ", the diameter at the roots of the teeth, got " .. o.bore, 2)
  end
  local gear = with_helix(polygon(outline), o, radii.pitch)
  if o.bore == 0 then return gear end
  return gear - cylinder{h = o.width, d = o.bore, fn = 4 * o.teeth}
end

--- A ring gear: the teeth point inwards. Options: those of the teeth, and width, rim [3 modules:
--- between the roots of the teeth and the outside], helix, herringbone. A gear meshes with it that
--- has the same helix angle and hand, and fewer teeth by some ten or more: with nearly as many, tips
--- of teeth meet beside the place where they mesh. With fewer than 17 teeth at 20 degrees its roots
--- meet the ring's tips by some thousandths of the module: `(ring * gear):volume()` tells, or backlash
--- makes room.
---@param given table
---@return Solid
function gears.ring(given)
  local o = options("gears.ring", given, with_body{rim = {type = "number", above = 0, optional = true}})
  local outline = outline_of("gears.ring", o, true)
  local radii = radii_of(o, true)
  local outside = cylinder{h = o.width, r = radii.tip + (o.rim or 3 * o.module), fn = 4 * o.teeth}
  return outside - with_helix(polygon(outline), o, radii.pitch)
end

--- A rack along X: its pitch line lies on X, a tooth stands about x = 0, in Y; it is extruded along
--- Z. Options: teeth, module, pressure, backlash, clearance, width, and height [2 modules: below the
--- roots].
---@param given table
---@return Solid
function gears.rack(given)
  local o = options("gears.rack", given, {
    teeth = {type = "number", min = 1, whole = true}, module = kTeeth.module,
    pressure = kTeeth.pressure, backlash = kTeeth.backlash, clearance = kTeeth.clearance,
    width = kBody.width, height = {type = "number", above = 0, optional = true},
  })
  local pitch, slope = math.pi * o.module, tan(o.pressure)
  local tip, root = o.module, -o.module * (1 + o.clearance)
  local half = pitch / 4 - o.backlash / 2
  if half - tip * slope <= 0 then error("gears.rack: the teeth come to a point below their tips", 2) end
  if half - root * slope >= pitch / 2 then error("gears.rack: the teeth leave no gap", 2) end
  local points = {}
  local function add(x, y) points[#points + 1] = {x, y} end
  local bottom = root - (o.height or 2 * o.module)
  add(-pitch / 2, bottom)
  for i = 0, o.teeth - 1 do
    local x = i * pitch
    add(x - pitch / 2, root)
    add(x - half + root * slope, root)
    add(x - half + tip * slope, tip)
    add(x + half - tip * slope, tip)
    add(x + half - root * slope, root)
  end
  add((o.teeth - 0.5) * pitch, root)
  add((o.teeth - 0.5) * pitch, bottom)
  return polygon(points):linear_extrude(o.width)
end

local function distance_of(name, first, second, o)
  local function is_whole(teeth) return type(teeth) == "number" and math.tointeger(teeth) end
  if not is_whole(first) or not is_whole(second) then
    error(name .. ": wants two numbers of teeth, whole ones, got " .. tostring(first) .. " and "
          .. tostring(second), 3)
  end
  return o.module * (o.internal and first - second or first + second) / 2
end

--- How far apart the axes of two gears stand: of `first` and `second` teeth, neither shifted or
--- shifted by opposite amounts. Options: module, internal [false: the first is a ring gear].
---@param first integer
---@param second integer
---@param given table
---@return number
function gears.distance(first, second, given)
  local o = options("gears.distance", given, {module = kTeeth.module, internal = {false}})
  local distance = distance_of("gears.distance", first, second, o)
  return distance
end

--- The second gear of `second` teeth, turned and moved to mesh with a gear of `first` teeth that
--- stands at the origin. Options: module, internal [false: the first is a ring gear], at [0 degrees:
--- in which direction from the first].
---@param gear Solid
---@param first integer
---@param second integer
---@param given table
---@return Solid
function gears.meshed(gear, first, second, given)
  local o = options("gears.meshed", given, {
    module = kTeeth.module, internal = {false}, at = {0},
  })
  if type(gear) ~= "userdata" then error("gears.meshed: wants a solid, got " .. tostring(gear), 2) end
  local distance = distance_of("gears.meshed", first, second, o)
  -- Along the line of the axes, the first has its phase at o.at; there the second must have a gap.
  local phase = o.at * first / second
  local turn
  if o.internal then
    turn = o.at - phase             -- a tooth of the gear stands in a gap of the ring, which has its
                                    -- own gaps where its hole has teeth
  else
    turn = 180 + o.at + phase + 180 / second
  end
  return gear:rotate(turn):translate(distance * cos(o.at), distance * sin(o.at), 0)
end

return gears
