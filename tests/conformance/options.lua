-- Every option of every function, by what it changes. Each is named when it is shown; a test compares the names
-- with the table of functions.
local failed = {}
local function shows(name, holds)
  if not holds then failed[#failed + 1] = name end
  print("SHOWN " .. name)
end
local function near(a, b) return math.abs(a - b) <= 1e-6 * math.max(1, math.abs(a), math.abs(b)) end
local function low(x) return x:bbox().min end
local function high(x) return x:bbox().max end

-- Facets: fn counts, fa and fs bound what fn = 0 leaves to them; the other name of fn is segments.
local round = {
  cube = function(o) o.size, o.r = 20, 5 return cube(o) end,
  sphere = function(o) o.r = 10 return sphere(o) end,
  cylinder = function(o) o.h, o.r = 3, 10 return cylinder(o) end,
  torus = function(o) o.R, o.r = 20, 10 return torus(o) end,
  ellipsoid = function(o) o.r = {10, 10, 8} return ellipsoid(o) end,
  square = function(o) o.size, o.r = 20, 5 return square(o) end,
  rect = function(o) o.size, o.r = 20, 5 return rect(o) end,
  circle = function(o) o.r = 10 return circle(o) end,
  linear_extrude = function(o) o.height, o.twist = 20, 90 return square(20):linear_extrude(o) end,
  rotate_extrude = function(o) return square(10, 3):translate(2, 0):rotate_extrude(o) end,
  offset = function(o) o.r = 10 return square(20):offset(o) end,
  text = function(o) o.text, o.size = "O", 100 return text(o) end,
  text3d = function(o) o.text, o.size = "O", 100 return text3d(o) end,
  sweep = function(o) o.path, o.twist = {{0, 0, 0}, {0, 0, 40}}, 180 return square(20, true):sweep(o) end,
  fillet = function(o) o.r = 10 return cube(30):fillet(o) end,
  import = function(o) o[1] = "options/a.svg" return import(o) end,
}
local function count(x)
  return tostring(x) == "shape" and #x:points() or #x:mesh().points
end
for name, make in pairs(round) do
  local few, many = count(make{fn = 8}), count(make{fn = 40})
  local is_own = name == "linear_extrude"  -- its segments are those of the outline
  shows(name .. ".fn", few < many and (is_own or count(make{segments = 8}) == few))
  shows(name .. ".fa", count(make{fn = 0, fa = 5, fs = 0.01}) > count(make{fn = 0, fa = 30, fs = 0.01}))
  shows(name .. ".fs", count(make{fn = 0, fa = 0.5, fs = 0.5}) > count(make{fn = 0, fa = 0.5, fs = 5}))
end
csg.fn = 16

-- Solids.
shows("cube.size", cube{size = {1, 2, 3}}:volume() == 6)
shows("cube.center", low(cube{size = 2, center = {true, false, true}})[1] == -1 and low(cube(2, true))[2] == -1)
shows("cube.r", cube{size = 4, r = 1}:volume() < 64)
shows("sphere.r", sphere{r = 3} == sphere(3))
shows("sphere.d", sphere{d = 6} == sphere(3))
shows("cylinder.h", cylinder{h = 5}:size()[3] == 5 and cylinder{height = 5} == cylinder(5))
shows("cylinder.r1", cylinder{h = 1, r1 = 2, r2 = 0}:size()[1] == 4)
shows("cylinder.r2", cylinder{h = 1, r1 = 0, r2 = 3}:size()[1] == 6)
shows("cylinder.center", low(cylinder{h = 4, center = true})[3] == -2)
shows("cylinder.r", cylinder{h = 1, r = 4}:size()[1] == 8)
shows("cylinder.d", cylinder{h = 1, d = 4}:size()[1] == 4)
shows("cylinder.d1", cylinder{h = 1, d1 = 4, r2 = 0} == cylinder{h = 1, r1 = 2, r2 = 0})
shows("cylinder.d2", cylinder{h = 1, r1 = 0, d2 = 4} == cylinder{h = 1, r1 = 0, r2 = 2})
shows("cylinder.round", cylinder{h = 4, r = 2, round = 1}:volume() < cylinder{h = 4, r = 2}:volume())
local corner = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}
local sides = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}
shows("polyhedron.points", polyhedron{points = corner, faces = sides}:bbox().max[3] == 1)
shows("polyhedron.faces", near(polyhedron(corner, sides):volume(), 1 / 6))
local turned = {}
for i, f in ipairs(sides) do turned[i] = {f[3], f[2], f[1]} end
shows("polyhedron.fill", polyhedron{points = corner, faces = turned, fill = "evenodd"}:volume() > 0 and
      polyhedron{points = corner, faces = turned, fill = "positive"}:is_empty())
shows("torus.R", torus{R = 9, r = 1}:size()[1] == 20 and torus{major = 9, r = 1} == torus(9, 1))
shows("torus.r", torus{R = 9, r = 2}:size()[3] == 4 and torus{R = 9, minor = 2} == torus(9, 2))
shows("polyhedron.convexity", polyhedron{points = corner, faces = sides, convexity = 3} == polyhedron(corner, sides))
shows("polygon.convexity", polygon{{{0, 0}, {1, 0}, {0, 1}}, convexity = 3} == polygon{{0, 0}, {1, 0}, {0, 1}})
shows("linear_extrude.convexity", square(2):linear_extrude(1, {convexity = 3}) == square(2):linear_extrude(1))
shows("rotate_extrude.convexity", square(2):rotate_extrude{convexity = 3} == square(2):rotate_extrude())
shows("surface.convexity", surface{heights = {{0, 1}, {1, 0}}, convexity = 3} == surface{heights = {{0, 1}, {1, 0}}})
shows("roof.convexity", square(2):roof{convexity = 3} == square(2):roof())
shows("projection.convexity", cube(2):projection{convexity = 3} == square(2))
shows("import.convexity", import("options/a.svg", {convexity = 3}) == import("options/a.svg"))
shows("torus.segments_minor", #torus{R = 9, r = 2, segments_minor = 5}:mesh().points == 16 * 5)
local unit = sphere(1):size()
shows("ellipsoid.r", near(ellipsoid{r = {3, 2, 2}}:size()[1], 3 * unit[1]))
for i, axis in ipairs{"x", "y", "z"} do shows("ellipsoid.r" .. axis, near(ellipsoid{["r" .. axis] = 3}:size()[i], 3 * unit[i])) end
shows("octahedron.r", octahedron{r = 3}:size()[1] == 6 and octahedron{radius = 3} == octahedron(3))
shows("icosahedron.r", near(norm(icosahedron{r = 3}:mesh().points[1]), 3) and icosahedron{radius = 3} == icosahedron(3))
shows("pyramid.x", low(pyramid{x = 2})[1] == 2)
shows("pyramid.y", low(pyramid{y = 2})[2] == 2)
shows("pyramid.z", low(pyramid{z = 2})[3] == 2)
shows("pyramid.length", pyramid{length = 2}:size()[2] == 2)
shows("pyramid.height", pyramid{height = 2}:size()[3] == 2)

-- Shapes, and solids of them.
for name, make in pairs{square = square, rect = rect} do
  shows(name .. ".size", make{size = {2, 3}}:area() == 6)
  shows(name .. ".center", low(make{size = 2, center = {false, true}})[2] == -1 and low(make(2, true))[1] == -1)
  shows(name .. ".r", make{size = 4, r = 1}:area() < 16)
end
shows("circle.r", circle{r = 3}:size()[1] == 6)
shows("circle.d", circle{d = 6}:outlines()[1][1][1] == circle(3):outlines()[1][1][1])
shows("regular_polygon.n", #regular_polygon{n = 5}:points() == 5)
shows("regular_polygon.r", high(regular_polygon{n = 5, r = 3})[1] == 3)
shows("regular_polygon.d", high(regular_polygon{n = 5, d = 3})[1] == 1.5)
shows("regular_polygon.side", near(regular_polygon{n = 6, side = 3}:perimeter(), 18))
shows("regular_polygon.across", near(regular_polygon{n = 6, across = 3}:size()[2], 3))
shows("polygon.points", polygon{points = {{0, 0}, {2, 0}, {0, 2}}}:area() == 2)
shows("polygon.paths", polygon{points = {{0, 0}, {2, 0}, {2, 2}, {0, 2}}, paths = {{0, 1, 2}}}:area() == 2)
local L = polygon{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}}
shows("linear_extrude.height", L:linear_extrude{height = 3}:volume() == 18 and L:linear_extrude{h = 3} == L:linear_extrude(3))
shows("linear_extrude.v", high(L:linear_extrude{v = {1, 0, 2}})[1] == 5)
shows("linear_extrude.center", low(L:linear_extrude{height = 3, center = true})[3] == -1.5)
shows("linear_extrude.twist", near(low(L:linear_extrude{height = 3, twist = 90})[2], -4))
shows("linear_extrude.scale", high(L:linear_extrude{height = 3, scale = {2, 1}})[1] == 8)
local dome, pill = square(4):linear_extrude{height = 4, round = {0, 2}}, square(4):linear_extrude{height = 4, round = 1}
shows("linear_extrude.round", dome:contains(2, 2, 4) and not dome:contains(1, 1, 4) and dome:contains(0, 0, 0) and
      pill:contains(1, 1, 0) and not pill:contains(0.1, 2, 0.1) and not pill:contains(0.1, 2, 3.9))
shows("linear_extrude.slices", #L:linear_extrude{height = 4, twist = 8, slices = 4, segments = 0}:mesh().points == 30)
shows("linear_extrude.segments", #square(2):linear_extrude{height = 4, twist = 8, slices = 1, segments = 8}:mesh().points == 16)
local ring = square(2):translate(5, 0)
shows("rotate_extrude.angle", near(ring:rotate_extrude{angle = 90, fn = 64}:size()[1], 7) and
      ring:rotate_extrude{a = 90} == ring:rotate_extrude(90))
shows("rotate_extrude.start", near(low(ring:rotate_extrude{angle = 90, start = 90})[1], -7))
shows("offset.r", near(square(2):offset{r = 1, fn = 4}:area(), 4 + 8 + 2))
shows("offset.delta", square(2):offset{delta = 1}:area() == 16 and cube(2):offset{delta = 1}:volume() == 64)
shows("offset.chamfer", square(2):offset{delta = 1, chamfer = true}:area() < 16)
shows("resize.newsize", cube(2):resize{newsize = {4, 0, 0}}:volume() == 16 and cube(2):resize{size = {4, 0, 0}}:volume() == 16)
shows("resize.auto", cube(2):resize({4, 0, 0}, {auto = true}):volume() == 64)

-- Text: what text shows, text3d and the metrics show as well.
local function extent(s) return {s:bbox().min[1], s:bbox().min[2], s:bbox().max[1], s:bbox().max[2]} end
local function of_metrics(f) return function(o)
  local m = f(o)
  return {m.position[1], m.position[2], m.position[1] + m.size[1], m.position[2] + m.size[2]}, m
end end
for name, box in pairs{
  text = function(o) return extent(text(o)) end, text3d = function(o) return extent(text3d(o)) end,
  text_metrics = of_metrics(text_metrics), textmetrics = of_metrics(textmetrics),
} do
  local function height(o) local b = box(o) return b[4] - b[2] end
  shows(name .. ".text", box{text = "II"}[3] > box{text = "I"}[3] and height{text = "I\nI"} > 2 * height{text = "I"})
  shows(name .. ".size", near(height{text = "I", size = 20}, 2 * height{text = "I"}))
  shows(name .. ".font", box{text = "I", font = "Liberation Sans:style=Bold"}[3] > box{text = "I"}[3])
  shows(name .. ".em", near(height{text = "I", em = 10}, height{text = "I", size = 7.2}))
  shows(name .. ".halign", box{text = "I", halign = "right"}[3] < 0)
  shows(name .. ".valign", near(box{text = "I", valign = "top"}[4], 0))
  shows(name .. ".spacing", box{text = "II", spacing = 2}[3] > box{text = "II"}[3])
  shows(name .. ".line_spacing", height{text = "I\nI", line_spacing = 2} > height{text = "I\nI"})
  shows(name .. ".direction", height{text = "II", direction = "ttb"} > height{text = "II"})
  shows(name .. ".language", near(height{text = "I", language = "tr"}, height{text = "I"}))
  local rounded, exact = height{text = "I", size = 1000, as_openscad = true}, height{text = "I", size = 1000}
  shows(name .. ".as_openscad", rounded < exact and rounded > exact - 0.1)
  shows(name .. ".script", near(height{text = "I", script = "latin"}, height{text = "I"}))
end
shows("text3d.depth", text3d{text = "I", depth = 3}:size()[3] == 3)
shows("text3d.height", text3d{text = "I", height = 3} == text3d{text = "I", depth = 3} and text3d{"I", h = 3}:size()[3] == 3)
for name, measure in pairs{text_metrics = text_metrics, textmetrics = textmetrics} do  -- of the curve, not of its steps
  for _, facet in ipairs{"fn", "fa", "fs"} do
    shows(name .. "." .. facet, near(measure{text = "O", [facet] = 7}.advance[1], measure{text = "O"}.advance[1]))
  end
end
for name, measure in pairs{font_metrics = font_metrics, fontmetrics = fontmetrics} do
  shows(name .. ".size", near(measure{size = 20}.interline, 2 * measure{}.interline))
  shows(name .. ".font", measure{font = "Liberation Sans:style=Italic"}.font.style == "Italic")
  shows(name .. ".em", near(measure{em = 10}.interline, measure{size = 7.2}.interline))
end

-- Sweeps, lofts, sums, sections.
local path = {{0, 0, 0}, {0, 0, 5}}
shows("sweep.path", square(2):sweep{path = path}:volume() == 20)
shows("sweep.closed", square(1, true):sweep({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}}, {closed = true}):genus() == 1)
shows("sweep.twist", square{4, 1, center = true}:sweep(path, {twist = 90}) ~= square{4, 1, center = true}:sweep(path))
shows("sweep.scale", near(square(2, true):sweep(path, {scale = 2}):size()[1], 4))
shows("sweep.up", square{4, 1, center = true}:sweep(path, {up = {1, 0, 0}}):size()[1] == 1)
local climb = {{20, 0, 0}, {0, 20, 9}, {-20, 0, 18}, {0, -20, 27}, {20, 0, 36}}
shows("sweep.upright", near(square(6, 1, true):sweep(climb, {upright = true}):size().z, 36 + 1 / norm{1, 9 / norm{20, 20}}))
local ell = square(20, 10) + square(10, 20)
local function roofed(o) return count(ell:roof(o)) end
shows("roof.fn", roofed{fn = 80} > roofed{fn = 16} and roofed{segments = 16} == roofed{fn = 16})
shows("roof.fa", roofed{fn = 0, fa = 3, fs = 100} > roofed{fn = 0, fa = 30, fs = 100})
shows("roof.fs", roofed{fn = 0, fa = 100, fs = 0.5} > roofed{fn = 0, fa = 100, fs = 5})
shows("roof.method", near(ell:roof("straight"):volume(), 2000 / 3) and ell:roof():volume() > 670)
shows("loft.outlines", loft{outlines = {square(2), square(2)}, heights = {0, 3}}:volume() == 12)
shows("loft.outlines", loft({square(2), {5, 5}}, 3):volume() == 4)
shows("loft.heights", loft({square(2), square(2)}, {1, 3}):volume() == 8 and loft({square(2), square(2)}, 5):volume() == 20)
shows("hull.operands", hull{cube(1), cube(1):right(3)}:volume() == 4)
shows("minkowski.operands", minkowski(cube(1), {cube(2)}):volume() == 27)
shows("projection.cut", (cube(4):down(1) + cube(9):up(1)):projection{cut = true}:area() == 16)
shows("slice.z", (cube(4) + cube(9):up(5)):slice{z = 6}:area() == 81)
shows("slice.normal", cube(2, 4, 8):slice{normal = {3, 0, 0}, offset = 1}:size() == vec(4, 8))
shows("slice.offset", (cube(4) + cube(9):right(5)):slice({1, 0, 0}, 6):area() == 81)
shows("slice.point", (cube(4) + cube(9):right(5)):slice{normal = {1, 0, 0}, point = {6, 99, 99}}:area() == 81)
shows("project.direction", cube(2, 4, 8):project{direction = {0, 2, 0}}:area() == 16 and
      cube(2, 4, 8):project{normal = {1, 0, 0}} == cube(2, 4, 8):project({1, 0, 0}))
for name, cut in pairs{split = function(o) return (cube(4):split(o)) end, trim = function(o) return cube(4):trim(o) end} do
  shows(name .. ".normal", low(cut{normal = {1, 0, 0}, offset = 1})[1] == 1)
  shows(name .. ".offset", low(cut{normal = {0, 0, 2}, offset = 3})[3] == 3)
  shows(name .. ".point", low(cut{normal = {0, 1, 0}, point = {9, 1, 9}})[2] == 1)
end

-- Free forms.
shows("surface.file", surface{file = "options/heights.txt"}:size()[1] == 2)
shows("surface.center", low(surface{file = "options/heights.txt", center = true})[1] == -1)
shows("surface.invert", surface{file = "options/heights.png", invert = true} ~= surface("options/heights.png"))
shows("surface.heights", surface{heights = {{0, 1}, {2, 3}}}:size()[3] == 4)
shows("refine.length", #cube(4):refine{length = 1}:mesh().points > 100)
shows("smooth.rounds", #cube(4):smooth{rounds = 2}:mesh().faces == 12 * 16)
shows("warp.f", cube(1):warp{f = function(x, y, z) return 2 * x, y, z end}:volume() == 2)
local function ball(x, y, z) return norm{x, y, z} - 3 end
local box = {min = {-5, -5, -5}, max = {5, 5, 5}}
shows("chamfer.distance", cube(4):chamfer{distance = 1, edges = "z"}:volume() == 56)
shows("chamfer.edges", cube(4):chamfer(1, {edges = "x"}) ~= cube(4):chamfer(1, {edges = "y"}))
shows("fillet.r", cube(4):fillet{r = 1} == cube(4):fillet{radius = 1})
shows("fillet.edges", cube(4):fillet(1, {edges = {on = "top"}}) == cube(4):fillet(1, "top"))
shows("edges.on", #cube(4):edges{on = "left"} == 4)
shows("edges.along", #cube(4):edges{along = {0, 0, -1}} == 4)
shows("edges.near", #cube(4):edges{near = {2, 0, 5}} == 1)
shows("edges.normal", #cube(4):edges{normal = {0, 1, 0}} == 4)
shows("edges.through", #cube(4):edges{through = {1, 0, 1}} == 4)
shows("edges.turn", #cube(4):edges{turn = 90} == 12 and #cube(4):edges{turn = 91} == 0)
shows("levelset.f", levelset{f = ball, bounds = box}:contains(0, 0, 2))
shows("levelset.bounds", high(levelset{f = ball, bounds = {{-5, -5, -5}, {0, 5, 5}}})[1] == 0)
shows("levelset.step", #levelset{f = ball, bounds = box, step = 0.5}:mesh().points > 2 * #levelset(ball, box):mesh().points)
shows("levelset.level", levelset{f = ball, bounds = box, level = 1}:volume() > levelset(ball, box):volume())

-- Transforms, and where parts stand.
for name, move in pairs{translate = translate, move = move} do
  shows(name .. ".v", low(move{v = {1, 2, 3}} * cube(1))[3] == 3)
  for i, axis in ipairs{"x", "y", "z"} do shows(name .. "." .. axis, low(move{[axis] = 4} * cube(1))[i] == 4) end
end
local bar = cube(1, 2, 4)
shows("rotate.a", bar:rotate{a = 90}:size()[1] == 2 and bar:rotate{a = {90, 0, 0}}:size()[2] == 4)
shows("rotate.v", bar:rotate{a = 90, v = {1, 0, 0}} == bar:rx(90))
shows("rotate.x", bar:rotate{x = 90} == bar:rx(90))
shows("rotate.y", bar:rotate{y = 90} == bar:ry(90))
shows("rotate.z", bar:rotate{z = 90} == bar:rz(90))
shows("scale.v", bar:scale{v = {1, 1, 2}}:size()[3] == 8 and bar:scale(2):size()[1] == 2)
for i, axis in ipairs{"x", "y", "z"} do shows("scale." .. axis, bar:scale{[axis] = 3}:size()[i] == 3 * bar:size()[i]) end
shows("mirror.v", low(bar:mirror{v = {0, 1, 0}})[2] == -2)
shows("multmatrix.m", low(bar:multmatrix{m = {{1, 0, 0, 7}}})[1] == 7)
for name, axis in pairs{up = 3, down = -3, left = -1, right = 1, forward = -2, front = -2, back = 2, tx = 1, ty = 2, tz = 3} do
  local i, sign = math.abs(axis), axis > 0 and 1 or -1
  shows(name .. ".d", low(bar[name](bar, {d = 5}))[i] == sign * 5)
end
shows("rx.a", bar:rx{a = 90}:size()[2] == 4)
shows("ry.a", bar:ry{a = 90}:size()[1] == 4)
shows("rz.a", bar:rz{a = 90}:size()[1] == 2)
shows("anchor.at", bar:anchor{at = "top-right"}[3] == 4 and bar:anchor{at = "top-right"}[1] == 1)
shows("attach.to", low(bar:attach{to = cube(3)})[3] == 3)
shows("attach.at", low(bar:attach{to = cube(3), at = "right"})[1] == 3)
shows("attach.own", low(bar:attach{to = cube(3), at = "top", own = "top"})[3] == -1)
shows("attach.gap", low(bar:attach{to = cube(3), gap = 2})[3] == 5)
for i, axis in ipairs{"x", "y", "z"} do shows("align." .. axis, high(bar:align{[axis] = "max"})[i] == 0) end
shows("align.to", low(bar:align{z = "min", to = {0, 0, 8}})[3] == 8 and high(bar:align{z = "max", to = cube(9)})[3] == 9)
shows("centered.axes", low(bar:centered{axes = {true, false, false}})[1] == -0.5 and low(bar:centered())[3] == -2)
local post = cube(1):translate(2, 0, 0)
shows("mirror_copy.v", low(post:mirror_copy{v = {1, 0, 0}})[1] == -3)
shows("mirror_copy.list", #post:mirror_copy{list = true} == 2)
shows("linear_array.n", cube(1):linear_array{n = 3, v = {2, 0}}:components() == 3)
shows("linear_array.v", cube(1):linear_array{n = 3, v = {0, 5}}:size()[2] == 11)
shows("linear_array.center", low(cube(1, true):linear_array{n = 3, v = {4, 0}, center = true})[1] == -4.5)
shows("linear_array.list", #cube(1):linear_array{n = 3, v = {2, 0}, list = true} == 3)
shows("grid_array.n", cube(1):grid_array{n = {3, 2}, step = 2}:components() == 6)
shows("grid_array.step", cube(1):grid_array{n = {2, 2}, step = {5, 3}}:size()[1] == 6)
shows("grid_array.center", low(cube(1, true):grid_array{n = {2, 2}, step = 4, center = true})[1] == -2.5)
shows("grid_array.list", #cube(1):grid_array{n = {3, 2}, step = 2, list = true} == 6)
shows("polar_array.n", post:polar_array{n = 5}:components() == 5)
shows("polar_array.angle", near(high(post:polar_array{n = 2, angle = 90})[2], 3))
shows("polar_array.axis", low(post:polar_array{n = 2, axis = {0, 1, 0}})[1] == -3)
shows("polar_array.center", low(post:polar_array{n = 2, center = {1, 0}})[1] == -1)
shows("polar_array.turn", near(high(cube(1):translate(2, -0.5, 0):polar_array{n = 2, angle = 90, turn = false})[2], 3.0 ))
shows("polar_array.list", #post:polar_array{n = 5, list = true} == 5)

-- Booleans and colours: painted solids are equal only where their colours are.
local a, b = cube(2), cube(2):right(1)
for name, volume in pairs{union = 12, intersection = 4, symmetric_difference = 8, add = 12, intersect = 4} do
  shows(name .. ".operands", a[name](a, {b}):volume() == volume)
end
for name, reduce in pairs{difference = a.difference, sub = a.sub, subtract = a.subtract} do
  shows(name .. ".operands", reduce(a, b):volume() == 4)
  local red, blue = a:color("red"), b:color("blue")
  shows(name .. ".cut", reduce(red, blue, {cut = "body"}) ~= reduce(red, blue) and
        reduce(red, blue, {cut = "body"}) == reduce(a, b):color("red"))
end
local shell = cube(6) - cube(2):translate(2, 2, 2)
shows("outer_hull.keep_voids", outer_hull(shell, {keep_voids = true}):volume() == 208 and outer_hull(shell):volume() == 216)
shows("outer_hull.orientation_sensitive", outer_hull(shell, {orientation_sensitive = true}):volume() == 216)
for name, paint in pairs{color = color, setcolor = setcolor} do
  shows(name .. ".c", paint(a, {c = "red"}) == paint(a, {c = {1, 0, 0}}) and paint(a, "red") ~= paint(a, "#0000ff"))
  shows(name .. ".alpha", paint(a, {c = "red", alpha = 0.5}) ~= paint(a, "red"))
  shows(name .. ".metallic", paint(a, {c = "red", metallic = 1}) ~= paint(a, "red"))
  shows(name .. ".roughness", paint(a, {c = "red", roughness = 1}) ~= paint(a, "red"))
  shows(name .. ".name", paint(a, {c = "red", name = "paint"}) ~= paint(a, "red"))
end
shows("material.kind", material(a, {kind = "glass"}) ~= material(a, {kind = "metal"}))
shows("material.metallic", material(a, {metallic = 1}) ~= material(a, "plastic"))
shows("material.roughness", material(a, {roughness = 1}) ~= material(a, "plastic"))
shows("material.name", material(a, {name = "mine"}) ~= material(a, "plastic"))
for _, unwritten in ipairs{"specular", "ior", "strength"} do  -- each is warned of
  shows("material." .. unwritten, material(a, {[unwritten] = 1}) == material(a, "plastic"))
end
shows("name.name", a:name{name = "lid"}:volume() == 8)

-- Measuring, selecting, numbers.
shows("contains.p", a:contains{p = {1, 1, 1}} and not a:contains{p = {3, 1, 1}})
shows("faces.normal", #a:faces{normal = {0, 0, 1}} == 1)
shows("faces.angle", #a:faces{normal = {0, 0, 1}, angle = 91} == 5)
shows("faces.through", #a:faces{through = {0, 0, 2}} == 3)
shows("ray.from", a:ray{from = {-3, 1, 1}, direction = {1, 0, 0}}[1].distance == 3)
shows("ray.direction", #a:ray{from = {-3, 1, 1}, direction = {0, 1, 0}} == 0)
shows("gap.other", a:gap{other = a:right(5)} == 3)
local one = {sin = {30, 0.5}, cos = {60, 0.5}, tan = {45, 1}, sind = {30, 0.5}, cosd = {60, 0.5}, tand = {45, 1}}
for name, case in pairs(one) do shows(name .. ".a", csg[name]{a = case[1]} == case[2]) end
one = {asin = {1, 90}, acos = {0, 90}, atan = {1, 45}, asind = {1, 90}, acosd = {0, 90}, atand = {1, 45}, abs = {-2, 2},
       sign = {-2, -1}, floor = {1.5, 1}, ceil = {1.5, 2}, round = {1.5, 2}, sqrt = {4, 2}, exp = {0, 1}, ln = {1, 0}}
for name, case in pairs(one) do shows(name .. ".x", csg[name]{x = case[1]} == case[2]) end
for _, name in ipairs{"atan2", "atan2d"} do
  shows(name .. ".y", csg[name]{y = 1, x = 0} == 90)
  shows(name .. ".x", csg[name]{y = 0, x = -1} == 180)
end
shows("pow.x", pow{x = 3, y = 1} == 3)
shows("pow.y", pow{x = 2, y = 5} == 32)
shows("vec.v", vec{v = {1, 2, 3}}.z == 3)
shows("vector.v", vector{v = {1, 2, 3}}.z == 3)
shows("cross.a", cross{a = {1, 0, 0}, b = {0, 1, 0}}[3] == 1)
shows("cross.b", cross{a = {1, 0, 0}, b = {0, 0, 1}}[2] == -1)
shows("norm.v", norm{v = {3, 4}} == 5)
shows("lookup.key", lookup{key = 1, table = {{0, 0}, {2, 4}}} == 2)
shows("lookup.table", lookup(1, {{0, 0}, {2, 8}}) == 4)
local drawn = rands{min = 5, max = 6, n = 40, seed = 1}
shows("rands.min", min(drawn) >= 5)
shows("rands.max", max(drawn) <= 6 and max(drawn) > 5.5)
shows("rands.n", #drawn == 40)
shows("rands.seed", rands(5, 6, 40, 1)[7] == drawn[7] and rands(5, 6, 40, 2)[7] ~= drawn[7])
shows("min.values", min(3, 1) == 1 and min{3, 1} == 1)
shows("max.values", max(3, 1) == 3 and max{3, 1} == 3)

-- Parameters: what is not good is an error of the default.
shows("param.name", param{name = "width", default = 3} == 3)
shows("param.default", param("list", {1, 2})[2] == 2)
shows("param.min", not pcall(param, "w1", 3, {min = 4}))
shows("param.max", not pcall(param, "w2", 3, {max = 2}))
shows("param.step", not pcall(param, "w3", 3, {step = 2}))
shows("param.choices", not pcall(param, "w4", 3, {choices = {4, 5}}))
shows("param.doc", param("w5", 3, {doc = "how wide"}) == 3)
shows("var.doc", var{doc = "how high", default = 4} == 4)
shows("var.default", var("how deep", "x") == "x")

-- Files.
shows("read_text.file", read_text{file = "options/table.csv"}:sub(1, 3) == "a;b")
shows("read_json.file", read_json{file = "options/a.json"}.list[2] == 2)
shows("read_csv.file", read_csv{file = "options/heights.txt", separator = " "}[2][1] == 1)
shows("read_csv.header", read_csv{file = "options/table.csv", separator = ";", header = true}[1].b == 2)
shows("read_csv.separator", #read_csv{file = "options/table.csv", separator = ";"}[1] == 2)
shows("read_csv.numbers", read_csv{file = "options/table.csv", separator = ";", numbers = false}[2][1] == "1")
shows("load_csg.file", load_csg{file = "options/a.csg"}:volume() == 6)
shows("import.file", import{file = "options/open.off", repair = {fill_holes = true}}:volume() > 0)
shows("import.repair", not pcall(import, "options/open.off"))
shows("import.parts", #import("options/closed.off", {parts = true}) == 1)
shows("import.fill", import("options/closed.off", {fill = "evenodd"}):volume() > 0)
shows("import.layer", import("options/a.dxf", {layer = "holes"}):size()[1] == 2)
shows("import.id", near(import("options/a.svg", {id = "box"}):size()[1], 4 * 25.4 / 72))
shows("import.dpi", near(import("options/a.svg", {id = "box", dpi = 25.4}):area(), 8))
shows("import.origin", low(import("options/a.dxf", {layer = "holes", origin = {1, 0}}))[1] == -2)
shows("import.scale", import("options/a.dxf", {layer = "holes", scale = 3}):size()[1] == 6)
shows("import.as_openscad", import("options/a.svg", {id = "none", as_openscad = true}):is_empty())
shows("import.center", near(low(import("options/a.svg", {id = "box", dpi = 25.4, center = true}))[1], -2))
shows("require.name", require{name = "csg.gears"} == require "csg.gears")
emit(cube(1), {name = "emitted"})
shows("emit.name", not pcall(emit, cube(1), {name = "emitted"}))
render(cube(1), {name = "rendered"})
shows("render.name", not pcall(render, cube(1), {name = "rendered"}))
assert(#failed == 0, "these do not do what they should: " .. table.concat(failed, ", "))
