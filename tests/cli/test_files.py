"""Files that come in: meshes that are wrong, things that are no files, places that are out of bounds."""
import math
import os
import struct

from support import Case, SANITIZED, TETRAHEDRON, main, off, stl

A, B, C, D = (0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)
POINTS = [A, B, C, D]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


class Meshes(Case):
    def test_good_ones(self):
        self.write("t.stl", stl(TETRAHEDRON))
        self.write("t.off", off(POINTS, FACES))
        self.write("t.obj", "".join(f"v {x} {y} {z}\n" for x, y, z in POINTS) +
                   "".join("f " + " ".join(str(i + 1) for i in f) + "\n" for f in FACES))
        self.write("t.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                   "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n" +
                   "".join(f"{x} {y} {z}\n" for x, y, z in POINTS) +
                   "".join("3 " + " ".join(map(str, f)) + "\n" for f in FACES))
        for name in ("t.stl", "t.off", "t.obj", "t.ply"):
            for outcome in (self.run_csgrun(name, "--stats=json"), self.run_script(f"return import('{name}')")):
                self.expect(outcome, 0)
                part = outcome.json()["parts"][0]
                self.assertEqual((part["triangles"], part["vertices"], part["genus"]), (4, 4, 0))
                self.assertEqual(part["volume"], 1 / 6)

    def check(self, name, *said):
        """The mesh is refused, as a model and by import(), and the message says this."""
        for outcome, start in ((self.run_csgrun(name, "-o", "out.stl"), name + ":"),
                               (self.run_script(f"\nreturn import('{name}')"), "model.lua:2: import: ")):
            self.expect(outcome, 1, start)
            for text in said:
                self.assertIn(text, outcome.err)
            self.assertFalse(os.path.exists(self.path("out.stl")))

    def test_open(self):
        self.write("open.off", off(POINTS, FACES[:3]))
        self.check("open.off", "3 open edges")

    def test_flipped_face(self):
        self.write("flipped.off", off(POINTS, FACES[:3] + [(1, 3, 2)]))
        self.check("flipped.off", "3 ", "edges")

    def test_faces_without_area_are_dropped_and_told(self):
        self.write("degenerate.off", off(POINTS, FACES + [(0, 0, 1)]))
        # The edge from 1 to 2 has its middle on one side only, and a face without area closes what is between.
        flat = FACES[:3] + [(1, 4, 3), (4, 2, 3), (1, 2, 4)]
        self.write("flat.off", off(POINTS + [(0.5, 0.5, 0)], flat))
        for name, place, triangles in (("degenerate.off", "(0, 0, 0)", 4), ("flat.off", "(1, 0, 0)", 6)):
            outcome = self.run_csgrun(name, "--stats=json")
            self.expect(outcome, 0)
            self.assertEqual(outcome.json()["warnings"], [f"{name}: 1 face without area was dropped (at {place})"])
            (part,) = outcome.json()["parts"]
            self.assertEqual((part["volume"], part["triangles"], part["closed"]), (1 / 6, triangles, True))

    def test_inside_out_is_turned_and_named_once(self):
        self.write("inside.off", off(POINTS, [f[::-1] for f in FACES]))
        outcome = self.run_csgrun("inside.off", "--stats=json")
        self.expect(outcome, 0)
        self.assertEqual(outcome.json()["warnings"], ["inside.off: inside out, its faces were turned over"])
        self.assertEqual(outcome.json()["parts"][0]["volume"], 1 / 6)

    def test_index_out_of_range(self):
        self.write("index.off", off(POINTS, FACES[:3] + [(1, 2, 9)]))
        self.check("index.off", "9")
        self.write("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n")
        self.check("index.obj", "7")

    def test_not_a_number(self):
        self.write("nan.stl", stl(TETRAHEDRON[:3] + [((float("nan"), 0, 0), C, D)]))
        self.check("nan.stl")

    def test_self_intersecting(self):
        # Two tetrahedra through one another in one mesh.
        shifted = [(x + 0.1, y + 0.1, z + 0.1) for x, y, z in POINTS]
        self.write("crossing.off", off(POINTS + shifted, FACES + [tuple(i + 4 for i in f) for f in FACES]))
        outcome = self.run_csgrun("crossing.off", "-o", "out.stl")
        self.assertEqual(outcome.code, 0)
        self.assertRegex(outcome.err, r"'crossing.off' crosses itself: \d+ pairs of faces, the first near \(")
        self.assertIn("the fill rule nonzero", outcome.err)

    def united(self, name, bodies):
        """Writes bodies into one mesh, and each into its own; both give the same file. Returns what is said of it."""
        points, faces = [], []
        for i, (own, triangles) in enumerate(bodies):
            self.write(f"{name}{i}.off", off(own, triangles))
            faces += [tuple(len(points) + v for v in f) for f in triangles]
            points += own
        self.write(f"{name}.off", off(points, faces))
        self.write(f"{name}.lua", "return union{%s}" % ", ".join(
            f"import('{name}{i}.off')" for i in range(len(bodies))))
        found, written = [], []
        for model in (f"{name}.off", f"{name}.lua"):
            outcome = self.run_csgrun(model, "-o", "out.off", "--stats=json")
            self.assertEqual(outcome.code, 0, outcome.err)
            (part,) = outcome.json()["parts"]
            part.pop("name")
            found.append(part)
            with open(self.path("out.off"), "rb") as file:
                written.append(file.read())
        self.assertEqual(found[0], found[1])
        self.assertEqual(written[0], written[1])
        return found[0]

    def test_many_bodies_in_one_place(self):
        box = [(x, y, z) for x in (-50, 50) for y in (-0.2, 0.2) for z in (-0.2, 0.2)]
        quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        sides = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]

        def turned(points, about_z, about_x=0.0):
            c, s, d, t = math.cos(about_z), math.sin(about_z), math.cos(about_x), math.sin(about_x)
            return [(c * x - s * (d * y - t * z), s * x + c * (d * y - t * z), t * y + d * z) for x, y, z in points]

        rods = [(turned([(y, x, z) for x, y, z in box], 1.1 * i, 2.3 * i), [t[::-1] for t in sides]) for i in range(40)]
        self.assertEqual(self.united("rods", rods)["components"], 1)
        # Rings of eight corners, and two poles.
        ring = [(math.cos(a * math.pi / 4), math.sin(a * math.pi / 4)) for a in range(8)]
        ball = [(r * x, r * y, z) for r, z in ((3, 4), (5, 0), (3, -4)) for x, y in ring] + [(0, 0, 5), (0, 0, -5)]
        facets = []
        for a in range(8):
            b = (a + 1) % 8
            facets += [(a, b, 24), (16 + b, 16 + a, 25)]
            for low in (8, 16):
                facets += [(low + a, low + b, low - 8 + b), (low + a, low - 8 + b, low - 8 + a)]
        one = self.united("ball", [(ball, facets)])
        many = self.united("balls", [(ball, facets)] * 30)
        self.assertEqual((many["volume"], many["area"], many["triangles"]),
                         (one["volume"], one["area"], one["triangles"]))
        self.united("turned", [(turned(ball, 0.01 * i), facets) for i in range(20)])
        # Each with a cavity.
        hollow = [tuple(0.5 * x for x in p) for p in ball]
        shells = [(turned(ball + hollow, 0.01 * i), facets + [tuple(26 + v for v in f[::-1]) for f in facets])
                  for i in range(20)]
        self.assertEqual(self.united("hollow", shells)["components"], 2)

    def test_truncated(self):
        self.write("cut.stl", stl(TETRAHEDRON)[:-20])
        self.check("cut.stl")
        self.write("cut.off", off(POINTS, FACES)[:-10])
        self.check("cut.off")
        self.write("empty.stl", b"")
        self.check("empty.stl")

    def test_not_what_its_name_says(self):
        self.write("png.stl", b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 4)
        self.check("png.stl")
        self.write("text.off", "This is a letter, not a mesh.\n")
        self.check("text.off")
        self.write("stl.ply", stl(TETRAHEDRON))
        self.check("stl.ply")

    def test_count_that_lies(self):
        self.write("count.stl", stl(TETRAHEDRON, count=4_000_000_000))
        self.write("count.off", "OFF\n4000000000 4000000000 0\n0 0 0\n")
        self.write("count.ply", b"ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n"
                   b"property float y\nproperty float z\nelement face 4000000000\n"
                   b"property list uint int vertex_indices\nend_header\n" + struct.pack("<3fI", 0, 0, 0, 4_000_000_000))
        for name in ("count.stl", "count.off", "count.ply"):
            self.check(name)
            outcome = self.run_csgrun(name, "-o", "out.stl")
            self.assertLess(outcome.seconds, 10 if SANITIZED else 1)
            self.assertLess(outcome.peak_mb, 1000 if SANITIZED else 200)


class NoFiles(Case):
    def test_as_the_model(self):
        os.mkfifo(self.path("fifo.lua"))
        os.mkdir(self.path("folder.lua"))
        os.symlink("/dev/zero", self.path("zero.lua"))
        os.symlink("/dev/zero", self.path("zero.stl"))
        for name, said in (("fifo.lua", "it is a FIFO"), ("folder.lua", "it is a directory"),
                           ("zero.lua", "it is a device"), ("zero.stl", "it is a device"),
                           ("none.lua", "No such file or directory")):
            outcome = self.run_csgrun(name, "-o", "out.stl", wall=20)
            self.expect(outcome, 4, f"csgrun: cannot read '{name}': {said}")
            self.assertLess(outcome.seconds, 5)

    def test_by_import(self):
        os.mkfifo(self.path("fifo.stl"))
        os.mkdir(self.path("folder.stl"))
        os.symlink("/dev/zero", self.path("zero.stl"))
        for name, said in (("fifo.stl", "cannot read 'fifo.stl': it is a FIFO"),
                           ("folder.stl", "cannot read 'folder.stl': it is a directory"),
                           ("none.stl", "cannot read 'none.stl': No such file or directory"),
                           ("zero.stl", "'zero.stl' lies outside of the model's folder")):
            self.expect(self.run_script(f"return import('{name}')", wall=20), 1, f"model.lua:1: import: {said}")


class Bounds(Case):
    def setUp(self):
        super().setUp()
        self.write("secret.stl", stl(TETRAHEDRON))
        self.write("secret.lua", "return cube(1)")
        self.write("library/shared.stl", stl(TETRAHEDRON))
        self.write("library/shared.lua", "return cube(7)")
        os.mkdir(self.path("model"))

    def run_inside(self, text, *arguments, env=None):
        self.write("model/model.lua", text)
        return self.run_csgrun("model/model.lua", *(arguments or ("--stats=json",)), env=env)

    def test_named_as_a_function(self):
        """Messages keep the file's name, also where a function of the language has it."""
        self.write("points", "")
        self.write("cube", "1 x\n2 3\n")
        for script, message in (('read_csv("points", {header = true})', "read_csv: points: there is no line with names"),
                                ('return surface("cube")', "surface: cube:1: ")):
            outcome = self.run_script(script, "-o", "a.stl")
            self.expect(outcome, 1, "model.lua:1: " + message)

    def test_invert_of_a_text(self):
        self.write("a.txt", "1 2\n3 4\n")
        outcome = self.run_script('return surface{"a.txt", invert = true}', "-o", "a.stl")
        self.expect(outcome, 1, "model.lua:1: surface: option 'invert' is for a PNG, and a.txt is a text")

    def test_out_of_the_folder(self):
        os.symlink("../secret.stl", self.path("model/link.stl"))
        os.symlink("..", self.path("model/up"))
        for name in ("../secret.stl", "link.stl", "up/secret.stl", self.path("secret.stl"), "../none.stl"):
            self.expect(self.run_inside(f"return import('{name}')"), 1,
                        f"model/model.lua:1: import: '{name}' lies outside of the model's folder")
        os.symlink("../secret.lua", self.path("model/link.lua"))
        self.expect(self.run_inside("return require 'link'"), 1, "model/model.lua:1: require: module 'link' not found:")
        self.expect(self.run_inside("return require '../secret'"), 1,
                    "model/model.lua:1: require: '../secret' is not a module's name")

    def test_a_slash_opens_a_folder_too(self):
        self.write("model/lib/p.lua", "return {size = 2}")
        self.expect(self.run_inside("return cube(require('lib/p').size)"), 0)
        self.expect(self.run_inside("assert(require('lib/p') == require('lib.p')) return cube(1)"), 0)
        for name in ("/etc/passwd", "lib/../../secret", "lib/"):
            self.expect(self.run_inside(f"return require '{name}'"), 1,
                        f"model/model.lua:1: require: '{name}' is not a module's name")

    def test_trees_of_editors_and_sources(self):
        self.write("model/a.csg", b"\xef\xbb\xbfcube(size = [1, 1, 1], center = false);\n")
        self.expect(self.run_csgrun("model/a.csg", "--stats"), 0)
        hint = "; a tree has calls and values only: openscad in.scad -o out.csg makes one of a source"
        for text, message in (("x = 5;", '1: expected "(" after "x", got "="'), ("module m() { }", '1: expected "(" after "module", got "m"'),
                              ("cube(x);", '1: expected a value, got "x"'), ("translate([1,2,3]) cube(1);", '1: expected ";" or "{", got "c"'),
                              ("rotate(1) { }", "1: unknown node rotate()")):
            self.write("model/b.csg", text)
            self.expect(self.run_csgrun("model/b.csg", "--stats"), 1, "model/b.csg:" + message + hint)

    def test_library_folders(self):
        self.expect(self.run_inside("return require 'shared'"), 1, "model/model.lua:1: require: module 'shared' not found:")
        self.expect(self.run_inside("return require 'shared'", "--stats=json", "-L", "library"), 0)
        self.expect(self.run_inside("return import('../library/shared.stl')", "--stats=json", "-L", "library"), 0)
        outcome = self.run_inside("return require 'shared'", env={"CSGRUN_PATH": "/nowhere:" + self.path("library")})
        self.expect(outcome, 0)
        self.assertEqual(outcome.json()["parts"][0]["volume"], 343)
        self.write("model/csgrun_modules/beside.lua", "return cube(2)")
        self.expect(self.run_inside("return require 'beside'"), 0)

    def test_meshes_of_library_folders(self):
        missing = "model/model.lua:1: import: cannot read 'shared.stl': No such file or directory"
        self.expect(self.run_inside("return import('shared.stl')"), 1, missing)
        for arguments, env in ((("--stats=json", "-L", "library"), None),
                               (("--stats=json",), {"CSGRUN_PATH": "/nowhere:" + self.path("library")})):
            outcome = self.run_inside("return import('shared.stl')", *arguments, env=env)
            self.expect(outcome, 0)
            self.assertEqual(outcome.json()["parts"][0]["volume"], 1 / 6)
        # What lies beside the script comes first.
        self.write("model/shared.stl", stl([[tuple(2 * c for c in p) for p in t] for t in TETRAHEDRON]))
        outcome = self.run_inside("return import('shared.stl')", "--stats=json", "-L", "library")
        self.assertEqual(outcome.json()["parts"][0]["volume"], 8 / 6)
        outcome = self.run_inside("return import('other.stl')", "--stats=json", "-L", "library")
        self.expect(outcome, 1, "model/model.lua:1: import: cannot read 'other.stl': No such file or directory; "
                    "looked in 'model', 'library'")
        # No way out of a library folder either.
        os.symlink("../secret.stl", self.path("library/link.stl"))
        self.expect(self.run_inside("return import('link.stl')", "--stats=json", "-L", "library"), 1)
        self.expect(self.run_inside("return import('../secret.stl')", "--stats=json", "-L", "library"), 1,
                    "model/model.lua:1: import: '../secret.stl' lies outside of the model's folder")

    def test_a_module_that_is_bytecode(self):
        self.write("model/code.lua", b"\x1bLuaT\0")
        self.expect(self.run_inside("return require 'code'"), 1, "model/code.lua:1: this is Lua bytecode")


class Trees(Case):
    def test_csg(self):
        self.write("m.csg", "difference() {\n\tcube(size = [10, 10, 10], center = false);\n"
                   "\tmultmatrix([[1, 0, 0, 5], [0, 1, 0, 5], [0, 0, 1, 5], [0, 0, 0, 1]]) {\n"
                   "\t\tcube(size = [10, 10, 10], center = false);\n\t}\n}\n")
        outcome = self.run_csgrun("m.csg", "--stats=json")
        self.expect(outcome, 0)
        self.assertEqual(outcome.json()["parts"][0]["volume"], 875)

    def test_places_are_in_the_folder_of_the_tree(self):
        self.write("sub/m.csg", "cube(1e-12);\ncube(-1);\ncube(1);\n")
        outcome = self.run_csgrun("sub/m.csg", "--stats")
        self.assertIn("warning: sub/m.csg:1: 'cube' encloses no volume", outcome.err)
        self.assertIn("warning: sub/m.csg:2: cube: size.x must be positive", outcome.err)

    def test_facets_of_trees_that_have_none(self):
        self.write("m.csg", "sphere(r = 10);\nmultmatrix([[1, 0, 0, 30]]) { sphere(r = 10, $fn = 8); }\n")
        self.write("n.csg", "sphere(r = 10, $fn = 50);\nmultmatrix([[1, 0, 0, 30]]) { sphere(r = 10, $fn = 8); }\n")
        def volume(*arguments):
            return self.run_csgrun(*arguments, "--stats=json").json()["parts"][0]["volume"]
        self.assertEqual(volume("m.csg", "--fn", "50"), volume("n.csg"))
        self.assertNotEqual(volume("m.csg"), volume("n.csg"))

    def test_a_node_that_does_not_exist(self):
        self.write("m.csg", "group() {\n\tgable(method = \"voronoi\") {\n\t\tsquare(size = [1, 1], center = false);\n\t}\n}\n")
        self.expect(self.run_csgrun("m.csg", "--stats=json"), 1, "m.csg:2: ")

    def test_what_is_no_tree(self):
        self.write("m.csg", "group() {\n\tcube(size = \n")
        self.expect(self.run_csgrun("m.csg", "--stats=json"), 1, "m.csg:")

    def test_parameters_do_not_exist(self):
        self.write("m.csg", "cube(size = [1, 1, 1], center = false);\n")
        self.expect(self.run_csgrun("m.csg", "--stats", "-D", "a=1"), 2, "csgrun: -D a: only a script has parameters")


class Libraries(Case):
    def test_text_without_harfbuzz(self):
        """A library in its place that is none: what needs it says so, all else works."""
        self.write("libraries/libharfbuzz.so.0", "This is no library.\n")
        environment = {"LD_LIBRARY_PATH": self.path("libraries")}
        self.write("text.lua", "local b = cube{10, 10, 1}\nreturn b - text('a')")
        self.write("features.lua", "return text{'a', font = 'Liberation Sans:fontfeatures=-kern'}")
        self.write("text.csg", "group() {\n\ttext(text = \"a\", size = 10);\n}\n")
        self.write("plain.lua", "return cube{1, 2, 3}")
        for model, line in (("text.lua", 2), ("features.lua", 1), ("text.csg", 2)):
            outcome = self.run_csgrun(model, "--stats=json", env=environment)
            self.expect(outcome, 1, f"{model}:{line}: ")
            self.assertIn("text needs the library HarfBuzz, which cannot be loaded: ", outcome.first)
        self.expect(self.run_csgrun("plain.lua", "--stats=json", env=environment), 0)


if __name__ == "__main__":
    main()
