"""The same bytes for any number of threads, in any folder, time zone and locale, on every run."""
import hashlib
import os
import subprocess

from support import CSGRUN, Case, SANITIZED, SOURCE, main

MODEL = """
local parts = {}
for name, h in pairs({zeta = 3, alpha = 5, mid = 4, [1] = 2, [2.5] = 6}) do
  parts[#parts + 1] = (cylinder(h, 2, {fn = 12}) - sphere(1.5, {fn = 10})):rotate(20, 30, 40):translate(math.random(50), h * 3, 0)
end
print(tostring({}), os == nil)
return {all = union(parts), ball = sphere(3.3):color("tomato")}
"""


class Bytes(Case):
    def digest(self, model, *arguments, env=None, cwd=None):
        outputs = [self.path(f"a.{ending}") for ending in ("glb", "stl", "obj", "off")]
        outcome = self.run_csgrun(model, *[x for o in outputs for x in ("-o", o)], *arguments, env=env, cwd=cwd)
        self.expect(outcome, 0)
        digest = hashlib.sha256()
        for output in outputs:
            with open(output, "rb") as file:
                digest.update(file.read())
            os.remove(output)
        return digest.hexdigest()

    def check(self, model):
        first = self.digest(model)
        for threads in ("1", "2", "7"):
            self.assertEqual(self.digest(model, "--threads", threads), first, threads)
        self.assertEqual(self.digest(model, "--stats"), first)
        for _ in range(10):
            self.assertEqual(self.digest(model), first)
        os.makedirs(self.path("else/where"), exist_ok=True)
        self.assertEqual(self.digest(os.path.relpath(model, self.path("else/where")), cwd=self.path("else/where")), first)
        for env in ({"TZ": "Asia/Kathmandu"}, {"LC_ALL": "de_DE.UTF-8"}, {"LANG": "tr_TR.UTF-8", "LC_NUMERIC": "de_DE"}):
            self.assertEqual(self.digest(model, env=env), first, env)

    def test_a_script_that_tries(self):
        self.check(self.write("model.lua", MODEL.replace("os == nil", "rawget(_G, 'os') == nil")))

    def test_threads_that_come_in_the_middle(self):
        """Of a model that takes long enough for several threads to begin, wherever they do."""
        model = self.write("model.lua", """
            local part = cube{100, 60, 20} - cylinder{h = 50, d = 30, fn = 48, center = true}:translate(50, 30, 0)
            for i = 1, 200 do part = part - sphere{r = 3, fn = 32}:translate(i * 7.3 % 100, i * 3.7 % 60, 20) end
            return part
        """)
        first = self.digest(model, "--threads", "1", "--no-cache")
        for threads in ("2", "3", "7") * 2:
            self.assertEqual(self.digest(model, "--threads", threads, "--no-cache"), first, threads)

    def test_questions_change_nothing(self):
        """Two cubes as one mesh of ten facets: one is on both sides of its plane, until what fills the gap comes."""
        self.write("bar.off", "OFF\n12 10 0\n" +
                   "".join(f"{x} {y} {z}\n" for x in (0, 2, 4) for y, z in ((0, 0), (2, 0), (2, 2), (0, 2))) +
                   "4 0 3 2 1\n4 8 9 10 11\n" +
                   "".join(f"4 {a + i} {a + (i + 1) % 4} {a + 4 + (i + 1) % 4} {a + 4 + i}\n"
                           for a in (0, 4) for i in range(4)))
        script = """
            local part = import("bar.off") ~ cube{1, 2, 1}:translate(0, 1, 1)
            ASK(part)
            part = part + cube{4, 2, 2}
            ASK(part)
            return part
        """
        digests = {self.digest(self.write("model.lua", f"local function ASK(part) {body} end\n{script}"), *arguments)
                   for body in ("return part:volume(), part:bbox()", "return part:mesh()",
                                "return part:area(), part:genus()", "part:mesh() part:area()", "")
                   for arguments in ((), ("--stats",))}
        self.assertEqual(len(digests), 1)

    def most_threads(self, model, threads):
        """How many threads were seen in a run."""
        process = subprocess.Popen([CSGRUN, model, "-o", self.path("a.glb"), "-q", "--threads", threads])
        most = 0
        while process.poll() is None:
            try:
                most = max(most, len(os.listdir(f"/proc/{process.pid}/task")))
            except FileNotFoundError:
                break
        self.assertEqual(process.wait(), 0)
        return most

    def test_one_thread_is_one(self):
        if SANITIZED or not os.path.isdir("/proc/self/task"):
            self.skipTest("threads cannot be counted")
        # Leaves, sums and arrays large enough that threads pay. One more thread looks at the clock.
        model = self.write("model.lua", "emit(minkowski(cube(9) - cube(4), sphere(1)))\nemit(sphere{r = 5, fn = 700})")
        self.assertLessEqual(self.most_threads(model, "1"), 2)
        self.assertGreater(self.most_threads(model, "4"), 2)
        # What takes a few milliseconds is done before others would come.
        model = self.write("model.lua", "return cube(9) - sphere{r = 3, fn = 32}")
        self.assertLessEqual(self.most_threads(model, "4"), 2)

    def test_examples(self):
        for name in ("bracket", "flush_assembly"):
            self.check(os.path.join(SOURCE, "examples", name + ".lua"))


if __name__ == "__main__":
    main()
