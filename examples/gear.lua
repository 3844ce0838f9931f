-- A spur gear with involute teeth, a bore with a keyway and holes that save weight.
--
-- The teeth are one solid turned about Z again and again. They are as high as the disc, and every
-- turn keeps their tops in its top exactly, so the gear has one flat face above and one below.

local teeth    = param("teeth", 24, {min = 8, max = 80})
local modul    = param("module", 2, {min = 0.5, max = 10, doc = "pitch diameter / teeth"})
local width    = param("width", 8, {min = 1, max = 100})
local bore     = param("bore", 8, {min = 0, max = 100, doc = "diameter"})
local pressure = param("pressure", 20, {min = 14.5, max = 30, doc = "angle, degrees"})

local pitch_r = modul * teeth / 2
local base_r  = pitch_r * cos(pressure)
local tip_r   = pitch_r + modul
local root_r  = pitch_r - 1.25 * modul

-- The involute of the base circle where its radius is r: the angle at which it stands, in degrees.
local function involute_angle(r)
  local unrolled = math.sqrt((r / base_r) ^ 2 - 1)
  return math.deg(unrolled) - atan(unrolled)
end

-- Half the tooth's width at the pitch circle, as an angle about the centre.
local half_tooth = 90 / teeth + involute_angle(pitch_r)

local function tooth_outline()
  local points = {}
  local steps = 8
  local start_r = math.max(base_r, root_r)
  local function add(r, angle) points[#points + 1] = {r * cos(angle), r * sin(angle)} end
  add(root_r * 0.9, -half_tooth)
  for i = 0, steps do
    local r = start_r + (tip_r - start_r) * i / steps
    add(r, involute_angle(r) - half_tooth)
  end
  for i = steps, 0, -1 do
    local r = start_r + (tip_r - start_r) * i / steps
    add(r, half_tooth - involute_angle(r))
  end
  add(root_r * 0.9, half_tooth)
  return polygon(points)
end

local tooth = tooth_outline():linear_extrude(width)
local gear = cylinder{h = width, r = root_r, fn = 4 * teeth}
for i = 0, teeth - 1 do
  gear = gear + tooth:rotate(360 / teeth * i)
end

if bore > 0 then
  local key = bore / 4
  gear = gear - cylinder{h = width, d = bore, fn = 48}
              - cube{bore / 2 + key / 2, key, width}:translate(0, -key / 2, 0)
end

local ring = (bore / 2 + root_r) / 2
local hole = cylinder{h = width, r = (root_r - bore / 2) * 0.25, fn = 32}:right(ring)
for i = 0, 5 do
  gear = gear - hole:rotate(60 * i)
end

return gear
