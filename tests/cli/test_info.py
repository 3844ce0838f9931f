"""`csgrun info`: the measures of files, those that csgrun wrote among them."""
import json
import os
import struct

from support import Case, SANITIZED, TETRAHEDRON, main, off, stl


def glb(document):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    return struct.pack("<4sIIII", b"glTF", 2, 20 + len(text), len(text), 0x4E4F534A) + text


class Info(Case):
    def info(self, name):
        outcome = self.run_csgrun("info", name, "--json")
        self.expect(outcome, 0)
        self.assertEqual(outcome.err, "")
        return outcome.json()

    def test_the_object(self):
        self.write("t.stl", stl(TETRAHEDRON))
        found = self.info("t.stl")
        self.assertAlmostEqual(found["parts"][0].pop("area"), 1.5 + 0.75**0.5, places=14)
        self.assertEqual(found, {
            "file": "t.stl",
            "parts": [{"name": "t", "triangles": 4, "vertices": 4, "volume": 1 / 6, "bbox": [[0, 0, 0], [1, 1, 1]],
                       "components": 1, "genus": 0, "closed": True}],
            "self_intersections": 0, "warnings": []})

    def test_agrees_with_the_run_that_wrote_it(self):
        names = ["a.glb", "a.stl", "a.obj", "a.off"]
        text = ("local torus = circle(1, {fn = 8}):translate(3, 0):rotate_extrude{fn = 12}\n"
                "return cube(8, 8, 1) - torus:translate(4, 4, -0.5) + cube(1):translate(8, 8, 1)")
        stats = self.run_script(text, "--stats=json", *[x for n in names for x in ("-o", n)]).json()
        expected = stats["parts"][0]
        for name in names:
            found = self.info(name)
            if name in ("a.obj", "a.off"):  # in doubles; rounding to floats may turn slivers over
                self.assertEqual(found["self_intersections"], 0, name)
            self.assertEqual(found["warnings"], [], name)
            part = found["parts"][0]
            for key in ("vertices", "components", "genus", "closed", "triangles"):
                self.assertEqual(part[key], expected[key], (name, key))
            for key in ("volume", "area"):
                self.assertAlmostEqual(part[key] / expected[key], 1, delta=1e-6)

    def test_parts_of_a_glb(self):
        self.expect(self.run_script("return {lid = cube(1), case = cube(2):up(5)}", "-o", "a.glb"), 0)
        parts = {p["name"]: p["volume"] for p in self.info("a.glb")["parts"]}
        self.assertEqual(parts, {"lid": 1, "case": 8})

    def test_gltf(self):
        script = "return {lid = cube(1), case = cube(2):up(5)}"
        self.expect(self.run_script(script, "-o", "a.glb", "-o", "a.gltf"), 0)
        self.assertEqual(self.info("a.gltf")["parts"], self.info("a.glb")["parts"])
        with open(self.path("a.gltf")) as file:
            document = json.load(file)
        for uri in ("data:application/octet-stream;base64,AAA", "data:;base64,A?==", "data:,AAAA", None):
            document["buffers"][0]["uri"] = uri
            if uri is None:
                del document["buffers"][0]["uri"]
            self.write("bad.gltf", json.dumps(document))
            self.expect(self.run_csgrun("info", "bad.gltf", "--json"), 1, "bad.gltf: buffers[0] has " + (
                "no data in the file, nor an address" if uri is None else "an address that is no base64"))
        for uri in ("../a.bin", "%2e%2e/a.bin", "http://a.b/c.bin", "/etc/passwd", "%2Fetc/passwd", "file:///etc/passwd",
                    "..\\a.bin"):
            document["buffers"][0]["uri"] = uri
            self.write("bad.gltf", json.dumps(document))
            for command in (("info", "bad.gltf"), ("bad.gltf", "--stats")):
                self.expect(self.run_csgrun(*command), 1, f'bad.gltf: buffers[0] is at "{uri}", outside of the file\'s folder')
        document["buffers"][0]["uri"] = "none.bin"
        self.write("bad.gltf", json.dumps(document))
        for command in (("info", "bad.gltf"), ("bad.gltf", "--stats")):
            self.expect(self.run_csgrun(*command), 1, "bad.gltf: buffers[0]: cannot read 'none.bin': No such file")
        document["buffers"][0]["uri"] = "data:;base64,AAAA"
        self.write("bad.gltf", json.dumps(document))
        self.expect(self.run_csgrun("info", "bad.gltf"), 1, "bad.gltf: buffers[0] has 3 bytes, and byteLength says ")

    def test_parts_stand_where_their_nodes_put_them(self):
        text = "local c = cube(2)\nreturn {a = c, g = {b = c:translate(10, 0, 0), c = c:mirror(1, 0, 0):up(7)}}"
        self.expect(self.run_script(text, "-o", "a.glb"), 0)
        parts = {p["name"]: (p["bbox"], p["volume"]) for p in self.info("a.glb")["parts"]}
        self.assertEqual(parts, {"a": ([[0, 0, 0], [2, 2, 2]], 8), "g/b": ([[10, 0, 0], [12, 2, 2]], 8),
                                 "g/c": ([[-2, 0, 7], [0, 2, 9]], 8)})

    def test_objects_of_an_obj_are_parts(self):
        self.expect(self.run_script("return {lid = cube(1), case = cube(2):up(5)}", "-o", "a.obj"), 0)
        parts = {p["name"]: (p["volume"], p["vertices"]) for p in self.info("a.obj")["parts"]}
        self.assertEqual(parts, {"lid": (1, 8), "case": (8, 8)})
        # Faces before the first object are a part of the file's name; objects without faces are none.
        with open(self.path("a.obj")) as file:
            text = file.read()
        self.write("b.obj", text.replace("o case\n", "", 1) + "o end\n")
        self.assertEqual([p["name"] for p in self.info("b.obj")["parts"]], ["b", "lid"])

    def test_nodes_that_are_no_tree(self):
        for nodes in ([{"children": [0]}], [{"children": [1]}, {"children": [0]}], [{"children": [7]}],
                      [{"children": [1, 1]}, {}], [{"children": [-1]}], [{"children": "x"}], [[]],
                      [{}, {"children": [2]}, {"matrix": [1, 2]}], {"a": 1}):
            self.write("bad.glb", glb({"scenes": [{"nodes": [0, 1][:len(nodes)]}], "nodes": nodes}))
            self.expect(self.run_csgrun("info", "bad.glb", "--json"), 1, "bad.glb: ")

    def test_vertices_are_those_of_the_manifold(self):
        """Solids that are joined along an edge have vertices of equal coordinates, which the file keeps apart."""
        text = "csg.contacts = 'join' return cube(10) + cube(10):translate(10, 10, 0)"
        stats = self.run_script(text, "--stats=json", "-o", "a.glb", "-o", "a.gltf").json()["parts"][0]
        for name in ("a.glb", "a.gltf"):
            part = self.info(name)["parts"][0]
            for key in ("vertices", "components", "genus", "closed", "triangles"):
                self.assertEqual(part[key], stats[key], (name, key))
        with open(self.path("a.gltf")) as file:
            document = json.load(file)
        document["meshes"][0]["extensions"]["EXT_mesh_manifold"]["manifoldPrimitive"]["indices"] = 99
        self.write("a.gltf", json.dumps(document))
        self.expect(self.run_csgrun("info", "a.gltf"), 1, "a.gltf: accessors has ")

    def test_crossings_are_counted(self):
        points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
        moved = [(x + 0.1, y + 0.1, z + 0.1) for x, y, z in points]
        self.write("x.off", off(points + moved, faces + [tuple(i + 4 for i in f) for f in faces]))
        self.assertGreater(self.info("x.off")["self_intersections"], 0)
        self.write("open.off", off(points, faces[:3]))
        found = self.info("open.off")
        self.assertFalse(found["parts"][0]["closed"])
        self.assertEqual(found["warnings"], ["part 'open' is not closed"])

    def test_counting_ends_somewhere(self):
        # 420 bars across 420 others, all through one another.
        lines = []
        for bar in range(840):
            at = 3 * (bar % 420)
            low, high = ((-1, at, 0), (1300, at + 1, 1)) if bar < 420 else ((at, -1, 0.25), (at + 1, 1300, 0.75))
            lines += [f"v {(high if i & 1 else low)[0]} {(high if i & 2 else low)[1]} {(high if i & 4 else low)[2]}"
                      for i in range(8)]
            sides = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6))
            lines += ["f " + " ".join(str(8 * bar + i + 1) for i in s) for s in sides]
        self.write("bars.obj", "\n".join(lines) + "\n")
        found = self.info("bars.obj")
        self.assertEqual((found["self_intersections"], found["at_least"]), (1000000, True))
        self.assertIn("at least 1000000 self-intersections\n", self.run_csgrun("info", "bars.obj").out)

    def test_mistakes(self):
        self.expect(self.run_csgrun("info", "none.stl", "--json"), 4, "csgrun: cannot read 'none.stl': No such file")
        self.expect(self.run_csgrun("info", "model.lua", "--json"), 2, "csgrun info: 'model.lua': the ending must be")
        self.expect(self.run_csgrun("info"), 2, "csgrun info: ")
        self.write("bad.glb", b"glTF\2\0\0\0\xff\xff\xff\x7f\xff\xff\xff\x7fJSON")
        self.write("bad.stl", stl(TETRAHEDRON, count=4_000_000_000))
        for name in ("bad.glb", "bad.stl"):
            outcome = self.run_csgrun("info", name, "--json")
            self.expect(outcome, 1, name + ": ")
            self.assertLess(outcome.peak_mb, 1000 if SANITIZED else 200)
        os.mkfifo(self.path("fifo.glb"))
        self.expect(self.run_csgrun("info", "fifo.glb", "--json", wall=20), 4, "csgrun: cannot read 'fifo.glb'")


if __name__ == "__main__":
    main()
