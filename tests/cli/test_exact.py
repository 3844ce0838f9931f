"""Exact export: what is in the file is the solid itself, to the last digit."""
import json
from fractions import Fraction

from support import Case, main


def read(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


class Exact(Case):
    def measure(self, part):
        """The exact volume of a part whose faces are planar and closed, which is checked."""
        points = [tuple(Fraction(x) for x in p) for p in part["points"]]
        edges, six_volumes = {}, Fraction(0)
        for face in part["faces"]:
            normal = (Fraction(0),) * 3
            for loop in face["loops"]:
                for a, b in zip(loop, loop[1:] + loop[:1]):
                    self.assertNotIn((a, b), edges)
                    edges[a, b] = True
                    normal = tuple(n + c for n, c in zip(normal, cross(points[a], points[b])))
            origin = points[face["loops"][0][0]]
            for loop in face["loops"]:
                for v in loop:
                    self.assertEqual(dot(normal, minus(points[v], origin)), 0)
            # A cone from the origin over a planar face: its area vector times any of its points.
            six_volumes += dot(normal, origin)
        for a, b in edges:
            self.assertIn((b, a), edges)
        return six_volumes / 6

    def test_volume_is_the_very_rational(self):
        text = """
          local a = cube(10, 7, 5):rotate(17, 33, 71)
          local b = cube(10, 7, 5):rotate(5, 81, 12):translate(1, 2, 0.5)
          return {cut = (a - b):color("red"), both = a * b, thirds = cube(1):scale(1 / 3)}"""
        stats = self.run_script(text, "--stats=json", "-o", "a.exact.json", "-o", "a.glb").json()
        file = read(self.path("a.exact.json"))
        self.assertEqual((file["format"], file["version"], file["unit"]), ("csgrun exact mesh", 1, "mm"))
        self.assertEqual([p["name"] for p in file["parts"]], [p["name"] for p in stats["parts"]])
        for part, measured in zip(file["parts"], stats["parts"]):
            # Fraction to float rounds once, to nearest: as the measures of a run do.
            self.assertEqual(float(self.measure(part)), measured["volume"], part["name"])
            self.assertEqual(len(part["points"]), measured["vertices"])
            self.assertEqual(len(part["faces"]), measured["faces"])
            low = [float(min(Fraction(p[k]) for p in part["points"])) for k in range(3)]
            self.assertEqual(low, measured["bbox"][0])
            for p in part["points"]:
                for x in p:
                    self.assertEqual(str(Fraction(x)), x, "not in lowest terms")
        denominators = {Fraction(x).denominator for p in file["parts"][0]["points"] for x in p}
        self.assertGreater(max(denominators), 10**20)
        self.assertEqual(file["parts"][1]["appearances"][0]["default"], False)

    def test_faces_part_with_their_vertices(self):
        # Two wedges touch behind a face along a line through it, and are connected around both ends of that.
        self.write("model.lua", '''local S = {{1, 0.5, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}
            return octahedron(2):translate(2, 2, 2):multmatrix(S) - cube(2, 1, 1):translate(2, 0, 2) -
              linear_extrude(polygon{{2, 0}, {1, 1}, {0, 1}}, 2):rotate(0, 90, 0):translate(0, 0, 2):multmatrix(S)''')
        outcome = self.run_csgrun("model.lua", "-o", "a.exact.json", "--stats=json")
        self.expect(outcome, 0)
        part = read(self.path("a.exact.json"))["parts"][0]
        self.assertEqual(float(self.measure(part)), outcome.json()["parts"][0]["volume"])
        self.assertEqual(len(part["faces"]), 15)

    def test_decimals_are_decimals(self):
        text = "return cube(0.1, 0.2, 0.3) + cube(1):translate(0.7, 0, 0)"
        self.expect(self.run_script(text, "-o", "a.exact.json"), 0)
        points = {tuple(p) for p in read(self.path("a.exact.json"))["parts"][0]["points"]}
        self.assertIn(("1/10", "1/5", "3/10"), points)
        self.assertIn(("17/10", "1", "1"), points)

    def test_the_same_bytes(self):
        text = "local s = sphere(5)\nreturn s - s:translate(1, 1, 1):rotate(10, 20, 30)"
        found = set()
        for threads in ("1", "2"):
            self.expect(self.run_script(text, "-o", "a.exact.json", "--threads", threads), 0)
            with open(self.path("a.exact.json"), "rb") as file:
                found.add(file.read())
        self.assertEqual(len(found), 1)

    def test_one_file_a_part_and_other_endings(self):
        self.expect(self.run_script("return {a = cube(1), b = cube(2)}", "-o", "%s.EXACT.json"), 0)
        self.assertEqual(self.measure(read(self.path("b.EXACT.json"))["parts"][0]), 8)
        self.expect(self.run_script("return cube(1)", "-o", "a.json"), 2,
                    "csgrun: 'a.json': the ending must be one of .glb, .gltf, .stl, .3mf, .obj, .off, "
                    ".ply, .exact.json")


if __name__ == "__main__":
    main()
