"""compare.py without any peer: what it reads, whom it runs again, what it divides."""
import pathlib
import struct
import sys
import tempfile
import unittest

import compare
from compare import CSGRUN, Contender, Failure, Refused

CORNERS = [(x, y, z) for x in (1, 3) for y in (1, 3) for z in (1, 3)]
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
TRIANGLES = [(a, b, c) for a, b, c, d in QUADS] + [(a, c, d) for a, b, c, d in QUADS]


class Volume(unittest.TestCase):
    def volume(self, name, data):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / name
            path.write_bytes(data)
            return compare.volume(path)

    def test_polygons_of_an_off_file(self):
        text = "OFF # a cube\n8 6 0\n" + "".join("{} {} {}\n".format(*c) for c in CORNERS)
        text += "".join(f"4 {' '.join(map(str, q))}\n" for q in QUADS)
        self.assertAlmostEqual(self.volume("a.off", text.encode()), 8, 12)

    def test_both_kinds_of_stl(self):
        facets = "".join("facet normal 0 0 0\nouter loop\n" +
                         "".join("vertex {} {} {}\n".format(*CORNERS[v]) for v in t) + "endloop\nendfacet\n"
                         for t in TRIANGLES)
        self.assertAlmostEqual(self.volume("a.stl", f"solid x\n{facets}endsolid x\n".encode()), 8, 12)
        packed = b"".join(struct.pack("<12fH", 0, 0, 0, *(k for v in t for k in CORNERS[v]), 0) for t in TRIANGLES)
        self.assertAlmostEqual(self.volume("b.stl", bytes(80) + struct.pack("<I", 12) + packed), 8, 12)

    def test_another_format(self):
        with self.assertRaises(ValueError):
            self.volume("a.off", b"ply\n")


class Measure(unittest.TestCase):
    def setUp(self):
        self.order = []

    def contender(self, name, seconds, volumes, tolerance=1e-6):
        seconds, volumes = iter(seconds), iter(volumes)

        def run():
            self.order.append(name)
            return next(seconds), next(volumes)
        return Contender(name, run, tolerance)

    def test_runs_take_turns(self):
        got = compare.measure([self.contender(CSGRUN, (1, 2, 3), (8, 8, 8)),
                               self.contender("peer", (6, 4, 5), (8, 8 + 1e-6, 8))], 3, 10)
        self.assertEqual(self.order, [CSGRUN, "peer"] * 3)
        self.assertEqual(got, {CSGRUN: [1, 2, 3], "peer": [6, 4, 5]})

    def test_a_slow_one_is_not_run_again(self):
        got = compare.measure([self.contender(CSGRUN, (1, 2), (8, 8)), self.contender("slow", (11,), (8,))], 2, 10)
        self.assertEqual(got["slow"], [11])

    def test_a_wrong_volume(self):
        got = compare.measure([self.contender(CSGRUN, (1, 2), (8, 8)),
                               self.contender("peer", (1,), (8.0001,))], 2, 10)
        self.assertIsInstance(got["peer"], Failure)
        self.assertIn("wrong volume", got["peer"].reason)
        with self.assertRaises(Refused):
            compare.measure([self.contender(CSGRUN, (1, 2), (8, 8.0001))], 2, 10)

    def test_geometric_means(self):
        runs = [{CSGRUN: [1, 2, 3], "peer": [2], "wrong": [5]}, {CSGRUN: [8], "peer": [1, 1, 4], "wrong": Failure("no")}]
        means = compare.geometric_means(runs)
        self.assertAlmostEqual(means[CSGRUN][0], 4, 12)
        self.assertAlmostEqual(means["peer"][0], 2 ** 0.5, 12)
        self.assertEqual(means["wrong"], Failure("no (1 of 2)"))

    def test_pairs_are_of_different_models(self):
        pairs = list(compare.random_pairs(["a", "b", "c"], 20))
        self.assertEqual(len(pairs), 60)
        self.assertEqual(pairs, list(compare.random_pairs(["a", "b", "c"], 20)))
        self.assertTrue(all(w.bench[1] != w.bench[2] and w.bench[4] == w.op for _, w in pairs))

    def test_a_program_that_fails(self):
        with tempfile.TemporaryDirectory() as folder:
            compare.BINARIES = pathlib.Path(folder)
            runner = compare.Runner(20)
            failing = [sys.executable, "-c", "import sys; sys.exit('peer: no manifold')"]
            got = compare.measure([self.contender(CSGRUN, (1,), (8,)),
                                   Contender("peer", lambda: runner.run(*failing), 0)], 1, 10)
            self.assertEqual(got["peer"], Failure("no manifold"))
            self.assertEqual(runner.run(sys.executable, "-c", "print(3)")[0], "3\n")
            with self.assertRaises(Refused):
                compare.Runner(0.2).run(sys.executable, "-c", "import time; time.sleep(20)")


class Table(unittest.TestCase):
    def test_ratio_of_medians(self):
        self.assertEqual(compare.cell([8, 100, 1], [4, 1, 2]), "8 (4x)")
        self.assertEqual(compare.cell([1, 1, 9], [4, 4, 5]), "1 (**0.25x**)")
        self.assertEqual(compare.cell(Failure("over 300 s"), [1]), "over 300 s")

    def test_rows(self):
        got = compare.table({"rot": {CSGRUN: [2], "A": [3], "B": [1]}, "batch": {CSGRUN: [1], "B": [250]}}, ["A", "B"])
        self.assertEqual(got.split("\n")[2:], ["| rot | 2 | 3 (1.5x) | 1 (**0.5x**) |", "| batch | 1 |  | 250 (250x) |"])


if __name__ == "__main__":
    unittest.main()
