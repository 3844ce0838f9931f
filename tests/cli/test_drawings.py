"""2D results: SVG and DXF out and in again, and what is said where dimensions do not fit."""
import json
import os
import re
import xml.etree.ElementTree

from support import SANITIZED, Case, main

RING = "local s = square{20, 10, r = 2, fn = 16} - circle(2, {fn = 12}):translate(8, 5)\n"


def path_area(data):
    """The area of the closed polygons of path data, by the shoelace formula."""
    total = 0
    for loop in data.split("Z"):
        points = [tuple(map(float, p.split(","))) for p in re.findall(r"[-\d.e]+,[-\d.e]+", loop)]
        total += sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(points, points[1:] + points[:1])) / 2
    return abs(total)


def dxf_polygons(path):
    """(layer, points) of each LWPOLYLINE."""
    with open(path) as file:
        lines = file.read().split("\n")
    polygons = []
    for code, value in zip(lines[::2], lines[1::2]):
        if code == "0":
            current = [] if value == "LWPOLYLINE" else None
            if current is not None:
                polygons.append(["", current])
        elif current is not None and code == "8":
            polygons[-1][0] = value
        elif current is not None and code == "10":
            current.append([float(value), 0])
        elif current is not None and code == "20":
            current[-1][1] = float(value)
    return polygons


class Drawings(Case):
    def read(self, name):
        with open(self.path(name)) as file:
            return file.read()

    def test_written_and_read_again(self):
        outcome = self.run_script(RING + "return {ring = s, dot = circle(1):translate(30, 0):color('red')}",
                                  "-o", "a.svg", "-o", "a.dxf", "--stats=json")
        self.expect(outcome, 0)
        dot, ring = outcome.json()["parts"]
        self.assertEqual((ring["name"], ring["outlines"], ring["components"], ring["holes"]), ("ring", 2, 1, 1))
        self.assertEqual(ring["bbox"], [[0, 0], [20, 10]])
        svg = xml.etree.ElementTree.parse(self.path("a.svg")).getroot()
        paths = svg.findall("{http://www.w3.org/2000/svg}path")
        self.assertEqual([p.get("id") for p in paths], ["dot", "ring"])
        self.assertEqual(paths[0].get("fill"), "#ff0000")
        self.assertAlmostEqual(path_area(paths[1].get("d")), ring["area"], places=9)
        self.assertEqual([layer for layer, _ in dxf_polygons(self.path("a.dxf"))], ["dot", "ring", "ring"])
        # Points of a DXF go to the nearest 1/1024.
        for name, delta in [("a.svg", 1e-6), ("a.dxf", 0.01)]:
            info = self.run_csgrun("info", name, "--json").json()
            self.assertAlmostEqual(info["parts"][0]["area"], ring["area"] + dot["area"], delta=delta)
            self.assertEqual(info["warnings"], [])
            model = self.run_csgrun(name, "-o", "b.dxf", "--stats=json")
            self.assertAlmostEqual(model.json()["parts"][0]["perimeter"], ring["perimeter"] + dot["perimeter"],
                                   delta=delta)

    def test_parts_have_their_names_again(self):
        outcome = self.run_script(RING + "return {ring = s, ['the dot'] = circle(1):translate(30, 3), "
                                  "box = {lid = square(3):translate(3, 2)}}",
                                  "-o", "a.svg", "-o", "a.dxf", "--stats=json")
        parts = {part["name"]: part for part in outcome.json()["parts"]}
        self.assertEqual(sorted(parts), ["box/lid", "ring", "the dot"])
        for file, spelt in [("a.svg", str), ("a.dxf", lambda name: re.sub("[ /]", "_", name))]:
            again = self.run_script(f"return import('{file}', {{parts = true}})", "-o", "b.svg", "--stats=json")
            self.expect(again, 0)
            self.assertEqual([p["name"] for p in again.json()["parts"]], [spelt(name) for name in parts])
            for part, given in zip(again.json()["parts"], parts.values()):
                self.assertAlmostEqual(part["area"], given["area"], delta=1e-6 if file == "a.svg" else 0.02)
                for corner, wanted in zip(part["bbox"], given["bbox"]):
                    for value, coordinate in zip(corner, wanted):
                        self.assertAlmostEqual(value, coordinate, delta=1e-3)

    def test_one_file_a_part(self):
        self.expect(self.run_script("return {a = square(1), b = {c = circle(2)}}", "-o", "%s.svg"), 0)
        self.assertEqual(sorted(n for n in os.listdir(self.folder) if n.endswith(".svg")), ["a.svg", "b-c.svg"])

    def test_same_bytes(self):
        texts = []
        for threads in ["1", "2"]:
            self.expect(self.run_script("return text('csgrun'):offset(1)", "-o", "a.svg", "-o", "a.dxf",
                                        "--threads", threads), 0)
            texts.append([self.read(n) for n in ["a.svg", "a.dxf"]])
        self.assertEqual(texts[0], texts[1])

    def test_dimensions_that_do_not_fit(self):
        outcome = self.run_script("return square(1)", "-o", "a.stl")
        self.expect(outcome, 1)
        self.assertEqual(outcome.first, "model.lua:1: part 'part1' is a 2D shape, and 'a.stl' holds solids; make a "
                                        "solid of it with linear_extrude or rotate_extrude, or write .svg or .dxf")
        outcome = self.run_script("return cube(1)", "-o", "a.svg")
        self.expect(outcome, 1)
        self.assertEqual(outcome.first, "model.lua:1: part 'part1' is a solid, and 'a.svg' holds 2D shapes; make a "
                                        "shape of it with project")
        outcome = self.run_script("return {a = cube(1), b = square(1)}", "--stats")
        self.expect(outcome, 1)
        self.assertIn("part 'b' is a 2D shape, but part 'a' is a solid", outcome.first)
        outcome = self.run_script("return square(1) - square(2)", "-o", "a.svg")
        self.expect(outcome, 3)
        self.assertEqual(self.left_over(), [])

    def test_trees(self):
        self.write("a.csg", 'offset(r = 1, $fn = 8, $fa = 12, $fs = 2) {\n\timport(file = "p.svg", dpi = 25.4);\n}\n')
        self.write("p.svg", "<svg><rect width='4' height='4'/></svg>")
        outcome = self.run_csgrun("a.csg", "-o", "a.svg", "--stats=json")
        self.assertAlmostEqual(outcome.json()["parts"][0]["area"], 16 + 16 + 8 * 0.5 ** 0.5 / 2, places=6)
        self.write("b.csg", '\nimport(file = "q.svg");\n')
        outcome = self.run_csgrun("b.csg", "-o", "a.svg")
        self.assertEqual(outcome.code, 1)
        self.assertTrue(outcome.first.startswith("b.csg:2: import: cannot read 'q.svg'"), outcome.first)
        self.write("c.csg", 'import(file = "../secret.svg");\n')
        self.assertIn("outside", self.run_csgrun("c.csg", "-o", "a.svg").first)

    def test_fonts(self):
        outcome = self.run_script("return text('a', {font = 'Nonesuch'})", "-o", "a.svg")
        self.expect(outcome, 0)
        self.assertEqual(outcome.first, "warning: model.lua:1: text: there is no font \"Nonesuch\"; Liberation Sans "
                                        "Regular is used instead")
        outcome = self.run_script("return text('a', {font = 'Nonesuch'})", "-o", "a.svg", "--strict")
        self.expect(outcome, 1)
        self.assertEqual(outcome.first, "model.lua:1: text: there is no font \"Nonesuch\"; name a font file, or "
                                        "allow --system-fonts")
        outcome = self.run_script("return text('a', {font = '/etc/passwd.ttf'})", "-o", "a.svg")
        self.expect(outcome, 1)
        self.write("bad.ttf", b"no font at all")
        outcome = self.run_script("return text('a', {font = 'bad.ttf'})", "-o", "a.svg")
        self.assertEqual(outcome.first, "model.lua:1: text: bad.ttf: this is no TrueType or OpenType font, or it is "
                                        "damaged")

    def test_hostile_drawings_end_soon(self):
        self.write("bomb.svg", "<svg>" + "".join(
            f"<g id='n{i}'>" + (f"<use href='#n{i - 1}'/>" * 10 if i else "<rect width='1' height='1'/>") + "</g>"
            for i in range(12)) + "</svg>")
        outcome = self.run_script("return import('bomb.svg')", "-o", "a.svg")
        self.expect(outcome, 1)
        self.assertEqual(outcome.first, "model.lua:1: import: bomb.svg: unfolds to more than 200000 elements")
        self.assertLess(outcome.seconds, 30 if SANITIZED else 5)
        self.assertLess(outcome.peak_mb, 1000 if SANITIZED else 300)


if __name__ == "__main__":
    main()
