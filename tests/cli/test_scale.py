"""Long chains in a stack of 8 MB."""
import resource

from support import Case, main


class Chains(Case):
    def setUp(self):
        super().setUp()
        resource.setrlimit(resource.RLIMIT_STACK, (8 << 20, resource.getrlimit(resource.RLIMIT_STACK)[1]))

    def test_100000_unions(self):
        # Every tenth lies elsewhere: the chain is long, the geometry small.
        text = ("local x = {} for i = 1, 10 do x[i] = cube(1):translate(2 * i, 0, 0) end\n"
                "local s = x[1] for i = 1, 100000 do s = s + x[i % 10 + 1] end return s")
        outcome = self.run_script(text)
        self.expect(outcome, 0)
        self.assertEqual(outcome.json()["parts"][0]["volume"], 10)

    def test_100000_translates(self):
        outcome = self.run_script("local s = cube(1) for i = 1, 100000 do s = s:translate(0.001, 0, 0) end return s")
        self.expect(outcome, 0)
        self.assertAlmostEqual(outcome.json()["parts"][0]["bbox"][0][0], 100, places=6)

    def test_copies_beyond_the_grid(self):
        # Each step doubles what the one before has, most of it far outside of the plate.
        text = ("local plate, t = cube(100, 100, 5, true), cylinder{h = 5, r = 6, fn = 12, center = true}:translate(20, 10, 0)\n"
                "for i = 1, 12 do t = plate * (t + t:translate(40 * (-1) ^ i, -23, 0)) %s end return t")
        coarse = self.run_script(text % "", "--stats=json", "--grid", "0.000008").json()["parts"][0]
        for look in ("", "t:volume()"):
            outcome = self.run_script(text % look, "--stats=json")
            self.expect(outcome, 0)
            self.assertLess(outcome.json()["nodes"]["evaluated"], 1000)  # 2^12 copies of a cylinder
            self.assertEqual(outcome.json()["parts"][0]["volume"], coarse["volume"])

    def test_nested_tables(self):
        outcome = self.run_script("local t = {} for i = 1, 100000 do t = {t} end return t")
        self.expect(outcome, 1, "model.lua:1: groups of parts are nested too deep")

    def test_deep_recursion(self):
        outcome = self.run_script("local function f(n) return 1 + f(n + 1) end return f(1)")
        self.expect(outcome, 1, "model.lua:1: stack overflow")


if __name__ == "__main__":
    main()
