"""`--check`: the verdict on what is written, and what is written then."""
import math

from support import Case, main


class Check(Case):
    def run_checked(self, text, *outputs):
        arguments = [x for name in outputs for x in ("-o", name)]
        return self.run_script(text, "--check", "--stats=json", *arguments)

    def verdicts(self, outcome):
        return {c["file"]: c["verdict"] for c in outcome.json()["check"]}

    def bytes_of(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def assert_proved(self, *names):
        """The files stand up to `csgrun info`."""
        for name in names:
            found = self.run_csgrun("info", name, "--json").json()
            self.assertEqual(found["self_intersections"], 0, name)
            self.assertEqual(found["warnings"], [], name)
            self.assertTrue(all(p["closed"] for p in found["parts"]), name)

    def test_clean_files_are_the_same_bytes(self):
        names = ["a.glb", "a.gltf", "a.stl", "a.off", "a.obj"]
        text = ("local c = cube(10)\n"
                "return {a = c - sphere(6, {fn = 20}), b = c:translate(20, 0, 0), c = c:mirror(1, 0, 0):up(30)}")
        outcome = self.run_checked(text, *names)
        self.expect(outcome, 0)
        self.assertEqual(self.verdicts(outcome), {n: "clean" for n in names})
        part = outcome.json()["check"][2]["parts"][0]
        self.assertEqual(part["found"], {"self_intersections": 0, "degenerate": 0, "flipped": 0})
        self.assertEqual(part["places"], [])
        self.assert_proved("a.glb", "a.stl", "a.off", "a.obj")
        checked = {n: self.bytes_of(n) for n in names}
        for name in names:
            self.expect(self.run_script(text, "-o", name), 0)
            self.assertEqual(self.bytes_of(name), checked[name], name)
        self.assertNotIn("check", self.run_script(text, "--stats=json", "-o", "a.stl").json())

    def assert_repaired(self, text, *names):
        """Every file has the verdict "repaired", is written, stands up to info, and has the volume that
        rounding explains: as if the surface had moved by a step of a float, and by those of the lattices
        that repair came to where it took several rounds."""
        outcome = self.run_checked(text, *names)
        self.expect(outcome, 0)
        stats = outcome.json()
        for check in stats["check"]:
            self.assertEqual(check["verdict"], "repaired", check)
            self.assertTrue(any(w.startswith(check["file"] + ": ") and "; repaired in " in w
                                for w in stats["warnings"]), stats["warnings"])
            for part in check["parts"]:
                self.assertEqual(part["left"], {"self_intersections": 0, "degenerate": 0, "flipped": 0})
                if part["verdict"] == "clean":
                    self.assertEqual(part["rounds"], 0)
                    continue
                self.assertGreater(sum(part["found"].values()), 0)
                self.assertTrue(1 <= part["rounds"] <= 12)
                self.assertTrue(part["places"])
        self.assert_proved(*names)
        for check in stats["check"]:
            if len(check["parts"]) != len(stats["parts"]):
                continue
            for part, exact in zip(check["parts"], stats["parts"]):
                written = next(p for p in self.run_csgrun("info", check["file"], "--json").json()["parts"]
                               if len(stats["parts"]) == 1 or p["name"] == part["name"])
                self.assertAlmostEqual(written["volume"] / part["volume"][1], 1, delta=1e-12)
                extent = max(abs(x) for corner in exact["bbox"] for x in corner)
                step = 2.0 ** (math.frexp(extent)[1] - 24)
                moved = step * (1 + 4.0 ** (part["rounds"] - 2) if part["rounds"] > 1 else 1)
                self.assertLess(abs(written["volume"] - exact["volume"]), exact["area"] * moved, check["file"])
        return stats

    def test_slivers_far_from_the_origin(self):
        text = """
          local a = cube(40, 40, 10):rotate(0.0003, 0.0002, 0)
          local b = cube(40, 40, 10):rotate(-0.0001, 0.0004, 30):translate(5, -8, 0.00002)
          return (a:color("red") + b:color("blue")):translate(900.3, 700.7, -800.1)"""
        self.assert_repaired(text, "a.stl", "a.glb")

    def test_a_shell_of_a_few_float_steps(self):
        text = "local s = sphere{r = 100, fn = 48}\nreturn s - s:translate(0.00001, 0, 0)"
        stats = self.assert_repaired(text, "a.stl", "a.glb")
        part = stats["check"][0]["parts"][0]
        self.assertGreater(part["unions"], 0)
        self.assertTrue(all(s.startswith("sphere, model.lua:1") for p in part["places"] for s in p["sources"]))
        # In doubles there is nothing to repair.
        outcome = self.run_checked(text, "a.off", "a.obj")
        self.assertEqual(self.verdicts(outcome), {"a.off": "clean", "a.obj": "clean"})
        self.assert_proved("a.off", "a.obj")

    def test_many_nearly_equal_boxes(self):
        text = """
          local u = {}
          for i = 1, 8 do
            for j = 1, 5 do
              u[#u + 1] = cube(20 + i * 0.00004, 20, 20 + j * 0.00003)
                :rotate(3 + 0.00001 * i, 5 + j * 0.00002, 7 + 0.00001 * (i - j))
                :translate(i * 0.00003, j * 0.00002, 0):color(i % 2 == 0 and "red" or "blue")
            end
          end
          return {block = union(u):translate(1003.3, 957.7, -1200.1), ball = sphere(5)}"""
        stats = self.assert_repaired(text, "a.glb")
        self.assertEqual([p["verdict"] for p in stats["check"][0]["parts"]], ["clean", "repaired"])
        names = {p["name"] for p in self.run_csgrun("info", "a.glb", "--json").json()["parts"]}
        self.assertEqual(names, {"block", "ball"})
        for colour in (b'"#ff0000"', b'"#0000ff"'):
            self.assertIn(colour, self.bytes_of("a.glb"))

    def test_repairs_are_the_same_bytes_for_any_threads(self):
        text = "local s = sphere{r = 100, fn = 32}\nreturn s - s:translate(0.00001, 0, 0)"
        found = set()
        for threads in ("1", "2", "3"):
            self.expect(self.run_script(text, "--check", "-o", "a.stl", "--threads", threads), 0)
            found.add(self.bytes_of("a.stl"))
        self.assertEqual(len(found), 1)

    def test_no_output_no_check(self):
        self.expect(self.run_script("return cube(1)", "--check", "--stats"), 2,
                    "csgrun: --check proves what is written")

    def test_nothing_is_left_behind(self):
        self.expect(self.run_checked("return cube(1)", "a.stl", "no/such/b.stl"), 4, "csgrun: cannot write")
        self.assertEqual(self.left_over(), [])


if __name__ == "__main__":
    main()
