-- A pawn, a rook and a bishop: turned profiles, and what a saw does to them afterwards.

local layout = require "csg.layout"

local size   = param("size", 1, {min = 0.3, max = 5, doc = "factor; at 1 a pawn is 44 mm high"})
local facets = param("facets", 96, {min = 16, max = 256, step = 1})

csg.fn = facets

-- A turned piece from its profile: {radius, height} from the foot up.
local function turned(profile)
  local points = {{0, 0}}
  for _, p in ipairs(profile) do points[#points + 1] = p end
  points[#points + 1] = {0, profile[#profile][2]}
  return polygon(points):rotate_extrude()
end

local foot = {{14, 0}, {14, 4}, {12, 6}, {12.5, 8}, {9, 11}, {6, 16}}
local function with(more)
  local profile = {}
  for _, p in ipairs(foot) do profile[#profile + 1] = p end
  for _, p in ipairs(more) do profile[#profile + 1] = p end
  return profile
end

local pawn = turned(with{{4.8, 26}, {8, 29}, {8, 30.5}, {4, 33}}) + sphere(7):up(37)

local rook = turned(with{{5.6, 30}, {8.5, 34}, {9.5, 35}, {9.5, 44}})
           - cylinder{h = 6, r = 6.5}:up(38)
for i = 0, 2 do rook = rook - cube{30, 3.5, 4, center = {true, true, false}}:rotate(60 * i):up(40) end

local head = sphere(8):scale(1, 1, 1.35):up(46)
local bishop = turned(with{{4.8, 32}, {8.5, 35.5}, {8.5, 37}, {4.5, 40}}) + head
             + sphere(2.2):up(57.5)
             - cube{20, 1.8, 12, center = true}:rotate(0, 35, 0):translate(4.5, 0, 51)

local row = layout.row({pawn:scale(size), rook:scale(size), bishop:scale(size)}, {gap = 6 * size})
return {pawn = row[1]:color("ivory"), rook = row[2]:color("ivory"), bishop = row[3]:color("ivory")}
