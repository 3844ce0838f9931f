"""`--check`: the verdict on what is written, and what is written then."""
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

    def test_no_output_no_check(self):
        self.expect(self.run_script("return cube(1)", "--check", "--stats"), 2,
                    "csgrun: --check proves what is written")

    def test_nothing_is_left_behind(self):
        self.expect(self.run_checked("return cube(1)", "a.stl", "no/such/b.stl"), 4, "csgrun: cannot write")
        self.assertEqual(self.left_over(), [])


if __name__ == "__main__":
    main()
