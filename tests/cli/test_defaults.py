"""The same scripts with nothing but the defaults: 60 s for the script, 1 GB for the Lua heap.

They wait for a minute side by side, and politely: the limit is time on the wall.
"""
import threading

from support import Case, main
from test_budgets import ENDLESS


class Defaults(Case):
    def test_time(self):
        names = ("loop in pcall", "string.find", "table.move")
        outcomes = {}

        def run(name):
            file = name.replace(" ", "_") + ".lua"
            self.write(file, ENDLESS[name])
            outcomes[name] = (file, self.run_csgrun(file, "-o", "a.stl", nice=19, wall=100))

        threads = [threading.Thread(target=run, args=(name,)) for name in names]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(outcomes), len(names))
        for name, (file, outcome) in outcomes.items():
            line = 2 if ENDLESS[name][0] == "\n" else 1
            self.expect(outcome, 124, f"{file}:{line}: ")
            self.assertIn("out of time (limit for the script 60 s)", outcome.err)
            self.assertGreaterEqual(outcome.seconds, 60)
            self.assertLess(outcome.seconds, 75)

    def test_memory(self):
        outcome = self.run_script("\nlocal s = ('x'):rep(2^20) local t = {} while true do t[#t + 1] = s .. #t end", "--stats")
        self.expect(outcome, 1, "model.lua:2: not enough memory (script limit 1024 MB)")
        self.assertLess(outcome.peak_mb, 2500)


if __name__ == "__main__":
    main()
