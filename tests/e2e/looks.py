#!/usr/bin/env python3
"""Looking at results changes nothing: random scripts that ask for the volume and the box of every value on the way
give the same bytes as when they ask for none. What was looked at is kept, and the next operation goes on from it;
without a look all operations are one.
"""
import os
import random

import support

SEED = int(os.environ.get("CSGRUN_SEED", "2026"))
COUNT = int(os.environ.get("CSGRUN_LOOKS", "50"))

HEAD = """local look = param("look", false)
local function see(p)
  if look and not p:is_empty() then
    local box = p:bbox()
    assert(p:volume() > 0 and box.max.x > box.min.x)
  end
  return p
end
"""


class Writer:
    """Writes a script."""

    def __init__(self, seed):
        self.random = random.Random(seed)

    def size(self, low, high):
        r = self.random
        return r.choice([r.randint(low, high), round(r.uniform(low, high), 2)])

    def solid(self):
        size, fn = self.size, self.random.choice([8, 12, 24])
        return self.random.choice([
            f"cube({size(1, 9)}, {size(1, 9)}, {size(1, 9)})",
            f"sphere({size(1, 6)}, {{fn = {fn}}})",
            f"cylinder{{h = {size(1, 12)}, r = {size(1, 5)}, fn = {fn}}}",
            f"cylinder{{h = {size(1, 12)}, r1 = {size(1, 5)}, r2 = {size(1, 5)}, fn = {fn}, center = true}}",
            f"(cube({size(2, 9)}, {size(2, 9)}, {size(2, 9)}) - sphere({size(1, 4)}, {{fn = {fn}}}))",
        ])

    def placed(self, solid):
        r, size = self.random, self.size
        for _ in range(r.randrange(3)):
            solid += r.choice([
                f":translate({size(-9, 9)}, {size(-9, 9)}, {size(-9, 9)})",
                f":translate({size(-9, 9)}, {size(-9, 9)}, {size(-9, 9)})",
                f":rotate({r.choice([0, 30, 90, 17.3])}, {r.choice([0, 45, 90])}, {r.choice([0, 10, 33.3])})",
                f":mirror({r.choice(['1, 0, 0', '0, 1, 0', '0, 0, 1'])})",
                f":scale({r.choice([1, 2, 0.5])}, 1, {r.choice([1, 1.5])})",
                f':color("{r.choice(["red", "blue"])}")',
            ])
        return solid

    def step(self):
        r = self.random
        # New ones, one that was there before, and the value itself at some earlier time, which others went on from.
        tool = r.choice([self.placed(self.solid()), self.placed(self.solid()), "t", self.placed("t"), self.placed("q")])
        return r.choice([
            f"p = see(p - {tool})", f"p = see(p - {tool})", f"p = see(p - {tool})", f"p = see(p + {tool})",
            f"p = see(p + {tool})", f"p = see(union{{p, {tool}, {self.placed(self.solid())}}})",
            f"p = see({tool} + p)", f"p = see(p * cube(40, {{center = true}}):translate({self.size(-9, 9)}, 0, 0))",
            f"q = p p = see({self.placed('p')})",
        ])

    def script(self):
        t = self.placed(self.solid())
        lines = [f"local p = see({self.placed(self.solid())})", "local q = p",
                 f"local t = {t if self.random.random() < 0.5 else f'see({t})'}"]
        lines += [self.step() for _ in range(self.random.randint(2, 14))]
        return HEAD + "\n".join(lines) + "\nreturn p\n"


class Looks(support.Case):

    def test_looks_change_nothing(self):
        solids = 0
        for number in range(COUNT):
            seed = SEED + number
            model, out = self.folder / "model.lua", self.folder / "model.glb"
            model.write_text(Writer(seed).script(), encoding="utf-8")
            results = []
            for look in ("false", "true"):
                done = support.run(support.PROGRAM, model, "-D", f"look={look}", "-o", out, "--no-cache", "-q")
                self.assertIn(done.returncode, (0, 3), f"seed {seed}: {done.stderr}")
                results.append((done.stderr, out.read_bytes() if done.returncode == 0 else b""))
            self.assertTrue(results[0] == results[1], f"seed {seed} (CSGRUN_SEED={seed} CSGRUN_LOOKS=1): "
                            f"{results[0][0]}{results[1][0]}\n{model.read_text(encoding='utf-8')}")
            solids += results[0][1] != b""
        self.assertGreaterEqual(solids, COUNT * 0.7)


if __name__ == "__main__":
    support.main()
