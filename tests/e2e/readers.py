#!/usr/bin/env python3
"""What csgrun writes, read by others: the loaders of three.js and dxf-parser find the same parts, volumes, areas and
colours. (Of OFF they have no reader: cli.formats gives it to assimp.)
"""
import json
import os

import support

READERS = support.SOURCE / "tests" / "npm" / "readers.mjs"
SOLIDS = """
local body = cube{20, 20, 10}:color("red")
local hole = cube{8, 8, 30, center = true}:translate(10, 10, 5):color("#0000ff", 0.4)
local gem = octahedron(6):color("gold"):material("metal", {roughness = 0.25})
render((body - hole):name("body"))
render(gem:translate(40, 0, 0):name("ball & <co>"))
render(gem:scale(1, 1, -2):translate(60, 0, 0):name("mirrored"))
render(cube(3):translate(0, 40, 0):name("group/plain"))
"""
GEM = 2 * 3 ** 0.5 * 72  # an octahedron with edges of 6 * sqrt(2)
TALL = 8 * 0.5 * (6 * 2 ** 0.5) * (2 * 81) ** 0.5  # ... of a gem twice as high: 162 is the square of their height
VOLUMES = {"body": 20 * 20 * 10 - 8 * 8 * 10, "ball & <co>": 288, "mirrored": 576, "group/plain": 27}
COLOURS = {"body": {"#ff0000": 2 * 400 + 4 * 200 - 2 * 64, "#0000ff66": 4 * 80}, "ball & <co>": {"#ffd700": GEM},
           "mirrored": {"#ffd700": TALL}, "group/plain": {"#f9d72c": 54}}
SHAPES = """
render((circle(10, {fn = 64}) - circle(6, {fn = 64}) + circle(3, {fn = 64})):color("red"):name("ring"))
render(text("a8&"):translate(20, 0):color("#0000ff", 0.5):name("word"))
render((square(4) - square(1):translate(1, 1)):translate(-20, 0):name("plain"))
"""
MODELS = sorted(support.EXAMPLES.glob("*.lua"))


class Readers(support.Case):

    def read(self, *paths):
        """By name of the file: its parts."""
        done = support.run(os.environ.get("NODE_PROGRAM", "node"), READERS, *paths)
        if done.returncode == 77:
            self.skipTest(done.stderr.strip())
        self.assertEqual(done.returncode, 0, done.stderr)
        return {os.path.basename(report["file"]): report["parts"]
                for report in map(json.loads, done.stdout.splitlines())}

    def assert_areas(self, found, expected, unit=1.0):
        """Areas by colour; colours may differ by what a reader rounds."""
        self.assertEqual(len(found), len(expected), found)
        for colour, area in expected.items():
            close = [name for name in found if len(name) == len(colour) and
                     all(abs(a - b) <= 2 for a, b in zip(bytes.fromhex(name[1:]), bytes.fromhex(colour[1:])))]
            self.assertEqual(len(close), 1, (colour, found))
            self.assert_relative(found[close[0]] * unit ** 2, area, 1e-5, colour)

    def test_parts_volumes_and_colours(self):
        endings = ("glb", "gltf", "3mf", "obj", "stl", "ply")
        self.script(SOLIDS, *(f"-o{self.folder / 'a'}.{ending}" for ending in endings))
        files = self.read(*(self.folder / f"a.{ending}" for ending in endings))
        names = {"glb": ["body", "ball & <co>", "mirrored", "plain"], "3mf": list(VOLUMES),
                 "obj": ["body", "ball_&_<co>", "mirrored", "group plain"]}
        names["gltf"] = names["glb"]
        for ending, wanted in names.items():
            with self.subTest(ending):
                unit = 1000 if ending.startswith("gl") else 1
                parts = files[f"a.{ending}"]
                self.assertEqual([part["name"] for part in parts], wanted)
                for part, (name, volume) in zip(parts, VOLUMES.items()):
                    self.assert_relative(part["volume"] * unit ** 3, volume, 1e-6, name)
                    self.assert_areas(part["colours"], COLOURS[name], unit)
        together = {}
        for colours in COLOURS.values():
            for colour, area in colours.items():
                together[colour] = together.get(colour, 0) + area
        for ending in ("stl", "ply"):
            with self.subTest(ending):
                part, = files[f"a.{ending}"]
                self.assert_relative(part["volume"], sum(VOLUMES.values()), 1e-6)
                self.assert_relative(sum(part["colours"].values()), sum(together.values()), 1e-6)
        # Its reader passes over the alpha of faces.
        self.assert_areas(files["a.ply"][0]["colours"], {colour[:7]: area for colour, area in together.items()})

    def test_drawings(self):
        shapes = self.script(SHAPES, f"-o{self.folder / 'a.svg'}", f"-o{self.folder / 'a.dxf'}")["parts"]
        files = self.read(self.folder / "a.svg", self.folder / "a.dxf")
        for name in ("a.svg", "a.dxf"):
            with self.subTest(name):
                self.assertEqual([part["name"] for part in files[name]], [part["name"] for part in shapes])
                for part, shape in zip(files[name], shapes):
                    self.assert_relative(part["area"], shape["area"], 1e-9, part["name"])
        self.assertEqual([part["colour"] for part in files["a.svg"]], ["#ff0000", "#0000ff80", "#d3d3d3"])
        self.assertEqual({part["units"] for part in files["a.dxf"]}, {4})  # millimetres

    def test_examples(self):
        units = {"3mf": 1, "glb": 1000, "obj": 1}
        paths = {(model, ending): self.folder / f"{model.stem}.{ending}" for model in MODELS for ending in units}
        stats = {model: self.stats(model, "-q", *(f"-o{paths[model, ending]}" for ending in units)) for model in MODELS}
        files = self.read(*paths.values())
        for (model, ending), path in paths.items():
            with self.subTest(path.name):
                solids = sorted(stats[model]["parts"], key=lambda part: part["volume"])
                parts = sorted(files[path.name], key=lambda part: part["volume"])
                self.assertEqual(len(parts), len(solids))
                for part, solid in zip(parts, solids):
                    self.assert_relative(part["volume"] * units[ending] ** 3, solid["volume"], 1e-5, solid["name"])
                    area = sum(part["colours"].values()) * units[ending] ** 2
                    self.assert_relative(area, solid["area"], 1e-4, solid["name"])


if __name__ == "__main__":
    support.main()
