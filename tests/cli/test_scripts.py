"""Mistakes in scripts: the message starts with FILE:line:, the exit code is 1."""
import os
import subprocess

from support import CSGRUN, Case, main


class Mistakes(Case):
    def check(self, text, message, code=1):
        outcome = self.run_script(text)
        self.expect(outcome, code, message)
        self.assertEqual(outcome.out, "")

    def test_syntax(self):
        self.check("local a = 1\nlocal b = = 2\n", "model.lua:2: unexpected symbol near '='")
        self.check("return cube(", "model.lua:1: unexpected symbol near <eof>")

    def test_runtime_error_deep_in_a_required_file(self):
        self.write("parts/wheel.lua", "local M = {}\nfunction M.spokes(n)\n  if n == 0 then\n    error('no spokes')\n"
                                      "  end\n  local r = M.spokes(n - 1)\n  return r\nend\nreturn M\n")
        outcome = self.run_script("local wheel = require 'parts.wheel'\n\nlocal r = wheel.spokes(2)\nreturn r\n")
        self.expect(outcome, 1, "parts/wheel.lua:4: no spokes\nstack traceback:\n")
        for frame in ("parts/wheel.lua:4: in ", "parts/wheel.lua:6: in ", "model.lua:3: in main chunk"):
            self.assertIn(frame, outcome.err)

    def test_what_was_loaded_under_another_name_is_named_once(self):
        for text in ("cube(-1)", "error('cube: ')", "local cube = nil; cube.a = 1"):
            outcome = self.run_script(f"load([[{text}]], '=piece')()")
            self.assertRegex(outcome.first, "^piece:1: .*cube")
            self.assertEqual(outcome.first.count("piece:"), 1)

    def test_unknown_option(self):
        self.check("return cube{centre = true}", "model.lua:1: cube: unknown option 'centre' (did you mean 'center'?)")

    def test_undefined_global(self):
        self.check("\nreturn cub(10)", "model.lua:2: undefined variable 'cub' (did you mean 'cube'?)")

    def test_what_openscad_users_write(self):
        for text, message in (
                ("cube([1, 2, 3]);", "unexpected symbol near '['; a list stands in braces: {10, 20, 30}"),
                ("return union{cube(1) sphere(2)}", "'}' expected near 'sphere'; what stands in braces is separated by commas"),
                ("return cube({1, 2, 3}, center=true)", "')' expected near '='; options by name stand in braces: cube{"),
                ("return translate{1, 2, 3} cube(10)", "<eof> expected near 'cube'; what is changed stands before: cube(10):translate("),
                ("return cylinder(5, 10, $fn=32)", "unexpected symbol near '$'; the facets are fn, fa and fs: sphere(5, {fn = 64})"),
                ("module foo() { cube(1); }", "syntax error near 'foo'; a module is a function that returns a solid: local function"),
                ("include <a.scad>", "syntax error near '<'; other files of Lua are read by require"),
                ("// words", "unexpected symbol near '//'; a comment begins with --"),
                ("if 1 != 2 then end", "'then' expected near '!'; \"not equal\" is ~="),
                ("difference() { cube(10); sphere(5) }", "a solid is no function: operands stand in the parentheses, difference(a, b)"),
                ("return translate(1, 2, 3)(cube(10))", "a matrix stands before what it moves: M * part"),
                ("return square(5):extrude(10)", "a shape has no method 'extrude' (did you mean 'linear_extrude'?)"),
                ("return subtract(cube(5), cube(1))", "undefined variable 'subtract' (did you mean 'difference'?)"),
                ("return extrudeLinear(square(5), 1)", "undefined variable 'extrudeLinear' (did you mean 'linear_extrude'?)"),
                ("return cube(5):rotateX(9)", "a solid has no method 'rotateX' (did you mean 'rx'?)"),
                ("return cube(5):minGap(cube(1))", "a solid has no method 'minGap' (did you mean 'gap'?)"),
                ("return Manifold.cube(5)", "undefined variable 'Manifold' (in Lua its functions are globals: cube, sphere, union)"),
                ("return cube(5):boundingBox()", "a solid has no method 'boundingBox' (did you mean 'bbox'?)"),
                ("return circle(1):loft(circle(2), 5)", "a shape has no method 'loft', which is a function: loft(...)"),
                ("return loft(circle(3), circle(2), 10)", "loft: its outlines are one list, and their heights follow: loft({a, b}, 10)"),
                ("return cube(1):color{r = 1, g = 0, b = 0}", "color: red, green and blue are a list: color{1, 0, 0}"),
                ("return square(5):revolve()", "a shape has no method 'revolve' (did you mean 'rotate_extrude'?)"),
                ("return cylinder{h = 5, radius = 2}", "cylinder: unknown option 'radius' (did you mean 'r'?)"),
                ("return circle{diameter = 2}", "circle: unknown option 'diameter' (did you mean 'd'?)"),
                ("echo('x')", "undefined variable 'echo' (in Lua print(...) writes to the log)"),
                ("return cube(len({1}))", "undefined variable 'len' (in Lua it is #list)")):
            with self.subTest(text):
                self.check(text, "model.lua:1: " + message)
        outcome = self.run_script("fn = 64\nfunction fs() end\nreturn cube(fn)")
        self.expect(outcome, 0)
        self.assertEqual(outcome.json()["warnings"], ["model.lua:1: 'fn' is a variable like any other; csg.fn = 64 sets the facets"])
        self.assertEqual(outcome.json()["parts"][0]["volume"], 64 ** 3)

    def test_sizes(self):
        for size, said in (("0/0", "finite, got nan"), ("1/0", "finite, got inf"), ("-1/0", "finite, got -inf"),
                           ("0", "positive, got 0"), ("-3", "positive, got -3")):
            self.check(f"return cube({size})", f"model.lua:1: cube: option 'size' must be {said}")
            self.check(f"return sphere({size})", f"model.lua:1: sphere: option 'r' must be {said}")
            self.check(f"return cylinder{{h = {size}}}", f"model.lua:1: cylinder: option 'h' must be {said}")
            self.check(f"return circle({size})", f"model.lua:1: circle: option 'r' must be {said}")
            self.check(f"return square(1):linear_extrude({size})",
                       f"model.lua:1: linear_extrude: option 'height' must be {said}")
        self.check("return cube(1):translate(0/0, 0, 0)", "model.lua:1: translate: option 'v' must be finite, got nan")
        self.check("return cube(1):rotate(1/0)", "model.lua:1: rotate: option 'a' must be finite, got inf")
        self.check("return multmatrix{{0/0}} * cube(1)", "model.lua:1: multmatrix: option 'm': entry [1][1] of a matrix must be a finite number")

    def test_sandbox(self):
        for text in ("io.open('x')", "os.execute('ls')", "debug.sethook()", "dofile('x')", "loadfile('x')"):
            name = text.split(".")[0].split("(")[0]
            self.check(text, f"model.lua:1: '{name}' is not available: ")
        for field in ("loadlib", "cpath", "preload", "searchers", "loaded"):
            self.check(f"local x = package.{field}", f"model.lua:1: 'package.{field}' is not available: ")
        self.check("package.cpath = '/tmp/?.so'", "model.lua:1: 'package.cpath' is not available: ")
        self.check("package.path = 5 require 'x'", "model.lua:1: require: package.path must be a string")
        self.check("setmetatable({}, {__gc = function() end})", "model.lua:1: setmetatable: '__gc' is not available")
        self.check(b"\x1bLuaR\0".decode("latin1"), "model.lua:1: this is Lua bytecode; only text is accepted")
        self.check("assert(load('\\27Lua'))", "model.lua:1: attempt to load a binary chunk (mode is 't')")
        self.check("string.dump(print)", "model.lua:1: attempt to call a nil value (field 'dump')")

    def test_standard_input_that_cannot_be_read(self):
        folder = os.open(self.folder, os.O_RDONLY)
        self.addCleanup(os.close, folder)
        done = subprocess.run([CSGRUN, "-", "--stats"], stdin=folder, capture_output=True, timeout=60)
        self.assertEqual((done.returncode, done.stdout), (4, b""))
        self.assertEqual(done.stderr, b"csgrun: cannot read standard input: Is a directory\n")

    def test_no_result(self):
        self.check("local a = cube(1)", "model.lua:1: the script makes no part")
        self.check("return 5", "model.lua:1: a part must be a solid, a shape or a table of them, got 5")

    def lines_of_dropped_values(self, text, *arguments):
        """Of a script that fails: the warnings are behind the message and the traceback."""
        outcome = self.run_script(text, *arguments)
        self.assertIn(outcome.code, (1, 3), outcome.err)
        self.assertTrue(outcome.err.startswith("model.lua:"), outcome.err)
        self.assertEqual(outcome.out, "")
        warnings = [line for line in outcome.err.split("\n") if line.startswith("warning: ")]
        for warning in warnings:
            self.assertRegex(warning, r"^warning: model\.lua:\d+: what \w+\(\.\.\.\) gives is dropped: ")
        return [int(warning.split(":")[2]) for warning in warnings]

    def test_a_forgotten_return_is_told_beside_the_error(self):
        part = "local function part()\n  cube(10)\nend\n"
        for rest in ("return cube(1) + part()", "return part()", "return part():up(3)", "local a = part() return a.x"):
            for arguments in (("--stats=json",), ("--stats",), ("-o", "a.stl"), ("--list-params",)):
                self.assertEqual(self.lines_of_dropped_values(part + rest, *arguments), [2], rest)
            self.assertEqual(self.lines_of_dropped_values(part.replace("\n", " ") + rest), [1], rest)
        self.assertEqual(self.lines_of_dropped_values("cube(10)"), [1])
        self.assertEqual(self.lines_of_dropped_values("\ncube(10)\n  :up(1)\n  :translate(1, 2, 3)"), [2])
        self.assertEqual(self.lines_of_dropped_values("cube(1)\nlocal a = nil + 1\nsphere(1)"), [1, 3])
        self.assertNotIn("warning", self.run_script("cube(10)", "-q", "-o", "a.stl").err)

    def test_what_a_statement_did_not_give_is_not_dropped(self):
        for text in ("cube('x')", "cube(10):translate('x')", "cube(10)\n:translate(\n'x')",
                     "local function size() error('no size') end\ncube(\nsize())",
                     "local function part()\ncube('x')\nend\nreturn part()",
                     "local function part() return cube(1):warp(function() error('x') end) end\npart():rotate(1)",
                     "local a = cube(1)\nlocal b = a + nil", "local a = cube(1) + cube('x')", "return cube(1, 'x')",
                     "local a = cube(1) local t = {cube(2); a; sphere(1);}\nerror('x')", "cube(1)\nreturn return"):
            with self.subTest(text):
                self.assertEqual(self.lines_of_dropped_values(text), [])
        outcome = self.run_script("return union{cube(1); sphere(1); cube(3)}")
        self.assertEqual(outcome.json()["warnings"], [])

    def test_2d_result(self):
        outcome = self.run_script("\nreturn square(10)", "-o", "a.stl")
        self.expect(outcome, 1, "model.lua:2: part 'part1' is a 2D shape")
        self.assertIn("linear_extrude", outcome.err)

    def test_long_paths_are_whole(self):
        folder = "/".join(["a" * 40, "b" * 40, "c" * 40])
        model = self.write(folder + "/model.lua", "local x\nreturn x.y")
        self.expect(self.run_csgrun(model, "--stats=json"), 1, model + ":2: attempt to index a nil value")
        model = self.write(folder + "/model.lua", "\nx = = 1")
        self.expect(self.run_csgrun(model, "--stats=json"), 1, model + ":2: unexpected symbol")

    def test_print_goes_to_standard_error(self):
        outcome = self.run_script("print('hello', {}, cube(1)) return cube(1)")
        self.expect(outcome, 0, "hello\ttable\tsolid\n")
        outcome.json()


class Geometry(Case):
    def test_empty_result(self):
        outcome = self.run_script("return cube(1) -\n cube(1)", "-o", "a.stl")
        self.expect(outcome, 3, "model.lua:1: the result is empty")
        self.assertFalse(__import__("os").path.exists(self.path("a.stl")))

    def test_an_empty_tree_has_no_dimension(self):
        """What OpenSCAD makes nothing of may have been a shape: no advice to project it."""
        for text in ("offset(r=-3,$fn=8){square(size=[1,1],center=false);}\n", "group();\n"):
            self.write("model.csg", text)
            for output in ("out.svg", "out.dxf", "out.stl"):
                self.expect(self.run_csgrun("model.csg", "-o", output), 3, "model.csg:1: the result is empty")

    def test_why_it_is_empty(self):
        for stats in ("--stats", "--stats=json"):
            outcome = self.run_script("\nreturn cube(1) + cube(1):translate(1e10, 0, 0)", stats)
            self.expect(outcome, 3, "model.lua:2: the result is empty\nwarning: model.lua:2: 'cube' encloses no volume")
            self.assertEqual(outcome.out, "")

    def test_warnings_name_files_as_errors_do(self):
        """An editor finds the file from the folder that the program was started in."""
        self.write("parts/model.lua", "\nreturn cube(1) + cube(1e-10)")
        self.expect(self.run_csgrun("parts/model.lua", "--stats"), 0, "warning: parts/model.lua:2: 'cube' encloses no volume")

    def test_colours_that_a_shape_cannot_keep_are_a_warning(self):
        """A 2D shape has one colour; solids of several keep them all."""
        for text, function in (("red + blue", "'+'"), ("red:union(plain, blue)", "union"), ("plain & red", "'&'"),
                               ("hull(red, blue)", "hull"), ("minkowski{red, blue}", "minkowski"),
                               ("red + plain", ""), ("red + red:right(9)", ""), ("red - blue", ""), ("blue - red - plain", ""),
                               ("red:linear_extrude(1) + blue:linear_extrude(2)", "")):
            outcome = self.run_script(f"""local plain = square(4)
                local red, blue = plain:color("red"), plain:color("blue"):right(2)
                return {text}""")
            self.expect(outcome, 0)
            expected = [f"model.lua:3: {function}: a 2D shape has one colour, that of the first; to keep the colours of all, "
                        "combine what is extruded from them"] if function else []
            self.assertEqual(outcome.json()["warnings"], expected, text)

    def test_colours_that_a_hull_cannot_keep_are_a_warning(self):
        for text, is_warned in (("hull(red, blue)", True), ("minkowski{plain, blue}", True), ("hull(red, plain, red)", False),
                                ("minkowski(red, sphere(1))", False), ("red + blue", False), ("hull(red - blue)", False)):
            outcome = self.run_script(f"""local plain = cube(4)
                local red, blue = plain:color("red"), plain:color("blue"):up(2)
                return {text}""")
            self.expect(outcome, 0)
            expected = [f"model.lua:3: {text.split('(')[0].split('{')[0]}: the result has one colour, that of the first"]
            self.assertEqual(outcome.json()["warnings"], expected if is_warned else [], text)

    def test_libraries_say_what_they_want(self):
        for call, message in (("csg.gears').meshed(5, 9, 8, {module = 1})", "gears.meshed: wants a solid, got 5"),
                              ("csg.gears').meshed(cube(1), cube(1), 8, {module = 1})", "gears.meshed: wants two numbers of teeth"),
                              ("csg.threads').bolt{size = 'M8', length = 30, threaded = 50}",
                               "threads.bolt: option 'threaded' must not be greater than the length, 30, got 50")):
            self.expect(self.run_script("return require('" + call), 1, "model.lua:1: " + message)

    def test_libraries_lose_nothing_behind_a_nil(self):
        for call, message in (("row{cube(1), nil, cube(2)}", "row: part 2 must be a solid, got nil"),
                              ("stack({nil, cube(2)}, {gap = 1})", "stack: part 1 must be a solid, got nil"),
                              ("grid({cube(1), nil, cube(2)})", "grid: part 2 must be a solid, got nil"),
                              ("at(cube(1), {{0, 0}, nil, {5, 5}})", "at: point 2 must be {x, y, z}, got nil"),
                              ("at(cube(1), {{0, 0}, {nil, 5}})", "at: point 2 must be {x, y, z}, but entry 1 is nil"),
                              ("line(cube(1), 3, {to = {9, nil, 5}})", "line: option 'to' must be {x, y, z}, but entry 2 is nil"),
                              ("row{cube(1), cube(2), gap = 3}", "row: what it places must be a list without names, got the key 'gap'")):
            self.expect(self.run_script(f"return require('csg.layout').{call}"), 1, f"model.lua:1: layout.{message}\n")
        choices = "require('csg.options')('f', {a = 'c'}, {a = {'a', choices = {'a', nil, 'b'}}})"
        self.expect(self.run_script(choices), 1, "model.lua:1: f: option 'a' must be one of \"a\", \"b\", got \"c\"")

    def test_libraries_take_whole_numbers_that_are_floats(self):
        def parts(expression):
            outcome = self.run_script("local layout, gears = require('csg.layout'), require('csg.gears')\n"
                                      "local gear = gears.spur{teeth = 10, module = 1, width = 1}\nreturn " + expression)
            self.expect(outcome, 0)
            return [(part["bbox"], part["volume"]) for part in outcome.json()["parts"]]
        for count, whole in (("12 / 2", "6"), ("2 ^ 2", "4")):
            for call in ("layout.ring(cube(1), {}, {{radius = 9}})", "layout.ring(cube(1), {}, {{radius = 9, turn = false}})",
                         "layout.line(cube(1), {}, {{to = {{9, 0, 0}}}})", "layout.grid({{cube(1), cube(2)}}, {{columns = {}}})",
                         "gears.meshed(gear, 20, 10 * {}, {{module = 1}})", "cube(gears.distance(40, {}, {{module = 1}}))",
                         "gears.spur{{teeth = 9 * {}, module = 1, width = 1}}"):
                self.assertEqual(parts(call.format(count)), parts(call.format(whole)), call)
        for call, message in (("layout').ring(cube(1), 12 / 5)", "layout.ring: wants how many, a whole number from 1, got 2.4"),
                              ("layout').line(cube(1), '3', {})", "layout.line: wants how many, a whole number from 1, got 3"),
                              ("gears').distance(40 / 3, 30.0, {module = 1})",
                               f"gears.distance: wants two numbers of teeth, whole ones, got {40 / 3:.14g} and 30.0")):
            self.expect(self.run_script("return require('csg." + call), 1, "model.lua:1: " + message + "\n")

    def test_what_functions_of_points_give(self):
        for body, got in (("return x", "got one value, the number 0"), ("return {x, y}", "got one value, a list of 2 values"),
                          ("return x, y", "got 2 values"), ("", "got 0 values"), ("return x, y, nil", "but number 3 is nil"),
                          ("return {x, true, z}", "but number 2 is boolean")):
            self.expect(self.run_script(f"return cube(10):warp(function(x, y, z) {body} end)"), 1,
                        f"model.lua:1: warp: the function must give three numbers, {got}\n")

    def test_names_of_faces_in_other_programs(self):
        for theirs, ours in ((">X", "right"), ("<X", "left"), (">Y", "back"), ("<y", "front"), (">z", "top"), ("<Z", "bottom")):
            for edges in (f"'{theirs}'", f"{{on = '{theirs}'}}", f"{{'x', '{theirs}'}}"):
                self.assertTrue(self.run_script(f"return cube(9):fillet(1, {{edges = {edges}}})").first.endswith(
                    f'got "{theirs}"; it is "{ours}" here'), edges)
        for edges in (">W", "top >Z", "^Z"):
            self.assertTrue(self.run_script(f"return cube(9):fillet(1, {{edges = '{edges}'}})").first.endswith(f'got "{edges}"'))
        own, theirs = (self.run_script(f"return cube(9):fillet(1, {{edges = '{edges}'}})").json()["parts"] for edges in ("z", "|Z"))
        self.assertEqual(own, theirs)

    def test_colours_are_lists_also_as_vectors(self):
        looks = [self.run_script(f"return cube(1):color{given}", "-o", "a.glb") and self.read_glb("a.glb")["materials"]
                 for given in ("{1, 0, 0}", "(vec(1, 0, 0))", "('red')")]
        self.assertEqual(looks[0], looks[1])
        self.assertEqual(looks[0], looks[2])

    def test_text_offers_what_the_docs_list(self):
        self.expect(self.run_script("return text('a', {halign = 'middle'})"), 1,
                    'model.lua:1: text: halign must be one of "left", "center", "right", got "middle"\n')
        self.expect(self.run_script("return text('a', {valign = 'middle'})"), 1,
                    'model.lua:1: text: valign must be one of "baseline", "bottom", "center", "top", got "middle"\n')

    def test_an_empty_part_is_a_warning(self):
        outcome = self.run_script("return {a = cube(1), b = cube(1) - cube(2)}")
        self.expect(outcome, 0)
        self.assertEqual([p["name"] for p in outcome.json()["parts"]], ["a", "b"])
        self.assertEqual(outcome.json()["warnings"], ["model.lua:1: part 'b' is empty"])

    def test_polyhedra(self):
        points = "{{0,0,0},{1,0,0},{0,1,0},{0,0,1}}"
        good = "{{0,1,2},{0,3,1},{0,2,3},{1,3,2}}"
        self.expect(self.run_script(f"return polyhedron{{points = {points}, faces = {good}}}"), 0)
        inverted = self.run_script(f"return polyhedron{{points = {points}, faces = {{{{2,1,0}},{{1,3,0}},{{3,2,0}},{{2,3,1}}}}}}")
        self.expect(inverted, 0)
        self.assertEqual(len(inverted.json()["warnings"]), 1)
        for faces in ("{{0,1,2},{0,3,1},{0,2,3}}", "{{2,1,0},{0,3,1},{0,2,3},{1,3,2}}", "{{0,1,2},{0,3,1},{0,2,3},{1,3,9}}"):
            self.expect(self.run_script(f"\nreturn polyhedron{{points = {points}, faces = {faces}}}"), 1,
                        "model.lua:2: polyhedron: ")


if __name__ == "__main__":
    main()
