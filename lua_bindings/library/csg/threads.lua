--- Screw threads, and the bolts, nuts and holes that go with them.
---
---   local threads = require "csg.threads"
---   local bolt = threads.bolt{size = "M8", length = 30}
---   local nut  = threads.nut{size = "M8", clearance = 0.2}
---   plate = plate - threads.hole{size = "M8", depth = 5}       -- the bolt passes through
---   block = block - threads.thread{size = "M8", length = 12, clearance = 0.2}   -- it screws in
---
--- A thread has the same cross-section at every height, turned: the radius as a function of the angle
--- is the profile over one lead. So it is one outline, extruded with a twist. It is right-handed, and
--- at a height of whole leads two threads of one pitch are in phase.

local options = require "csg.options"

local threads = {}

-- ISO 261, 4017, 4032, 4762, 273: pitch; across the flats, height of head and nut; diameter, hexagon
-- and its depth of a socket head (as high as the bolt is thick); diameters of holes: close, medium,
-- coarse.
local kSizes = {
  ["M2"]   = {d = 2,   pitch = 0.4,  flats = 4,   head = 1.4,  nut = 1.6,  socket = {3.8, 1.5, 1},   holes = {2.2, 2.4, 2.6}},
  ["M2.5"] = {d = 2.5, pitch = 0.45, flats = 5,   head = 1.7,  nut = 2,    socket = {4.5, 2, 1.1},   holes = {2.7, 2.9, 3.1}},
  ["M3"]   = {d = 3,   pitch = 0.5,  flats = 5.5, head = 2,    nut = 2.4,  socket = {5.5, 2.5, 1.3}, holes = {3.2, 3.4, 3.6}},
  ["M4"]   = {d = 4,   pitch = 0.7,  flats = 7,   head = 2.8,  nut = 3.2,  socket = {7, 3, 2},       holes = {4.3, 4.5, 4.8}},
  ["M5"]   = {d = 5,   pitch = 0.8,  flats = 8,   head = 3.5,  nut = 4.7,  socket = {8.5, 4, 2.5},   holes = {5.3, 5.5, 5.8}},
  ["M6"]   = {d = 6,   pitch = 1,    flats = 10,  head = 4,    nut = 5.2,  socket = {10, 5, 3},      holes = {6.4, 6.6, 7}},
  ["M8"]   = {d = 8,   pitch = 1.25, flats = 13,  head = 5.3,  nut = 6.8,  socket = {13, 6, 4},      holes = {8.4, 9, 10}},
  ["M10"]  = {d = 10,  pitch = 1.5,  flats = 16,  head = 6.4,  nut = 8.4,  socket = {16, 8, 5},      holes = {10.5, 11, 12}},
  ["M12"]  = {d = 12,  pitch = 1.75, flats = 18,  head = 7.5,  nut = 10.8, socket = {18, 10, 6},     holes = {13, 13.5, 14.5}},
  ["M14"]  = {d = 14,  pitch = 2,    flats = 21,  head = 8.8,  nut = 12.8, socket = {21, 12, 7},     holes = {15, 15.5, 16.5}},
  ["M16"]  = {d = 16,  pitch = 2,    flats = 24,  head = 10,   nut = 14.8, socket = {24, 14, 8},     holes = {17, 17.5, 18.5}},
  ["M20"]  = {d = 20,  pitch = 2.5,  flats = 30,  head = 12.5, nut = 18,   socket = {30, 17, 10},    holes = {21, 22, 24}},
  ["M24"]  = {d = 24,  pitch = 3,    flats = 36,  head = 15,   nut = 21.5, socket = {36, 19, 12},    holes = {25, 26, 28}},
  ["M30"]  = {d = 30,  pitch = 3.5,  flats = 46,  head = 18.7, nut = 25.6, socket = {45, 22, 15.5},  holes = {31, 33, 35}},
  ["M36"]  = {d = 36,  pitch = 4,    flats = 55,  head = 22.5, nut = 31,   socket = {54, 27, 19},    holes = {37, 39, 42}},
}

local kSizeNames = {}
for name in pairs(kSizes) do kSizeNames[#kSizeNames + 1] = name end
table.sort(kSizeNames, function(a, b) return kSizes[a].d < kSizes[b].d end)

-- Crest and root of the profile as shares of the pitch, and its depth: ISO 68 (60 degrees) and
-- ISO 2901 (30 degrees, trapezoidal).
local kProfiles = {
  metric      = {crest = 1 / 8, root = 1 / 4, depth = 0.625 * math.sqrt(3) / 2},
  trapezoidal = {crest = 0.366, root = 0.366, depth = 0.5},
}

--- A table of the measures of a metric size ("M8"): d, pitch, flats, head, nut; socket, a list of
--- diameter, hexagon and depth; holes, a list of the close, the medium and the coarse diameter.
---@param name string
---@return table
function threads.size(name)
  local size = kSizes[name]
  if not size then
    error("threads.size: there is no size '" .. tostring(name) .. "'; there are "
          .. table.concat(kSizeNames, ", "), 2)
  end
  local copy = {}
  for key, value in pairs(size) do
    copy[key] = type(value) == "table" and {table.unpack(value)} or value
  end
  return copy
end

-- Diameter and pitch: the named size, unless they are given.
local function measures(name, o)
  local size = o.size and kSizes[o.size]
  local d, pitch = o.d or size and size.d, o.pitch or size and size.pitch
  if not (d and pitch) then
    error(name .. ": wants a size such as \"M8\", or d and pitch", 3)
  end
  return d, pitch
end

local kSize = {optional = true, type = "string", choices = kSizeNames}
local kNumber = {optional = true, type = "number", above = 0}

local kThread = {
  size = kSize, d = kNumber, pitch = kNumber,
  profile = {"metric", choices = {"metric", "trapezoidal"}},
  starts = {1, min = 1, max = 16, whole = true},
  left = {false},
  clearance = {0, min = 0},
  facets = {36, min = 8, max = 720, whole = true, alias = "fn"},
}

local function rules(more)
  for name, rule in pairs(kThread) do
    if more[name] == nil then more[name] = rule end
  end
  return more
end

-- The threaded cylinder from z = 0 to z = length, with flat ends.
local function thread_of(name, o, d, pitch, length)
  local profile = kProfiles[o.profile]
  local depth, radius = profile.depth * pitch, d / 2 + o.clearance
  if depth >= d / 2 then
    error(name .. ": a thread of pitch " .. pitch .. " is deeper than a diameter of " .. d
          .. " has room for", 3)
  end
  local flank = (1 - profile.crest - profile.root) / 2
  local points = {}
  for i = 0, o.facets - 1 do
    local t = i * o.starts / o.facets % 1            -- where in the profile, from 0 to 1
    t = math.abs(t - 0.5) * 2                        -- 0 in the middle of the crest, 1 of the root
    local down = math.max(0, math.min(1, (t - profile.crest) / (2 * flank)))
    local r, angle = radius - depth * down, 360 * i / o.facets
    points[i + 1] = {r * cos(angle), r * sin(angle)}
  end
  local turns = length / (pitch * o.starts)
  local solid = polygon(points):linear_extrude{
    height = length, twist = -360 * turns, segments = 0,
    slices = math.max(1, math.ceil(turns * o.facets / 2)),
  }
  if o.left then solid = solid:mirror(0, 1, 0) end
  return solid, radius - depth, radius
end

--- A thread along Z from z = 0, as a solid: a rod to add, or with some clearance a tool to cut with.
--- Options: size ["M8" and the like: gives d and pitch], d, pitch, length, profile ["metric" or
--- "trapezoidal"], starts [1], left [false: left-handed], clearance [0 mm: added to the radius],
--- chamfer [false: both ends are cut by a cone of 45 degrees], facets or fn [36: of a
--- full turn].
---@param given table
---@return Solid
function threads.thread(given)
  local o = options("threads.thread", given, rules{
    length = {type = "number", above = 0}, chamfer = {false},
  })
  local d, pitch = measures("threads.thread", o)
  local solid, inner = thread_of("threads.thread", o, d, pitch, o.length)
  if not o.chamfer then return solid end
  -- One double cone cuts both ends: its slope is 1, it is `inner` wide at the ends of the thread.
  local half = o.length / 2
  local cone = cylinder{h = half, r1 = inner + half, r2 = inner, fn = 2 * o.facets}
  return solid * (cone + cone:mirror(0, 0, 1)):up(half)
end

-- A hexagonal prism whose corners a cone of 30 degrees takes off; at the top, or at both ends.
local function hexagon(flats, height, both)
  local corners = flats / cos(30)
  local function cone(h) return cylinder{h = h, r1 = flats / 2 + h / tan(30), r2 = flats * 0.475, fn = 96} end
  local prism = cylinder{h = height, d = corners, fn = 6}
  if not both then return prism * cone(height) end
  local half = cone(height / 2)
  return prism * (half + half:mirror(0, 0, 1)):up(height / 2)
end

--- A bolt that points upwards: its head stands on z = 0, its shaft begins above the head. Options:
--- size, length (of the shaft), threaded [all of the shaft], head ["hexagon", "socket" or "none"],
--- left, clearance [0: here taken from the radius], facets or fn.
---@param given table
---@return Solid
function threads.bolt(given)
  local o = options("threads.bolt", given, {
    size = {type = "string", choices = kSizeNames}, length = {type = "number", above = 0},
    threaded = kNumber, head = {"hexagon", choices = {"hexagon", "socket", "none"}},
    left = kThread.left, clearance = kThread.clearance, facets = kThread.facets,
  })
  local size = kSizes[o.size]
  local threaded = o.threaded or o.length
  if threaded > o.length then
    error("threads.bolt: option 'threaded' must not be greater than the length, " .. o.length .. ", got " .. threaded, 2)
  end
  local plain = o.length - threaded
  o.profile, o.starts, o.clearance = "metric", 1, -o.clearance
  local rod, inner, outer = thread_of("threads.bolt", o, size.d, size.pitch, threaded)
  -- The tip is cut by a cone, so that it is easy to enter.
  local tip = cylinder{h = threaded, r1 = inner + threaded, r2 = inner, fn = 2 * o.facets}
  local shaft = (rod * tip):up(plain)
  if plain > 0 then shaft = shaft + cylinder{h = plain, r = outer, fn = o.facets} end
  if o.head == "none" then return shaft end
  if o.head == "hexagon" then
    return hexagon(size.flats, size.head):mirror(0, 0, 1):up(size.head) + shaft:up(size.head)
  end
  local width, across, deep = size.socket[1], size.socket[2], size.socket[3]
  local socket = cylinder{h = deep, d = across / cos(30), fn = 6}
  return cylinder{h = size.d, d = width, fn = 2 * o.facets} - socket + shaft:up(size.d)
end

--- A hexagon nut on z = 0. Options: size, clearance [0 mm: added to the radius of its thread],
--- height [that of the size], left, facets or fn.
---@param given table
---@return Solid
function threads.nut(given)
  local o = options("threads.nut", given, {
    size = {type = "string", choices = kSizeNames}, height = kNumber,
    left = kThread.left, clearance = kThread.clearance, facets = kThread.facets,
  })
  local size = kSizes[o.size]
  local height = o.height or size.nut
  o.profile, o.starts = "metric", 1
  return hexagon(size.flats, height, true)
       - thread_of("threads.nut", o, size.d, size.pitch, height)
end

--- A washer (ISO 7089 in its proportions) on z = 0. Options: size, d [twice the size: outside],
--- thickness [0.2 of the size].
---@param given table
---@return Solid
function threads.washer(given)
  local o = options("threads.washer", given, {
    size = {type = "string", choices = kSizeNames}, d = kNumber, thickness = kNumber,
  })
  local size = kSizes[o.size]
  local outside, thickness = o.d or 2 * size.d, o.thickness or size.d / 5
  if outside <= size.holes[1] then
    error("threads.washer: option 'd' must be greater than " .. size.holes[1] .. ", got " .. outside, 2)
  end
  return cylinder{h = thickness, d = outside, fn = 96} - cylinder{h = thickness, d = size.holes[1], fn = 96}
end

--- A tool for a hole that a bolt passes through: it reaches down from z = 0 to z = -depth. Options:
--- size, depth, fit ["medium", "close" or "coarse"], head ["none"; "socket": a counterbore for a
--- socket head; "hexagon": a pocket for a hexagon; "flat": a countersink of 90 degrees, twice as wide
--- as the size], facets or fn [64].
---@param given table
---@return Solid
function threads.hole(given)
  local o = options("threads.hole", given, {
    size = {type = "string", choices = kSizeNames}, depth = {type = "number", above = 0},
    fit = {"medium", choices = {"close", "medium", "coarse"}},
    head = {"none", choices = {"none", "socket", "hexagon", "flat"}},
    facets = {64, min = 8, max = 720, whole = true, alias = "fn"},
  })
  local size = kSizes[o.size]
  local d = size.holes[({close = 1, medium = 2, coarse = 3})[o.fit]]
  local air = d - size.d
  local function down(solid, height) return solid:down(math.min(height, o.depth)) end
  local hole = down(cylinder{h = o.depth, d = d, fn = o.facets}, o.depth)
  if o.head == "socket" then
    local h = math.min(size.d, o.depth)
    hole = hole + down(cylinder{h = h, d = size.socket[1] + air, fn = o.facets}, h)
  elseif o.head == "hexagon" then
    local h = math.min(size.head, o.depth)
    hole = hole + down(cylinder{h = h, d = (size.flats + air) / cos(30), fn = 6}, h)
  elseif o.head == "flat" then
    local h = math.min(size.d - d / 2, o.depth)
    hole = hole + down(cylinder{h = h, r1 = size.d - h, r2 = size.d, fn = o.facets}, h)
  end
  return hole
end

return threads
