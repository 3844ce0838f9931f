-- A small machine, made with as much of the language as there is: a base with a drive, a crank, a
-- hopper, a nameplate. It must evaluate without a warning, and each part has what it must have.
local gears   = require "csg.gears"
local threads = require "csg.threads"
local layout  = require "csg.layout"
local options = require "csg.options"

-- Parameters, settings, tables, functions.
local width  = param("width", 120, {min = 60, max = 300, doc = "of the base, mm"})
local label  = param("label", "MILL No. 7", {doc = "on the plate"})
local finish = param("finish", "painted", {choices = {"painted", "plain"}})
local fits   = param("bolts", {4, 5}, {doc = "sizes that are used"})
csg.fn = 32

local function near(value, wanted, tolerance)
  assert(math.abs(value - wanted) <= tolerance * math.abs(wanted), value .. " instead of " .. wanted)
end

-- What the model reads: its own text, tables as values, a tree of OpenSCAD, a drawing.
local data = read_json("everything/sizes.json")
assert(data.tray.gap == 6 and data.names[2] == "drive" and read_text("everything/note.txt"):find("mill"))
local rows = read_csv("everything/pins.csv", {header = true})
assert(#rows == 3 and rows[2].height == 5)
local tree = load_csg("everything/bracket.csg")
near(tree:volume(), 20 * 10 * 2 + 2 * 10 * 8, 1e-12)
local badge = import("everything/badge.svg", {fn = 16})
near(badge:area(), 12 * 8 - 16 / 2 * 4 ^ 2 * sin(360 / 16), 1e-6)

local function painted(part, name)
  return finish == "painted" and part:color(name) or part
end

-- Outlines: regular, rounded, offset, hulls, sums, fills, text, metrics.
local depth, height = width * 0.6, 12
local outline = square{width, depth, center = true, r = 8}
local rim = outline - outline:offset(-4)
local feet = hull(circle(5):translate(-width / 2 + 12, 0), circle(5):translate(width / 2 - 12, 0))
local nut_pocket = regular_polygon(6, {across = 7})
local star = polygon{{0, 6}, {1.5, 1.5}, {6, 0}, {1.5, -1.5}, {0, -6}, {-1.5, -1.5}, {-6, 0}, {-1.5, 1.5}}
assert(polygon(star:points(), star:paths()):area() == star:area())
local soft_star = star:offset{delta = 1, chamfer = true}
local window = minkowski(square(10, 4), circle(1))
assert((circle(5) - circle(3)):fill():area() > circle(4):area())
assert(rim:components() == 1 and #rim:outlines() == 2 and rim:contains(width / 2 - 1, 0))
near(outline:perimeter(), 2 * (width - 16) + 2 * (depth - 16) + 32 * 2 * 8 * sin(180 / 32), 1e-6)
local metrics = text_metrics(label, {size = 6})
assert(fontmetrics(6).interline == font_metrics(6).interline and text("a\nb"):components() == 2)
local plate_size = {metrics.size[1] + 10, 14}

-- The base: extrusions, holes from the library, pockets, ribs as an array.
local base = outline:linear_extrude(height) + rim:linear_extrude(4):up(height)
local hole = threads.hole{size = "M" .. fits[1], depth = height, head = "flat"}:up(height)
base = base - union(layout.at(hole, {{-50, -25}, {50, -25}, {-50, 25}, {50, 25}}))
base = base - nut_pocket:linear_extrude(3) - feet:linear_extrude(1)
base = base - window:linear_extrude(height):translate(20, -5, 0)
base = base - soft_star:linear_extrude(height, {twist = 30, scale = 0.8, slices = 4}):translate(-25, 0, 0)
local rib = cube{2, depth - 10, 3, center = {true, true, false}}
base = base + rib:up(height):left(30):linear_array(5, {15, 0, 0})
assert(base:components() == 1 and base:genus() >= 6)
near(base:bbox().max[1] - base:bbox().min[1], width, 1e-12)

-- The drive: two gears that mesh, on a threaded shaft.
local wheel = gears.spur{teeth = 30, module = 1.5, width = 6, bore = 8, helix = 15, backlash = 0.1}
local pinion = gears.spur{teeth = 14, module = 1.5, width = 6, bore = 5, helix = -15, backlash = 0.1}
local placed = gears.meshed(pinion, 30, 14, {module = 1.5, at = 40})
assert((wheel * placed):is_empty())
local lightened = wheel - union(layout.ring(cylinder(6, 4), 6, {radius = 13}))
near(wheel:volume() - lightened:volume(), 6 * 6 * 32 / 2 * 16 * sin(360 / 32), 1e-6)
local shaft = threads.thread{d = 8, pitch = 1.25, length = 20, chamfer = true, facets = 24}
            + cylinder{h = 20, d = 8, fn = 24}:down(20)
local drive = (lightened + placed):up(height + 6)

-- Curves: a sweep, a loft, a turned bell, a torus, a spring of a swept disc.
local path = {}
for i = 0, 48 do path[i + 1] = {9 * cos(i * 30), 9 * sin(i * 30), i * 0.5} end
local spring = circle(1, {fn = 8}):sweep(path)
local hopper = loft({square(16, true) - square(12, true), square(40, true) - square(36, true)}, {0, 30})
local bell = polygon{{0, 0}, {10, 0}, {9, 4}, {5, 9}, {4, 16}, {0, 16}}:rotate_extrude()
local handle = torus(20, 3) + sphere(5):right(20)
local shed = (square(12, 6) + square(6, 12)):roof("straight")
near(shed:area(), 108 * (1 + math.sqrt(2)), 1e-9)
assert(hopper:genus() == 1 and spring:genus() == 0 and handle:genus() == 1)
near(hopper:volume(), ((40 ^ 3 - 16 ^ 3) / 24 - (36 ^ 3 - 12 ^ 3) / 24) * 30 / 3, 1e-9)

-- Hulls, sums, rounded things, sections.
local lever = hull(sphere(4), sphere(2):right(40))
local cover = cube{30, 30, 8, r = 2, fn = 16}
local knob = minkowski(cylinder{h = 6, r = 6, fn = 12}, sphere{r = 1, fn = 8})
local upper, lower = knob:split({0, 0, 1}, 3)
near(upper:volume() + lower:volume(), knob:volume(), 1e-9)
near(knob:slice(3):area(), knob:projection():area(), 1e-9)
assert(knob:project():area() == knob:projection():area())
near(cover:resize{60, 0, 0}:size()[1], 60, 1e-12)
assert(#(cube(1) + cube(1):right(3)):decompose() == 2)
assert(upper:trim({0, 0, 1}, 5):bbox().min[3] == 5)

-- Solids from functions and tables.
local foam = levelset(function(x, y, z)
  return math.max(math.abs(x) - 6, math.abs(y) - 6, math.abs(z) - 6, 2 - norm{x, y})
end, {{-7, -7, -7}, {7, 7, 7}}, 1)
assert(foam:genus() == 1)
local wave = cube{24, 6, 2}:refine(2):warp(function(x, y, z) return x, y, z + 2 * sin(x * 15) end)
near(wave:volume(), 288, 1e-6)
local pebble = cube(8):smooth(2)
local relief = surface{heights = {{0, 1, 0, 1}, {1, 3, 2, 0}, {0, 1, 1, 1}}, center = true}

-- Transforms as values, short forms, anchors, copies, arrays.
local tab = cube(6, 2, 1):multmatrix{{0, -1, 0, 5}, {1, 0, 0, 0}, {0, 0, 1, 2}}
assert(tab:bbox().min[3] == 2 and tab:bounds().max[1] == 5)
local ears = tab:mirror_copy(1, 0, 0)
local upright = cylinder(5, 2):attach(cube(10), "top"):align{x = "center"}
assert(upright:anchor("bottom")[3] == 10)
local grid = cylinder(2, 0.8):grid_array({4, 3}, {3, 3})
local ring = cube(2, 1, 1):translate(10, 0, 0):polar_array(8)
assert(grid:components() == 12 and ring:components() == 8 and ears:components() == 2)
local knob_on_lever = layout.attach(knob, lever, "top")
assert(layout.anchor(knob_on_lever, "bottom")[3] == layout.anchor(lever, "top")[3])

-- Booleans as operators, and what they keep.
local a, b = cube{10, 10, 10, center = true}:color("red"), sphere(6.5):color("#4488cc")
near((a + b):volume() + (a * b):volume(), a:volume() + b:volume(), 1e-9)
near((a ~ b):volume(), (a - b):volume() + (b - a):volume(), 1e-9)
assert(difference(a, b, {cut = "body"}):volume() == (a - b):volume())
assert((a | b):volume() == (a + b):volume() and (a & b):volume() == (a * b):volume())
local charm = a - b

-- Vectors, lookups, seeded numbers, trigonometry in degrees.
local v = vec(1, 2, 2)
assert(norm(v) == 3 and cross({1, 0, 0}, {0, 1, 0})[3] == 1 and sin(30) == 0.5 and atan2(1, 1) == 45)
assert(lookup(2.5, {{0, 0}, {5, 10}}) == 5 and #rands(0, 1, 4, 7) == 4)
local pins = {}
for i, r in ipairs(rands(1, 2, 5, 11)) do pins[i] = cylinder{h = 4, r = r}:right(6 * i) end

-- Measuring: rays, gaps, faces, meshes, points inside.
assert(cover:contains(15, 15, 4) and not cover:contains(-1, 0, 0))
near(cube(2):gap(cube(2):right(5)), 3, 1e-12)
assert(#cube(1):mesh().faces == 12)
near(polyhedron(lever:mesh()):volume(), lever:volume(), 1e-6)
local c = bell:centroid()
assert(math.abs(c[1]) < 1e-9 and c[3] > 0)

-- The plate, with raised letters; its text keeps the holes of its letters.
local letters = text(label, {size = 6, halign = "center", valign = "center"})
local nameplate = square{plate_size, center = true, r = 2}:linear_extrude(1.5)
local raised = letters:linear_extrude(0.8):up(1.5)
assert((nameplate + raised):components() == 1)

-- A checked function of our own, and one that fails as it should.
local function spacer(given)
  local o = options("spacer", given, {h = {type = "number", above = 0}, d = {8, min = 2}})
  return cylinder{h = o.h, d = o.d}
end
local good, message = pcall(spacer, {h = 3, dd = 4})
assert(not good and message:find("unknown option 'dd' %(did you mean 'd'%?%)"), message)

-- The other solids there are, and other names of what is there.
local egg, gem, die = ellipsoid(6, 4, 3), octahedron(4), icosahedron(4)
local roof, word = pyramid(0, 0, 0, 8, 5), text3d("ok", {size = 5, depth = 1})
near(gem:volume(), 4 / 3 * 4 ^ 3, 1e-12)
near(roof:volume(), 8 * 8 * 5 / 3, 1e-12)
near(die:volume(), 5 / 12 * (3 + sqrt(5)) * (4 / sin(72)) ^ 3, 1e-6)
assert(rect(4, 3):area() == 12 and textmetrics("ok").size[1] == text_metrics("ok").size[1])
local ball_in_box = polyhedron{points = {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}},
                               faces = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}}
assert(ball_in_box:faces({0, 0, -1})[1].area == 40.5 and #ball_in_box:faces() == 4)

-- Matrices as values: they turn, move and mirror what they stand before, and can be undone.
local there = translate(5, 0, 0) * rotate(0, 0, 90) * mirror(0, 1, 0)
local moved = there * cube(1, 2, 3)
assert((there:inverse() * moved) == cube(1, 2, 3) and (there * {1, 1, 0})[1] == 6)
local block = cube(4):rx(90):ry(180):rz(-90):tx(1):ty(2):tz(3):forward(1):front(1):back(2):move{x = -1}
assert(block:centered() == cube(4, true) and block:scale(0.5):volume() == 8)
near(cube(2):offset{delta = 1}:volume(), 4 ^ 3, 1e-12)
near(cube(4):chamfer(1, "z"):volume(), 4 ^ 3 - 8, 1e-12)
assert((cube(20) - cylinder{h = 20, r = 5, fn = 48}:translate(10, 10, 0)):chamfer(0.8):genus() == 1)
assert(#cube(4):edges("top") == 4 and cube(4):fillet(1, {fn = 8}) == cube(4, {r = 1, fn = 8}))

-- Booleans as methods, and modifiers: what is skipped is not there.
assert(a:union(b) == a:add(b) and a:difference(b) == a:sub(b) and a:sub(b) == a:subtract(b) and a:intersection(b) == a:intersect(b))
assert(a:symmetric_difference(b):volume() == (a ~ b):volume() and a:clone() == a and a:copy() == a)
assert((a - s(b)):volume() == 1000 and (a - b:skip() - t(b)):volume() == 1000 and (a - b:transparent()) == a)
assert((a - d(b)) == (a - b:debug()) and o(a) == a:only())
assert(outer_hull(cube(8) - cube(2):translate(3, 3, 3)):volume() == 512)
local inlet = lever:ray({-9, 0, 0}, {1, 0, 0})
near(inlet[1].distance, 9 - 4 * cos(180 / 32), 1e-6)

-- Numbers, in degrees and not.
assert(tan(45) == 1 and asin(0.5) == 30 and acos(0.5) == 60 and atan(1) == 45 and sind(30) == sin(30))
assert(cosd(60) == cos(60) and tand(45) == 1 and asind(1) == 90 and acosd(0) == 90 and atand(1) == 45)
assert(atan2d(1, -1) == 135 and sign(-3) == -1 and floor(1.5) == 1 and ceil(1.5) == 2 and pow(2, 3) == 8)
near(exp(ln(5)), 5, 1e-12)
assert(var("of LuaCAD", 7) == 7 and round(2.4) == 2 and abs(-1) == 1 and vector{1, 2, 3}.z == 3)

-- Parts, groups, one after another.
emit(painted(base, "slategray"), {name = "base"})
emit(painted(drive, "goldenrod"), {name = "drive"})
emit({shaft = painted(shaft, "silver"):up(60), spring = spring:up(100), spacer = spacer{h = 5}:up(90)},
     {name = "axle"})
emit(painted(hopper, "teal"):translate(0, 0, 130):material{metallic = 0.8, roughness = 0.3}, {name = "hopper"})
render(tree:up(200):name("bracket"))
render(badge:linear_extrude(1):up(220):setcolor("crimson"):name("badge"))
render(upright:right(80):material("brass"):name("upright"))
emit(layout.row({bell, handle, lever, cover, knob_on_lever, foam, wave, pebble, relief, charm},
                {gap = 6, align = "min"}), {name = "tray"})
emit(layout.row({ears, grid, ring, union(pins), egg, gem, die, roof, word, ball_in_box, moved, block}, {gap = 4, axis = "y"}), {name = "bits"})
return {
  plate = painted(nameplate, "black"):translate(0, -depth / 2 - 20, 0),
  letters = painted(raised, "gold"):translate(0, -depth / 2 - 20, 0),
}
