#!/usr/bin/env python3
"""Trees that OpenSCAD wrote, against the volumes, areas and boxes that it gives for them.

A tree with a node that csgrun has not yet is skipped, with the message of the program.
"""
import csv
import json
import re
import unittest

import support

CORPUS = support.SHARED / "csg_corpus"
NOT_SUPPORTED = re.compile(r"^\S+:\d+: (\w+)\(\) is not supported in \.csg files$")
SUPPORTED = {"cube", "sphere", "cylinder", "polyhedron", "multmatrix", "union", "difference",
             "intersection", "group", "render", "color", "square", "circle", "polygon",
             "linear_extrude", "rotate_extrude", "hull", "minkowski", "resize", "projection",
             "offset", "fill"}


@support.needs_shared("csg_corpus")
class Corpus(support.Case):

    def check(self, row, part):
        self.assertTrue(part["closed"])
        self.assert_relative(part["volume"], float(row["volume"]), 1e-5, "volume")
        self.assert_relative(part["area"], float(row["area"]), 1e-5, "area")
        expected = [float(c) for c in (row["bbox_min"] + " " + row["bbox_max"]).split()]
        for value, wanted in zip(part["bbox"][0] + part["bbox"][1], expected):
            self.assertLessEqual(abs(value - wanted), 1e-4, f"bounding box: {part['bbox']}")
        mesh = support.read_stl(self.folder / "x.stl")
        self.assertEqual(mesh.unbalanced_edges(), [])
        self.assert_relative(mesh.volume(), part["volume"], 1e-5, "volume of the STL")

    def test_agrees_with_openscad(self):
        with open(CORPUS / "expected.csv", encoding="utf-8") as table:
            rows = list(csv.DictReader(table))
        self.assertEqual([row["file"] for row in rows], sorted(p.name for p in CORPUS.glob("*.csg")))
        skipped = []
        for row in rows:
            with self.subTest(row["file"]):
                done = support.run(support.PROGRAM, CORPUS / row["file"], "-o",
                                   self.folder / "x.stl", "--stats=json")
                message = done.stderr.strip()
                missing = NOT_SUPPORTED.match(message)
                if done.returncode == 1 and missing and missing[1] not in SUPPORTED:
                    skipped.append(message.removeprefix(f"{CORPUS}/"))
                    continue
                self.assertEqual(done.returncode, 0, message)
                self.check(row, *json.loads(done.stdout)["parts"])
        print(f"\n{len(rows) - len(skipped)} trees checked, {len(skipped)} skipped:")
        print("".join(f"  {reason}\n" for reason in skipped), flush=True)


if __name__ == "__main__":
    support.main()
