#!/usr/bin/env python3
"""Pairs of meshes from the wild, scaled to one box and turned at random: csgbench proves that all four
operations are closed, that their volumes are exactly those of the identities, and that they are free of
self-intersections as they are written, if need be after repair.

CSGRUN_PAIRS=500 asks for so many of all models; an ordinary run takes a few of the small ones.
CSGRUN_FIRST_PAIR=n starts with the n-th, and each pair can be run alone: csgbench pair A B SEED --check.
"""
import json
import os

import support

MODELS = ("c3_nefertiti.obj", "lg_armadillo.obj", "lg_bunny.off", "lg_decimated-knight.off",
          "lg_elephant.obj", "lg_fandisk.off", "lg_fertility.off", "th_112932.stl",
          "th_1514499.stl", "th_472042.stl", "th_65004.stl")
SMALL = ("lg_bunny.off", "lg_decimated-knight.off", "lg_fandisk.off", "th_472042.stl",
         "th_65004.stl")
FEW = 5


def pairs():
    """(A, B, seed): every model meets every other and itself before a pair comes again, turned
    otherwise."""
    asked = os.environ.get("CSGRUN_PAIRS")
    models = MODELS if asked else SMALL
    first = int(os.environ.get("CSGRUN_FIRST_PAIR", "0"))
    for k in range(first, first + int(asked or FEW)):
        offset = k // len(models)
        yield models[k % len(models)], models[(k + 1 + offset) % len(models)], k + 1


class Pairs(support.Case):

    @support.needs_shared("meshes")
    def test_identities_of_turned_pairs(self):
        folder = support.SHARED / "meshes"
        for a, b, seed in pairs():
            with self.subTest(a=a, b=b, seed=seed):
                done = support.run(support.BENCHMARK, "pair", folder / a, folder / b, seed, "--check")
                print(done.stdout or f"pair {a} {b} {seed}: {done.stderr}", end="", flush=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                result = json.loads(done.stdout)
                self.assertTrue(result["closed"])
                self.assertTrue(result["counters"]["identities_exact"])


class Shifts(support.Case):
    """The smallest shift there is, and the way through planes and back."""

    @support.needs_shared("meshes")
    def test_a_mesh_less_a_copy_that_is_shifted_by_one_unit_in_the_last_place(self):
        for name in SMALL:
            with self.subTest(name):
                done = support.run(support.BENCHMARK, "ulp", support.SHARED / "meshes" / name)
                self.assertEqual(done.returncode, 0, done.stderr)
                result = json.loads(done.stdout)
                self.assertTrue(result["closed"])
                self.assertGreater(result["volume"], 0)
                self.assertTrue(result["counters"]["volume_exact"])

    @support.needs_shared("meshes")
    def test_no_vertex_moves_on_the_way_through_planes_and_back(self):
        for name in SMALL[:2]:
            with self.subTest(name):
                done = support.run(support.BENCHMARK, "roundtrip", support.SHARED / "meshes" / name)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(json.loads(done.stdout)["counters"]["hausdorff_mm"], 0)


class Needles(support.Case):
    """A model of which nearly every triangle is a cap or a needle: beside its coordinates they are next to nothing
    wide, and most of what goes wrong when they are rounded is mended without a union."""

    @support.needs_shared("meshes")
    def test_a_mesh_of_needles_and_a_turned_copy(self):
        for side, operation in (("left", "a - a:rotate(0, 0, 30)"), ("right", "a + a:rotate(17, 29, 41)")):
            name = f"mf_Generic_Twin_7081.1.t0_{side}.obj"
            with self.subTest(name):
                (self.folder / name).write_bytes((support.SHARED / "meshes" / name).read_bytes())
                out = self.folder / "out.stl"
                stats = self.script(f"local a = import({name!r}, {{repair = true}})\nreturn {operation}",
                                    "-q", "--check", "-o", out)
                check = stats["check"][0]["parts"][0]
                self.assertEqual(check["verdict"], "repaired")
                self.assertGreater(check["found"]["self_intersections"], 10)
                self.assertLess(check["rounds"], 20)
                self.assert_relative(support.read_stl(out).volume(), stats["parts"][0]["volume"], 1e-3)
                self.assertEqual(self.info(out)["self_intersections"], 0)


if __name__ == "__main__":
    support.main()
