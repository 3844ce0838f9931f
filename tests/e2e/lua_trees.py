#!/usr/bin/env python3
"""A tree that OpenSCAD wrote and the script that says the same give the same files, byte for byte.

The trees are those of the corpus, and small ones of our own that hold what the corpus has not: text, files,
outlines alone, things that come to nothing.
"""
import re
import struct
import zlib

import csg_to_lua
import support

CORPUS = support.SHARED / "csg_corpus"
SOLID, FLAT = ("glb", "stl", "3mf", "ply", "off", "obj", "mtl"), ("svg", "dxf")
FACETS = "$fn = 0, $fa = 12, $fs = 2"
DRAWING = '<svg><rect width="4" height="3"/><circle cx="9" cy="9" r="2"/></svg>'
WEDGE = "OFF\n6 5 0\n0 0 0\n4 0 0\n0 3 0\n0 0 2\n4 0 2\n0 3 2\n3 0 2 1\n3 3 4 5\n4 0 1 4 3\n4 1 2 5 4\n4 2 0 3 5\n"


def png(rows):
    """A grey picture."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    pixels = zlib.compress(b"".join(b"\0" + bytes(row) for row in rows))
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", pixels) + chunk(b"IEND", b"")


SOLID_TREES = {
    "text": f'linear_extrude(height = 2, {FACETS}) {{ text(text = "a"b\\c", size = 10, spacing = 1.1, font = "",'
            f' direction = "ltr", language = "en", script = "Latn", halign = "center", valign = "top", {FACETS}); }}',
    "drawing": f'linear_extrude(height = 2, {FACETS}) {{ import(file = "a.svg", origin = [0, 0], dpi = 25.4, scale = 1,'
               f' center = true, convexity = 1, {FACETS}, timestamp = -5); }}',
    "mesh": f'import(file = "a.off", origin = [0, 0], scale = 1, center = false, convexity = 1, {FACETS});',
    "colours of faces": f'import(file = "c.off", origin = [0, 0], scale = 1, center = false, {FACETS});',
    "archive": f'difference() {{ import(file = "a.3mf", {FACETS}); cube(size = [1, 1, 1], center = true); }}',
    "colours of shapes": f"""linear_extrude(height = 2, {FACETS}) {{ difference() {{
        color([1, 0, 0, 0.5]) {{ circle({FACETS}, r = 5); }} color([0, 0, 1, 1]) {{ square(size = [2, 2]); }} }} }}
        rotate_extrude(angle = 90, start = 0, {FACETS}) {{ offset(r = 1, {FACETS}) {{ color([0, 1, 0, 1]) {{
            multmatrix([[1, 0, 0, 20], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {{
                hull() {{ color([1, 1, 0, 1]) {{ circle({FACETS}, r = 2); }} }} }} }} }} }}""",
    "heights": 'surface(file = "a.txt", center = true, invert = false, timestamp = 3);',
    "picture": 'surface(file = "a.png", center = false, invert = true, timestamp = 3);',
    "outlines": f"""linear_extrude(height = 3, center = true, scale = [0.5, 2], slices = 3, {FACETS}) {{
        offset(r = 1, $fn = 12, $fa = 12, $fs = 2) {{ square(size = [4, 3], center = false); }}
        multmatrix([[1, 0, 0, 20], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {{
            offset(delta = -0.5, chamfer = true, {FACETS}) {{ square(size = [4, 3], center = true); }} }}
        multmatrix([[2, 0, 0, 60], [0, 2, 0, 0], [0, 0, 2, 0], [0, 0, 0, 2]]) {{
            hull() {{ circle({FACETS}, r = 2); polygon(points = [[0, 0], [9, 0], [0, 9]], paths = [[0, 1, 2]]); }} }}
        multmatrix([[1, 0, 0, 0], [0, 1, 0, 30], [0, 0, 1, 0], [0, 0, 0, 1]]) {{
            minkowski(convexity = 0) {{ square(size = [4, 3], center = true); circle($fn = 5, $fa = 12, $fs = 2, r = 1); }}
        }}
        multmatrix([[1, 0, 0, 30], [0, 1, 0, 30], [0, 0, 1, 0], [0, 0, 0, 1]]) {{
            fill() {{ difference() {{ circle({FACETS}, r = 5); circle({FACETS}, r = 3); }} }} }}
        multmatrix([[1, 0, 0, -30], [0, 1, 0, 30], [0, 0, 1, 0], [0, 0, 0, 1]]) {{
            resize(newsize = [9, 0, 0], auto = [0, 1, 0], convexity = 0) {{ circle({FACETS}, r = 5); }} }} }}""",
    "nothing": """difference() { cube(size = [3, 3, 3], center = true); group(); cube(size = [1, 1, 9], center = true);
                  cube(size = [0, 1, 1], center = true); square(size = [2, 2], center = false); }
                  difference() { group(); cube(size = [9, 9, 9], center = false); }
                  intersection() { cube(size = [7, 7, 7], center = false); sphere($fn = 0, $fa = 12, $fs = 2, r = -1); }
                  %cube(size = [20, 20, 20], center = false);
                  #cube(size = [1, 1, 4], center = false);
                  multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0], [0, 0, 0, 1]]) { cube(size = [8, 8, 8], center = true); }
                  multmatrix([[1, 0, 0, nan], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) { cube(size = [8, 8, 8], center = true); }
                  color([-1, -1, -1, -1]) { cube(size = [2, 1, 1], center = true); }
                  linear_extrude(height = -3, $fn = 0, $fa = 12, $fs = 2) { square(size = [50, 50], center = true); }""",
    "sections": f"""linear_extrude(height = 1, {FACETS}) {{ projection(cut = true, convexity = 0) {{
                        sphere({FACETS}, r = 5); square(size = [50, 50], center = false); }} }}
                    rotate_extrude(angle = 270, start = 15, convexity = 2, {FACETS}) {{
                        multmatrix([[1, 0, 0, 20], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {{ circle({FACETS}, r = 2); }} }}
                    rotate_extrude(angle = 360, convexity = 2, {FACETS}) {{ multmatrix([[1, 0, 0, 30], [0, 1, 0, 0],
                        [0, 0, 1, 0], [0, 0, 0, 1]]) {{ square(size = [1, 2], center = false); }} }}""",
}
FLAT_TREES = {
    "flat": f'difference() {{ circle($fn = 40, $fa = 12, $fs = 2, r = 9); text(text = "B", size = 5, spacing = 1,'
            f' font = "Liberation Sans:style=Bold", direction = "ltr", language = "en", script = "Latn",'
            f' halign = "center", valign = "center", {FACETS}); }}',
    "shadow": f"projection(cut = false, convexity = 0) {{ sphere({FACETS}, r = 5); }}",
    "coloured": f"color([0, 0.5, 1, 1]) {{ circle({FACETS}, r = 3); }}",
    "mixed": f"group() {{ circle({FACETS}, r = 0); }} square(size = [2, 3], center = false); cube(size = [9, 9, 9]);",
}


class LuaTrees(support.Case):

    def compare(self, tree, endings):
        """Runs the tree, and the script beside it; they differ in their names alone."""
        script = self.folder / "model.lua"
        script.write_text(csg_to_lua.translate(tree.read_text(encoding="utf-8")), encoding="utf-8")
        for folder, model in (("tree", tree), ("script", script)):
            (self.folder / folder).mkdir(exist_ok=True)
            outputs = [f"-o{self.folder / folder / 'x'}.{ending}" for ending in endings if ending != "mtl"]
            self.csgrun(model, *outputs)
        for ending in endings:
            of_tree, of_script = ((self.folder / folder / f"x.{ending}").read_bytes() for folder in ("tree", "script"))
            if ending == "obj":  # its comments tell which line of which file made a face
                of_tree, of_script = (re.sub(rb"(?m)^#.*\n", b"", data) for data in (of_tree, of_script))
            self.assertTrue(of_tree, ending)
            self.assertTrue(of_tree == of_script, f"the .{ending} files differ")

    @support.needs_shared("csg_corpus")
    def test_corpus(self):
        trees = sorted(CORPUS.glob("*.csg"))
        self.assertGreater(len(trees), 50)
        for tree in trees:
            with self.subTest(tree.name):
                self.compare(tree, SOLID)

    def test_what_the_corpus_has_not(self):
        (self.folder / "a.svg").write_text(DRAWING)
        (self.folder / "a.off").write_text(WEDGE)
        (self.folder / "c.off").write_text(WEDGE.replace("OFF", "COFF", 1).replace("3 0 2 1\n", "3 0 2 1 255 0 0\n"))
        (self.folder / "two.lua").write_text("return {a = cube(2):color('red'), b = sphere(3):right(5)}")
        self.csgrun(self.folder / "two.lua", "-o", self.folder / "a.3mf")
        (self.folder / "a.txt").write_text("# heights\n0 1 2\n1 4 1\n2 1 0\n")
        (self.folder / "a.png").write_bytes(png([[0, 80, 200], [9, 255, 1], [40, 40, 40]]))
        for trees, endings in ((SOLID_TREES, SOLID), (FLAT_TREES, FLAT)):
            for name, text in trees.items():
                with self.subTest(name):
                    tree = self.folder / "tree.csg"
                    tree.write_text(text + "\n")
                    self.compare(tree, endings)


if __name__ == "__main__":
    support.main()
