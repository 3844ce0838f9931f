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
        self.assertEqual(part["found"], {"self_intersections": 0, "degenerate": 0, "flipped": 0, "inverted": 0})
        self.assertEqual(part["places"], [])
        self.assert_proved("a.glb", "a.stl", "a.off", "a.obj")
        checked = {n: self.bytes_of(n) for n in names}
        for name in names:
            self.expect(self.run_script(text, "-o", name), 0)
            self.assertEqual(self.bytes_of(name), checked[name], name)
        self.assertNotIn("check", self.run_script(text, "--stats=json", "-o", "a.stl").json())

    def assert_repaired(self, text, *names, rounds=range(1, 13)):
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
                self.assertEqual(part["left"], {"self_intersections": 0, "degenerate": 0, "flipped": 0, "inverted": 0})
                if part["verdict"] == "clean":
                    self.assertEqual(part["rounds"], 0)
                    continue
                self.assertGreater(sum(part["found"].values()), 0)
                self.assertIn(part["rounds"], rounds)
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
                self.assertLess(abs(written["volume"] - exact["volume"]), exact["area"] * part["distance"])
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

    # Plates a few steps of floats thick that cross in lines along all of them: length, width, thickness, turn, place.
    PLATES = """
          local all = {}
          for i, p in ipairs{
            %s} do
            all[i] = cube{p[1], p[2], p[3], center = true}:rotate(p[4], p[5], p[6]):translate(p[7], p[8], p[9])
          end
          return union(all)"""

    def test_layers_beside_one_another(self):
        stats = self.assert_repaired(self.PLATES % """{132.28, 15.9607, 0.002, -47.647232, 4.983551, -26.468849, 4849.98, -19200, 1690},
            {144.08, 18.6742, 0.002, -47.647133, 4.981246, -26.479697, 4850, -19200, 1690.01},
            {112.933, 15.8564, 0.002, -47.648037, 4.983584, -26.469540, 4850.01, -19200, 1690.01},
            {80.7856, 10.9824, 0.01, -47.646141, 4.989392, -26.468079, 4850, -19200, 1689.99},
            {143.036, 19.4459, 0.002, -47.654294, 4.994558, -26.468710, 4850.01, -19200, 1690.03},
            {124.064, 18.0401, 0.004, -47.646958, 4.983504, -26.456701, 4849.98, -19200, 1689.99},
            {135.801, 7.62343, 0.004, -47.647241, 4.983371, -26.468305, 4849.99, -19200, 1690.02},
            {108.862, 13.3318, 0.004, -47.647214, 4.977238, -26.452314, 4850.02, -19200, 1689.97},
            {116.667, 6.57091, 0.05, -47.647194, 4.973197, -26.469194, 4849.97, -19200, 1689.99},
            {143.485, 4.84355, 0.01, -47.646926, 4.983664, -26.468343, 4849.99, -19200, 1689.97},
            {149.792, 16.629, 0.004, -47.647142, 4.984140, -26.466343, 4850, -19200, 1690.01},
            {66.8166, 6.80783, 0.004, -47.647140, 4.967055, -26.468267, 4850, -19200, 1689.98}""", "a.stl")
        self.assertLess(stats["check"][0]["parts"][0]["distance"], 0.05)

    def test_layers_that_cross_all_along(self):
        self.assert_repaired(self.PLATES % """{125.519, 18.9258, 0.002, -47.338601, -2.525456, -15.419268, 4850.02, -19200, 1690.01},
            {71.6122, 7.70005, 0.01, -47.338656, -2.525794, -15.419135, 4850, -19200, 1690.02},
            {139.766, 9.60264, 0.004, -47.328042, -2.533070, -15.419027, 4850.03, -19200, 1690},
            {110.232, 6.07298, 0.002, -47.337723, -2.524631, -15.417443, 4850, -19200, 1690.02},
            {96.9264, 13.7779, 0.05, -47.337374, -2.531607, -15.419504, 4849.97, -19200, 1689.98},
            {105.211, 5.89496, 0.01, -47.339230, -2.520523, -15.419186, 4849.99, -19200, 1690.01},
            {88.9821, 15.0834, 0.05, -47.346078, -2.529754, -15.419119, 4849.97, -19200, 1690.01},
            {106.608, 3.9558, 0.01, -47.335268, -2.530750, -15.419072, 4850.03, -19200, 1690.01},
            {78.0389, 12.6063, 0.05, -47.338645, -2.525637, -15.418586, 4849.98, -19200, 1690},
            {133.902, 9.87822, 0.01, -47.339978, -2.525776, -15.419012, 4850.02, -19200, 1690.03},
            {129.224, 11.6962, 0.004, -47.338497, -2.526401, -15.419868, 4850, -19200, 1690.02},
            {60.5177, 4.32681, 0.002, -47.337507, -2.525968, -15.418593, 4850.02, -19200, 1690.02}""", "a.stl")

    def test_layers_that_need_lattices(self):
        # Most of them, from several origins.
        self.assert_repaired(self.PLATES % """{103.63, 18.649, 0.004, -44.240922, 46.203223, 24.766013, 4850, -19200, 1689.97},
            {138.785, 9.80142, 0.004, -44.239044, 46.203306, 24.766566, 4850.03, -19200, 1689.98},
            {95.7642, 3.74357, 0.004, -44.241774, 46.203880, 24.765323, 4849.97, -19200, 1690.01},
            {116.829, 4.12007, 0.004, -44.242333, 46.202283, 24.758722, 4850.03, -19200, 1689.99},
            {111.312, 17.4605, 0.004, -44.241236, 46.203302, 24.766990, 4849.99, -19200, 1690.02},
            {72.0029, 17.8154, 0.01, -44.241206, 46.203250, 24.766618, 4849.99, -19200, 1689.97},
            {119.779, 19.2459, 0.002, -44.234413, 46.203310, 24.766345, 4850.03, -19200, 1689.99},
            {120.057, 11.0942, 0.004, -44.248654, 46.207540, 24.771931, 4850.03, -19200, 1689.98},
            {127.781, 8.34257, 0.01, -44.241456, 46.203296, 24.768982, 4850, -19200, 1689.98},
            {83.4358, 3.29169, 0.002, -44.241528, 46.203255, 24.766001, 4849.98, -19200, 1690.02},
            {116.988, 6.71076, 0.002, -44.241519, 46.203480, 24.766076, 4849.99, -19200, 1690.01},
            {102.482, 4.38312, 0.002, -44.240783, 46.197124, 24.766011, 4850.03, -19200, 1690.03}""", "a.stl", rounds=range(4, 26))

    def test_what_is_thinner_than_the_precision_is_said(self):
        # 0.008 mm thick where floats have steps of 0.0625: rounding turns it inside out, and nothing crosses.
        text = """
          csg.grid = 0.032768 -- holds these points
          local p = {{1000009.105408, 1000008.941568, 999991.115776}, {999991.7056, 1000006.713344, 1000004.714496},
            {1000003.403776, 999996.162048, 1000002.125824}, {1000001.404928, 1000003.960832, 999999.340544}}
          local thin = polyhedron(p, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}})
          return """
        outcome = self.run_checked(text + "thin", "a.stl", "a.off")
        self.expect(outcome, 0)
        stats = outcome.json()
        self.assertEqual(self.verdicts(outcome), {"a.stl": "repaired", "a.off": "clean"})
        part = stats["check"][0]["parts"][0]
        self.assertEqual(part["found"], {"self_intersections": 0, "degenerate": 0, "flipped": 0, "inverted": 1})
        self.assertLess(part["volume"][0], 0)
        self.assertEqual((part["triangles"][1], part["vanished"]), (0, 1))
        self.assertAlmostEqual(part["thickness"], 0.00837, places=5)
        self.assertEqual([p["kind"] for p in part["places"]], ["inverted", "vanished"])
        self.assertIn("a.stl: the solid is thinner than the file's precision and was written empty",
                      [w.replace("part 'part1'", "the solid") for w in stats["warnings"]])
        self.assertTrue(any("1 surface inside out or on the wrong side of another at the coordinates of the file"
                            in w for w in stats["warnings"]))

        outcome = self.run_checked(text + "thin + cube(1)", "a.stl")
        self.expect(outcome, 0)
        part = outcome.json()["check"][0]["parts"][0]
        self.assertEqual((part["verdict"], part["vanished"]), ("repaired", 1))
        self.assertAlmostEqual(part["volume"][1], 1, delta=0.1)  # on a grid of 2^-7 mm
        self.assert_proved("a.stl")

    def test_walls_that_vanish_in_doubles_are_said(self):
        text = "return cube(10) - cube(10):rotate(1e-7, 0, 0) + cube(3):translate(20, 0, 0)"
        outcome = self.run_checked(text, "a.obj")
        self.expect(outcome, 0)
        check = outcome.json()["check"][0]
        warnings = outcome.json()["warnings"]
        part = check["parts"][0]
        self.assertEqual(part["verdict"], "repaired")
        self.assertEqual(part["vanished"], 1)
        self.assertLess(part["thickness"], 2 * part["distance"])
        self.assertLess(part["distance"], 1e-6)
        self.assertTrue(any("; 1 connected surface less than 8.8" in w and " vanished, near (" in w
                            and "(cube, model.lua:1)" in w for w in warnings), warnings)

    def test_exact_files_have_a_verdict_of_their_own(self):
        outcome = self.run_checked("return cube(1)", "a.exact.json", "a.off")
        self.expect(outcome, 0)
        self.assertEqual(outcome.json()["check"][0], {"file": "a.exact.json", "verdict": "exact", "parts": []})
        self.assertEqual(self.verdicts(outcome)["a.off"], "clean")
        outcome = self.run_script("return cube(1)", "--check", "--stats", "-o", "a.exact.json")
        self.assertIn("a.exact.json: check: exact\n", outcome.err)

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
