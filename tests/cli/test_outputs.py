"""Files that go out: whole or not at all; parts; what stands on standard output."""
import json
import os
import subprocess

from support import CSGRUN, Case, main


class Outputs(Case):
    def test_all_formats_at_once(self):
        names = ["a.glb", "a.gltf", "a.stl", "a.obj", "a.off"]
        arguments = [x for name in names for x in ("-o", name)]
        outcome = self.run_script("return cube(10) - cylinder(10, 3)", *arguments)
        self.expect(outcome, 0)
        self.assertEqual(outcome.out, "")
        for name in names:
            self.assertGreater(os.path.getsize(self.path(name)), 100)
        self.assertEqual(self.left_over(), [])

    def test_one_mesh_formats_get_the_exact_union(self):
        self.expect(self.run_script("return {a = cube(10), b = cube(10):translate(5, 0, 0)}", "-o", "a.stl"), 0)
        outcome = self.run_csgrun("a.stl", "--stats=json")
        part = outcome.json()["parts"][0]
        self.assertEqual((part["volume"], part["components"], part["triangles"]), (1500, 1, 12))

    def test_parts_stay_apart_in_gltf(self):
        outcome = self.run_script("return {lid = cube(10), case = {cube(10):up(20)}}", "-o", "a.gltf", "--stats=json")
        self.expect(outcome, 0)
        self.assertEqual([p["name"] for p in outcome.json()["parts"]], ["case/part1", "lid"])
        with open(self.path("a.gltf")) as file:
            nodes = {n.get("name") for n in json.load(file)["nodes"]}
        self.assertTrue({"lid"} <= nodes, nodes)

    def test_instances_share_a_mesh(self):
        text = ("local leaf = cube(10) - cylinder(10, 3)\nlocal parts = {}\n"
                "for i = 1, 12 do parts[i] = leaf:translate(30, 0, 0):rotate(i * 30):color('red') end\n"
                "parts[13] = leaf:mirror(1, 0, 0):color('red')\nparts[14] = leaf:color('blue')\nreturn parts")
        outcome = self.run_script(text, "-o", "a.gltf", "-o", "a.obj", "--stats=json")
        self.expect(outcome, 0)
        with open(self.path("a.gltf")) as file:
            model = json.load(file)
        self.assertEqual(len(model["meshes"]), 2)
        self.assertEqual(sum("mesh" in node for node in model["nodes"]), 14)
        for part in outcome.json()["parts"]:  # turned parts are right to about eleven digits
            self.assertAlmostEqual(part["volume"] / outcome.json()["parts"][13]["volume"], 1, delta=1e-10)

    def test_one_file_a_part(self):
        os.mkdir(self.path("out"))
        self.expect(self.run_script("return {lid = cube(1), case = {side = cube(2)}}", "-o", "out/%s.stl"), 0)
        self.assertEqual(sorted(os.listdir(self.path("out"))), ["case-side.stl", "lid.stl"])
        outcome = self.run_script("return {['a-b'] = cube(1), a = {b = cube(2)}}", "-o", "out/%s.stl")
        self.expect(outcome, 4, "csgrun: parts 'a/b' and 'a-b' would both be written to 'out/a-b.stl'")

    def test_patterns_and_files_do_not_meet(self):
        os.mkdir(self.path("out"))
        for text, ending in (("return {a = cube(1), b = cube(2)}", "stl"), ("return {a = square(1), b = square(2)}", "svg")):
            for other in (f"out/a.{ending}", f"out/../out/a.{ending}"):
                outcome = self.run_script(text, "-o", f"out/%s.{ending}", "-o", other)
                self.expect(outcome, 4, f"csgrun: -o out/%s.{ending} and -o {other} would both be written to '{other}'")
            outcome = self.run_script(text.replace("b =", "xa ="), "-o", f"out/%s.{ending}", "-o", f"out/x%s.{ending}")
            self.expect(outcome, 4, f"csgrun: -o out/%s.{ending} and -o out/x%s.{ending} would both be written to "
                                    f"'out/xa.{ending}'")
            self.assertEqual(os.listdir(self.path("out")), [])
        self.expect(self.run_script("return {a = cube(1)}", "-o", "out/%s.stl", "-o", "out/a.off"), 0)

    def test_the_object_of_stats(self):
        outcome = self.run_script("return cube(1)", "--stats=json", "--threads", "2")
        self.expect(outcome, 0)
        self.assertEqual(outcome.err, "")
        stats = outcome.json()
        self.assertEqual(outcome.out.count("\n"), 1)
        self.assertEqual(list(stats)[:7], ["version", "threads", "grid_mm", "seconds", "nodes", "parts", "warnings"])
        self.assertEqual(list(stats["seconds"]), ["script", "leaves", "boolean", "export", "total"])
        self.assertEqual(list(stats["nodes"]), ["evaluated", "memory", "disk"])
        self.assertEqual(stats["threads"], 2)
        self.assertEqual(stats["grid_mm"], 1.5625e-08)
        self.assertRegex(stats["parts"][0].pop("hash"), "^[0-9a-f]{32}$")
        self.assertEqual(stats["parts"], [{"name": "part1", "triangles": 12, "vertices": 8, "volume": 1, "area": 6,
                                           "bbox": [[0, 0, 0], [1, 1, 1]], "components": 1, "genus": 0, "closed": True,
                                           "faces": 6}])
        self.assertEqual(stats["warnings"], [])

    def test_stats_for_people_go_to_standard_error(self):
        outcome = self.run_script("return cube(1)", "--stats")
        self.expect(outcome, 0, "part1: 12 triangles, 8 vertices, volume 1 mm^3")
        self.assertEqual(outcome.out, "")


class Warnings(Case):
    """Of those that are alike people see three; JSON has all."""

    def warnings_of(self, boxes):
        self.write("a.csg", "".join(f"cube(size = [{size}, 1, 1], center = false);\n" for size in boxes))
        outcome = self.run_csgrun("a.csg", "-o", "a.stl")
        self.expect(outcome, 0)
        return [line for line in outcome.err.splitlines() if line.startswith("warning: ")]

    def test_many_alike(self):
        negative = [f"warning: a.csg:{line}: cube: size.x must be positive, got -{line}" for line in range(1, 9)]
        self.assertEqual(self.warnings_of([-1, -2, -3, -4, -5, -6, 1]),
                         [*negative[:3], "warning: 3 more like the one before"])
        outcome = self.run_csgrun("a.csg", "-o", "a.stl", "--stats=json")
        self.assertEqual(["warning: " + text for text in json.loads(outcome.out)["warnings"]], negative[:6])

    def test_no_line_is_saved(self):
        self.assertEqual(len(self.warnings_of([-1, -2, -3, -4, 1])), 4)

    def test_others_between(self):
        lines = self.warnings_of([-1, "nan", -2, -3, -4, -5, 1])
        self.assertEqual(len(lines), 5, lines)
        self.assertEqual(lines[4], "warning: 2 more like the one before")


class Unwritable(Case):
    def check(self, output, **options):
        outcome = self.run_script("return cube(10) - sphere(6, {fn = 100})", "-o", output, **options)
        self.expect(outcome, 4, "csgrun: ")
        self.assertIn(output, outcome.err)
        self.assertEqual(self.left_over(), [])
        return outcome

    def test_no_such_folder(self):
        self.assertIn("there is no folder 'none'", self.check("none/a.stl").err)

    def test_a_folder_of_that_name(self):
        os.mkdir(self.path("a.stl"))
        self.check("a.stl")

    def test_no_permission(self):
        if os.geteuid() == 0:
            self.skipTest("root may write everywhere")
        os.mkdir(self.path("closed"), 0o500)
        self.check("closed/a.stl")

    def test_file_limit(self):
        for name in ("a.stl", "a.glb", "a.obj", "a.off", "a.gltf"):
            self.check(name, file_limit=8192)
            self.assertFalse(os.path.exists(self.path(name)))

    def test_full_disk(self):
        os.mkdir(self.path("small"))
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", self.path("small")],
                                 capture_output=True)
        if mounted.returncode != 0:
            self.skipTest("cannot mount a small file system here")
        try:
            outcome = self.check("small/a.stl")
            self.assertIn("No space left on device", outcome.err)
            self.assertEqual(os.listdir(self.path("small")), [])
        finally:
            subprocess.run(["umount", self.path("small")], check=True)

    def test_standard_output_that_is_full(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("there is no /dev/full here")
        self.write("model.lua", "return cube(1)")
        self.expect(self.run_csgrun("model.lua", "-o", "a.off"), 0)
        for arguments in (["model.lua", "--stats=json"], ["model.lua", "--list-params"], ["info", "a.off"], ["--help-api"],
                          ["--help"]):
            with open("/dev/full", "w") as full:
                done = subprocess.run([CSGRUN, *arguments], cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True)
            self.assertEqual(done.returncode, 4, arguments)
            self.assertRegex(done.stderr, "^csgrun: cannot write standard output(: No space left on device)?\n$")

    def test_what_was_there_stays(self):
        self.write("a.stl", "precious")
        self.check("a.stl", file_limit=8192)
        with open(self.path("a.stl")) as file:
            self.assertEqual(file.read(), "precious")


if __name__ == "__main__":
    main()
