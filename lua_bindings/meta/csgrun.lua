---@meta
-- Made by `csgrun --help-api=luals` from the tables that check arguments; do not edit.
-- `csgrun --init` puts it where the Lua language server finds it.

---@class csg
---@field fn number
---@field fa number
---@field fs number
---@field grid number|string|nil
---@field contacts "separate"|"join"
---@field PI number
csg = {}

---@type number
PI = nil

---@class Vector: number[]
---@field x number
---@field y number
---@field z number
---@operator add(number[]): Vector
---@operator sub(number[]): Vector
---@operator mul(number): Vector
---@operator div(number): Vector
---@operator unm: Vector
local Vector = {}

---@class Matrix
---@operator mul(any): any
local Matrix = {}

---@class Solid
---@operator add(Solid): Solid
---@operator sub(Solid): Solid
---@operator mul(Solid): Solid
---@operator bor(Solid): Solid
---@operator band(Solid): Solid
---@operator bxor(Solid): Solid
local Solid = {}

---@class Shape
---@operator add(Shape): Shape
---@operator sub(Shape): Shape
---@operator mul(Shape): Shape
---@operator bor(Shape): Shape
---@operator band(Shape): Shape
---@operator bxor(Shape): Shape
local Shape = {}

---@class (exact) csgrun.cube
---@field [integer] any
---@field size? number|number[] edge length, or lengths along X, Y and Z
---@field center? boolean|boolean[] centred in the origin, or along these axes
---@field r? number radius of its edges and corners, at most half of its shortest side
---@field fn? number number of facets of a full turn; 0: from fa and fs
---@field segments? number the same as fn
---@field fa? number smallest angle of a facet, degrees, at least 0.01
---@field fs? number smallest length of a facet, mm, at least 0.01

---A box; a corner stands in the origin unless it is centred.
---
---Example: `cube{size = {60, 40, 5}, center = true}`
---@overload fun(options: csgrun.cube): Solid
---@overload fun(x: number, y?: number, z?: number, ...): Solid
---@param size? number|number[] edge length, or lengths along X, Y and Z
---@param center? boolean|boolean[] centred in the origin, or along these axes
---@param options? csgrun.cube
---@return Solid
function cube(size, center, options) end
csg.cube = cube

---@class (exact) csgrun.sphere
---@field [integer] any
---@field r? number radius
---@field d? number diameter, instead of r
---@field fn? number number of facets of a full turn; 0: from fa and fs
---@field segments? number the same as fn
---@field fa? number smallest angle of a facet, degrees, at least 0.01
---@field fs? number smallest length of a facet, mm, at least 0.01

---A ball about the origin, as rings of facets.
---
---Example: `sphere(10, {fn = 64})`
---@overload fun(options: csgrun.sphere): Solid
---@param r? number radius
---@param options? csgrun.sphere
---@return Solid
function sphere(r, options) end
csg.sphere = sphere

---@class (exact) csgrun.cylinder
---@field [integer] any
---@field h? number height
---@field height? number the same as h
---@field r1? number radius at the bottom
---@field r2? number radius at the top
---@field center? boolean centred along Z
---@field r? number radius at both ends
---@field d? number diameter at both ends
---@field d1? number diameter at the bottom
---@field d2? number diameter at the top
---@field round? number radius of both rims, at most r and half of h
---@field fn? number number of facets of a full turn; 0: from fa and fs
---@field segments? number the same as fn
---@field fa? number smallest angle of a facet, degrees, at least 0.01
---@field fs? number smallest length of a facet, mm, at least 0.01

---A cylinder along Z; cylinder(h, r1, r2) is a cone, cylinder(h, r) is not; cylinder(h, r, true) is centred.
---
---Example: `cylinder{h = 20, r = 4, center = true, fn = 64}`
---@overload fun(options: csgrun.cylinder): Solid
---@param h? number height
---@param r1? number radius at the bottom
---@param r2? number radius at the top
---@param center? boolean centred along Z
---@param options? csgrun.cylinder
---@return Solid
function cylinder(h, r1, r2, center, options) end
csg.cylinder = cylinder

---@class (exact) csgrun.polyhedron
---@field [integer] any
---@field points? number[][] the corners; the first is point 0, in faces and messages
---@field faces? integer[][] corners of each face, clockwise seen from outside; the first is face 0 in messages
---@field fill? string what is inside where the surface crosses itself, by how often it wraps around a point, one way less the other: "nonzero" (wherever that is not 0: overlaps are united, but an inverted part cancels what it overlaps), "positive" (inverted parts are cut away), "evenodd" (an odd number: overlaps cancel)
---@field convexity? integer ignored: OpenSCAD needs it for its preview

---A solid of its own corners and faces; it must be closed.
---
---Example: `polyhedron{points = {{0,0,0},{1,0,0},{0,1,0},{0,0,1}}, faces = {{0,1,2},{0,3,1},{0,2,3},{1,3,2}}}`
---@overload fun(options: csgrun.polyhedron): Solid
---@param points? number[][] the corners; the first is point 0, in faces and messages
---@param faces? integer[][] corners of each face, clockwise seen from outside; the first is face 0 in messages
---@param options? csgrun.polyhedron
---@return Solid
function polyhedron(points, faces, options) end
csg.polyhedron = polyhedron

---@class (exact) csgrun.torus
---@field [integer] any
---@field R? number radius of the ring, to the middle of its tube
---@field major? number the same as R
---@field r? number radius of the tube
---@field minor? number the same as r
---@field segments_minor? number fn of the tube
---@field fn? number number of facets of a full turn; 0: from fa and fs
---@field segments? number the same as fn
---@field fa? number smallest angle of a facet, degrees, at least 0.01
---@field fs? number smallest length of a facet, mm, at least 0.01

---A ring about Z: a circle that is turned.
---
---Example: `torus{R = 20, r = 5, fn = 48}`
---@overload fun(options: csgrun.torus): Solid
---@param R? number radius of the ring, to the middle of its tube
---@param r? number radius of the tube
---@param options? csgrun.torus
---@return Solid
function torus(R, r, options) end
csg.torus = torus

---@class (exact) csgrun.ellipsoid
---@field [integer] any
---@field r? number|number[] radii along X, Y and Z, or one for all
---@field rx? number radius along X
---@field ry? number radius along Y
---@field rz? number radius along Z
---@field fn? number number of facets of a full turn; 0: from fa and fs
---@field segments? number the same as fn
---@field fa? number smallest angle of a facet, degrees, at least 0.01
---@field fs? number smallest length of a facet, mm, at least 0.01

---A sphere that is scaled; fa and fs are those of a sphere of the largest radius.
---
---Example: `ellipsoid(20, 10, 5, {fn = 48})`
---@overload fun(options: csgrun.ellipsoid): Solid
---@overload fun(x: number, y?: number, z?: number, ...): Solid
---@param r? number|number[] radii along X, Y and Z, or one for all
---@param options? csgrun.ellipsoid
---@return Solid
function ellipsoid(r, options) end
csg.ellipsoid = ellipsoid

---@class (exact) csgrun.octahedron
---@field [integer] any
---@field r? number distance of the corners from the origin
---@field radius? number the same as r

---Eight triangles; the corners lie on the axes.
---
---Example: `octahedron(10)`
---@overload fun(options: csgrun.octahedron): Solid
---@param r? number distance of the corners from the origin
---@param options? csgrun.octahedron
---@return Solid
function octahedron(r, options) end
csg.octahedron = octahedron

---@class (exact) csgrun.icosahedron
---@field [integer] any
---@field r? number distance of the corners from the origin
---@field radius? number the same as r

---Twenty triangles; each corner lies in a plane of two axes.
---
---Example: `icosahedron(10)`
---@overload fun(options: csgrun.icosahedron): Solid
---@param r? number distance of the corners from the origin
---@param options? csgrun.icosahedron
---@return Solid
function icosahedron(r, options) end
csg.icosahedron = icosahedron

---@class (exact) csgrun.pyramid
---@field [integer] any
---@field x? number where its first corner is
---@field y? number likewise
---@field z? number likewise
---@field length? number side of the square below
---@field height? number height

---A square pyramid, its tip over the middle; a corner stands at (x, y, z).
---
---Example: `pyramid(0, 0, 0, 10, 8)`
---@overload fun(options: csgrun.pyramid): Solid
---@param x? number where its first corner is
---@param y? number likewise
---@param z? number likewise
---@param length? number side of the square below
---@param height? number height
---@param options? csgrun.pyramid
---@return Solid
function pyramid(x, y, z, length, height, options) end
csg.pyramid = pyramid

---@class (exact) csgrun.square
---@field [integer] any
---@field size? number|number[] edge length, or lengths along X and Y
---@field center? boolean|boolean[] centred in the origin, or along these axes
---@field r? number radius of the corners
---@field fn? number number of facets of a full turn; 0: from fa and fs
---@field segments? number the same as fn
---@field fa? number smallest angle of a facet, degrees, at least 0.01
---@field fs? number smallest length of a facet, mm, at least 0.01

---A rectangle; a corner lies in the origin unless it is centred.
---
---Example: `square{20, 10, center = true, r = 2}`
---@overload fun(options: csgrun.square): Shape
---@overload fun(x: number, y?: number, z?: number, ...): Shape
---@param size? number|number[] edge length, or lengths along X and Y
---@param center? boolean|boolean[] centred in the origin, or along these axes
---@param options? csgrun.square
---@return Shape
function square(size, center, options) end
csg.square = square

---@class (exact) csgrun.rect
---@field [integer] any
---@field size? number|number[] edge length, or lengths along X and Y
---@field center? boolean|boolean[] centred in the origin, or along these axes
---@field r? number radius of the corners
---@field fn? number number of facets of a full turn; 0: from fa and fs
---@field segments? number the same as fn
---@field fa? number smallest angle of a facet, degrees, at least 0.01
---@field fs? number smallest length of a facet, mm, at least 0.01

---A rectangle: another name of square.
---
---Example: `rect(20, 10)`
---@overload fun(options: csgrun.rect): Shape
---@overload fun(x: number, y?: number, z?: number, ...): Shape
---@param size? number|number[] edge length, or lengths along X and Y
---@param center? boolean|boolean[] centred in the origin, or along these axes
---@param options? csgrun.rect
---@return Shape
function rect(size, center, options) end
csg.rect = rect

---@class (exact) csgrun.circle
---@field [integer] any
---@field r? number radius
---@field d? number diameter, instead of r
---@field fn? number number of facets of a full turn; 0: from fa and fs
---@field segments? number the same as fn
---@field fa? number smallest angle of a facet, degrees, at least 0.01
---@field fs? number smallest length of a facet, mm, at least 0.01

---A disc about the origin.
---
---Example: `circle(5, {fn = 48})`
---@overload fun(options: csgrun.circle): Shape
---@param r? number radius
---@param options? csgrun.circle
---@return Shape
function circle(r, options) end
csg.circle = circle

---@class (exact) csgrun.regular_polygon
---@field [integer] any
---@field n? integer number of corners, at least 3
---@field r? number radius of the corners
---@field d? number twice that
---@field side? number length of a side, instead of r
---@field across? number twice the distance of a side from the centre, instead of r: the size of a spanner

---A polygon of equal sides about the origin; its first corner lies on +X.
---
---Example: `regular_polygon(6, {across = 10})`
---@overload fun(options: csgrun.regular_polygon): Shape
---@param n? integer number of corners, at least 3
---@param r? number radius of the corners
---@param options? csgrun.regular_polygon
---@return Shape
function regular_polygon(n, r, options) end
csg.regular_polygon = regular_polygon

---@class (exact) csgrun.polygon
---@field [integer] any
---@field points? number[][] the corners; the first is point 0, in paths and messages
---@field paths? integer[][] outlines and holes, as indices of points from 0
---@field convexity? integer ignored: OpenSCAD needs it for its preview

---A shape of its own outlines, filled by the even-odd rule.
---
---Example: `polygon{{0, 0}, {20, 0}, {0, 10}}`
---@overload fun(options: csgrun.polygon): Shape
---@param points? number[][] the corners; the first is point 0, in paths and messages
---@param paths? integer[][] outlines and holes, as indices of points from 0
---@param options? csgrun.polygon
---@return Shape
function polygon(points, paths, options) end
csg.polygon = polygon

---@class (exact) csgrun.linear_extrude
---@field [integer] any
---@field height? number height; or a vector {x, y, z}: where the shape is moved, as v alone says it
---@field h? number the same as height
---@field v? number[] direction
---@field center? boolean centred along the direction
---@field twist? number turn over the whole height, clockwise seen from above, degrees
---@field scale? number|number[] factor at the top, or factors along X and Y; 0 gives a point or an edge
---@field round? number|number[] radius of the edges at the bottom and at the top, or {bottom, top}, mm: at most what the widest place of each piece has room for
---@field slices? integer number of layers
---@field segments? integer number of pieces of the outline; 0: never split
---@field convexity? integer ignored: OpenSCAD needs it for its preview
---@field fn? number number of facets of a full turn; 0: from fa and fs
---@field fa? number smallest angle of a facet, degrees, at least 0.01
---@field fs? number smallest length of a facet, mm, at least 0.01

---A solid: the shape moved along Z (or v).
---
---Example: `circle(5):linear_extrude(20, {twist = 90})`
---@param shape any the 2D shape; as a method, shape:f(...), it is left out
---@param height? number height; or a vector {x, y, z}: where the shape is moved, as v alone says it
---@param options? csgrun.linear_extrude
---@return Solid
function linear_extrude(shape, height, options) end
csg.linear_extrude = linear_extrude

---A solid: the shape moved along Z (or v).
---
---Example: `circle(5):linear_extrude(20, {twist = 90})`
---@overload fun(self: Shape, options: csgrun.linear_extrude): Solid
---@param height? number height; or a vector {x, y, z}: where the shape is moved, as v alone says it
---@param options? csgrun.linear_extrude
---@return Solid
function Shape:linear_extrude(height, options) end

---@class (exact) csgrun.rotate_extrude
---@field [integer] any
---@field angle? number how far to turn, counter-clockwise seen from above, degrees
---@field a? number the same as angle
---@field start? number where to start, degrees from X
---@field convexity? integer ignored: OpenSCAD needs it for its preview
---@field fn? number number of facets of a full turn; 0: from fa and fs
---@field segments? number the same as fn
---@field fa? number smallest angle of a facet, degrees, at least 0.01
---@field fs? number smallest length of a facet, mm, at least 0.01

---A solid: the shape turned about Z, its Y upwards. It must lie on one side of Y.
---
---Example: `circle(2):translate(10, 0):rotate_extrude()`
---@param shape any the 2D shape; as a method, shape:f(...), it is left out
---@param angle? number how far to turn, counter-clockwise seen from above, degrees
---@param options? csgrun.rotate_extrude
---@return Solid
function rotate_extrude(shape, angle, options) end
csg.rotate_extrude = rotate_extrude

---A solid: the shape turned about Z, its Y upwards. It must lie on one side of Y.
---
---Example: `circle(2):translate(10, 0):rotate_extrude()`
---@overload fun(self: Shape, options: csgrun.rotate_extrude): Solid
---@param angle? number how far to turn, counter-clockwise seen from above, degrees
---@param options? csgrun.rotate_extrude
---@return Solid
function Shape:rotate_extrude(angle, options) end

---@class (exact) csgrun.offset
---@field [integer] any
---@field r? number distance, outwards (negative: inwards), with round corners: of a solid by a ball
---@field delta? number distance with sharp corners (of a solid by a box along the axes); r counts if both are given
---@field chamfer? boolean with delta: corners are cut square at that distance
---@field fn? number number of facets of a full turn; 0: from fa and fs
---@field segments? number the same as fn
---@field fa? number smallest angle of a facet, degrees, at least 0.01
---@field fs? number smallest length of a facet, mm, at least 0.01

---The shape with its outline moved; or the solid with its surface moved.
---
---Example: `square(10):offset{delta = 2, chamfer = true}`
---@param shape any the 2D shape; as a method, shape:f(...), it is left out
---@param r? number distance, outwards (negative: inwards), with round corners: of a solid by a ball
---@param options? csgrun.offset
---@return Shape
function offset(shape, r, options) end
csg.offset = offset

---The shape with its outline moved; or the solid with its surface moved.
---
---Example: `square(10):offset{delta = 2, chamfer = true}`
---@overload fun(self: Solid, options: csgrun.offset): Shape
---@param r? number distance, outwards (negative: inwards), with round corners: of a solid by a ball
---@param options? csgrun.offset
---@return Shape
function Solid:offset(r, options) end

---The shape with its outline moved; or the solid with its surface moved.
---
---Example: `square(10):offset{delta = 2, chamfer = true}`
---@overload fun(self: Shape, options: csgrun.offset): Shape
---@param r? number distance, outwards (negative: inwards), with round corners: of a solid by a ball
---@param options? csgrun.offset
---@return Shape
function Shape:offset(r, options) end

---The shape without its holes.
---
---Example: `(circle(5) - circle(3)):fill()`
---@param shape any the 2D shape; as a method, shape:f(...), it is left out
---@return Shape
function fill(shape) end
csg.fill = fill

---The shape without its holes.
---
---Example: `(circle(5) - circle(3)):fill()`
---@return Shape
function Shape:fill() end

---The length of all outlines, holes included.
---
---Example: `circle(5):perimeter()`
---@return number
function Shape:perimeter() end

---The corners {{x, y}, ...}, as polygon takes them.
---
---Example: `polygon(shape:points(), shape:paths())`
---@return number[][]
function Shape:points() end

---The outlines, by indices of points() from 0: outer ones counter-clockwise, holes clockwise.
---
---Example: `square(5):paths()`
---@return integer[][]
function Shape:paths() end

---The outlines as lists of points {x, y}, in the order of paths().
---
---Example: `square(5):outlines()`
---@return number[][][]
function Shape:outlines() end

---@class (exact) csgrun.text
---@field [integer] any
---@field text? string in UTF-8; a newline begins a line
---@field size? number height of capitals, roughly; the em is size / 0.72
---@field font? string a font file beside the model (.ttf, .otf), or a family: "Liberation Sans:style=Bold"; behind either its features: "Liberation Sans:fontfeatures=-kern;-liga"
---@field em? number the em itself, instead of size
---@field halign? string "left", "center" or "right", by advance width; in ttb and btt by the ink
---@field valign? string "baseline", "bottom", "center" or "top", by the ink; in ttb and btt by advance
---@field spacing? number factor of the distances of characters
---@field line_spacing? number factor of the distance of lines, which the font has
---@field direction? string "ltr", "rtl", "ttb" or "btt"
---@field language? string language, for the font's rules
---@field script? string script: "latin", "arabic" ..., or a code: "Latn"
---@field as_openscad? boolean rounded as in OpenSCAD: letters 6e-5 smaller, ink aligned to within 6e-4 of the size
---@field fn? number number of facets of a full turn; 0: from fa and fs
---@field segments? number the same as fn
---@field fa? number smallest angle of a facet, degrees, at least 0.01
---@field fs? number smallest length of a facet, mm, at least 0.01

---Text as a 2D shape: one line or several.
---
---Example: `text("csgrun", {size = 8, halign = "center"})`
---@overload fun(options: csgrun.text): Shape
---@param text? string in UTF-8; a newline begins a line
---@param size? number height of capitals, roughly; the em is size / 0.72
---@param font? string a font file beside the model (.ttf, .otf), or a family: "Liberation Sans:style=Bold"; behind either its features: "Liberation Sans:fontfeatures=-kern;-liga"
---@param options? csgrun.text
---@return Shape
function text(text, size, font, options) end
csg.text = text

---@class (exact) csgrun.text3d
---@field [integer] any
---@field text? string in UTF-8; a newline begins a line
---@field size? number height of capitals, roughly; the em is size / 0.72
---@field font? string a font file beside the model (.ttf, .otf), or a family: "Liberation Sans:style=Bold"; behind either its features: "Liberation Sans:fontfeatures=-kern;-liga"
---@field em? number the em itself, instead of size
---@field halign? string "left", "center" or "right", by advance width; in ttb and btt by the ink
---@field valign? string "baseline", "bottom", "center" or "top", by the ink; in ttb and btt by advance
---@field spacing? number factor of the distances of characters
---@field line_spacing? number factor of the distance of lines, which the font has
---@field direction? string "ltr", "rtl", "ttb" or "btt"
---@field language? string language, for the font's rules
---@field script? string script: "latin", "arabic" ..., or a code: "Latn"
---@field as_openscad? boolean rounded as in OpenSCAD: letters 6e-5 smaller, ink aligned to within 6e-4 of the size
---@field depth? number how thick, along Z
---@field height? number the same, as linear_extrude calls it
---@field h? number the same as height
---@field fn? number number of facets of a full turn; 0: from fa and fs
---@field segments? number the same as fn
---@field fa? number smallest angle of a facet, degrees, at least 0.01
---@field fs? number smallest length of a facet, mm, at least 0.01

---Text as a solid: one line or several.
---
---Example: `text3d("csgrun", {size = 8, depth = 2})`
---@overload fun(options: csgrun.text3d): Solid
---@param text? string in UTF-8; a newline begins a line
---@param size? number height of capitals, roughly; the em is size / 0.72
---@param font? string a font file beside the model (.ttf, .otf), or a family: "Liberation Sans:style=Bold"; behind either its features: "Liberation Sans:fontfeatures=-kern;-liga"
---@param options? csgrun.text3d
---@return Solid
function text3d(text, size, font, options) end
csg.text3d = text3d

---@class (exact) csgrun.text_metrics
---@field [integer] any
---@field text? string in UTF-8; a newline begins a line
---@field size? number height of capitals, roughly; the em is size / 0.72
---@field font? string a font file beside the model (.ttf, .otf), or a family: "Liberation Sans:style=Bold"; behind either its features: "Liberation Sans:fontfeatures=-kern;-liga"
---@field em? number the em itself, instead of size
---@field halign? string "left", "center" or "right", by advance width; in ttb and btt by the ink
---@field valign? string "baseline", "bottom", "center" or "top", by the ink; in ttb and btt by advance
---@field spacing? number factor of the distances of characters
---@field line_spacing? number factor of the distance of lines, which the font has
---@field direction? string "ltr", "rtl", "ttb" or "btt"
---@field language? string language, for the font's rules
---@field script? string script: "latin", "arabic" ..., or a code: "Latn"
---@field as_openscad? boolean rounded as in OpenSCAD: letters 6e-5 smaller, ink aligned to within 6e-4 of the size
---@field fn? number number of facets of a full turn; 0: from fa and fs
---@field segments? number the same as fn
---@field fa? number smallest angle of a facet, degrees, at least 0.01
---@field fs? number smallest length of a facet, mm, at least 0.01

---What text would measure: {position, size, ascent, descent, offset, advance}, in mm. Of several lines: of all, above and below the first baseline.
---
---Example: `text_metrics("csgrun", {size = 8}).size[1]`
---@overload fun(options: csgrun.text_metrics): table
---@param text? string in UTF-8; a newline begins a line
---@param size? number height of capitals, roughly; the em is size / 0.72
---@param font? string a font file beside the model (.ttf, .otf), or a family: "Liberation Sans:style=Bold"; behind either its features: "Liberation Sans:fontfeatures=-kern;-liga"
---@param options? csgrun.text_metrics
---@return table
function text_metrics(text, size, font, options) end
csg.text_metrics = text_metrics

---@class (exact) csgrun.textmetrics
---@field [integer] any
---@field text? string in UTF-8; a newline begins a line
---@field size? number height of capitals, roughly; the em is size / 0.72
---@field font? string a font file beside the model (.ttf, .otf), or a family: "Liberation Sans:style=Bold"; behind either its features: "Liberation Sans:fontfeatures=-kern;-liga"
---@field em? number the em itself, instead of size
---@field halign? string "left", "center" or "right", by advance width; in ttb and btt by the ink
---@field valign? string "baseline", "bottom", "center" or "top", by the ink; in ttb and btt by advance
---@field spacing? number factor of the distances of characters
---@field line_spacing? number factor of the distance of lines, which the font has
---@field direction? string "ltr", "rtl", "ttb" or "btt"
---@field language? string language, for the font's rules
---@field script? string script: "latin", "arabic" ..., or a code: "Latn"
---@field as_openscad? boolean rounded as in OpenSCAD: letters 6e-5 smaller, ink aligned to within 6e-4 of the size
---@field fn? number number of facets of a full turn; 0: from fa and fs
---@field segments? number the same as fn
---@field fa? number smallest angle of a facet, degrees, at least 0.01
---@field fs? number smallest length of a facet, mm, at least 0.01

---OpenSCAD's name of text_metrics.
---
---Example: `textmetrics("csgrun").advance[1]`
---@overload fun(options: csgrun.textmetrics): table
---@param text? string in UTF-8; a newline begins a line
---@param size? number height of capitals, roughly; the em is size / 0.72
---@param font? string a font file beside the model (.ttf, .otf), or a family: "Liberation Sans:style=Bold"; behind either its features: "Liberation Sans:fontfeatures=-kern;-liga"
---@param options? csgrun.textmetrics
---@return table
function textmetrics(text, size, font, options) end
csg.textmetrics = textmetrics

---@class (exact) csgrun.font_metrics
---@field [integer] any
---@field size? number height of capitals, roughly; the em is size / 0.72
---@field font? string a font file beside the model (.ttf, .otf), or a family: "Liberation Sans:style=Bold"; behind either its features: "Liberation Sans:fontfeatures=-kern;-liga"
---@field em? number the em itself, instead of size

---What a font measures: {nominal = {ascent, descent}, max = {ascent, descent}, interline, font = {family, style}}, in mm: what it keeps for a line, its tallest and deepest glyph, from a baseline to the next.
---
---Example: `font_metrics(10).interline`
---@overload fun(options: csgrun.font_metrics): table
---@param size? number height of capitals, roughly; the em is size / 0.72
---@param font? string a font file beside the model (.ttf, .otf), or a family: "Liberation Sans:style=Bold"; behind either its features: "Liberation Sans:fontfeatures=-kern;-liga"
---@param options? csgrun.font_metrics
---@return table
function font_metrics(size, font, options) end
csg.font_metrics = font_metrics

---@class (exact) csgrun.fontmetrics
---@field [integer] any
---@field size? number height of capitals, roughly; the em is size / 0.72
---@field font? string a font file beside the model (.ttf, .otf), or a family: "Liberation Sans:style=Bold"; behind either its features: "Liberation Sans:fontfeatures=-kern;-liga"
---@field em? number the em itself, instead of size

---OpenSCAD's name of font_metrics.
---
---Example: `fontmetrics(10, "Liberation Sans:style=Bold").nominal.ascent`
---@overload fun(options: csgrun.fontmetrics): table
---@param size? number height of capitals, roughly; the em is size / 0.72
---@param font? string a font file beside the model (.ttf, .otf), or a family: "Liberation Sans:style=Bold"; behind either its features: "Liberation Sans:fontfeatures=-kern;-liga"
---@param options? csgrun.fontmetrics
---@return table
function fontmetrics(size, font, options) end
csg.fontmetrics = fontmetrics

---@class (exact) csgrun.sweep
---@field [integer] any
---@field path? number[][] the points that it goes along
---@field closed? boolean joins the last point to the first
---@field twist? number turn over the whole path, counter-clockwise seen against it, degrees
---@field scale? number|number[] factor at the end, or factors along X and Y of the shape; 0 comes to a point
---@field up? number[] where the shape's Y points to at the start
---@field upright? boolean Y points there along the whole path, as far as that is across it: for a spring or a ramp
---@field fn? number number of facets of a full turn; 0: from fa and fs
---@field segments? number the same as fn
---@field fa? number smallest angle of a facet, degrees, at least 0.01
---@field fs? number smallest length of a facet, mm, at least 0.01

---A solid: the shape, across the path, moved along it; it turns with the path and no more, or stays upright.
---
---Example: `circle(2):sweep{{0, 0, 0}, {0, 0, 20}, {15, 0, 30}}`
---@param shape any the 2D shape; as a method, shape:f(...), it is left out
---@param path? number[][] the points that it goes along
---@param options? csgrun.sweep
---@return Solid
function sweep(shape, path, options) end
csg.sweep = sweep

---A solid: the shape, across the path, moved along it; it turns with the path and no more, or stays upright.
---
---Example: `circle(2):sweep{{0, 0, 0}, {0, 0, 20}, {15, 0, 30}}`
---@overload fun(self: Shape, options: csgrun.sweep): Solid
---@param path? number[][] the points that it goes along
---@param options? csgrun.sweep
---@return Solid
function Shape:sweep(path, options) end

---@class (exact) csgrun.loft
---@field [integer] any
---@field outlines? any a list of shapes, from the lowest on; the first or the last may be a point {x, y}
---@field heights? any where each lies along Z, a list; or one number: all in even steps
---@field height? any the same as heights

---A solid between shapes, each flat at its height, with straight walls from one to the next.
---
---Example: `loft({square(20, true), circle(6)}, {0, 15})`
---@overload fun(options: csgrun.loft): Solid
---@param outlines? any a list of shapes, from the lowest on; the first or the last may be a point {x, y}
---@param heights? any where each lies along Z, a list; or one number: all in even steps
---@param options? csgrun.loft
---@return Solid
function loft(outlines, heights, options) end
csg.loft = loft

---@class (exact) csgrun.roof
---@field [integer] any
---@field method? string "voronoi": as high as the outline is far, with cones around corners that point inwards; or "straight": planes only
---@field convexity? integer ignored: OpenSCAD needs it for its preview
---@field fn? number number of facets of a full turn; 0: from fa and fs
---@field segments? number the same as fn
---@field fa? number smallest angle of a facet, degrees, at least 0.01
---@field fs? number smallest length of a facet, mm, at least 0.01

---A solid: a roof over the shape, with planes that rise inwards from its edges at 45 degrees.
---
---Example: `square(30, 20):roof()`
---@param shape any the 2D shape; as a method, shape:f(...), it is left out
---@param method? string "voronoi": as high as the outline is far, with cones around corners that point inwards; or "straight": planes only
---@param options? csgrun.roof
---@return Solid
function roof(shape, method, options) end
csg.roof = roof

---A solid: a roof over the shape, with planes that rise inwards from its edges at 45 degrees.
---
---Example: `square(30, 20):roof()`
---@overload fun(self: Shape, options: csgrun.roof): Solid
---@param method? string "voronoi": as high as the outline is far, with cones around corners that point inwards; or "straight": planes only
---@param options? csgrun.roof
---@return Solid
function Shape:roof(method, options) end

---@class (exact) csgrun.hull
---@field [integer] any
---@field operands? any solids or shapes, one after another or as lists; or a list of points {x, y, z} (a solid) or {x, y} (a shape)

---The least convex solid or shape that contains all of them.
---
---Example: `hull(sphere(4), cube(2):up(10))`
---@param ... any solids or shapes, one after another or as lists; or a list of points {x, y, z} (a solid) or {x, y} (a shape)
---@return any
function hull(...) end
csg.hull = hull

---The least convex solid or shape that contains all of them.
---
---Example: `hull(sphere(4), cube(2):up(10))`
---@param ... any solids or shapes, one after another or as lists; or a list of points {x, y, z} (a solid) or {x, y} (a shape)
---@return Solid
function Solid:hull(...) end

---The least convex solid or shape that contains all of them.
---
---Example: `hull(sphere(4), cube(2):up(10))`
---@param ... any solids or shapes, one after another or as lists; or a list of points {x, y, z} (a solid) or {x, y} (a shape)
---@return Shape
function Shape:hull(...) end

---@class (exact) csgrun.minkowski
---@field [integer] any
---@field operands? any solids or shapes, one after another or as lists

---All sums of a point of each: the first, swept by the others. Empty ones count for nothing.
---
---Example: `minkowski{cube{20, 20, 5}, sphere(1)}`
---@param ... any solids or shapes, one after another or as lists
---@return any
function minkowski(...) end
csg.minkowski = minkowski

---All sums of a point of each: the first, swept by the others. Empty ones count for nothing.
---
---Example: `minkowski{cube{20, 20, 5}, sphere(1)}`
---@param ... any solids or shapes, one after another or as lists
---@return Solid
function Solid:minkowski(...) end

---All sums of a point of each: the first, swept by the others. Empty ones count for nothing.
---
---Example: `minkowski{cube{20, 20, 5}, sphere(1)}`
---@param ... any solids or shapes, one after another or as lists
---@return Shape
function Shape:minkowski(...) end

---@class (exact) csgrun.resize
---@field [integer] any
---@field newsize? number[] lengths along X, Y and (of a solid) Z; 0 leaves that axis as it is
---@field size? number[] the same as newsize
---@field auto? boolean|boolean[] whether axes of length 0 take the factor of the longest one that is given; or which do

---Scales about the origin until the bounding box has these lengths.
---
---Example: `part:resize({20, 0, 0}, {auto = true})`
---@overload fun(x: number, y: number, z?: number, ...): any
---@param part any a solid or a shape; part:resize(...) leaves it out
---@param newsize? number[] lengths along X, Y and (of a solid) Z; 0 leaves that axis as it is
---@param auto? boolean|boolean[] whether axes of length 0 take the factor of the longest one that is given; or which do
---@param options? csgrun.resize
---@return any
function resize(part, newsize, auto, options) end
csg.resize = resize

---Scales about the origin until the bounding box has these lengths.
---
---Example: `part:resize({20, 0, 0}, {auto = true})`
---@overload fun(self: Solid, options: csgrun.resize): Solid
---@overload fun(self: Solid, x: number, y: number, z?: number, ...): Solid
---@param newsize? number[] lengths along X, Y and (of a solid) Z; 0 leaves that axis as it is
---@param auto? boolean|boolean[] whether axes of length 0 take the factor of the longest one that is given; or which do
---@param options? csgrun.resize
---@return Solid
function Solid:resize(newsize, auto, options) end

---Scales about the origin until the bounding box has these lengths.
---
---Example: `part:resize({20, 0, 0}, {auto = true})`
---@overload fun(self: Shape, options: csgrun.resize): Shape
---@overload fun(self: Shape, x: number, y: number, z?: number, ...): Shape
---@param newsize? number[] lengths along X, Y and (of a solid) Z; 0 leaves that axis as it is
---@param auto? boolean|boolean[] whether axes of length 0 take the factor of the longest one that is given; or which do
---@param options? csgrun.resize
---@return Shape
function Shape:resize(newsize, auto, options) end

---@class (exact) csgrun.projection
---@field [integer] any
---@field cut? boolean the section at z = 0 instead of the shadow
---@field convexity? integer ignored: OpenSCAD needs it for its preview

---The shadow of a solid on the plane z = 0, a 2D shape.
---
---Example: `part:projection{cut = true}`
---@param solid any the solid; as a method, solid:f(...), it is left out
---@param cut? boolean the section at z = 0 instead of the shadow
---@param options? csgrun.projection
---@return Shape
function projection(solid, cut, options) end
csg.projection = projection

---The shadow of a solid on the plane z = 0, a 2D shape.
---
---Example: `part:projection{cut = true}`
---@overload fun(self: Solid, options: csgrun.projection): Shape
---@param cut? boolean the section at z = 0 instead of the shadow
---@param options? csgrun.projection
---@return Shape
function Solid:projection(cut, options) end

---@class (exact) csgrun.project
---@field [integer] any
---@field direction? number[] where the shadow is looked at from, of any length: it falls on the plane across it through the origin, with axes as slice has them
---@field normal? number[] the same as direction

---The shadow of a solid on a plane, z = 0 by default, a 2D shape.
---
---Example: `linear_extrude(part:project(), 2)`
---@overload fun(x: number, y: number, z?: number, ...): Shape
---@param solid any the solid; as a method, solid:f(...), it is left out
---@param direction? number[] where the shadow is looked at from, of any length: it falls on the plane across it through the origin, with axes as slice has them
---@param options? csgrun.project
---@return Shape
function project(solid, direction, options) end
csg.project = project

---The shadow of a solid on a plane, z = 0 by default, a 2D shape.
---
---Example: `linear_extrude(part:project(), 2)`
---@overload fun(self: Solid, options: csgrun.project): Shape
---@overload fun(self: Solid, x: number, y: number, z?: number, ...): Shape
---@param direction? number[] where the shadow is looked at from, of any length: it falls on the plane across it through the origin, with axes as slice has them
---@param options? csgrun.project
---@return Shape
function Solid:project(direction, options) end

---@class (exact) csgrun.slice
---@field [integer] any
---@field z? number the height of the cut
---@field normal? number[] instead of a height: a direction across the plane, of any length; slice({1, 0, 0}, 5) as well
---@field offset? number where the plane is: its distance from the origin along the normal
---@field point? number[] instead of the offset: a point of the plane

---What a plane cuts of a solid, a 2D shape, seen from where the normal points: its Y is upwards (Z; Y where the normal is along Z), its origin the point of the plane nearest to the origin. Where the solid has a face in the plane, what is in front of it counts.
---
---Example: `sphere(10):slice(5):area()`
---@param solid any the solid; as a method, solid:f(...), it is left out
---@param z? number the height of the cut
---@param options? csgrun.slice
---@return Shape
function slice(solid, z, options) end
csg.slice = slice

---What a plane cuts of a solid, a 2D shape, seen from where the normal points: its Y is upwards (Z; Y where the normal is along Z), its origin the point of the plane nearest to the origin. Where the solid has a face in the plane, what is in front of it counts.
---
---Example: `sphere(10):slice(5):area()`
---@overload fun(self: Solid, options: csgrun.slice): Shape
---@param z? number the height of the cut
---@param options? csgrun.slice
---@return Shape
function Solid:slice(z, options) end

---@class (exact) csgrun.split
---@field [integer] any
---@field normal? number[] a direction across the plane, of any length
---@field offset? number where the plane is: its distance from the origin along the normal
---@field point? number[] instead of the offset: a point of the plane

---The two parts of a solid on either side of a plane: first what is in front of it, where the normal points, then what is behind. The cut has the colour of the solid (of its first leaf, where it has several). It lies in the plane exactly where the normal is a multiple of small whole numbers and the point one of the grid.
---
---Example: `local top, bottom = part:split({0, 0, 1}, 5)`
---@overload fun(x: number, y: number, z?: number, ...): Solid, Solid
---@param solid any the solid; as a method, solid:f(...), it is left out
---@param normal? number[] a direction across the plane, of any length
---@param offset? number where the plane is: its distance from the origin along the normal
---@param options? csgrun.split
---@return Solid, Solid
function split(solid, normal, offset, options) end
csg.split = split

---The two parts of a solid on either side of a plane: first what is in front of it, where the normal points, then what is behind. The cut has the colour of the solid (of its first leaf, where it has several). It lies in the plane exactly where the normal is a multiple of small whole numbers and the point one of the grid.
---
---Example: `local top, bottom = part:split({0, 0, 1}, 5)`
---@overload fun(self: Solid, options: csgrun.split): Solid, Solid
---@overload fun(self: Solid, x: number, y: number, z?: number, ...): Solid, Solid
---@param normal? number[] a direction across the plane, of any length
---@param offset? number where the plane is: its distance from the origin along the normal
---@param options? csgrun.split
---@return Solid, Solid
function Solid:split(normal, offset, options) end

---@class (exact) csgrun.trim
---@field [integer] any
---@field normal? number[] a direction across the plane, of any length
---@field offset? number where the plane is: its distance from the origin along the normal
---@field point? number[] instead of the offset: a point of the plane

---What of a solid is in front of a plane, where the normal points; as split.
---
---Example: `part:trim{normal = {1, 0, 1}, point = {0, 0, 5}}`
---@overload fun(x: number, y: number, z?: number, ...): Solid
---@param solid any the solid; as a method, solid:f(...), it is left out
---@param normal? number[] a direction across the plane, of any length
---@param offset? number where the plane is: its distance from the origin along the normal
---@param options? csgrun.trim
---@return Solid
function trim(solid, normal, offset, options) end
csg.trim = trim

---What of a solid is in front of a plane, where the normal points; as split.
---
---Example: `part:trim{normal = {1, 0, 1}, point = {0, 0, 5}}`
---@overload fun(self: Solid, options: csgrun.trim): Solid
---@overload fun(self: Solid, x: number, y: number, z?: number, ...): Solid
---@param normal? number[] a direction across the plane, of any length
---@param offset? number where the plane is: its distance from the origin along the normal
---@param options? csgrun.trim
---@return Solid
function Solid:trim(normal, offset, options) end

---A list of the connected solids, or shapes, of which it consists.
---
---Example: `for i, piece in ipairs(part:decompose()) do print(piece) end`
---@param part any a solid or a shape; part:decompose() leaves it out
---@return any[]
function decompose(part) end
csg.decompose = decompose

---A list of the connected solids, or shapes, of which it consists.
---
---Example: `for i, piece in ipairs(part:decompose()) do print(piece) end`
---@return any[]
function Solid:decompose() end

---A list of the connected solids, or shapes, of which it consists.
---
---Example: `for i, piece in ipairs(part:decompose()) do print(piece) end`
---@return any[]
function Shape:decompose() end

---@class (exact) csgrun.chamfer
---@field [integer] any
---@field distance? number from the edge, on both faces, in mm
---@field edges? any which edges: all that are convex; "x", "y", "z" (their direction); "top", "bottom", ... (the face they are on); {on = ..., along = ..., near = ..., normal = ..., through = ..., turn = ...} as edges() takes them; a list of these; what edges() gave, or a function of such a table that tells

---The solid with edges cut off flat. Where all three edges of a corner are cut, so is it.
---
---Example: `cube(10):chamfer(1.5, {edges = "top"})`
---@param solid any the solid; as a method, solid:f(...), it is left out
---@param distance? number from the edge, on both faces, in mm
---@param edges? any which edges: all that are convex; "x", "y", "z" (their direction); "top", "bottom", ... (the face they are on); {on = ..., along = ..., near = ..., normal = ..., through = ..., turn = ...} as edges() takes them; a list of these; what edges() gave, or a function of such a table that tells
---@param options? csgrun.chamfer
---@return Solid
function chamfer(solid, distance, edges, options) end
csg.chamfer = chamfer

---The solid with edges cut off flat. Where all three edges of a corner are cut, so is it.
---
---Example: `cube(10):chamfer(1.5, {edges = "top"})`
---@overload fun(self: Solid, options: csgrun.chamfer): Solid
---@param distance? number from the edge, on both faces, in mm
---@param edges? any which edges: all that are convex; "x", "y", "z" (their direction); "top", "bottom", ... (the face they are on); {on = ..., along = ..., near = ..., normal = ..., through = ..., turn = ...} as edges() takes them; a list of these; what edges() gave, or a function of such a table that tells
---@param options? csgrun.chamfer
---@return Solid
function Solid:chamfer(distance, edges, options) end

---@class (exact) csgrun.fillet
---@field [integer] any
---@field r? number radius, in mm
---@field radius? number the same as r
---@field edges? any which edges: all that are convex; "x", "y", "z" (their direction); "top", "bottom", ... (the face they are on); {on = ..., along = ..., near = ..., normal = ..., through = ..., turn = ...} as edges() takes them; a list of these; what edges() gave, or a function of such a table that tells
---@field fn? number number of facets of a full turn; 0: from fa and fs
---@field segments? number the same as fn
---@field fa? number smallest angle of a facet, degrees, at least 0.01
---@field fs? number smallest length of a facet, mm, at least 0.01

---The solid with edges rounded off. Where all three edges of a corner are rounded, so is it, by a ball.
---
---Example: `cube(10):fillet(2, {edges = "z", fn = 32})`
---@param solid any the solid; as a method, solid:f(...), it is left out
---@param r? number radius, in mm
---@param edges? any which edges: all that are convex; "x", "y", "z" (their direction); "top", "bottom", ... (the face they are on); {on = ..., along = ..., near = ..., normal = ..., through = ..., turn = ...} as edges() takes them; a list of these; what edges() gave, or a function of such a table that tells
---@param options? csgrun.fillet
---@return Solid
function fillet(solid, r, edges, options) end
csg.fillet = fillet

---The solid with edges rounded off. Where all three edges of a corner are rounded, so is it, by a ball.
---
---Example: `cube(10):fillet(2, {edges = "z", fn = 32})`
---@overload fun(self: Solid, options: csgrun.fillet): Solid
---@param r? number radius, in mm
---@param edges? any which edges: all that are convex; "x", "y", "z" (their direction); "top", "bottom", ... (the face they are on); {on = ..., along = ..., near = ..., normal = ..., through = ..., turn = ...} as edges() takes them; a list of these; what edges() gave, or a function of such a table that tells
---@param options? csgrun.fillet
---@return Solid
function Solid:fillet(r, edges, options) end

---@class (exact) csgrun.edges
---@field [integer] any
---@field on? any edges of the faces that look this way and lie farthest that way: "top", "bottom", "left", "right", "front", "back", or a vector
---@field along? any their direction, either way: "x", "y", "z" or a vector
---@field near? number[] the one that is nearest to a point
---@field normal? number[] edges of faces that look this way, as faces() has it
---@field through? number[] edges of faces in a plane through this point
---@field turn? number the least angle between their two faces' normals, in degrees

---Its straight edges between flat faces, each {from, to, length, turn, convex, normals}. Those between facets of one round surface, or of fillets, are left out.
---
---Example: `#part:edges{along = "z"}`
---@overload fun(self: Solid, options: csgrun.edges): {from: number[], to: number[], length: number, turn: number, convex: boolean, normals: number[][]}[]
---@param on? any edges of the faces that look this way and lie farthest that way: "top", "bottom", "left", "right", "front", "back", or a vector
---@param options? csgrun.edges
---@return {from: number[], to: number[], length: number, turn: number, convex: boolean, normals: number[][]}[]
function Solid:edges(on, options) end

---@class (exact) csgrun.surface
---@field [integer] any
---@field file? any the name of a PNG, or of a text of numbers with one row a line; or heights, as that option
---@field center? boolean the middle of the table stands on the Z axis
---@field invert? boolean of a PNG: what is dark is high
---@field heights? any instead of a file: a list of rows, each a list of numbers; the first row is at y = 0
---@field convexity? integer ignored: OpenSCAD needs it for its preview

---The solid under heights 1 mm apart along X and Y, down to 1 mm below the least of them; of a text file down to 0 at least.
---
---Example: `surface({{0, 1, 0}, {1, 3, 1}, {0, 1, 0}}, true)`
---@overload fun(options: csgrun.surface): Solid
---@param file? any the name of a PNG, or of a text of numbers with one row a line; or heights, as that option
---@param center? boolean the middle of the table stands on the Z axis
---@param options? csgrun.surface
---@return Solid
function surface(file, center, options) end
csg.surface = surface

---@class (exact) csgrun.refine
---@field [integer] any
---@field length? number the longest edge that is left, mm

---The same solid with triangles divided until no edge is longer: for warp and smooth.
---
---Example: `cube(10):refine(2)`
---@param solid any the solid; as a method, solid:f(...), it is left out
---@param length? number the longest edge that is left, mm
---@param options? csgrun.refine
---@return Solid
function refine(solid, length, options) end
csg.refine = refine

---The same solid with triangles divided until no edge is longer: for warp and smooth.
---
---Example: `cube(10):refine(2)`
---@overload fun(self: Solid, options: csgrun.refine): Solid
---@param length? number the longest edge that is left, mm
---@param options? csgrun.refine
---@return Solid
function Solid:refine(length, options) end

---@class (exact) csgrun.smooth
---@field [integer] any
---@field rounds? integer each makes four triangles of one

---Rounds off the whole solid by subdivision (Loop 1987): it draws near a surface without edges that lies within its corners. Refine it first to keep it nearer to what it was.
---
---Example: `cube(10):refine(4):smooth(2)`
---@param solid any the solid; as a method, solid:f(...), it is left out
---@param rounds? integer each makes four triangles of one
---@param options? csgrun.smooth
---@return Solid
function smooth(solid, rounds, options) end
csg.smooth = smooth

---Rounds off the whole solid by subdivision (Loop 1987): it draws near a surface without edges that lies within its corners. Refine it first to keep it nearer to what it was.
---
---Example: `cube(10):refine(4):smooth(2)`
---@overload fun(self: Solid, options: csgrun.smooth): Solid
---@param rounds? integer each makes four triangles of one
---@param options? csgrun.smooth
---@return Solid
function Solid:smooth(rounds, options) end

---@class (exact) csgrun.warp
---@field [integer] any
---@field f? any a function of x, y, z, or of one vector, that gives the three of the moved point, or a list

---Moves every corner by a function. Edges stay straight: refine the solid first.
---
---Example: `cube{40, 4, 4}:refine(2):warp(function(x, y, z) return x, y, z + 5 * sin(9 * x) end)`
---@param solid any the solid; as a method, solid:f(...), it is left out
---@param f? any a function of x, y, z, or of one vector, that gives the three of the moved point, or a list
---@param options? csgrun.warp
---@return Solid
function warp(solid, f, options) end
csg.warp = warp

---Moves every corner by a function. Edges stay straight: refine the solid first.
---
---Example: `cube{40, 4, 4}:refine(2):warp(function(x, y, z) return x, y, z + 5 * sin(9 * x) end)`
---@overload fun(self: Solid, options: csgrun.warp): Solid
---@param f? any a function of x, y, z, or of one vector, that gives the three of the moved point, or a list
---@param options? csgrun.warp
---@return Solid
function Solid:warp(f, options) end

---@class (exact) csgrun.levelset
---@field [integer] any
---@field f? any a function of x, y, z, or of one vector: at most the level inside
---@field bounds? any {min = {x, y, z}, max = {x, y, z}}, as bbox() gives them
---@field step? number mm between samples
---@field level? number the value at the surface

---The solid where a function (a signed distance, say) is at most the level, cut with the bounds where it reaches farther.
---
---Example: `levelset(function(x, y, z) return norm{x, y, z} - 8 end, {{-9, -9, -9}, {9, 9, 9}}, 1)`
---@overload fun(options: csgrun.levelset): Solid
---@param f? any a function of x, y, z, or of one vector: at most the level inside
---@param bounds? any {min = {x, y, z}, max = {x, y, z}}, as bbox() gives them
---@param step? number mm between samples
---@param options? csgrun.levelset
---@return Solid
function levelset(f, bounds, step, options) end
csg.levelset = levelset

---@class (exact) csgrun.translate
---@field [integer] any
---@field v? number[] how far along X, Y and Z
---@field x? number along X
---@field y? number along Y
---@field z? number along Z

---Moves.
---
---Example: `part:translate(0, 0, 10)`
---@overload fun(options: csgrun.translate): any
---@overload fun(x: number, y: number, z?: number, ...): any
---@param v? number[] how far along X, Y and Z
---@param options? csgrun.translate
---@return any
function translate(v, options) end
csg.translate = translate

---Moves.
---
---Example: `part:translate(0, 0, 10)`
---@overload fun(self: Solid, options: csgrun.translate): Solid
---@overload fun(self: Solid, x: number, y: number, z?: number, ...): Solid
---@param v? number[] how far along X, Y and Z
---@param options? csgrun.translate
---@return Solid
function Solid:translate(v, options) end

---Moves.
---
---Example: `part:translate(0, 0, 10)`
---@overload fun(self: Shape, options: csgrun.translate): Shape
---@overload fun(self: Shape, x: number, y: number, z?: number, ...): Shape
---@param v? number[] how far along X, Y and Z
---@param options? csgrun.translate
---@return Shape
function Shape:translate(v, options) end

---Moves.
---
---Example: `part:translate(0, 0, 10)`
---@overload fun(self: Matrix, options: csgrun.translate): Matrix
---@overload fun(self: Matrix, x: number, y: number, z?: number, ...): Matrix
---@param v? number[] how far along X, Y and Z
---@param options? csgrun.translate
---@return Matrix
function Matrix:translate(v, options) end

---@class (exact) csgrun.rotate
---@field [integer] any
---@field a? number|number[] an angle about Z (or v), or angles about X, Y and Z in this order
---@field v? number[] axis to turn about; {0, 0, 0} turns nothing, as in OpenSCAD
---@field x? number about X
---@field y? number about Y
---@field z? number about Z

---Turns by degrees: about X first, then Y, then Z.
---
---Example: `part:rotate(0, 90, 45)`
---@overload fun(options: csgrun.rotate): any
---@overload fun(x: number, y?: number, z?: number, ...): any
---@param a? number|number[] an angle about Z (or v), or angles about X, Y and Z in this order
---@param v? number[] axis to turn about; {0, 0, 0} turns nothing, as in OpenSCAD
---@param options? csgrun.rotate
---@return any
function rotate(a, v, options) end
csg.rotate = rotate

---Turns by degrees: about X first, then Y, then Z.
---
---Example: `part:rotate(0, 90, 45)`
---@overload fun(self: Solid, options: csgrun.rotate): Solid
---@overload fun(self: Solid, x: number, y?: number, z?: number, ...): Solid
---@param a? number|number[] an angle about Z (or v), or angles about X, Y and Z in this order
---@param v? number[] axis to turn about; {0, 0, 0} turns nothing, as in OpenSCAD
---@param options? csgrun.rotate
---@return Solid
function Solid:rotate(a, v, options) end

---Turns by degrees: about X first, then Y, then Z.
---
---Example: `part:rotate(0, 90, 45)`
---@overload fun(self: Shape, options: csgrun.rotate): Shape
---@overload fun(self: Shape, x: number, y?: number, z?: number, ...): Shape
---@param a? number|number[] an angle about Z (or v), or angles about X, Y and Z in this order
---@param v? number[] axis to turn about; {0, 0, 0} turns nothing, as in OpenSCAD
---@param options? csgrun.rotate
---@return Shape
function Shape:rotate(a, v, options) end

---Turns by degrees: about X first, then Y, then Z.
---
---Example: `part:rotate(0, 90, 45)`
---@overload fun(self: Matrix, options: csgrun.rotate): Matrix
---@overload fun(self: Matrix, x: number, y?: number, z?: number, ...): Matrix
---@param a? number|number[] an angle about Z (or v), or angles about X, Y and Z in this order
---@param v? number[] axis to turn about; {0, 0, 0} turns nothing, as in OpenSCAD
---@param options? csgrun.rotate
---@return Matrix
function Matrix:rotate(a, v, options) end

---@class (exact) csgrun.scale
---@field [integer] any
---@field v? number|number[] a factor, or factors along X, Y and Z
---@field x? number along X
---@field y? number along Y
---@field z? number along Z

---Scales about the origin.
---
---Example: `part:scale(1, 1, 2)`
---@overload fun(options: csgrun.scale): any
---@overload fun(x: number, y?: number, z?: number, ...): any
---@param v? number|number[] a factor, or factors along X, Y and Z
---@param options? csgrun.scale
---@return any
function scale(v, options) end
csg.scale = scale

---Scales about the origin.
---
---Example: `part:scale(1, 1, 2)`
---@overload fun(self: Solid, options: csgrun.scale): Solid
---@overload fun(self: Solid, x: number, y?: number, z?: number, ...): Solid
---@param v? number|number[] a factor, or factors along X, Y and Z
---@param options? csgrun.scale
---@return Solid
function Solid:scale(v, options) end

---Scales about the origin.
---
---Example: `part:scale(1, 1, 2)`
---@overload fun(self: Shape, options: csgrun.scale): Shape
---@overload fun(self: Shape, x: number, y?: number, z?: number, ...): Shape
---@param v? number|number[] a factor, or factors along X, Y and Z
---@param options? csgrun.scale
---@return Shape
function Shape:scale(v, options) end

---Scales about the origin.
---
---Example: `part:scale(1, 1, 2)`
---@overload fun(self: Matrix, options: csgrun.scale): Matrix
---@overload fun(self: Matrix, x: number, y?: number, z?: number, ...): Matrix
---@param v? number|number[] a factor, or factors along X, Y and Z
---@param options? csgrun.scale
---@return Matrix
function Matrix:scale(v, options) end

---@class (exact) csgrun.mirror
---@field [integer] any
---@field v? number[] normal of the plane through the origin; {0, 0, 0} mirrors nothing, as in OpenSCAD

---Mirrors at a plane through the origin.
---
---Example: `part:mirror(1, 0, 0)`
---@overload fun(options: csgrun.mirror): any
---@overload fun(x: number, y: number, z?: number, ...): any
---@param v? number[] normal of the plane through the origin; {0, 0, 0} mirrors nothing, as in OpenSCAD
---@param options? csgrun.mirror
---@return any
function mirror(v, options) end
csg.mirror = mirror

---Mirrors at a plane through the origin.
---
---Example: `part:mirror(1, 0, 0)`
---@overload fun(self: Solid, options: csgrun.mirror): Solid
---@overload fun(self: Solid, x: number, y: number, z?: number, ...): Solid
---@param v? number[] normal of the plane through the origin; {0, 0, 0} mirrors nothing, as in OpenSCAD
---@param options? csgrun.mirror
---@return Solid
function Solid:mirror(v, options) end

---Mirrors at a plane through the origin.
---
---Example: `part:mirror(1, 0, 0)`
---@overload fun(self: Shape, options: csgrun.mirror): Shape
---@overload fun(self: Shape, x: number, y: number, z?: number, ...): Shape
---@param v? number[] normal of the plane through the origin; {0, 0, 0} mirrors nothing, as in OpenSCAD
---@param options? csgrun.mirror
---@return Shape
function Shape:mirror(v, options) end

---Mirrors at a plane through the origin.
---
---Example: `part:mirror(1, 0, 0)`
---@overload fun(self: Matrix, options: csgrun.mirror): Matrix
---@overload fun(self: Matrix, x: number, y: number, z?: number, ...): Matrix
---@param v? number[] normal of the plane through the origin; {0, 0, 0} mirrors nothing, as in OpenSCAD
---@param options? csgrun.mirror
---@return Matrix
function Matrix:mirror(v, options) end

---@class (exact) csgrun.multmatrix
---@field [integer] any
---@field m? Matrix|number[][] rows of the matrix; what is missing is that of the identity

---Applies an affine matrix.
---
---Example: `part:multmatrix{{1, 0.5, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}`
---@overload fun(options: csgrun.multmatrix): any
---@param m? Matrix|number[][] rows of the matrix; what is missing is that of the identity
---@param options? csgrun.multmatrix
---@return any
function multmatrix(m, options) end
csg.multmatrix = multmatrix

---Applies an affine matrix.
---
---Example: `part:multmatrix{{1, 0.5, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}`
---@overload fun(self: Solid, options: csgrun.multmatrix): Solid
---@param m? Matrix|number[][] rows of the matrix; what is missing is that of the identity
---@param options? csgrun.multmatrix
---@return Solid
function Solid:multmatrix(m, options) end

---Applies an affine matrix.
---
---Example: `part:multmatrix{{1, 0.5, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}`
---@overload fun(self: Shape, options: csgrun.multmatrix): Shape
---@param m? Matrix|number[][] rows of the matrix; what is missing is that of the identity
---@param options? csgrun.multmatrix
---@return Shape
function Shape:multmatrix(m, options) end

---The matrix that undoes a matrix.
---
---Example: `rotate(30):inverse()`
---@param matrix any a matrix
---@return Matrix
function inverse(matrix) end
csg.inverse = inverse

---The matrix that undoes a matrix.
---
---Example: `rotate(30):inverse()`
---@return Matrix
function Matrix:inverse() end

---@class (exact) csgrun.move
---@field [integer] any
---@field v? number[] how far along X, Y and Z
---@field x? number along X
---@field y? number along Y
---@field z? number along Z

---Moves: another name of translate.
---
---Example: `part:move{z = 10}`
---@overload fun(options: csgrun.move): any
---@overload fun(x: number, y: number, z?: number, ...): any
---@param v? number[] how far along X, Y and Z
---@param options? csgrun.move
---@return any
function move(v, options) end
csg.move = move

---Moves: another name of translate.
---
---Example: `part:move{z = 10}`
---@overload fun(self: Solid, options: csgrun.move): Solid
---@overload fun(self: Solid, x: number, y: number, z?: number, ...): Solid
---@param v? number[] how far along X, Y and Z
---@param options? csgrun.move
---@return Solid
function Solid:move(v, options) end

---Moves: another name of translate.
---
---Example: `part:move{z = 10}`
---@overload fun(self: Shape, options: csgrun.move): Shape
---@overload fun(self: Shape, x: number, y: number, z?: number, ...): Shape
---@param v? number[] how far along X, Y and Z
---@param options? csgrun.move
---@return Shape
function Shape:move(v, options) end

---Moves: another name of translate.
---
---Example: `part:move{z = 10}`
---@overload fun(self: Matrix, options: csgrun.move): Matrix
---@overload fun(self: Matrix, x: number, y: number, z?: number, ...): Matrix
---@param v? number[] how far along X, Y and Z
---@param options? csgrun.move
---@return Matrix
function Matrix:move(v, options) end

---@class (exact) csgrun.up
---@field [integer] any
---@field d? number how far

---Moves along +Z.
---
---Example: `part:up(3)`
---@overload fun(options: csgrun.up): any
---@param d? number how far
---@param options? csgrun.up
---@return any
function up(d, options) end
csg.up = up

---Moves along +Z.
---
---Example: `part:up(3)`
---@overload fun(self: Solid, options: csgrun.up): Solid
---@param d? number how far
---@param options? csgrun.up
---@return Solid
function Solid:up(d, options) end

---Moves along +Z.
---
---Example: `part:up(3)`
---@overload fun(self: Shape, options: csgrun.up): Shape
---@param d? number how far
---@param options? csgrun.up
---@return Shape
function Shape:up(d, options) end

---Moves along +Z.
---
---Example: `part:up(3)`
---@overload fun(self: Matrix, options: csgrun.up): Matrix
---@param d? number how far
---@param options? csgrun.up
---@return Matrix
function Matrix:up(d, options) end

---@class (exact) csgrun.down
---@field [integer] any
---@field d? number how far

---Moves along -Z.
---
---Example: `part:down(3)`
---@overload fun(options: csgrun.down): any
---@param d? number how far
---@param options? csgrun.down
---@return any
function down(d, options) end
csg.down = down

---Moves along -Z.
---
---Example: `part:down(3)`
---@overload fun(self: Solid, options: csgrun.down): Solid
---@param d? number how far
---@param options? csgrun.down
---@return Solid
function Solid:down(d, options) end

---Moves along -Z.
---
---Example: `part:down(3)`
---@overload fun(self: Shape, options: csgrun.down): Shape
---@param d? number how far
---@param options? csgrun.down
---@return Shape
function Shape:down(d, options) end

---Moves along -Z.
---
---Example: `part:down(3)`
---@overload fun(self: Matrix, options: csgrun.down): Matrix
---@param d? number how far
---@param options? csgrun.down
---@return Matrix
function Matrix:down(d, options) end

---@class (exact) csgrun.left
---@field [integer] any
---@field d? number how far

---Moves along -X.
---
---Example: `part:left(3)`
---@overload fun(options: csgrun.left): any
---@param d? number how far
---@param options? csgrun.left
---@return any
function left(d, options) end
csg.left = left

---Moves along -X.
---
---Example: `part:left(3)`
---@overload fun(self: Solid, options: csgrun.left): Solid
---@param d? number how far
---@param options? csgrun.left
---@return Solid
function Solid:left(d, options) end

---Moves along -X.
---
---Example: `part:left(3)`
---@overload fun(self: Shape, options: csgrun.left): Shape
---@param d? number how far
---@param options? csgrun.left
---@return Shape
function Shape:left(d, options) end

---Moves along -X.
---
---Example: `part:left(3)`
---@overload fun(self: Matrix, options: csgrun.left): Matrix
---@param d? number how far
---@param options? csgrun.left
---@return Matrix
function Matrix:left(d, options) end

---@class (exact) csgrun.right
---@field [integer] any
---@field d? number how far

---Moves along +X.
---
---Example: `part:right(3)`
---@overload fun(options: csgrun.right): any
---@param d? number how far
---@param options? csgrun.right
---@return any
function right(d, options) end
csg.right = right

---Moves along +X.
---
---Example: `part:right(3)`
---@overload fun(self: Solid, options: csgrun.right): Solid
---@param d? number how far
---@param options? csgrun.right
---@return Solid
function Solid:right(d, options) end

---Moves along +X.
---
---Example: `part:right(3)`
---@overload fun(self: Shape, options: csgrun.right): Shape
---@param d? number how far
---@param options? csgrun.right
---@return Shape
function Shape:right(d, options) end

---Moves along +X.
---
---Example: `part:right(3)`
---@overload fun(self: Matrix, options: csgrun.right): Matrix
---@param d? number how far
---@param options? csgrun.right
---@return Matrix
function Matrix:right(d, options) end

---@class (exact) csgrun.forward
---@field [integer] any
---@field d? number how far

---Moves along -Y, towards the viewer.
---
---Example: `part:forward(3)`
---@overload fun(options: csgrun.forward): any
---@param d? number how far
---@param options? csgrun.forward
---@return any
function forward(d, options) end
csg.forward = forward

---Moves along -Y, towards the viewer.
---
---Example: `part:forward(3)`
---@overload fun(self: Solid, options: csgrun.forward): Solid
---@param d? number how far
---@param options? csgrun.forward
---@return Solid
function Solid:forward(d, options) end

---Moves along -Y, towards the viewer.
---
---Example: `part:forward(3)`
---@overload fun(self: Shape, options: csgrun.forward): Shape
---@param d? number how far
---@param options? csgrun.forward
---@return Shape
function Shape:forward(d, options) end

---Moves along -Y, towards the viewer.
---
---Example: `part:forward(3)`
---@overload fun(self: Matrix, options: csgrun.forward): Matrix
---@param d? number how far
---@param options? csgrun.forward
---@return Matrix
function Matrix:forward(d, options) end

---@class (exact) csgrun.front
---@field [integer] any
---@field d? number how far

---Moves along -Y, towards the viewer: another name of forward.
---
---Example: `part:front(3)`
---@overload fun(options: csgrun.front): any
---@param d? number how far
---@param options? csgrun.front
---@return any
function front(d, options) end
csg.front = front

---Moves along -Y, towards the viewer: another name of forward.
---
---Example: `part:front(3)`
---@overload fun(self: Solid, options: csgrun.front): Solid
---@param d? number how far
---@param options? csgrun.front
---@return Solid
function Solid:front(d, options) end

---Moves along -Y, towards the viewer: another name of forward.
---
---Example: `part:front(3)`
---@overload fun(self: Shape, options: csgrun.front): Shape
---@param d? number how far
---@param options? csgrun.front
---@return Shape
function Shape:front(d, options) end

---Moves along -Y, towards the viewer: another name of forward.
---
---Example: `part:front(3)`
---@overload fun(self: Matrix, options: csgrun.front): Matrix
---@param d? number how far
---@param options? csgrun.front
---@return Matrix
function Matrix:front(d, options) end

---@class (exact) csgrun.back
---@field [integer] any
---@field d? number how far

---Moves along +Y.
---
---Example: `part:back(3)`
---@overload fun(options: csgrun.back): any
---@param d? number how far
---@param options? csgrun.back
---@return any
function back(d, options) end
csg.back = back

---Moves along +Y.
---
---Example: `part:back(3)`
---@overload fun(self: Solid, options: csgrun.back): Solid
---@param d? number how far
---@param options? csgrun.back
---@return Solid
function Solid:back(d, options) end

---Moves along +Y.
---
---Example: `part:back(3)`
---@overload fun(self: Shape, options: csgrun.back): Shape
---@param d? number how far
---@param options? csgrun.back
---@return Shape
function Shape:back(d, options) end

---Moves along +Y.
---
---Example: `part:back(3)`
---@overload fun(self: Matrix, options: csgrun.back): Matrix
---@param d? number how far
---@param options? csgrun.back
---@return Matrix
function Matrix:back(d, options) end

---@class (exact) csgrun.tx
---@field [integer] any
---@field d? number how far

---Moves along X.
---
---Example: `part:tx(3)`
---@overload fun(options: csgrun.tx): any
---@param d? number how far
---@param options? csgrun.tx
---@return any
function tx(d, options) end
csg.tx = tx

---Moves along X.
---
---Example: `part:tx(3)`
---@overload fun(self: Solid, options: csgrun.tx): Solid
---@param d? number how far
---@param options? csgrun.tx
---@return Solid
function Solid:tx(d, options) end

---Moves along X.
---
---Example: `part:tx(3)`
---@overload fun(self: Shape, options: csgrun.tx): Shape
---@param d? number how far
---@param options? csgrun.tx
---@return Shape
function Shape:tx(d, options) end

---Moves along X.
---
---Example: `part:tx(3)`
---@overload fun(self: Matrix, options: csgrun.tx): Matrix
---@param d? number how far
---@param options? csgrun.tx
---@return Matrix
function Matrix:tx(d, options) end

---@class (exact) csgrun.ty
---@field [integer] any
---@field d? number how far

---Moves along Y.
---
---Example: `part:ty(3)`
---@overload fun(options: csgrun.ty): any
---@param d? number how far
---@param options? csgrun.ty
---@return any
function ty(d, options) end
csg.ty = ty

---Moves along Y.
---
---Example: `part:ty(3)`
---@overload fun(self: Solid, options: csgrun.ty): Solid
---@param d? number how far
---@param options? csgrun.ty
---@return Solid
function Solid:ty(d, options) end

---Moves along Y.
---
---Example: `part:ty(3)`
---@overload fun(self: Shape, options: csgrun.ty): Shape
---@param d? number how far
---@param options? csgrun.ty
---@return Shape
function Shape:ty(d, options) end

---Moves along Y.
---
---Example: `part:ty(3)`
---@overload fun(self: Matrix, options: csgrun.ty): Matrix
---@param d? number how far
---@param options? csgrun.ty
---@return Matrix
function Matrix:ty(d, options) end

---@class (exact) csgrun.tz
---@field [integer] any
---@field d? number how far

---Moves along Z.
---
---Example: `part:tz(3)`
---@overload fun(options: csgrun.tz): any
---@param d? number how far
---@param options? csgrun.tz
---@return any
function tz(d, options) end
csg.tz = tz

---Moves along Z.
---
---Example: `part:tz(3)`
---@overload fun(self: Solid, options: csgrun.tz): Solid
---@param d? number how far
---@param options? csgrun.tz
---@return Solid
function Solid:tz(d, options) end

---Moves along Z.
---
---Example: `part:tz(3)`
---@overload fun(self: Shape, options: csgrun.tz): Shape
---@param d? number how far
---@param options? csgrun.tz
---@return Shape
function Shape:tz(d, options) end

---Moves along Z.
---
---Example: `part:tz(3)`
---@overload fun(self: Matrix, options: csgrun.tz): Matrix
---@param d? number how far
---@param options? csgrun.tz
---@return Matrix
function Matrix:tz(d, options) end

---@class (exact) csgrun.rx
---@field [integer] any
---@field a? number degrees

---Turns about X.
---
---Example: `part:rx(90)`
---@overload fun(options: csgrun.rx): any
---@param a? number degrees
---@param options? csgrun.rx
---@return any
function rx(a, options) end
csg.rx = rx

---Turns about X.
---
---Example: `part:rx(90)`
---@overload fun(self: Solid, options: csgrun.rx): Solid
---@param a? number degrees
---@param options? csgrun.rx
---@return Solid
function Solid:rx(a, options) end

---Turns about X.
---
---Example: `part:rx(90)`
---@overload fun(self: Shape, options: csgrun.rx): Shape
---@param a? number degrees
---@param options? csgrun.rx
---@return Shape
function Shape:rx(a, options) end

---Turns about X.
---
---Example: `part:rx(90)`
---@overload fun(self: Matrix, options: csgrun.rx): Matrix
---@param a? number degrees
---@param options? csgrun.rx
---@return Matrix
function Matrix:rx(a, options) end

---@class (exact) csgrun.ry
---@field [integer] any
---@field a? number degrees

---Turns about Y.
---
---Example: `part:ry(90)`
---@overload fun(options: csgrun.ry): any
---@param a? number degrees
---@param options? csgrun.ry
---@return any
function ry(a, options) end
csg.ry = ry

---Turns about Y.
---
---Example: `part:ry(90)`
---@overload fun(self: Solid, options: csgrun.ry): Solid
---@param a? number degrees
---@param options? csgrun.ry
---@return Solid
function Solid:ry(a, options) end

---Turns about Y.
---
---Example: `part:ry(90)`
---@overload fun(self: Shape, options: csgrun.ry): Shape
---@param a? number degrees
---@param options? csgrun.ry
---@return Shape
function Shape:ry(a, options) end

---Turns about Y.
---
---Example: `part:ry(90)`
---@overload fun(self: Matrix, options: csgrun.ry): Matrix
---@param a? number degrees
---@param options? csgrun.ry
---@return Matrix
function Matrix:ry(a, options) end

---@class (exact) csgrun.rz
---@field [integer] any
---@field a? number degrees

---Turns about Z.
---
---Example: `part:rz(90)`
---@overload fun(options: csgrun.rz): any
---@param a? number degrees
---@param options? csgrun.rz
---@return any
function rz(a, options) end
csg.rz = rz

---Turns about Z.
---
---Example: `part:rz(90)`
---@overload fun(self: Solid, options: csgrun.rz): Solid
---@param a? number degrees
---@param options? csgrun.rz
---@return Solid
function Solid:rz(a, options) end

---Turns about Z.
---
---Example: `part:rz(90)`
---@overload fun(self: Shape, options: csgrun.rz): Shape
---@param a? number degrees
---@param options? csgrun.rz
---@return Shape
function Shape:rz(a, options) end

---Turns about Z.
---
---Example: `part:rz(90)`
---@overload fun(self: Matrix, options: csgrun.rz): Matrix
---@param a? number degrees
---@param options? csgrun.rz
---@return Matrix
function Matrix:rz(a, options) end

---@class (exact) csgrun.anchor
---@field [integer] any
---@field at? string left, right, front, back, bottom, top, or several: "top-left"; else the middle

---A point of the bounding box, {x, y, z}.
---
---Example: `cube(10):anchor("top-right")`
---@param part any a solid or a shape; as a method, part:f(...), it is left out
---@param at? string left, right, front, back, bottom, top, or several: "top-left"; else the middle
---@param options? csgrun.anchor
---@return number[]
function anchor(part, at, options) end
csg.anchor = anchor

---A point of the bounding box, {x, y, z}.
---
---Example: `cube(10):anchor("top-right")`
---@overload fun(self: Solid, options: csgrun.anchor): number[]
---@param at? string left, right, front, back, bottom, top, or several: "top-left"; else the middle
---@param options? csgrun.anchor
---@return number[]
function Solid:anchor(at, options) end

---A point of the bounding box, {x, y, z}.
---
---Example: `cube(10):anchor("top-right")`
---@overload fun(self: Shape, options: csgrun.anchor): number[]
---@param at? string left, right, front, back, bottom, top, or several: "top-left"; else the middle
---@param options? csgrun.anchor
---@return number[]
function Shape:anchor(at, options) end

---@class (exact) csgrun.attach
---@field [integer] any
---@field to? any the part that stays where it is
---@field at? string where on that one; sides as anchor has them
---@field own? string which of its own places comes there
---@field gap? number how far apart, along the sides that are named

---Moves it so that its bounding box touches that of another part.
---
---Example: `cylinder(5, 2):attach(cube(10), "top")`
---@param part any a solid or a shape; as a method, part:f(...), it is left out
---@param to? any the part that stays where it is
---@param at? string where on that one; sides as anchor has them
---@param own? string which of its own places comes there
---@param options? csgrun.attach
---@return any
function attach(part, to, at, own, options) end
csg.attach = attach

---Moves it so that its bounding box touches that of another part.
---
---Example: `cylinder(5, 2):attach(cube(10), "top")`
---@overload fun(self: Solid, options: csgrun.attach): Solid
---@param to? any the part that stays where it is
---@param at? string where on that one; sides as anchor has them
---@param own? string which of its own places comes there
---@param options? csgrun.attach
---@return Solid
function Solid:attach(to, at, own, options) end

---Moves it so that its bounding box touches that of another part.
---
---Example: `cylinder(5, 2):attach(cube(10), "top")`
---@overload fun(self: Shape, options: csgrun.attach): Shape
---@param to? any the part that stays where it is
---@param at? string where on that one; sides as anchor has them
---@param own? string which of its own places comes there
---@param options? csgrun.attach
---@return Shape
function Shape:attach(to, at, own, options) end

---@class (exact) csgrun.align
---@field [integer] any
---@field x? string "min", "center" or "max": which side of its box comes there
---@field y? string "min", "center" or "max": which side of its box comes there
---@field z? string "min", "center" or "max": which side of its box comes there
---@field to? any a point, or a part: then the same side of its box

---Moves it by its bounding box.
---
---Example: `cube(10):align{x = "center", z = "max"}`
---@param part any a solid or a shape; as a method, part:f(...), it is left out
---@param x? string "min", "center" or "max": which side of its box comes there
---@param y? string "min", "center" or "max": which side of its box comes there
---@param z? string "min", "center" or "max": which side of its box comes there
---@param options? csgrun.align
---@return any
function align(part, x, y, z, options) end
csg.align = align

---Moves it by its bounding box.
---
---Example: `cube(10):align{x = "center", z = "max"}`
---@overload fun(self: Solid, options: csgrun.align): Solid
---@param x? string "min", "center" or "max": which side of its box comes there
---@param y? string "min", "center" or "max": which side of its box comes there
---@param z? string "min", "center" or "max": which side of its box comes there
---@param options? csgrun.align
---@return Solid
function Solid:align(x, y, z, options) end

---Moves it by its bounding box.
---
---Example: `cube(10):align{x = "center", z = "max"}`
---@overload fun(self: Shape, options: csgrun.align): Shape
---@param x? string "min", "center" or "max": which side of its box comes there
---@param y? string "min", "center" or "max": which side of its box comes there
---@param z? string "min", "center" or "max": which side of its box comes there
---@param options? csgrun.align
---@return Shape
function Shape:align(x, y, z, options) end

---@class (exact) csgrun.centered
---@field [integer] any
---@field axes? boolean|boolean[] along which axes

---Moves the middle of its bounding box into the origin.
---
---Example: `cube(10):centered{true, true, false}`
---@param part any a solid or a shape; as a method, part:f(...), it is left out
---@param axes? boolean|boolean[] along which axes
---@param options? csgrun.centered
---@return any
function centered(part, axes, options) end
csg.centered = centered

---Moves the middle of its bounding box into the origin.
---
---Example: `cube(10):centered{true, true, false}`
---@overload fun(self: Solid, options: csgrun.centered): Solid
---@param axes? boolean|boolean[] along which axes
---@param options? csgrun.centered
---@return Solid
function Solid:centered(axes, options) end

---Moves the middle of its bounding box into the origin.
---
---Example: `cube(10):centered{true, true, false}`
---@overload fun(self: Shape, options: csgrun.centered): Shape
---@param axes? boolean|boolean[] along which axes
---@param options? csgrun.centered
---@return Shape
function Shape:centered(axes, options) end

---@class (exact) csgrun.mirror_copy
---@field [integer] any
---@field v? number[] normal of the plane through the origin
---@field list? boolean gives both as a list instead of their union

---It and its image in a plane through the origin.
---
---Example: `cube(2):translate(5, 0, 0):mirror_copy(1, 0, 0)`
---@overload fun(x: number, y: number, z?: number, ...): any
---@param part any a solid or a shape; as a method, part:f(...), it is left out
---@param v? number[] normal of the plane through the origin
---@param options? csgrun.mirror_copy
---@return any
function mirror_copy(part, v, options) end
csg.mirror_copy = mirror_copy

---It and its image in a plane through the origin.
---
---Example: `cube(2):translate(5, 0, 0):mirror_copy(1, 0, 0)`
---@overload fun(self: Solid, options: csgrun.mirror_copy): Solid
---@overload fun(self: Solid, x: number, y: number, z?: number, ...): Solid
---@param v? number[] normal of the plane through the origin
---@param options? csgrun.mirror_copy
---@return Solid
function Solid:mirror_copy(v, options) end

---It and its image in a plane through the origin.
---
---Example: `cube(2):translate(5, 0, 0):mirror_copy(1, 0, 0)`
---@overload fun(self: Shape, options: csgrun.mirror_copy): Shape
---@overload fun(self: Shape, x: number, y: number, z?: number, ...): Shape
---@param v? number[] normal of the plane through the origin
---@param options? csgrun.mirror_copy
---@return Shape
function Shape:mirror_copy(v, options) end

---@class (exact) csgrun.linear_array
---@field [integer] any
---@field n? integer how many
---@field v? number[] from one to the next
---@field center? boolean the middle of the row stays where it is
---@field list? boolean gives the copies as a list instead of their union

---Copies in a row.
---
---Example: `cylinder(5, 1):linear_array(4, {10, 0, 0})`
---@param part any a solid or a shape; as a method, part:f(...), it is left out
---@param n? integer how many
---@param v? number[] from one to the next
---@param options? csgrun.linear_array
---@return any
function linear_array(part, n, v, options) end
csg.linear_array = linear_array

---Copies in a row.
---
---Example: `cylinder(5, 1):linear_array(4, {10, 0, 0})`
---@overload fun(self: Solid, options: csgrun.linear_array): Solid
---@param n? integer how many
---@param v? number[] from one to the next
---@param options? csgrun.linear_array
---@return Solid
function Solid:linear_array(n, v, options) end

---Copies in a row.
---
---Example: `cylinder(5, 1):linear_array(4, {10, 0, 0})`
---@overload fun(self: Shape, options: csgrun.linear_array): Shape
---@param n? integer how many
---@param v? number[] from one to the next
---@param options? csgrun.linear_array
---@return Shape
function Shape:linear_array(n, v, options) end

---@class (exact) csgrun.grid_array
---@field [integer] any
---@field n? number[] how many along X, Y and Z
---@field step? number|number[] from one to the next along each axis
---@field center? boolean the middle of the grid stays where it is
---@field list? boolean gives the copies as a list instead of their union

---Copies in rows and columns, and in layers.
---
---Example: `cylinder(5, 1):grid_array({3, 2}, {10, 8})`
---@overload fun(x: number, y: number, z?: number, ...): any
---@param part any a solid or a shape; as a method, part:f(...), it is left out
---@param n? number[] how many along X, Y and Z
---@param step? number|number[] from one to the next along each axis
---@param options? csgrun.grid_array
---@return any
function grid_array(part, n, step, options) end
csg.grid_array = grid_array

---Copies in rows and columns, and in layers.
---
---Example: `cylinder(5, 1):grid_array({3, 2}, {10, 8})`
---@overload fun(self: Solid, options: csgrun.grid_array): Solid
---@overload fun(self: Solid, x: number, y: number, z?: number, ...): Solid
---@param n? number[] how many along X, Y and Z
---@param step? number|number[] from one to the next along each axis
---@param options? csgrun.grid_array
---@return Solid
function Solid:grid_array(n, step, options) end

---Copies in rows and columns, and in layers.
---
---Example: `cylinder(5, 1):grid_array({3, 2}, {10, 8})`
---@overload fun(self: Shape, options: csgrun.grid_array): Shape
---@overload fun(self: Shape, x: number, y: number, z?: number, ...): Shape
---@param n? number[] how many along X, Y and Z
---@param step? number|number[] from one to the next along each axis
---@param options? csgrun.grid_array
---@return Shape
function Shape:grid_array(n, step, options) end

---@class (exact) csgrun.polar_array
---@field [integer] any
---@field n? integer how many
---@field angle? number how far around, degrees; less than a full turn has its last copy at the end
---@field axis? number[] axis to turn about
---@field center? number[] a point of the axis
---@field turn? boolean copies turn with their place; else they keep looking one way
---@field list? boolean gives the copies as a list instead of their union

---Copies in a circle.
---
---Example: `cube(2):translate(10, 0, 0):polar_array(6)`
---@param part any a solid or a shape; as a method, part:f(...), it is left out
---@param n? integer how many
---@param angle? number how far around, degrees; less than a full turn has its last copy at the end
---@param options? csgrun.polar_array
---@return any
function polar_array(part, n, angle, options) end
csg.polar_array = polar_array

---Copies in a circle.
---
---Example: `cube(2):translate(10, 0, 0):polar_array(6)`
---@overload fun(self: Solid, options: csgrun.polar_array): Solid
---@param n? integer how many
---@param angle? number how far around, degrees; less than a full turn has its last copy at the end
---@param options? csgrun.polar_array
---@return Solid
function Solid:polar_array(n, angle, options) end

---Copies in a circle.
---
---Example: `cube(2):translate(10, 0, 0):polar_array(6)`
---@overload fun(self: Shape, options: csgrun.polar_array): Shape
---@param n? integer how many
---@param angle? number how far around, degrees; less than a full turn has its last copy at the end
---@param options? csgrun.polar_array
---@return Shape
function Shape:polar_array(n, angle, options) end

---@class (exact) csgrun.union
---@field [integer] any
---@field operands? any solids or shapes, one after another or as lists (of lists)

---What is in any of them.
---
---Example: `union{a, b, c}`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return any
function union(...) end
csg.union = union

---What is in any of them.
---
---Example: `union{a, b, c}`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return Solid
function Solid:union(...) end

---What is in any of them.
---
---Example: `union{a, b, c}`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return Shape
function Shape:union(...) end

---@class (exact) csgrun.difference
---@field [integer] any
---@field operands? any solids or shapes, one after another or as lists (of lists)
---@field cut? string which colour cut faces have: "tool", that of what cuts, or "body", that of the first solid (of its first leaf, where it has several)

---What is in the first and in none of the others.
---
---Example: `plate:difference(hole, slot)`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return any
function difference(...) end
csg.difference = difference

---What is in the first and in none of the others.
---
---Example: `plate:difference(hole, slot)`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return Solid
function Solid:difference(...) end

---What is in the first and in none of the others.
---
---Example: `plate:difference(hole, slot)`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return Shape
function Shape:difference(...) end

---@class (exact) csgrun.intersection
---@field [integer] any
---@field operands? any solids or shapes, one after another or as lists (of lists)

---What is in all of them.
---
---Example: `a:intersection(b)`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return any
function intersection(...) end
csg.intersection = intersection

---What is in all of them.
---
---Example: `a:intersection(b)`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return Solid
function Solid:intersection(...) end

---What is in all of them.
---
---Example: `a:intersection(b)`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return Shape
function Shape:intersection(...) end

---@class (exact) csgrun.symmetric_difference
---@field [integer] any
---@field operands? any solids or shapes, one after another or as lists (of lists)

---What is in an odd number of them.
---
---Example: `a:symmetric_difference(b)`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return any
function symmetric_difference(...) end
csg.symmetric_difference = symmetric_difference

---What is in an odd number of them.
---
---Example: `a:symmetric_difference(b)`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return Solid
function Solid:symmetric_difference(...) end

---What is in an odd number of them.
---
---Example: `a:symmetric_difference(b)`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return Shape
function Shape:symmetric_difference(...) end

---@class (exact) csgrun.add
---@field [integer] any
---@field operands? any solids or shapes, one after another or as lists (of lists)

---What is in any of them: another name of union.
---
---Example: `a:add(b, c)`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return Solid
function Solid:add(...) end

---What is in any of them: another name of union.
---
---Example: `a:add(b, c)`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return Shape
function Shape:add(...) end

---@class (exact) csgrun.sub
---@field [integer] any
---@field operands? any solids or shapes, one after another or as lists (of lists)
---@field cut? string which colour cut faces have: "tool", that of what cuts, or "body", that of the first solid (of its first leaf, where it has several)

---What is in the first and in none of the others: another name of difference.
---
---Example: `plate:sub(hole, {cut = "body"})`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return Solid
function Solid:sub(...) end

---What is in the first and in none of the others: another name of difference.
---
---Example: `plate:sub(hole, {cut = "body"})`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return Shape
function Shape:sub(...) end

---@class (exact) csgrun.subtract
---@field [integer] any
---@field operands? any solids or shapes, one after another or as lists (of lists)
---@field cut? string which colour cut faces have: "tool", that of what cuts, or "body", that of the first solid (of its first leaf, where it has several)

---What is in the first and in none of the others: another name of difference.
---
---Example: `plate:subtract(hole)`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return Solid
function Solid:subtract(...) end

---What is in the first and in none of the others: another name of difference.
---
---Example: `plate:subtract(hole)`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return Shape
function Shape:subtract(...) end

---@class (exact) csgrun.intersect
---@field [integer] any
---@field operands? any solids or shapes, one after another or as lists (of lists)

---What is in all of them: another name of intersection.
---
---Example: `a:intersect(b)`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return Solid
function Solid:intersect(...) end

---What is in all of them: another name of intersection.
---
---Example: `a:intersect(b)`
---@param ... any solids or shapes, one after another or as lists (of lists)
---@return Shape
function Shape:intersect(...) end

---@class (exact) csgrun.outer_hull
---@field [integer] any
---@field orientation_sensitive? boolean the way through a surface from its back to its front is open: inverted parts vanish, and a body parts where it is thinner than nothing
---@field keep_voids? boolean voids inside stay empty instead of being filled

---What cannot be reached from outside without crossing the surface, as it crosses itself.
---
---Example: `outer_hull(import("scan.stl"), {orientation_sensitive = true})`
---@param solid any a solid
---@param options? csgrun.outer_hull
---@return any
function outer_hull(solid, options) end
csg.outer_hull = outer_hull

---What cannot be reached from outside without crossing the surface, as it crosses itself.
---
---Example: `outer_hull(import("scan.stl"), {orientation_sensitive = true})`
---@overload fun(self: Solid, options: csgrun.outer_hull): Solid
---@param options? csgrun.outer_hull
---@return Solid
function Solid:outer_hull(options) end

---@class (exact) csgrun.color
---@field [integer] any
---@field c? string|number[] name, '#rrggbb', '#rrggbbaa', or red, green, blue (and alpha) from 0 to 1
---@field alpha? number opacity, 0 to 1
---@field metallic? number 0 to 1
---@field roughness? number 0 to 1
---@field name? string name of the material

---Paints every face; of several colours the outermost counts. The material stays.
---
---Example: `part:color('steelblue', 0.5)`
---@param part any a solid or a shape; part:color(...) leaves it out
---@param c? string|number[] name, '#rrggbb', '#rrggbbaa', or red, green, blue (and alpha) from 0 to 1
---@param alpha? number opacity, 0 to 1
---@param options? csgrun.color
---@return any
function color(part, c, alpha, options) end
csg.color = color

---Paints every face; of several colours the outermost counts. The material stays.
---
---Example: `part:color('steelblue', 0.5)`
---@overload fun(self: Solid, options: csgrun.color): Solid
---@param c? string|number[] name, '#rrggbb', '#rrggbbaa', or red, green, blue (and alpha) from 0 to 1
---@param alpha? number opacity, 0 to 1
---@param options? csgrun.color
---@return Solid
function Solid:color(c, alpha, options) end

---Paints every face; of several colours the outermost counts. The material stays.
---
---Example: `part:color('steelblue', 0.5)`
---@overload fun(self: Shape, options: csgrun.color): Shape
---@param c? string|number[] name, '#rrggbb', '#rrggbbaa', or red, green, blue (and alpha) from 0 to 1
---@param alpha? number opacity, 0 to 1
---@param options? csgrun.color
---@return Shape
function Shape:color(c, alpha, options) end

---@class (exact) csgrun.setcolor
---@field [integer] any
---@field c? string|number[] name, '#rrggbb', '#rrggbbaa', or red, green, blue (and alpha) from 0 to 1
---@field alpha? number opacity, 0 to 1
---@field metallic? number 0 to 1
---@field roughness? number 0 to 1
---@field name? string name of the material

---Paints every face: another name of color.
---
---Example: `part:setcolor("red")`
---@param part any a solid or a shape; part:color(...) leaves it out
---@param c? string|number[] name, '#rrggbb', '#rrggbbaa', or red, green, blue (and alpha) from 0 to 1
---@param alpha? number opacity, 0 to 1
---@param options? csgrun.setcolor
---@return any
function setcolor(part, c, alpha, options) end
csg.setcolor = setcolor

---Paints every face: another name of color.
---
---Example: `part:setcolor("red")`
---@overload fun(self: Solid, options: csgrun.setcolor): Solid
---@param c? string|number[] name, '#rrggbb', '#rrggbbaa', or red, green, blue (and alpha) from 0 to 1
---@param alpha? number opacity, 0 to 1
---@param options? csgrun.setcolor
---@return Solid
function Solid:setcolor(c, alpha, options) end

---Paints every face: another name of color.
---
---Example: `part:setcolor("red")`
---@overload fun(self: Shape, options: csgrun.setcolor): Shape
---@param c? string|number[] name, '#rrggbb', '#rrggbbaa', or red, green, blue (and alpha) from 0 to 1
---@param alpha? number opacity, 0 to 1
---@param options? csgrun.setcolor
---@return Shape
function Shape:setcolor(c, alpha, options) end

---@class (exact) csgrun.material
---@field [integer] any
---@field kind? string "matte", "plastic", "metal", "glass", "emissive", "steel", "chrome", "gold", "copper", "brass", "rubber", "wood" or "ivory"
---@field metallic? number 0 to 1
---@field roughness? number 0 to 1
---@field name? string name of the material
---@field specular? number reflectance; no format holds it, so it is said in a warning
---@field ior? number index of refraction; as specular
---@field strength? number of light; as specular

---What every face is made of; colours stay. The kinds with a colour of their own (steel, gold, rubber ...) give it to faces that have none.
---
---Example: `part:material("metal", {roughness = 0.4})`
---@param part any a solid or a shape; part:material(...) leaves it out
---@param kind? string "matte", "plastic", "metal", "glass", "emissive", "steel", "chrome", "gold", "copper", "brass", "rubber", "wood" or "ivory"
---@param options? csgrun.material
---@return any
function material(part, kind, options) end
csg.material = material

---What every face is made of; colours stay. The kinds with a colour of their own (steel, gold, rubber ...) give it to faces that have none.
---
---Example: `part:material("metal", {roughness = 0.4})`
---@overload fun(self: Solid, options: csgrun.material): Solid
---@param kind? string "matte", "plastic", "metal", "glass", "emissive", "steel", "chrome", "gold", "copper", "brass", "rubber", "wood" or "ivory"
---@param options? csgrun.material
---@return Solid
function Solid:material(kind, options) end

---What every face is made of; colours stay. The kinds with a colour of their own (steel, gold, rubber ...) give it to faces that have none.
---
---Example: `part:material("metal", {roughness = 0.4})`
---@overload fun(self: Shape, options: csgrun.material): Shape
---@param kind? string "matte", "plastic", "metal", "glass", "emissive", "steel", "chrome", "gold", "copper", "brass", "rubber", "wood" or "ivory"
---@param options? csgrun.material
---@return Shape
function Shape:material(kind, options) end

---@class (exact) csgrun.name
---@field [integer] any
---@field name? string name of the part that it becomes

---The same with a name: as a part of the result it is called so. Transforms, colours and Booleans (of their first operand) keep it.
---
---Example: `render(lid:name("lid"))`
---@overload fun(self: Solid, options: csgrun.name): Solid
---@param name? string name of the part that it becomes
---@param options? csgrun.name
---@return Solid
function Solid:name(name, options) end

---The same with a name: as a part of the result it is called so. Transforms, colours and Booleans (of their first operand) keep it.
---
---Example: `render(lid:name("lid"))`
---@overload fun(self: Shape, options: csgrun.name): Shape
---@param name? string name of the part that it becomes
---@param options? csgrun.name
---@return Shape
function Shape:name(name, options) end

---The same again. Values never change, so nobody needs it: it is there for LuaCAD.
---
---Example: `part:clone()`
---@return Solid
function Solid:clone() end

---The same again. Values never change, so nobody needs it: it is there for LuaCAD.
---
---Example: `part:clone()`
---@return Shape
function Shape:clone() end

---The same again: another name of clone.
---
---Example: `part:copy()`
---@return Solid
function Solid:copy() end

---The same again: another name of clone.
---
---Example: `part:copy()`
---@return Shape
function Shape:copy() end

---OpenSCAD's *: no part, and as an operand as if it were not there.
---
---Example: `part - hole:skip()`
---@return Solid
function Solid:skip() end

---OpenSCAD's *: no part, and as an operand as if it were not there.
---
---Example: `part - hole:skip()`
---@return Shape
function Shape:skip() end

---OpenSCAD's !: where a part has it in it, the result is this alone, in its place, without the Booleans that it stands in.
---
---Example: `render(part - hole:only())`
---@return Solid
function Solid:only() end

---OpenSCAD's !: where a part has it in it, the result is this alone, in its place, without the Booleans that it stands in.
---
---Example: `render(part - hole:only())`
---@return Shape
function Shape:only() end

---OpenSCAD's # marks for the eye only; the result is the same.
---
---Example: `part - hole:debug()`
---@return Solid
function Solid:debug() end

---OpenSCAD's # marks for the eye only; the result is the same.
---
---Example: `part - hole:debug()`
---@return Shape
function Shape:debug() end

---OpenSCAD's %: shown in previews, so to a file the same as skip.
---
---Example: `render(part:transparent())`
---@return Solid
function Solid:transparent() end

---OpenSCAD's %: shown in previews, so to a file the same as skip.
---
---Example: `render(part:transparent())`
---@return Shape
function Shape:transparent() end

---A short form: s(part) is part:skip().
---
---Example: `part - s(hole)`
---@return any
function s() end
csg.s = s

---A short form: o(part) is part:only().
---
---Example: `render(part - o(hole))`
---@return any
function o() end
csg.o = o

---A short form: d(part) is part:debug().
---
---Example: `part - d(hole)`
---@return any
function d() end
csg.d = d

---A short form: t(part) is part:transparent().
---
---Example: `render(t(part))`
---@return any
function t() end
csg.t = t

---The bounding box: its corners .min and .max, .size and .center, vectors as of vec; two numbers each for a shape.
---
---Example: `part:bbox().max.z`
---@return {min: number[], max: number[], size: number[], center: number[]}
function Solid:bbox() end

---The bounding box: its corners .min and .max, .size and .center, vectors as of vec; two numbers each for a shape.
---
---Example: `part:bbox().max.z`
---@return {min: number[], max: number[], size: number[], center: number[]}
function Shape:bbox() end

---The bounding box: another name of bbox.
---
---Example: `part:bounds().min.x`
---@return number
function Solid:bounds() end

---The bounding box: another name of bbox.
---
---Example: `part:bounds().min.x`
---@return number
function Shape:bounds() end

---The lengths of the bounding box, a vector: .x, .y, .z or [1], [2], [3].
---
---Example: `part:size().x`
---@return number[]
function Solid:size() end

---The lengths of the bounding box, a vector: .x, .y, .z or [1], [2], [3].
---
---Example: `part:size().x`
---@return number[]
function Shape:size() end

---The volume in mm^3, rounded once from the exact value.
---
---Example: `part:volume()`
---@return number
function Solid:volume() end

---The area of the surface in mm^2; of a shape its own area.
---
---Example: `part:area()`
---@return number
function Solid:area() end

---The area of the surface in mm^2; of a shape its own area.
---
---Example: `part:area()`
---@return number
function Shape:area() end

---The centre of mass, a vector {x, y, z}; of a shape {x, y}.
---
---Example: `part:centroid().x`
---@return number[]
function Solid:centroid() end

---The centre of mass, a vector {x, y, z}; of a shape {x, y}.
---
---Example: `part:centroid().x`
---@return number[]
function Shape:centroid() end

---The number of connected surfaces; of a shape that of connected pieces.
---
---Example: `part:components()`
---@return integer
function Solid:components() end

---The number of connected surfaces; of a shape that of connected pieces.
---
---Example: `part:components()`
---@return integer
function Shape:components() end

---The number of handles, over all surfaces.
---
---Example: `part:genus()`
---@return integer
function Solid:genus() end

---Whether there is nothing in it.
---
---Example: `(part - part):is_empty()`
---@return boolean
function Solid:is_empty() end

---Whether there is nothing in it.
---
---Example: `(part - part):is_empty()`
---@return boolean
function Shape:is_empty() end

---Its triangles: {points = {{x, y, z}, ...}, faces = {{i, j, k}, ...}}, as polyhedron takes them.
---
---Example: `polyhedron(part:mesh())`
---@return {points: number[][], faces: integer[][]}
function Solid:mesh() end

---@class (exact) csgrun.contains
---@field [integer] any
---@field p? number[] the point

---Whether the point is inside or on the boundary, exactly.
---
---Example: `part:contains(0, 0, 5)`
---@overload fun(self: Solid, options: csgrun.contains): boolean
---@overload fun(self: Solid, x: number, y: number, z?: number, ...): boolean
---@param p? number[] the point
---@param options? csgrun.contains
---@return boolean
function Solid:contains(p, options) end

---Whether the point is inside or on the boundary, exactly.
---
---Example: `part:contains(0, 0, 5)`
---@overload fun(self: Shape, options: csgrun.contains): boolean
---@overload fun(self: Shape, x: number, y: number, z?: number, ...): boolean
---@param p? number[] the point
---@param options? csgrun.contains
---@return boolean
function Shape:contains(p, options) end

---@class (exact) csgrun.faces
---@field [integer] any
---@field normal? number[] which way they look, outwards
---@field angle? number how far from that, in degrees
---@field through? number[] a point of their plane, to a millionth of a mm

---Its flat faces, each {normal, area, center, loops}: loops are lists of points, the outer one first and counter-clockwise, then holes.
---
---Example: `part:faces({0, 0, 1})[1].area`
---@overload fun(self: Solid, options: csgrun.faces): {normal: number[], area: number, center: number[], loops: number[][][]}[]
---@overload fun(self: Solid, x: number, y: number, z?: number, ...): {normal: number[], area: number, center: number[], loops: number[][][]}[]
---@param normal? number[] which way they look, outwards
---@param options? csgrun.faces
---@return {normal: number[], area: number, center: number[], loops: number[][][]}[]
function Solid:faces(normal, options) end

---@class (exact) csgrun.ray
---@field [integer] any
---@field from? number[] where it starts
---@field direction? number[] where it goes

---Where a ray passes its surface, from the start on: each {distance, point, normal, entering}.
---
---Example: `part:ray({-5, 5, 5}, {1, 0, 0})[1].distance`
---@overload fun(self: Solid, options: csgrun.ray): {distance: number, point: number[], normal: number[], entering: boolean}[]
---@overload fun(self: Solid, x: number, y: number, z?: number, ...): {distance: number, point: number[], normal: number[], entering: boolean}[]
---@param from? number[] where it starts
---@param direction? number[] where it goes
---@param options? csgrun.ray
---@return {distance: number, point: number[], normal: number[], entering: boolean}[]
function Solid:ray(from, direction, options) end

---@class (exact) csgrun.gap
---@field [integer] any
---@field other? any the other solid

---How far it is from another solid: 0 where they touch or overlap.
---
---Example: `part:gap(cube(1):translate(20, 0, 0))`
---@overload fun(self: Solid, options: csgrun.gap): number
---@param other? any the other solid
---@param options? csgrun.gap
---@return number
function Solid:gap(other, options) end

---@class (exact) csgrun.sin
---@field [integer] any
---@field a? number degrees

---Sine of an angle in degrees.
---
---Example: `sin(30)`
---@overload fun(options: csgrun.sin): number
---@param a? number degrees
---@param options? csgrun.sin
---@return number
function sin(a, options) end
csg.sin = sin

---@class (exact) csgrun.cos
---@field [integer] any
---@field a? number degrees

---Cosine of an angle in degrees.
---
---Example: `cos(60)`
---@overload fun(options: csgrun.cos): number
---@param a? number degrees
---@param options? csgrun.cos
---@return number
function cos(a, options) end
csg.cos = cos

---@class (exact) csgrun.tan
---@field [integer] any
---@field a? number degrees

---Tangent of an angle in degrees.
---
---Example: `tan(45)`
---@overload fun(options: csgrun.tan): number
---@param a? number degrees
---@param options? csgrun.tan
---@return number
function tan(a, options) end
csg.tan = tan

---@class (exact) csgrun.asin
---@field [integer] any
---@field x? number ratio

---Arc sine in degrees.
---
---Example: `asin(0.5)`
---@overload fun(options: csgrun.asin): number
---@param x? number ratio
---@param options? csgrun.asin
---@return number
function asin(x, options) end
csg.asin = asin

---@class (exact) csgrun.acos
---@field [integer] any
---@field x? number ratio

---Arc cosine in degrees.
---
---Example: `acos(0.5)`
---@overload fun(options: csgrun.acos): number
---@param x? number ratio
---@param options? csgrun.acos
---@return number
function acos(x, options) end
csg.acos = acos

---@class (exact) csgrun.atan
---@field [integer] any
---@field x? number ratio

---Arc tangent in degrees.
---
---Example: `atan(1)`
---@overload fun(options: csgrun.atan): number
---@param x? number ratio
---@param options? csgrun.atan
---@return number
function atan(x, options) end
csg.atan = atan

---@class (exact) csgrun.atan2
---@field [integer] any
---@field y? number opposite side
---@field x? number adjacent side

---Angle of the direction (x, y) in degrees.
---
---Example: `atan2(1, -1)`
---@overload fun(options: csgrun.atan2): number
---@param y? number opposite side
---@param x? number adjacent side
---@param options? csgrun.atan2
---@return number
function atan2(y, x, options) end
csg.atan2 = atan2

---@class (exact) csgrun.sind
---@field [integer] any
---@field a? number degrees

---The same as sin.
---
---Example: `sind(30)`
---@overload fun(options: csgrun.sind): number
---@param a? number degrees
---@param options? csgrun.sind
---@return number
function sind(a, options) end
csg.sind = sind

---@class (exact) csgrun.cosd
---@field [integer] any
---@field a? number degrees

---The same as cos.
---
---Example: `cosd(60)`
---@overload fun(options: csgrun.cosd): number
---@param a? number degrees
---@param options? csgrun.cosd
---@return number
function cosd(a, options) end
csg.cosd = cosd

---@class (exact) csgrun.tand
---@field [integer] any
---@field a? number degrees

---The same as tan.
---
---Example: `tand(45)`
---@overload fun(options: csgrun.tand): number
---@param a? number degrees
---@param options? csgrun.tand
---@return number
function tand(a, options) end
csg.tand = tand

---@class (exact) csgrun.asind
---@field [integer] any
---@field x? number ratio

---The same as asin.
---
---Example: `asind(0.5)`
---@overload fun(options: csgrun.asind): number
---@param x? number ratio
---@param options? csgrun.asind
---@return number
function asind(x, options) end
csg.asind = asind

---@class (exact) csgrun.acosd
---@field [integer] any
---@field x? number ratio

---The same as acos.
---
---Example: `acosd(0.5)`
---@overload fun(options: csgrun.acosd): number
---@param x? number ratio
---@param options? csgrun.acosd
---@return number
function acosd(x, options) end
csg.acosd = acosd

---@class (exact) csgrun.atand
---@field [integer] any
---@field x? number ratio

---The same as atan.
---
---Example: `atand(1)`
---@overload fun(options: csgrun.atand): number
---@param x? number ratio
---@param options? csgrun.atand
---@return number
function atand(x, options) end
csg.atand = atand

---@class (exact) csgrun.atan2d
---@field [integer] any
---@field y? number opposite side
---@field x? number adjacent side

---The same as atan2.
---
---Example: `atan2d(1, -1)`
---@overload fun(options: csgrun.atan2d): number
---@param y? number opposite side
---@param x? number adjacent side
---@param options? csgrun.atan2d
---@return number
function atan2d(y, x, options) end
csg.atan2d = atan2d

---@class (exact) csgrun.vec
---@field [integer] any
---@field v? number[] x, y and z; z is 0 if it is left out

---A list {x, y, z} with + - * / and ==, and with len, unit, cross, scalar, normal, rot as methods; * of two is their scalar product.
---
---Example: `vec(1, 0, 0) * 10 + vec(0, 5)`
---@overload fun(options: csgrun.vec): Vector
---@overload fun(x: number, y: number, z?: number, ...): Vector
---@param v? number[] x, y and z; z is 0 if it is left out
---@param options? csgrun.vec
---@return Vector
function vec(v, options) end
csg.vec = vec

---@class (exact) csgrun.vector
---@field [integer] any
---@field v? number[] x, y and z; z is 0 if it is left out

---Another name of vec.
---
---Example: `vector(1, 2, 3):len()`
---@overload fun(options: csgrun.vector): Vector
---@overload fun(x: number, y: number, z?: number, ...): Vector
---@param v? number[] x, y and z; z is 0 if it is left out
---@param options? csgrun.vector
---@return Vector
function vector(v, options) end
csg.vector = vector

---@class (exact) csgrun.cross
---@field [integer] any
---@field a? number[] a vector
---@field b? number[] another

---The vector product.
---
---Example: `cross({1, 0, 0}, {0, 1, 0})`
---@overload fun(options: csgrun.cross): Vector
---@overload fun(x: number, y: number, z?: number, ...): Vector
---@param a? number[] a vector
---@param b? number[] another
---@param options? csgrun.cross
---@return Vector
function cross(a, b, options) end
csg.cross = cross

---@class (exact) csgrun.norm
---@field [integer] any
---@field v? number[] a vector

---The length of a vector.
---
---Example: `norm{3, 4, 0}`
---@overload fun(options: csgrun.norm): number
---@overload fun(x: number, y: number, z?: number, ...): number
---@param v? number[] a vector
---@param options? csgrun.norm
---@return number
function norm(v, options) end
csg.norm = norm

---@class (exact) csgrun.lookup
---@field [integer] any
---@field key? number where to look
---@field table? number[][] pairs {key, value}, in any order

---The value at key, on straight lines between the pairs; beyond them the outermost's.
---
---Example: `lookup(5, {{0, 0}, {10, 100}})`
---@overload fun(options: csgrun.lookup): number
---@param key? number where to look
---@param table? number[][] pairs {key, value}, in any order
---@param options? csgrun.lookup
---@return number
function lookup(key, table, options) end
csg.lookup = lookup

---@class (exact) csgrun.rands
---@field [integer] any
---@field min? number the least
---@field max? number the greatest
---@field n? integer how many
---@field seed? number the same seed, the same numbers; without one it goes on

---A list of random numbers: the same on every run and machine.
---
---Example: `rands(0, 1, 3, 42)`
---@overload fun(options: csgrun.rands): number[]
---@param min? number the least
---@param max? number the greatest
---@param n? integer how many
---@param seed? number the same seed, the same numbers; without one it goes on
---@param options? csgrun.rands
---@return number[]
function rands(min, max, n, seed, options) end
csg.rands = rands

---@class (exact) csgrun.abs
---@field [integer] any
---@field x? number a number

---The number without its sign.
---
---Example: `abs(-3)`
---@overload fun(options: csgrun.abs): number
---@param x? number a number
---@param options? csgrun.abs
---@return number
function abs(x, options) end
csg.abs = abs

---@class (exact) csgrun.sign
---@field [integer] any
---@field x? number a number

----1, 0 or 1.
---
---Example: `sign(-0.5)`
---@overload fun(options: csgrun.sign): number
---@param x? number a number
---@param options? csgrun.sign
---@return number
function sign(x, options) end
csg.sign = sign

---@class (exact) csgrun.floor
---@field [integer] any
---@field x? number a number

---The next whole number below.
---
---Example: `floor(2.7)`
---@overload fun(options: csgrun.floor): number
---@param x? number a number
---@param options? csgrun.floor
---@return number
function floor(x, options) end
csg.floor = floor

---@class (exact) csgrun.ceil
---@field [integer] any
---@field x? number a number

---The next whole number above.
---
---Example: `ceil(2.1)`
---@overload fun(options: csgrun.ceil): number
---@param x? number a number
---@param options? csgrun.ceil
---@return number
function ceil(x, options) end
csg.ceil = ceil

---@class (exact) csgrun.round
---@field [integer] any
---@field x? number a number

---The nearest whole number, halves away from 0.
---
---Example: `round(2.5)`
---@overload fun(options: csgrun.round): number
---@param x? number a number
---@param options? csgrun.round
---@return number
function round(x, options) end
csg.round = round

---@class (exact) csgrun.sqrt
---@field [integer] any
---@field x? number a number

---The square root.
---
---Example: `sqrt(2)`
---@overload fun(options: csgrun.sqrt): number
---@param x? number a number
---@param options? csgrun.sqrt
---@return number
function sqrt(x, options) end
csg.sqrt = sqrt

---@class (exact) csgrun.exp
---@field [integer] any
---@field x? number a number

---e to the power of x.
---
---Example: `exp(1)`
---@overload fun(options: csgrun.exp): number
---@param x? number a number
---@param options? csgrun.exp
---@return number
function exp(x, options) end
csg.exp = exp

---@class (exact) csgrun.ln
---@field [integer] any
---@field x? number a number

---The natural logarithm.
---
---Example: `ln(2)`
---@overload fun(options: csgrun.ln): number
---@param x? number a number
---@param options? csgrun.ln
---@return number
function ln(x, options) end
csg.ln = ln

---@class (exact) csgrun.pow
---@field [integer] any
---@field x? number base
---@field y? number exponent

---x to the power of y.
---
---Example: `pow(2, 10)`
---@overload fun(options: csgrun.pow): number
---@param x? number base
---@param y? number exponent
---@param options? csgrun.pow
---@return number
function pow(x, y, options) end
csg.pow = pow

---@class (exact) csgrun.min
---@field [integer] any
---@field values? any numbers, one after another or as a list

---The least.
---
---Example: `min(3, 1, 2)`
---@param ... any numbers, one after another or as a list
---@return number
function min(...) end
csg.min = min

---@class (exact) csgrun.max
---@field [integer] any
---@field values? any numbers, one after another or as a list

---The greatest.
---
---Example: `max{3, 1, 2}`
---@param ... any numbers, one after another or as a list
---@return number
function max(...) end
csg.max = max

---@class (exact) csgrun.param
---@field [integer] any
---@field name? string name, for -D name=value
---@field default? any a number, true or false, a string or a list of numbers
---@field min? number least value
---@field max? number greatest value
---@field step? number values are whole steps from min (or from 0)
---@field choices? any list of the values that it may have
---@field doc? string what it means

---A parameter of the model: its default, or what -D name=value or a file of -p says.
---
---Example: `param("hole_radius", 4, {min = 1, max = 10})`
---@overload fun(options: csgrun.param): any
---@param name? string name, for -D name=value
---@param default? any a number, true or false, a string or a list of numbers
---@param options? csgrun.param
---@return any
function param(name, default, options) end
csg.param = param

---@class (exact) csgrun.var
---@field [integer] any
---@field doc? string what it means; -D "doc=value" sets it by this
---@field default? any a number, true or false, a string or a list of numbers

---A parameter of the model, as LuaCAD writes it.
---
---Example: `var("Radius of the hole", 4)`
---@overload fun(options: csgrun.var): any
---@param doc? string what it means; -D "doc=value" sets it by this
---@param default? any a number, true or false, a string or a list of numbers
---@param options? csgrun.var
---@return any
function var(doc, default, options) end
csg.var = var

---@class (exact) csgrun.read_text
---@field [integer] any
---@field file? string relative to the file that calls, or else to the folders of -L and CSGRUN_PATH

---The bytes of a file as a string.
---
---Example: `read_text("notes.txt")`
---@overload fun(options: csgrun.read_text): string
---@param file? string relative to the file that calls, or else to the folders of -L and CSGRUN_PATH
---@param options? csgrun.read_text
---@return string
function read_text(file, options) end
csg.read_text = read_text

---@class (exact) csgrun.read_json
---@field [integer] any
---@field file? string relative to the file that calls, or else to the folders of -L and CSGRUN_PATH

---What a JSON file holds, as tables, lists, strings, numbers, true and false; null is nil.
---
---Example: `read_json("sizes.json").width`
---@overload fun(options: csgrun.read_json): any
---@param file? string relative to the file that calls, or else to the folders of -L and CSGRUN_PATH
---@param options? csgrun.read_json
---@return any
function read_json(file, options) end
csg.read_json = read_json

---@class (exact) csgrun.read_csv
---@field [integer] any
---@field file? string relative to the file that calls, or else to the folders of -L and CSGRUN_PATH
---@field header? boolean the first line has names: each row is a table by these, instead of a list
---@field separator? string one character between the fields
---@field numbers? boolean fields that are numbers become numbers

---The rows of a table in text, as lists of numbers and strings. Fields may stand in "quotes".
---
---Example: `read_csv("points.csv", {header = true})[1].x`
---@overload fun(options: csgrun.read_csv): any
---@param file? string relative to the file that calls, or else to the folders of -L and CSGRUN_PATH
---@param options? csgrun.read_csv
---@return any
function read_csv(file, options) end
csg.read_csv = read_csv

---@class (exact) csgrun.load_csg
---@field [integer] any
---@field file? string relative to the file that calls, or else to the folders of -L and CSGRUN_PATH

---What OpenSCAD's .csg file describes: a solid, or a shape when all of it is flat.
---
---Example: `load_csg("tree.csg"):translate(0, 0, 10)`
---@overload fun(options: csgrun.load_csg): any
---@param file? string relative to the file that calls, or else to the folders of -L and CSGRUN_PATH
---@param options? csgrun.load_csg
---@return any
function load_csg(file, options) end
csg.load_csg = load_csg

---@class (exact) csgrun.import
---@field [integer] any
---@field file? string STL, OFF, OBJ, PLY, GLB, glTF, 3MF, AMF, SVG or DXF, relative to the file that calls, or else to the folders of -L and CSGRUN_PATH
---@field parts? boolean gives a list of its parts, which have the names that the file has for them, instead of their union; of a drawing: the outermost elements of an SVG, the layers of a DXF (without parts they are one drawing: where two overlap is a hole)
---@field fill? string what is inside where the surface crosses itself, by how often it wraps around a point, one way less the other: "nonzero" (wherever that is not 0: overlaps are united, but an inverted part cancels what it overlaps), "positive" (inverted parts are cut away), "evenodd" (an odd number: overlaps cancel)
---@field repair? any makes a broken mesh a closed one and warns of all it does: true, or a table of weld = MM (0: how far apart points of open edges may be that become one), fill_holes (false: closes what is open), orient (true: turns faces to agree, surfaces outwards), drop_degenerate (true: drops faces whose points lie on one line), drop_duplicates (true: of faces on the same points those that are too many)
---@field layer? string of a drawing: only this layer (in an SVG one of Inkscape)
---@field id? string of an SVG: only the element of this id, with what is in it
---@field dpi? number of an SVG with a viewBox: user units an inch, where its size has no unit
---@field origin? number[] of a DXF, whose points go to the nearest 1/1024: this one becomes the origin
---@field scale? number of a DXF: a factor
---@field center? boolean the middle of its box becomes the origin
---@field as_openscad? boolean of a drawing: by OpenSCAD's rules of what is area and how many pieces curves have; a layer or an id that is not there is empty, and what is damaged or hidden in a DXF is read as OpenSCAD does
---@field convexity? integer ignored: OpenSCAD needs it for its preview
---@field fn? number number of facets of a full turn; 0: from fa and fs
---@field segments? number the same as fn
---@field fa? number smallest angle of a facet, degrees, at least 0.01
---@field fs? number smallest length of a facet, mm, at least 0.01

---A solid from a file, with its colours; its meshes must be closed, or are repaired on request. Where one crosses itself, fill says what is inside. A shape from a drawing: what is filled or closed.
---
---Example: `import("scan.stl", {repair = {weld = 0.01, fill_holes = true}})`
---@overload fun(options: csgrun.import): Solid
---@param file? string STL, OFF, OBJ, PLY, GLB, glTF, 3MF, AMF, SVG or DXF, relative to the file that calls, or else to the folders of -L and CSGRUN_PATH
---@param options? csgrun.import
---@return Solid
function import(file, options) end
csg.import = import

---@class (exact) csgrun.require
---@field [integer] any
---@field name? string a module of csgrun's own library (csg.gears, csg.layout, csg.options, csg.threads), or the file name.lua or name/init.lua in the model's folder, in csgrun_modules beside it, in the folders of -L and in those of CSGRUN_PATH, and before these where package.path says; a dot in the name opens a folder

---Runs a module once and gives what it returns.
---
---Example: `local wheel = require "parts.wheel"`
---@overload fun(options: csgrun.require): any
---@param name? string a module of csgrun's own library (csg.gears, csg.layout, csg.options, csg.threads), or the file name.lua or name/init.lua in the model's folder, in csgrun_modules beside it, in the folders of -L and in those of CSGRUN_PATH, and before these where package.path says; a dot in the name opens a folder
---@param options? csgrun.require
---@return any
function require(name, options) end
csg.require = require

---@class (exact) csgrun.emit
---@field [integer] any
---@field name? string name of the part, or of the group

---Adds a part, or a table of parts, to the result, beside what the script returns.
---
---Example: `emit(lid, "lid")`
---@param part any a solid, a shape, or a table of them; several may stand one after another
---@param name? string name of the part, or of the group
---@param options? csgrun.emit
function emit(part, name, options) end
csg.emit = emit

---@class (exact) csgrun.render
---@field [integer] any
---@field name? string name of the part, or of the group

---Adds a part to the result: another name of emit.
---
---Example: `render(lid, {name = "lid"})`
---@param part any a solid, a shape, or a table of them; several may stand one after another
---@param name? string name of the part, or of the group
---@param options? csgrun.render
function render(part, name, options) end
csg.render = render
