"""Scripts that do not want to stop: --timeout and --max-memory."""
import os

from support import SANITIZED, Case, main

ENDLESS = {
    "loop": "while true do end",
    "loop in pcall": "while true do pcall(function() while true do end end) end",
    "loop in a coroutine": "coroutine.wrap(function() while true do pcall(error) end end)()",
    "string.find": "\nreturn ('a'):rep(40):find(('a?'):rep(40) .. ('a'):rep(40))",
    "table.move": "\ntable.move({}, 1, 1e15, 2)",
    "table.insert": "\ntable.insert(setmetatable({}, {__len = function() return 2^53 end}), 1, 5)",
    "string.rep": "\nreturn (''):rep(1e18)",
}


class Time(Case):
    def test_timeout(self):
        for name, text in ENDLESS.items():
            if name == "string.rep":
                continue  # Lua is quick here
            with self.subTest(name):
                outcome = self.run_script(text, "-o", "a.stl", "--timeout", "0.5")
                line = 2 if text[0] == "\n" else 1
                self.expect(outcome, 124, f"model.lua:{line}: ")
                self.assertIn("out of time (limit 0.5 s)", outcome.err)
                self.assertLess(outcome.seconds, 20 if SANITIZED else 4)
                self.assertEqual(self.left_over(), [])

    def test_timeout_in_evaluation(self):
        text = ("local s = sphere(10, {fn = 300})\nlocal t = s\n"
                "for i = 1, 100 do t = t - s:translate(i * 0.013, i * 0.017, i * 0.019) end\nreturn t")
        outcome = self.run_script(text, "-o", "a.stl", "--timeout", "1")
        self.expect(outcome, 124, "model.lua")
        self.assertIn("out of time (limit 1 s)", outcome.err)
        self.assertLess(outcome.seconds, 60 if SANITIZED else 8)

    def test_timeout_in_what_does_not_look_at_the_clock(self):
        """A single sphere is made ready in one go: late is late, and no file is left."""
        for arguments in (("--stats",), ("-o", "a.stl")):
            outcome = self.run_script("return sphere{5, fn = 801}", *arguments, "--timeout", "0.1", "--no-cache")
            self.expect(outcome, 124, "model.lua")
            self.assertIn("out of time (limit 0.1 s)", outcome.err)
            self.assertLess(outcome.seconds, 60 if SANITIZED else 2.5)
            self.assertEqual(self.left_over(), [])

    def test_what_a_tree_projects(self):
        """Evaluated while the file is read: out of time, or a failure of geometry, as anywhere else."""
        place = "multmatrix([[1, 0, 0, {}], [0, 1, 0, {}], [0, 0, 1, 0], [0, 0, 0, 1]])"
        ball = "sphere($fn = 300, $fa = 12, $fs = 2, r = 10);"
        slow = "".join(f"{place.format(i * 0.013, i * 0.017)} {{ {ball} }}\n" for i in range(100))
        far = f"cube(size = [1, 1, 1], center = false); {place.format(1e300, 0)} {{ {ball} }}"
        for inner, code, message in ((slow, 124, "out of time"), (far, 3, "tree.csg:1: ")):
            self.write("tree.csg", f"projection(cut = false) {{ union() {{ {inner} }} }}")
            self.write("model.lua", 'return load_csg("tree.csg")')
            for model in ("tree.csg", "model.lua"):
                with self.subTest(model=model, code=code):
                    outcome = self.run_csgrun(model, "-o", "a.svg", "--timeout", "1", "--no-cache")
                    self.expect(outcome, code, model)
                    self.assertIn(message, outcome.err)

    def test_bad_values(self):
        for value in ("0", "-1", "nan", "inf", "x", "1e12", "1e300"):
            self.expect(self.run_script("return cube(1)", "--stats", "--timeout", value), 2)
        self.expect(self.run_script("return cube(1)", "--stats", "--timeout", "1e9"), 0)


class Memory(Case):
    def test_bomb(self):
        for text in ("\nlocal t = {} for i = 1, 1e9 do t[i] = {i} end",
                     "\nlocal s = 'x' while true do s = s .. s end",
                     "\nlocal t = {} for i = 1, 1e9 do t[i] = sphere(1, {fn = 100}) end"):
            outcome = self.run_script(text, "--stats", "--max-memory", "100")
            self.expect(outcome, 1, "model.lua:2: not enough memory")
            self.assertLess(outcome.peak_mb, 1000 if SANITIZED else 180)

    def test_little_memory_is_enough_for_a_small_model(self):
        if SANITIZED:
            self.skipTest("the shadow memory of sanitizers does not fit under a limit")
        for megabytes in (16, 24, 40, 70, 100):
            with self.subTest(megabytes=megabytes):
                outcome = self.run_script("return cube(10) - cylinder{h = 30, r = 3, center = true}", "-o", "a.stl",
                                          "--max-memory", str(megabytes))
                self.assertEqual(outcome.code, 0, outcome.err)

    def test_threads_that_do_not_fit(self):
        """A model that several threads would share either fits or is told that it does not."""
        if SANITIZED:
            self.skipTest("the shadow memory of sanitizers does not fit under a limit")
        text = ("local s = cube{80, 30, 3}\nfor i = 1, 12 do\n"
                "  s = s - sphere{2, fn = 60}:translate(6 * i, 15, 3)\n  assert(s:volume() > 0)\nend\nreturn s")
        codes = []
        for megabytes in range(16, 72, 4):
            for threads in ("2", "8"):
                outcome = self.run_script(text, "-o", "a.stl", "--max-memory", str(megabytes), "--threads", threads)
                # In the script, while it is evaluated, or while the file is made.
                self.assertIn(outcome.code, (0, 1, 3, 4), outcome.err)
                self.assertIn("not enough memory" if outcome.code else "", outcome.err)
                self.assertEqual(os.path.exists(self.path("a.stl")), outcome.code == 0)
                if outcome.code == 0:
                    os.remove(self.path("a.stl"))
                codes.append(outcome.code)
        self.assertEqual(codes[-1], 0)

    def test_nodes_without_end(self):
        if SANITIZED:
            self.skipTest("the shadow memory of sanitizers does not fit under a limit")
        outcome = self.run_script("\nlocal s = cube(1) while true do s = s + s end", "--stats", "--max-memory", "200")
        self.expect(outcome, 1, "model.lua:2: not enough memory")
        self.assertLess(outcome.peak_mb, 300)

    def test_evaluation(self):
        if SANITIZED:
            self.skipTest("the shadow memory of sanitizers does not fit under a limit")
        text = ("local s, t = sphere(10, {fn = 100}), {}\n"
                "for i = 1, 2000 do t[i] = s:rotate(i, i * 7, i * 13):translate(i % 50, i % 31, 0) end\nreturn union(t)")
        outcome = self.run_script(text, "--stats", "--max-memory", "150")
        self.expect(outcome, 3)
        self.assertIn("memory", outcome.err)


if __name__ == "__main__":
    main()
