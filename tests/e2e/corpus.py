#!/usr/bin/env python3
"""Trees that OpenSCAD wrote, against the volumes, areas and boxes that it gives for them."""
import csv
import json

import support

CORPUS = support.SHARED / "csg_corpus"


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
        for row in rows:
            with self.subTest(row["file"]):
                done = support.run(support.PROGRAM, CORPUS / row["file"], "-o",
                                   self.folder / "x.stl", "--stats=json")
                self.assertEqual(done.returncode, 0, done.stderr)
                # Whatever OpenSCAD writes is known.
                self.assertNotRegex(done.stderr, "there is no argument|without a name|given twice")
                self.check(row, *json.loads(done.stdout)["parts"])
        print(f"\n{len(rows)} trees checked", flush=True)


if __name__ == "__main__":
    support.main()
