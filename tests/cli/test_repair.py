"""Broken meshes: refused with what is wrong and what would help, repaired on request with a report."""
import os
import random
import re
import struct
import unittest
from collections import Counter
from fractions import Fraction
from math import floor

from support import Case, main, off

POINTS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
FACES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6)]


class Repaired(Case):
    def refuse(self, options, *said):
        outcome = self.run_script(f"return import('m.off'{options})")
        self.expect(outcome, 1, "model.lua:1: import: ")
        for text in said:
            self.assertIn(text, outcome.err)

    def repair(self, options, volume, *said):
        outcome = self.run_script(f"return import('m.off', {{repair = {options}}})")
        self.expect(outcome, 0)
        found = outcome.json()
        self.assertAlmostEqual(found["parts"][0]["volume"], volume, places=12)
        self.assertTrue(found["parts"][0]["closed"])
        self.assertEqual(found["warnings"], ["model.lua:1: import: m.off: repair: " + text for text in said])

    def test_hole(self):
        self.write("m.off", off(POINTS, FACES[:5]))
        hint = 'a script repairs it by import("m.off", {repair = {fill_holes = true}})'
        where = "4 open edges (first: (0, 0, 0) - (0, 1, 0)) in 1 hole of 4 edges at (0, 0.5, 0.5)"
        self.refuse("", "m.off: not closed: " + where, hint)
        outcome = self.run_csgrun("m.off", "-o", "out.stl")
        self.expect(outcome, 1, "m.off: not closed: " + where)
        self.assertIn(hint, outcome.err)
        self.refuse(", {repair = true}", "m.off: not closed: 4 open edges in 1 hole of 4 edges at (0, 0.5, 0.5)",
                    hint)
        self.repair("{fill_holes = true}", 1, "1 hole was filled with 2 faces (4 edges at (0, 0.5, 0.5))")

    def test_orientation(self):
        self.write("m.off", off(POINTS, FACES[:5] + [FACES[5][::-1]]))
        self.refuse("", "not consistently oriented: 4 edges", 'import("m.off", {repair = true})')
        self.repair("true", 1, "1 face was turned to agree with its neighbours (at (0, 1, 1))")
        self.refuse(", {repair = {orient = false}}", "faces disagree at the edge (0, 0, 0) - (0, 1, 0)",
                    'import("m.off", {repair = true})')

    def test_cracks(self):
        moved = [(x + 0.0001, y, z) for x, y, z in POINTS]
        self.write("m.off", off(POINTS + moved, FACES[:5] + [tuple(i + 8 for i in FACES[5])]))
        # The least power of ten that closes it; 0.0001 is a little less than the gap in doubles.
        self.refuse("", "8 open edges", "{repair = {weld = ")
        self.repair("{weld = 0.001}", 1,
                    "4 points were welded to another within 0.001 mm (first: at (0.0001, 0, 0), at (0.0001, 1, 0), "
                    "at (0.0001, 0, 1))")

    def test_faces_that_are_nothing_or_there_twice(self):
        self.write("m.off", off(POINTS, FACES + [(0, 1, 0), FACES[2], FACES[3][::-1]]))
        self.refuse("", "degenerate", 'import("m.off", {repair = true})')  # not by itself: others are there twice
        self.repair("true", 1, "1 face without area was dropped (at (0, 0, 0))",
                    "2 faces on the same points as others were dropped (at (0, 0, 0), at (1, 0, 1))")

        self.refuse(", {repair = {drop_duplicates = false}}", "not closed: ",
                    '; a script repairs it by import("m.off", {repair = true})')

    def volumes(self, meshes, options):
        """The volume of each mesh (points, faces), repaired, and how many faces were dropped as repeated."""
        for number, mesh in enumerate(meshes):
            self.write(f"m{number}.off", off(*mesh))
        outcome = self.run_script(f"for i = 0, {len(meshes) - 1} do\n"
                                  f"  print(import('m' .. i .. '.off', {{repair = {options}}}):volume())\nend\nreturn cube(1)")
        self.expect(outcome, 0)
        return [float(line) for line in outcome.err.split("\n") if re.fullmatch(r"[0-9.]+", line)]

    def test_faces_that_are_there_twice_where_it_is_cracked(self):
        triangles = [t for a, b, c, d in FACES for t in ((a, b, c), (a, c, d))]
        copies = [[t if forward else t[::-1] for forward in kinds] for t in triangles
                  for kinds in ((False,), (True,), (True, False))]
        # Each triangle has its own corners, a little off.
        rng = random.Random(4)
        apart = [tuple(x + rng.uniform(-1e-4, 1e-4) for x in POINTS[v]) for t in triangles for v in t]
        numbers = {t: tuple(range(3 * k, 3 * k + 3)) for k, t in enumerate(triangles)}
        meshes = []
        for t, more in zip([t for t in triangles for _ in range(3)], copies):
            again = [numbers[t] if copy == t else numbers[t][::-1] for copy in more]
            meshes.append((apart, list(numbers.values()) + again))
        once, = self.volumes([(apart, list(numbers.values()))], "{weld = 0.001}")
        self.assertAlmostEqual(once, 1, delta=1e-3)
        for volume in self.volumes(meshes, "{weld = 0.001}"):
            self.assertAlmostEqual(volume, once, delta=1e-3)
        # Neighbours have points in the edges of the one that is there more than once.
        meshes = []
        for t, more in zip([t for t in triangles for _ in range(3)], copies):
            for split in ((0,), (0, 1), (0, 1, 2)):
                points, faces = list(POINTS), [f for f in triangles if f != t]
                for a, b in ((t[i], t[i - 2]) for i in split):
                    beside = next(f for f in faces if (b, a) in zip(f, f[1:] + f[:1]))
                    c, = set(beside) - {a, b}
                    points.append(tuple((x + y) / 2 for x, y in zip(points[a], points[b])))
                    faces.remove(beside)
                    faces += [(b, len(points) - 1, c), (len(points) - 1, a, c)]
                meshes.append((points, [t] + faces + more))
                meshes.append((points, more + faces + [t]))
        self.assertEqual(self.volumes(meshes, "true"), [1] * len(meshes))

    def test_flaps_beside_cracks_go(self):
        triangles = [t for a, b, c, d in FACES for t in ((a, b, c), (a, c, d))]
        points, flap = POINTS + [(0.5, 0, 0), (0.5, 0.4, 3)], (0, 1, 9)
        faces = [t for t in triangles if t != (0, 1, 5)] + [(0, 8, 5), (8, 1, 5)]  # against the edge from 0 to 1
        hole = [t for t in triangles if t != (0, 1, 5)]
        meshes = [(points, mesh + [flap, flap[::-1]]) for mesh in (faces, triangles)]
        meshes += [(points, mesh + [(9, 7, 6), (6, 7, 9)]) for mesh in (faces, triangles)]
        self.assertEqual(self.volumes(meshes, "true"), [1] * len(meshes))
        self.assertEqual(self.volumes([(points, hole + [flap, flap[::-1]])], "{fill_holes = true}"), [1])

    def test_many_voids(self):
        """Voids with bodies in them, all in one body and inside out: their planes and edges are in line."""
        def box(low, side, turned):
            first = len(points)
            points.extend(tuple(c + side * x for c, x in zip(low, p)) for p in POINTS)
            faces.extend(tuple(first + v for v in (f[::-1] if turned else f)) for f in FACES)

        count = 8
        for inside_out in (False, True):
            points, faces = [], []
            box((0, 0, 0), 4 * count, inside_out)
            box((-9, 0, 0), 3, True)  # that is inverted in any case
            expected = (4 * count) ** 3 + 27
            for n in range(count ** 3):
                low = [4 * (n // count ** i % count) + 1 for i in range(3)]
                box(low, 2, not inside_out)
                expected -= 8
                if n % 3 == 0:
                    box([c + 0.5 for c in low], 1, inside_out)
                    expected += 1
            self.assertEqual(self.volumes([(points, faces)], "true"), [expected])

    def test_sheet(self):
        self.write("m.off", off([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2, 3)]))
        self.refuse("", "m.off: not closed: 4 open edges", "; no repair makes it a solid: nothing is ")
        self.refuse(", {repair = {fill_holes = true}}", "m.off: nothing is ")

    def test_face_that_crosses_itself(self):
        corners = [(0, 0), (10, 10), (10, 0), (0, 10)]
        faces = [(3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
        self.write("m.off", off([(x, y, z) for z in (0, 5) for x, y in corners], faces))
        self.write("triangles.off", off([(x, y, z) for z in (0, 5) for x, y in corners],
                                        [f[:3] for f in faces] + [(f[0], f[2], f[3]) for f in faces]))
        points = "{" + ", ".join("{%d, %d, %d}" % (x, y, z) for z in (0, 5) for x, y in corners) + "}"
        clockwise = "{" + ", ".join("{%d, %d, %d, %d}" % f[::-1] for f in faces) + "}"
        for rule, volume in (("nonzero", 250), ("evenodd", 250), ("positive", 125)):
            for made in (f"import('m.off', {{fill = '{rule}'}})", f"import('m.off', {{fill = '{rule}', repair = true}})",
                         f"import('triangles.off', {{fill = '{rule}'}})",
                         f"polyhedron{{points = {points}, faces = {clockwise}, fill = '{rule}'}}"):
                outcome = self.run_script("return " + made)
                self.expect(outcome, 0)
                self.assertEqual(outcome.json()["parts"][0]["volume"], volume, made)

    def test_no_orientation(self):
        strip = [(0, 1, 2), (1, 3, 2), (2, 3, 4), (3, 0, 4), (4, 0, 1)]
        self.write("m.off", off([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 1), (0, 2, 5)], strip))
        self.refuse(", {repair = {fill_holes = true}}", "like a Moebius strip", "at the edge (")
        self.refuse("", "not closed", "like a Moebius strip")

    def test_nothing_to_repair(self):
        self.write("m.off", off(POINTS, FACES))
        self.repair("true", 1)
        self.repair("false", 1)

    def test_options(self):
        self.write("m.off", off(POINTS, FACES))
        for options, said in (
                ("{fill_hole = true}", "unknown option 'fill_hole' (did you mean 'fill_holes'?)"),
                ("{weld = -1}", "'weld'"), ("{weld = 'much'}", "'weld' must be a number"), ("{orient = 1}", "'orient'"),
                ("{0.1}", ""), ("'yes'", "option 'repair' must be true, false or a table of options"), ("5", "got 5")):
            self.refuse(f", {{repair = {options}}}", "option 'repair'", said)

    def test_asked_for_in_several_ways(self):
        self.write("m.off", off(POINTS, FACES[:5]))
        outcome = self.run_script(
            "local a = import('m.off', {repair = {fill_holes = true}})\n"
            "print(pcall(import, 'm.off', {repair = true}))\n"
            "return a + import('m.off', {repair = {fill_holes = true}}):up(5)")
        self.expect(outcome, 0)
        self.assertIn("false", outcome.err)
        self.assertEqual(outcome.json()["parts"][0]["volume"], 2)
        self.assertEqual(len(outcome.json()["warnings"]), 1)


def load(path):
    """Points and triangles of an OBJ, OFF or binary STL, welded by coordinates."""
    points, faces = [], []
    with open(path, "rb") as file:
        data = file.read()
    if path.endswith(".stl"):
        for t in range(struct.unpack_from("<I", data, 80)[0]):
            corners = struct.unpack_from("<9f", data, 84 + 50 * t + 12)
            faces.append(tuple(range(3 * t, 3 * t + 3)))
            points += [corners[0:3], corners[3:6], corners[6:9]]
    elif path.endswith(".off"):
        words = data.split()
        count, at = int(words[1]), 4
        points = [tuple(map(float, words[at + 3 * i:at + 3 * i + 3])) for i in range(count)]
        at += 3 * count
        for _ in range(int(words[2])):
            n = int(words[at])
            faces.append(tuple(map(int, words[at + 1:at + 1 + n])))
            at += n + 1
    else:
        for line in data.decode(errors="replace").splitlines():
            words = line.split()
            if words[:1] == ["v"]:
                points.append(tuple(map(float, words[1:4])))
            elif words[:1] == ["f"]:
                faces.append(tuple(int(w.split("/")[0]) - 1 for w in words[1:]))
    number = {}
    names = [number.setdefault(p, len(number)) for p in points]
    return list(number), [tuple(names[i] for i in f) for f in faces]


def closed_by_fans(points, faces):
    """The signed volume with each boundary loop closed by a fan around its middle; how far that can be from the
    volume of any other closing (the boxes of the loops); the number of open edges and of loops."""
    edges = Counter((f[i - 1], f[i]) for f in faces for i in range(len(f)))
    loops, left = [], {b: a for a, b in edges if edges[a, b] > edges[b, a]}  # the fan runs back
    while left:
        start, at = next(iter(left.items()))
        del left[start]
        loop = [start]
        while at != start:
            loop.append(at)
            at = left.pop(at)
        loops.append(loop)

    def wedge(p, q, r):
        return (p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) +
                p[2] * (q[0] * r[1] - q[1] * r[0])) / 6

    volume = sum(wedge(points[f[0]], points[f[i]], points[f[i + 1]]) for f in faces for i in range(1, len(f) - 1))
    slack = 0
    for loop in loops:
        corners = [points[v] for v in loop]
        middle = [sum(p[i] for p in corners) / len(corners) for i in range(3)]
        volume += sum(wedge(corners[i - 1], corners[i], middle) for i in range(len(corners)))
        sides = [max(p[i] for p in corners) - min(p[i] for p in corners) for i in range(3)]
        slack += sides[0] * sides[1] * sides[2]
    return volume, slack, sum(map(len, loops)), len(loops)


SHARED = os.path.join(os.environ.get("CSGRUN_SHARED") or os.path.join(os.environ["CSGRUN_SOURCE"], "..", "shared"),
                      "meshes")


@unittest.skipUnless(os.path.isdir(SHARED), f"no models in {SHARED}")
class FoundModels(Case):
    def bring(self, name):
        with open(os.path.join(SHARED, name), "rb") as file:
            self.write(name, file.read())
        return load(self.path(name))

    def evaluate(self, name, options=""):
        outcome = self.run_script(f"return import('{name}'{options})")
        self.expect(outcome, 0)
        found = outcome.json()
        self.assertTrue(found["parts"][0]["closed"])
        return found

    def test_open_models(self):
        for name, open_edges, holes in (("c3_ogre.obj", 200, 5), ("lg_camelhead.off", 56, 1),
                                        ("c3_teapot.obj", 160, 6)):
            points, faces = self.bring(name)
            volume, slack, edges, loops = closed_by_fans(points, faces)
            self.assertEqual((edges, loops), (open_edges, holes), name)
            outcome = self.run_csgrun(name, "-o", "out.stl")
            self.expect(outcome, 1, name + ": ")
            for text in (f"{edges} open edges (first: (", f" in {loops} hole", f'import("{name}", {{repair = {{fill_'):
                self.assertIn(text, outcome.err)
            found = self.evaluate(name, ", {repair = {fill_holes = true}}")
            self.assertIn(f": {loops} hole", "".join(found["warnings"]))
            part = found["parts"][0]
            low, high = ([side(p[i] for p in points) for i in range(3)] for side in (min, max))
            for i in range(3):
                self.assertAlmostEqual(part["bbox"][0][i], low[i], delta=1e-5)
                self.assertAlmostEqual(part["bbox"][1][i], high[i], delta=1e-5)
            # Where it laps over itself, the solid is less than the sum of its windings.
            self.assertLessEqual(part["volume"], volume * (1 + 1e-6) + slack, name)
            self.assertGreaterEqual(part["volume"], 0.85 * volume - slack, name)

    def test_closed_models_that_are_no_manifold_or_cross_themselves(self):
        for name in ("mf_Generic_Twin_7081.1.t0_left.obj", "mf_Generic_Twin_7081.1.t0_right.obj",
                     "tf_dragon-50k.stl", "c3_cow.obj"):
            points, faces = self.bring(name)
            volume, _, edges, _ = closed_by_fans(points, faces)
            self.assertEqual(edges, 0, name)
            volumes = {}
            for rule in ("nonzero", "positive", "evenodd"):
                for repair in ("", ", repair = true"):
                    found = self.evaluate(name, f", {{fill = '{rule}'{repair}}}")
                    part = found["parts"][0]
                    self.assertEqual(volumes.setdefault(rule, part["volume"]), part["volume"], (name, rule))
            # With winding numbers from -1 to 2 these differ from the signed volume on the engine's grid by what
            # they take for inside.
            grid = Fraction(str(found["grid_mm"]))
            snapped = [[floor(Fraction(x) / grid + Fraction(2049, 4096)) * grid for x in p] for p in points]
            signed = closed_by_fans(snapped, faces)[0]
            self.assertAlmostEqual((2 * volumes["positive"] - volumes["evenodd"]) / float(signed), 1, delta=1e-14)
            self.assertLess(abs(volumes["nonzero"] / float(signed) - 1), 0.05)

    def test_damage_of_a_clean_model_is_undone(self):
        """A soup of triangles with coordinates apart by their rounding, half of them turned."""
        points, faces = self.bring("lg_bunny.off")
        volume, _, edges, _ = closed_by_fans(points, faces)
        self.assertEqual(edges, 0)
        rng = random.Random(3)
        soup, triangles = [], []
        for face in faces:
            for v in face if rng.random() < 0.5 else face[::-1]:
                soup.append(tuple(c + rng.uniform(-1e-8, 1e-8) for c in points[v]))
            triangles.append((len(soup) - 3, len(soup) - 2, len(soup) - 1))
        self.write("soup.off", off(soup, triangles))
        found = self.evaluate("soup.off", ", {repair = {weld = 1e-7}}")
        self.assertEqual(found["parts"][0]["components"], 1)
        self.assertAlmostEqual(found["parts"][0]["volume"] / volume, 1, delta=1e-4)


if __name__ == "__main__":
    main()
