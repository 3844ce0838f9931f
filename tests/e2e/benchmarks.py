#!/usr/bin/env python3
"""csgbench computes what another engine computes: the volumes of ../shared/bench/expected.csv. How long
it takes is no matter of tests.
"""
import csv
import json
import math
import os

import support

BENCH = support.SHARED / "bench"
# The library of shared workloads makes all statues at once, up to six million triangles.
ONE_STATUE = """
#define main make_all
#include "make_meshes.cpp"
#undef main
int main(int, char** arguments) { write_off(arguments[1], statue(35), true); }
"""


class Benchmarks(support.Case):

    def bench(self, *words):
        done = support.run(support.BENCHMARK, *words)
        self.assertEqual(done.returncode, 0, f"csgbench {words}: {done.stderr}")
        result = json.loads(done.stdout)
        self.assertTrue(result["closed"], result)
        return result

    @support.needs_shared("bench")
    def test_volumes_are_those_of_another_engine(self):
        expected = self.expected()
        for name in ("chain 50", "batch 100", "grid 5", "grid 10"):
            with self.subTest(name):
                result = self.bench(*name.split())
                self.assertEqual(result["name"], name)
                self.assertEqual(result["n_in_tris"], int(expected[name]["n_in_tris"]))
                self.assert_relative(result["volume"], float(expected[name]["volume"]), 1e-6)
                self.assert_relative(result["area"], float(expected[name]["area"]), 1e-5)

    @support.needs_shared("bench")
    def test_sponges_are_exact(self):
        expected = self.expected()
        for name in ("menger 1", "menger 2", "menger 3"):
            with self.subTest(name):
                result = self.bench(*name.split())
                self.assertEqual(result["n_in_tris"], int(expected[name]["n_in_tris"]))
                self.assertEqual(result["volume"], float(expected[name]["volume"]))
                self.assertEqual(result["area"], float(expected[name]["area"]))

    def test_boxes_are_exact(self):
        result = self.bench("cubegrid", 5)
        self.assertEqual((result["volume"], result["area"], result["n_out_tris"]), (125, 150, 12))
        result = self.bench("boxes")
        self.assertEqual((result["volume"], result["area"]), (15, 42))

    def test_a_chain_on_a_sphere_is_one_difference(self):
        result = self.bench("dome", 30, "--write-inputs", self.folder / "tool")
        self.assertEqual(result["n_in_tris"], 8192 + 30 * 512)
        # Every tool is centred on the surface: a little less than half of it is taken, less what they share.
        ball, tool = 4 / 3 * math.pi * 50 ** 3, 4 / 3 * math.pi * 2 ** 3
        self.assertTrue(0.99 * ball - 15 * tool < result["volume"] < ball - 10 * tool, result["volume"])
        part, = self.script("local s = import('tool0.off') for i = 1, 30 do s = s - import('tool' .. i .. '.off') end "
                            "return s", "-o", self.folder / "x.stl")["parts"]
        self.assert_relative(part["volume"], result["volume"], 1e-9)
        self.assert_relative(part["area"], result["area"], 1e-9)

    def test_what_two_spheres_have_in_common_is_counted_once_in_their_union(self):
        one, both, common = (self.bench(*words) for words in (("shells", 1), ("shells", 2), ("common", 2)))
        for measure in ("volume", "area"):  # a sphere that is turned is another one on the grid
            self.assert_relative(both[measure] + common[measure], 2 * one[measure], 1e-6)
        self.assertLess(common["volume"], one["volume"])

    def test_operands_that_overlap_are_the_same_one_after_another(self):
        for name, count in (("rods", 16), ("plates", 150)):
            with self.subTest(name):
                result = self.bench(name, count, "--write-inputs", self.folder / name)
                part, = self.script(f"local s = import('{name}0.off') for i = 1, {count - 1} do "
                                    f"s = s + import('{name}' .. i .. '.off') s:volume() end return s",
                                    "-o", self.folder / "x.stl")["parts"]
                self.assert_relative(part["volume"], result["volume"], 1e-9)
                self.assert_relative(part["area"], result["area"], 1e-9)

    @support.needs_shared("bench")
    def test_a_statue_and_its_turned_copy(self):
        source, program = self.folder / "statue.cpp", self.folder / "statue"
        source.write_text(ONE_STATUE, encoding="utf-8")
        done = support.run(os.environ.get("CXX", "c++"), "-std=c++17", "-O1", "-w",
                           "-ffp-contract=off", "-I", BENCH, source, "-o", program)
        self.assertEqual(done.returncode, 0, done.stderr)
        statue = self.folder / "statue_25k.off"
        self.assertEqual(support.run(program, statue).returncode, 0)
        expected = self.expected()
        for angle in (30, 60, 90):
            with self.subTest(angle):
                row = expected[f"rot {statue.name} {angle}"]
                result = self.bench("rot", statue, angle)
                self.assertEqual(result["n_in_tris"], int(row["n_in_tris"]))
                self.assert_relative(result["volume"], float(row["volume"]), 1e-6)
                self.assert_relative(result["area"], float(row["area"]), 1e-5)
                # The turn as a transform is the same turn.
                framed = self.bench("rotframe", statue, angle)
                self.assert_relative(framed["volume"], float(row["volume"]), 1e-6)
                # Only where the surfaces meet is there work to do.
                counters = result["counters"]
                self.assertGreater(counters["filter"], 0)
                self.assertLess(counters["critical_cells"], counters["surface_cells"])

    def expected(self):
        with open(BENCH / "expected.csv", encoding="utf-8") as table:
            rows = csv.DictReader(line for line in table if not line.startswith("#"))
            return {row["workload"]: row for row in rows}


if __name__ == "__main__":
    support.main()
