-- A hexagon bolt and its nut with a metric thread that really turns.
--
-- A thread with one start has the same cross-section everywhere, turned as it goes up: the radius as
-- a function of the angle is the profile of the thread. So a thread is one outline, extruded with a
-- twist of one turn for each pitch. The nut is cut by the same thread with a little air, where it is.

local size      = param("size", 10, {min = 3, max = 64, doc = "M10 has 10"})
local pitch     = param("pitch", 1.5, {min = 0.5, max = 6, doc = "of the thread, mm"})
local length    = param("length", 28, {min = 5, max = 300, doc = "under the head"})
local threaded  = param("threaded", 18, {min = 2, max = 300, doc = "length of the thread"})
local clearance = param("clearance", 0.2, {min = 0, max = 1, doc = "between bolt and nut"})
local facets    = param("facets", 36, {min = 12, max = 256, step = 1, doc = "of a full turn"})

local deep = 0.6134 * pitch         -- ISO 68: depth of an external thread
threaded = math.min(threaded, length)
local flats = size * 1.6            -- across the hexagon
local head, nut_height = size * 0.64, size * 0.8

-- The profile over one pitch, from 0 to 1: a crest, a flank down, the root, a flank up.
local function depth_at(t)
  local crest, root = 1 / 8, 1 / 4
  local flank = (1 - crest - root) / 2
  t = math.abs(t - 0.5) * 2         -- symmetric: 0 in the middle of the crest, 1 in that of the root
  return deep * math.max(0, math.min(1, (t - crest) / (2 * flank)))
end

local function thread(diameter, turns)
  local points = {}
  for i = 0, facets - 1 do
    local radius = diameter / 2 - depth_at(i / facets)
    local angle = 360 / facets * i
    points[#points + 1] = {radius * cos(angle), radius * sin(angle)}
  end
  return polygon(points):linear_extrude{
    height = turns * pitch, twist = -360 * turns, slices = math.ceil(turns * facets / 2), segments = 0,
  }
end

-- A hexagonal prism; a cone takes its upper corners off.
local function hexagon(height)
  local corners = flats / cos(30)
  return cylinder{h = height, d = corners, fn = 6}
       * cylinder{h = height, r1 = flats / 2 + 2 * height, r2 = flats / 2 * 0.95, fn = 100}
end

-- The bolt stands on its head. A cone makes the end of the thread easy to enter.
local stem = thread(size, threaded / pitch):up(length - threaded)
if threaded < length then stem = stem + cylinder{h = length - threaded, d = size, fn = facets} end
local tip = cylinder{h = length, r1 = size / 2 + length - deep, r2 = size / 2 - deep, fn = 100}
local bolt = hexagon(head):mirror(0, 0, 1):up(head) + (stem * tip):up(head)

-- The nut starts a whole number of pitches up the thread, so it is in phase with it.
local turns = nut_height / pitch
local up = head + length - threaded + math.floor((threaded - nut_height) / 2 / pitch) * pitch
local hole = thread(size + 2 * clearance, turns)
local nut = (hexagon(nut_height) - hole):up(up)

assert((bolt * nut):is_empty(), "bolt and nut do not fit")

return {bolt = bolt:color("lightsteelblue"), nut = nut:color("goldenrod")}
