"""The command line: usage errors are exit code 2 and say what to do."""
import os
import re

from support import Case, main

SCRIPT = "local r = param('hole_radius', 4, {min = 1, max = 10})\nreturn cube(r)"


class Usage(Case):
    def check(self, message, *arguments):
        self.write("model.lua", SCRIPT)
        outcome = self.run_csgrun(*arguments)
        self.expect(outcome, 2, message)
        self.assertEqual(outcome.out, "")

    def test_what_is_missing(self):
        self.check("csgrun: which model?")
        self.check("csgrun: nothing to do: give an output with -o, or --stats", "model.lua")

    def test_endings(self):
        self.check("csgrun: 'a.step': the ending must be one of", "model.lua", "-o", "a.step")
        self.check("csgrun: 'model.txt': the model must end in", "model.txt", "-o", "a.stl")
        self.check("csgrun: '/dev/zero': the model must end in", "/dev/zero", "-o", "a.stl")

    def test_outputs(self):
        self.check("csgrun: 'a.stl' is given twice with -o", "model.lua", "-o", "a.stl", "-o", "a.stl")
        self.check("csgrun: './a.stl' is given twice with -o", "model.lua", "-o", "./a.stl", "-o", "b/../a.stl")
        self.check("csgrun: -o=a.stl: write -o a.stl", "model.lua", "-o=a.stl")
        self.check("csgrun: '%s%s.stl': %s", "model.lua", "-o", "%s%s.stl")
        self.write("mesh.stl", "solid x\nendsolid x\n")
        self.check("csgrun: 'mesh.stl' is the model itself and would be overwritten", "mesh.stl", "-o", "mesh.stl")

    def test_sources_are_not_replaced(self):
        """What was read, in whatever way, stays as it is; nothing else is written either."""
        self.write("in.lua", "return import('in.off')")
        self.write("in.csg", "import(file = \"in.off\");\n")
        self.write("two.obj", "mtllib a.mtl\nv 0 0 0\nv 6 0 0\nv 0 6 0\nv 0 0 6\nusemtl x\n"
                   "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
        off, colours = "OFF\n4 4 0\n0 0 0\n6 0 0\n0 6 0\n0 0 6\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n", "newmtl x\nKd 1 0 0\n"
        self.write("in.off", off)
        self.write("a.mtl", colours)
        os.symlink("in.off", self.path("link.off"))
        for model, source, output in (("in.lua", "in.off", "in.off"), ("in.lua", "link.off", "link.off"),
                                      ("in.csg", "in.off", "in.off"), ("two.obj", "a.mtl", "a.obj")):
            arguments = [model] + (["-o", "other.stl"] if output == source else []) + ["-o", output]
            self.check(f"csgrun: '{source}' is read by the model and would be overwritten", *arguments)
            self.assertFalse(os.path.exists(self.path("other.stl")) or os.path.exists(self.path("a.obj")))
        for name, text in (("in.off", off), ("a.mtl", colours)):
            with open(self.path(name)) as file:
                self.assertEqual(file.read(), text)
        self.expect(self.run_csgrun("two.obj", "-o", "b.obj", "-o", "b.off"), 0)

    def test_options(self):
        self.write("mesh.off", "OFF\n4 4 0\n0 0 0\n6 0 0\n0 6 0\n0 0 6\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")
        self.check("csgrun: --fn, --fa and --fs: the facets of a mesh are what they are", "mesh.off", "--stats", "--fn", "9")
        self.check("csgrun: The following argument was not expected: mesh.off; info is the first word: csgrun info FILE",
                   "--threads", "1", "info", "mesh.off")
        self.check("csgrun: --check proves what is written: give an output with -o", "model.lua", "--stats", "--check")
        self.check("csgrun: The following argument was not expected: --bogus", "model.lua", "--stats", "--bogus")
        self.check("csgrun: The following argument was not expected: --treads=3 (did you mean '--threads'?)",
                   "model.lua", "--stats", "--treads=3")
        self.check("csgrun: 'a.scad' is OpenSCAD's language; OpenSCAD makes a tree of it: openscad 'a.scad' -o out.csg",
                   "a.scad", "--stats")
        self.check("csgrun: --stats can be =json or nothing", "model.lua", "--stats=xml")
        self.check("csgrun: --threads must be from 1 to", "model.lua", "--stats", "--threads", "0")
        self.check("csgrun: --grid x: ", "model.lua", "--stats", "--grid", "x")
        self.check("csgrun: --grid 0: ", "model.lua", "--stats", "--grid", "0")
        self.check("csgrun: --fn must be from 0 to", "model.lua", "--stats", "--fn", "-1")
        self.check("csgrun: --check proves meshes, and 'a.svg' is a drawing", "model.lua", "-o", "a.svg", "--check")
        self.check("csgrun: --max-memory must be from 16 to 1e+09 (MB), got 1e+20", "model.lua", "--stats",
                   "--max-memory", "1e20")
        self.check("csgrun: --max-memory must be from 16 to 1e+09 (MB), got 1", "model.lua", "--stats", "--max-memory", "1")
        self.check("csgrun: -L none: there is no such folder", "model.lua", "--stats", "-L", "none")
        self.check(f"csgrun: -L {'n' * 300}: there is no such folder", "model.lua", "--stats", "-L", "n" * 300)

    def test_definitions(self):
        self.check("csgrun: -D hole_radis: the model has no such parameter (did you mean 'hole_radius'?)",
                   "model.lua", "--stats", "-D", "hole_radis=5")
        self.check("csgrun: -D hole_radius=x: 'hole_radius' must be a number", "model.lua", "--stats", "-D", "hole_radius=x")
        self.check("csgrun: -D hole_radius=11: 'hole_radius' must be at most 10, got 11",
                   "model.lua", "--stats", "-D", "hole_radius=11")
        for name, value in (("fn", "30"), ("fa", "5"), ("fs", "0.5")):
            self.check(f"csgrun: -D ${name}={value}: the facets are not a parameter; write --{name} {value}",
                       "model.lua", "--stats", "-D", f"${name}={value}")
        self.check("csgrun: -D hole_radius: write it as -D name=value", "model.lua", "--stats", "-D", "hole_radius")


class Folders(Case):
    def test_told_before_the_model_is_read(self):
        for output in ("none/a.stl", "none/%s.stl", "model.lua/a.stl"):
            outcome = self.run_script("print('it ran') return cube(1)", "-o", output)
            self.expect(outcome, 4, f"csgrun: cannot write '{output}': there is no folder '{os.path.dirname(output)}'")
            self.assertNotIn("it ran", outcome.err)


class FarAway(Case):
    WARNING = "lies too far away for its size"

    def test_a_part_that_rounding_spoils(self):
        outcome = self.run_script("\nreturn cube(1):translate(1e6, 0, 0)", "--stats")
        self.expect(outcome, 0)
        self.assertIn("model.lua:2: a part of 1 mm " + self.WARNING + ": 1e+06 mm from the origin points are rounded "
                      "to 0.01 mm", outcome.err)
        outcome = self.run_script("return {cube(1), cube(1):translate(1e6, 0, 0)}", "--stats")
        self.assertEqual(outcome.err.count(" of a part of 1 mm are rounded to 0.01 mm"), 1)
        outcome = self.run_script("return {cube(1):translate(1e6, 0, 0), cube(1):translate(2e6, 0, 0)}", "--stats")
        self.assertEqual(outcome.err.count(self.WARNING), 1)
        self.assertIn(self.WARNING, self.run_script("return cube(1):translate(1e12, 0, 0)", "--stats").err)

    def test_a_tool_that_spoils_the_part(self):
        outcome = self.run_script("return cube(1) -\n\nsphere(1e9):translate(1e9, 0, 0)", "--stats")
        self.expect(outcome, 0)
        self.assertIn("model.lua:3: 'sphere' reaches 2e+09 mm from the origin: beside it points of a part of 1 mm "
                      "are rounded to ", outcome.err)
        self.assertNotIn(self.WARNING, outcome.err)
        # The one that is to blame, not those that are drawn near or beside.
        outcome = self.run_script("return cube(1) - cube(1e10, 1, 1):rotate(0, 0, 30) - cube(1):translate(1e10, 0, 0) -"
                                  "\n\nsphere(1e9):translate(1e9, 0, 0)", "--stats")
        self.assertIn("model.lua:3: 'sphere' reaches 2e+09 mm from the origin", outcome.err)

    def test_tools_that_are_drawn_near(self):
        for tool, volume in (("cube(1):translate(1e9, 0, 0)", 1), ("sphere(1e9):translate(3e9, 0, 0)", 1),
                             ("cube(1e9):translate(0.5, -5e8, -5e8)", 0.5),
                             ("cube(1e9, true):translate(5e8, 0, 0):rotate(0, 0, 45):translate(0.5, 0.5, 0)", 0.5)):
            outcome = self.run_script(f"return cube(1) - {tool}", "--stats=json")
            self.expect(outcome, 0)
            self.assertEqual(outcome.err, "")
            self.assertAlmostEqual(outcome.json()["parts"][0]["volume"], volume, delta=1e-6)

    def test_parts_that_are_well(self):
        for model in ("cube(1):translate(1000, 0, 0)", "cube(1) - cube(1e6)", "cube(1e6)", "cube(1e-6)",
                      "cube(1) - cube(1):translate(0.5, 0, 0)", "cube(1000) + cube(0.01):translate(999.995, 0, 0)"):
            outcome = self.run_script(f"return {model}", "--stats")
            self.assertNotIn(self.WARNING, outcome.err, model)
            self.assertNotIn("mm thin", outcome.err, model)

    def test_a_thickness_that_rounding_spoils(self):
        # 2^27 steps of 0.1 mm reach 1.3e7 mm.
        said = " mm thin: in a scene that reaches 1e+07 mm from the origin points are rounded to 0.1 mm"
        self.write("m.csg", "cube(size = [1e7, 1e7, 0.26]);")
        self.assertIn("m.csg:1: 'cube' is 0.26" + said, self.run_csgrun("m.csg", "--stats").err)
        outcome = self.run_script("return cube(1e7, 1000, 1000) +\n\ncube(10):rotate(0, 0, 30)", "--stats")
        self.assertIn("model.lua:3: 'cube' is 10" + said, outcome.err)
        self.assertNotIn("mm thin", self.run_script("return cube(1e7, 1000, 1000)", "--stats").err)

    def test_a_grid_that_would_hold_the_thickness(self):
        said = "points are rounded to 6.4e-05 mm"
        outcome = self.run_script("return cube(8000, 1, 0.05)", "--stats")
        self.assertIn(said + "; a grid of 0.0001 mm would hold it\n", outcome.err)
        outcome = self.run_script("return cube(8000, 1, 0.05)", "--stats=json", "--grid", "0.0001")
        self.assertEqual((outcome.err, outcome.json()["parts"][0]["volume"]), ("", 400))
        outcome = self.run_script("return cube(8000, 1, 0.050707)", "--stats")
        self.assertIn(said + "\n", outcome.err)

    def test_large_models_in_whole_millimetres(self):
        for size in ("12000, 9000, 1", "12000, 9000, 0.003", "1e5, 1, 1", "1.3e6, 3, 0.07"):
            outcome = self.run_script(f"return cube({size})", "--stats=json")
            x, y, z = (float(s) for s in size.split(", "))
            self.assertEqual(outcome.err, "", size)
            self.assertAlmostEqual(outcome.json()["parts"][0]["volume"] / (x * y * z), 1, delta=1e-12)
        # All edges of the top, and what two of them have in common at each corner.
        for size in (10000, 20000, 200000):
            outcome = self.run_script(f"return cube({size}, {size}/2, 30):chamfer(4, {{edges = 'top'}})", "--stats=json")
            volume = size * size / 2 * 30 - 8 * 3 * size + 4 * 4**3 / 3
            self.assertAlmostEqual(outcome.json()["parts"][0]["volume"] / volume, 1, delta=1e-13)


class Good(Case):
    def volume(self, *arguments, text=SCRIPT, **options):
        outcome = self.run_script(text, "--stats=json", *arguments, **options)
        self.expect(outcome, 0)
        return outcome.json()["parts"][0]["volume"]

    def test_definitions(self):
        self.assertEqual(self.volume(), 64)
        self.assertEqual(self.volume("-D", "hole_radius=5"), 125)
        self.assertEqual(self.volume("-Dhole_radius=5"), 125)
        self.assertEqual(self.volume("-D", "hole_radius=5", "-D", "hole_radius=6"), 216)

    def test_facets(self):
        text = "return cylinder(1, 1)"
        self.assertEqual(self.volume("--fn", "4", text=text), 2)
        self.assertEqual(self.volume("--fa", "90", "--fs", "0.01", text="return cylinder{h = 1, r = 1, fn = 4}"), 2)

    def test_grid(self):
        outcome = self.run_script("return cube(1)", "--stats=json", "--grid", "0.001")
        self.assertEqual(outcome.json()["grid_mm"], 0.001)
        outcome = self.run_script("return cube(1)", "--stats=json", "--grid", "2^-20mm")
        self.assertEqual(outcome.json()["grid_mm"], 2.0**-20)
        outcome = self.run_script("csg.grid = 0.25 return cube(1.1)", "--stats=json")
        self.assertEqual((outcome.json()["grid_mm"], outcome.json()["parts"][0]["volume"]), (0.25, 1))

    def test_standard_input(self):
        outcome = self.run_csgrun("-", "--stats=json", stdin=b"return cube(2)")
        self.expect(outcome, 0)
        self.assertEqual(outcome.json()["parts"][0]["volume"], 8)
        self.expect(self.run_csgrun("-", "--stats=json", stdin=b"\nreturn cub(2)"), 1, "stdin:2: undefined variable 'cub'")

    def test_caches_are_accepted(self):
        self.assertEqual(self.volume("--no-cache", "--cache-dir", "x"), 64)

    def test_version_and_help(self):
        self.assertRegex(self.run_csgrun("--version").out, r"^csgrun \d+\.\d+\.\d+\n$")
        self.assertIn("--timeout", self.run_csgrun("--help").out)
        api = self.run_csgrun("--help-api")
        self.expect(api, 0)
        functions = re.findall(r"^(\w+)\(", api.out, re.MULTILINE)
        self.assertGreater(len(functions), 50)
        self.assertEqual(len(functions), len(set(functions)))

    def test_quiet(self):
        outcome = self.run_script("return {cube(1), cube(1) - cube(2)}", "-o", "a.stl")
        self.assertIn("warning: model.lua:1: part 'part2' is empty", outcome.err)
        self.assertEqual(self.run_script("return {cube(1), cube(1) - cube(2)}", "-o", "a.stl", "-q").err, "")

    def test_a_cube_is_quick(self):
        times = sorted(self.run_script("return cube(10)", "-o", "a.glb").seconds for _ in range(5))
        self.assertLess(times[0], 1.0)  # a guard against the absurd; timings belong to benchmarks


if __name__ == "__main__":
    main()
