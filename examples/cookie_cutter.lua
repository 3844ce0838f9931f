-- A cookie cutter from a drawing: the outline, moved outwards in steps, gives blade, wall and rim.
--
--   csgrun examples/cookie_cutter.lua -D drawing=drawings/leaf.svg -o cutter.stl

local drawing = param("drawing", "drawings/leaf.svg", {doc = "an SVG or DXF beside this script"})
local width   = param("width", 70, {min = 20, max = 200, doc = "of the cookie, mm"})
local depth   = param("depth", 15, {min = 5, max = 40})
local blade   = param("blade", 0.8, {min = 0.4, max = 2, doc = "thickness at the dough, mm"})

local cookie = import(drawing, {center = true}):fill()
cookie = cookie:resize({width, 0}, {auto = true})

local function wall(thickness)
  return cookie:offset{r = thickness, fn = 48} - cookie
end

-- From the table up: a rim to press on, a wall, the blade.
return wall(5):linear_extrude(2)
     + wall(2 * blade):linear_extrude(depth * 0.6):up(2)
     + wall(blade):linear_extrude(depth * 0.4):up(2 + depth * 0.6)
