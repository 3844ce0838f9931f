#!/usr/bin/env python3
"""Models in which everything touches: what a kernel with an epsilon gets wrong."""
import math
from fractions import Fraction

import support


class Marginal(support.Case):

    def only_part(self, text, *arguments):
        part, = self.script(text, *arguments)["parts"]
        self.assertTrue(part["closed"])
        return part

    def assert_box(self, part, size, volume):
        """One box from the origin, of twelve triangles."""
        self.assertEqual((part["triangles"], part["vertices"]), (12, 8))
        self.assertEqual((part["components"], part["genus"]), (1, 0))
        self.assertEqual(part["bbox"], [[0, 0, 0], size])
        self.assertEqual(part["volume"], volume)

    def test_boxes_whose_decimals_meet_are_one_box(self):
        part = self.only_part("return cube(.3) + cube(.3):translate(.1 + .2, 0, 0)")
        self.assert_box(part, [0.6, 0.3, 0.3], 0.054)

    def test_ten_boxes_in_a_row_are_one_box(self):
        part = self.only_part("""
            local row = cube(.1)
            for i = 1, 9 do row = row + cube(.1):translate(i * .1, 0, 0) end
            return row""")
        self.assert_box(part, [1, 0.1, 0.1], 0.01)

    def test_a_block_of_boxes_is_one_box(self):
        for n, size in ((4, 1), (5, 0.1), (6, 0.7)):
            with self.subTest(n=n, size=size):
                part = self.only_part(f"""
                    local n, size, block = {n}, {size}, {{}}
                    for x = 0, n - 1 do for y = 0, n - 1 do for z = 0, n - 1 do
                      block[#block + 1] = cube(size):translate(x * size, y * size, z * size)
                    end end end
                    return union(block)""")
                edge = float(Fraction(str(size)) * n)
                self.assert_box(part, [edge] * 3, float((Fraction(str(size)) * n)**3))

    def test_a_flush_hole_stays_a_hole_when_turned(self):
        stats = self.script("""
            local box = cube{10, 20, 5, center = true}
            local drill = cylinder{h = 5, r = 2, fn = 32, center = true}
            local function turned(part) return part:rotate(20, 30, 40) end
            return {flat = box - drill, holed = turned(box) - turned(drill),
                    also = turned(box - drill), box = turned(box), drill = turned(drill)}""",
                            "-o", self.folder / "x.off")
        parts = {part["name"]: part for part in stats["parts"]}
        for name in ("flat", "holed", "also"):
            self.assertTrue(parts[name]["closed"])
            self.assertEqual((parts[name]["genus"], parts[name]["components"]), (1, 1), name)
            self.assertEqual(parts[name]["triangles"], parts["flat"]["triangles"], name)
        self.assert_relative(parts["holed"]["volume"], parts["flat"]["volume"], 1e-10)
        self.assertEqual(parts["holed"]["volume"], parts["also"]["volume"])
        # In the frame nothing is lost: what is missing is the cylinder. The three are rounded once.
        box, drill, holed = (parts[name]["volume"] for name in ("box", "drill", "holed"))
        rounding = sum(Fraction(math.ulp(v)) / 2 for v in (box, drill, holed))
        self.assertLessEqual(abs(Fraction(box) - Fraction(drill) - Fraction(holed)), rounding)

    def test_a_gear_has_one_top(self):
        teeth, height = 13, 5
        path = self.folder / "gear.off"
        part = self.only_part(f"""
            local gear = cylinder{{h = {height}, r = 10, fn = 64}}
            local tooth = cube(4, 3, {height}):translate(8, -1.5, 0)
            for i = 0, {teeth} - 1 do gear = gear + tooth:rotate(7 + i * 360 / {teeth}) end
            return gear""", "-o", path)
        self.assertEqual((part["genus"], part["components"]), (0, 1))
        mesh = support.read_off(path)
        self.assertEqual({point[2] for point in mesh.points}, {0.0, float(height)})
        # A sliver between top and tooth would be a face with no normal along Z or across it.
        tops = [face for face in mesh.faces if len({mesh.points[i][2] for i in face}) == 1]
        sides = [face for face in mesh.faces if len({mesh.points[i][2] for i in face}) == 2]
        # One polygon above and one below, of a corner for each side, and cut into triangles.
        self.assertEqual(part["faces"], len(sides) + 2)
        self.assertEqual(len(tops), 2 * (len(sides) - 2))
        self.assertEqual(len(tops) + len(sides), len(mesh.faces))
        self.assertTrue(all(len(face) == 4 for face in sides))
        for face in mesh.faces:
            for i, j in zip(face, face[1:] + face[:1]):
                self.assertGreater(math.dist(mesh.points[i], mesh.points[j]), 1e-3)
        self.assertEqual(len({i for face in tops for i in face}), 2 * len(sides))

    def test_boxes_that_share_an_edge_or_a_corner_stay_apart(self):
        for shift in ("1, 1, 0", "1, 1, 1"):
            with self.subTest(shift):
                path = self.folder / "two.obj"
                part = self.only_part(f"return cube(1) + cube(1):translate({shift})", "-o", path)
                self.assertEqual((part["components"], part["genus"]), (2, 0))
                self.assertEqual((part["triangles"], part["vertices"]), (24, 16))
                self.assertEqual(part["volume"], 2)
                mesh, = support.read_obj(path)
                self.assertEqual(mesh.unpaired_edges(), set())
                self.assertEqual(len(mesh.points), 16)

    def test_what_touches_along_a_line_in_a_wall_stays_apart_however_it_is_turned(self):
        """The walls are coplanar on both sides of the line; where they are cut must not depend on
        the order of coordinates."""
        stats = self.script("""
            local corners = cube(6, 6, 1) - cylinder{h = 1, r = 3, fn = 4}:translate(3, 3, 0)
            local half = polygon{{0, 0}, {3, 0}, {3, 3}}:linear_extrude(4)
            local wedges = half + half:mirror(1, 0, 0)
            local parts = {}
            for i, turn in ipairs{{0, 0, 0}, {0, 0, 90}, {0, 90, 0}, {90, 0, 0}, {180, 0, 0},
                                  {20, 30, 40}, {10, 50, 70}, {0, 0, 45}} do
              parts["corners" .. i] = corners:rotate(turn)
              parts["wedges" .. i] = wedges:rotate(turn)
              parts["mirrored" .. i] = wedges:mirror(1, 2, 3):rotate(turn)
            end
            return parts""")
        self.assertEqual(len(stats["parts"]), 24)
        for part in stats["parts"]:
            with self.subTest(part["name"]):
                corners = part["name"].startswith("corners")
                shape = (part["components"], part["genus"], part["triangles"], part["vertices"])
                self.assertEqual(shape, (4, 0, 32, 24) if corners else (2, 0, 16, 12))
                self.assert_relative(part["volume"], 18 if corners else 36, 1e-10)

    def test_nothing_is_left_of_a_box_minus_itself(self):
        model = self.folder / "model.lua"
        model.write_text("local box = cube(1)\nreturn box - box\n", encoding="utf-8")
        done = self.csgrun(model, "-o", self.folder / "x.glb", code=3)
        self.assertEqual(done.stderr, f"{model}:2: the result is empty\n")
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["model.lua"])


if __name__ == "__main__":
    support.main()
