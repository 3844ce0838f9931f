"""Every Lua block of the cookbook runs without a warning; those that say a volume have it, and so has the OpenSCAD block
beside them where OpenSCAD is installed."""
import os
import re
import shutil
import subprocess

from support import SOURCE, TETRAHEDRON, Case, main, stl

FOLDER = os.path.join(SOURCE, "docs", "cookbook")


def stl_volume(text):
    numbers = [float(x) for x in re.findall(r"vertex (\S+) (\S+) (\S+)", text) for x in x]
    total = 0
    for i in range(0, len(numbers), 9):
        p, q, r = (numbers[i + k:i + k + 3] for k in (0, 3, 6))
        total += (p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0])
                  + p[2] * (q[0] * r[1] - q[1] * r[0])) / 6
    return total


class Cookbook(Case):
    def pairs(self):
        """(OpenSCAD or None, Lua) of all pages."""
        for name in sorted(os.listdir(FOLDER)):
            with open(os.path.join(FOLDER, name), encoding="utf-8") as file:
                blocks = re.findall(r"```(\w+)\n(.*?)\n```", file.read(), re.DOTALL)
            before = None
            for language, text in blocks:
                if language == "lua":
                    yield name, before, text
                before = text if language == "openscad" else None

    def test_blocks(self):
        # What the pages read: a mesh, heights, a module of each language.
        self.write("part.stl", stl(TETRAHEDRON))
        self.write("heights.dat", "0 1 2\n1 3 1\n0 2 5\n")
        self.write("logo.svg", '<svg width="20mm" height="20mm" viewBox="0 0 20 20"><circle cx="10" cy="10" r="9"/>'
                   '<path d="M 1 1 L 19 19" stroke-width="3" stroke-linecap="butt"/>'
                   '</svg>')
        self.write("sizes.scad", "width = 3; function area(x) = x * x;")
        self.write("sizes.lua", "local width = 3 local function area(x) return x * x end return {width = width, area = area}")
        count = 0
        for name, scad, lua in self.pairs():
            count += 1
            outcome = self.run_script(lua, "--fn", "0", "--stats=json")
            self.assertEqual(outcome.code, 0, f"{name}:\n{lua}\n{outcome.err}")
            stats = outcome.json()
            self.assertEqual(stats["warnings"], [], f"{name}:\n{lua}")
            total = sum(part["volume"] for part in stats["parts"])
            said = re.search(r"-- volume (\S+)\s*$", lua)
            if said:
                self.assertAlmostEqual(total, float(said.group(1)), delta=1e-7 * total, msg=lua)
            if scad is not None and shutil.which("openscad") is not None:
                self.write("model.scad", scad)
                subprocess.run(["openscad", self.path("model.scad"), "-o", self.path("model.stl")], check=True,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                with open(self.path("model.stl")) as file:
                    self.assertAlmostEqual(stl_volume(file.read()), total, delta=2e-5 * total, msg=scad)
        self.assertGreater(count, 20)


if __name__ == "__main__":
    main()
