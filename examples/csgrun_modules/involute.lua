-- Involute gears, as outlines to extrude. A script beside this folder gets them with
--   local involute = require "involute"

local involute = {}

-- The angle, in degrees, at which the involute of a circle stands where its radius is r.
local function unrolled_angle(base_r, r)
  local unrolled = math.sqrt(math.max(0, (r / base_r) ^ 2 - 1))
  return math.deg(unrolled) - atan(unrolled)
end

--- The radii of a gear: pitch, tip and root. `internal` is for the hole of a ring gear, whose teeth
--- point inwards: what is the tip for other gears is its root.
function involute.radii(gear)
  local pitch = gear.modul * gear.teeth / 2
  local tip, root = gear.modul, 1.25 * gear.modul
  if gear.internal then tip, root = root, tip end
  return {pitch = pitch, tip = pitch + tip, root = pitch - root}
end

--- The outline of one tooth that points along X. It begins inside the root circle, so that it can be
--- joined to any disc. Options: modul, teeth; pressure [20 degrees], backlash [0 mm, of this gear at the
--- pitch circle], internal [false], steps [8 points along a flank].
function involute.tooth(gear)
  local radii = involute.radii(gear)
  local base_r = radii.pitch * cos(gear.pressure or 20)
  local steps = gear.steps or 8
  local thinner = math.deg((gear.backlash or 0) / 2 / radii.pitch)
  if gear.internal then thinner = -thinner end  -- the hole is wider
  local half = 90 / gear.teeth - thinner + unrolled_angle(base_r, radii.pitch)

  local points = {}
  local function add(r, angle) points[#points + 1] = {r * cos(angle), r * sin(angle)} end
  local start_r = math.max(base_r, radii.root)
  add(radii.root * 0.9, -half)
  for i = 0, steps do
    local r = start_r + (radii.tip - start_r) * i / steps
    add(r, unrolled_angle(base_r, r) - half)
  end
  for i = steps, 0, -1 do
    local r = start_r + (radii.tip - start_r) * i / steps
    add(r, half - unrolled_angle(base_r, r))
  end
  add(radii.root * 0.9, half)
  return polygon(points)
end

--- The outline of a whole gear, with a tooth along X. Options: those of a tooth.
function involute.gear(gear)
  local tooth = involute.tooth(gear)
  local all = {circle{r = involute.radii(gear).root, fn = 4 * gear.teeth}}
  for i = 1, gear.teeth do
    all[#all + 1] = tooth:rotate(360 / gear.teeth * i)
  end
  return union(all)
end

return involute
