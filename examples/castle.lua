-- A castle: towers, walls between them, battlements, a gate. Loops over tables place everything.

local sides  = param("sides", 5, {min = 3, max = 9, step = 1})
local radius = param("radius", 60, {min = 30, max = 200, doc = "from the middle to a tower, mm"})
local stone  = param("stone", "tan")

csg.fn = 48
local tower_r, tower_h, wall_h, wall_w = radius * 0.16, radius * 0.55, radius * 0.32, radius * 0.1

-- A crown of merlons on a ring or a straight wall: what is cut from their full height.
local function tower()
  local body = cylinder{h = tower_h, r1 = tower_r * 1.1, r2 = tower_r}
             + cylinder{h = tower_r * 0.6, r = tower_r * 1.2}:up(tower_h)
             - cylinder{h = tower_r * 0.4, r = tower_r}:up(tower_h + tower_r * 0.2)
  local gap = cube{3 * tower_r, tower_r * 0.3, tower_r * 0.3, center = {true, true, false}}
  for i = 0, 3 do body = body - gap:rotate(45 * i):up(tower_h + tower_r * 0.3) end
  local slit = cube{tower_r, tower_r * 0.12, tower_r * 0.7}:translate(tower_r * 0.6, 0, tower_h * 0.5)
  return body - slit
end

local function wall(length, has_gate)
  local merlon = wall_w * 0.8
  local body = cube{length, wall_w, wall_h, center = {true, true, false}}
  local count = math.floor(length / (2 * merlon))
  for i = 0, count - 1 do
    local x = (i - (count - 1) / 2) * 2 * merlon
    body = body + cube{merlon, wall_w * 0.35, merlon}:translate(x - merlon / 2, -wall_w / 2, wall_h)
  end
  if not has_gate then return body end
  local w, h = length * 0.22, wall_h * 0.45
  local gate = square{w, h, center = {true, false}} + circle(w / 2):translate(0, h)
  local gatehouse = cube{2 * w, 1.8 * wall_w, wall_h * 1.25, center = {true, true, false}}
  return body + gatehouse - gate:linear_extrude(3 * wall_w, {center = true}):rotate(90, 0, 0)
end

local castle = {}
for i = 0, sides - 1 do
  local angle = 360 / sides * i
  castle[#castle + 1] = tower():translate(radius, 0, 0):rotate(angle)
  castle[#castle + 1] = wall(2 * radius * sin(180 / sides), i == 0)
    :translate(0, -radius * cos(180 / sides), 0):rotate(angle + 180 / sides + 90)
end
local keep = cube{radius * 0.5, radius * 0.5, radius * 0.7, center = {true, true, false}}
local roof = cylinder{h = radius * 0.35, r1 = radius * 0.4, r2 = 0, fn = 4}:rotate(45):up(radius * 0.7)

return {castle = union(castle):color(stone), keep = keep:color(stone), roof = roof:color("firebrick")}
