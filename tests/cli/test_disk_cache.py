"""Intermediate meshes on disk: the same bytes with them, and what did not change is not evaluated again."""
import os
import stat
import subprocess

from support import CSGRUN, Case, main

MODEL = """
local size = param("size", 6)
local plate = cube{40, 40, size} - cylinder{h = 50, r = 7, fn = 60, center = true}:translate(20, 20, 0)
local body = sphere{9, fn = 40}:color("tomato") - cube(10):rotate(10, 20, 30)
local tower = union{body, body:rotate(0, 0, 90):translate(0, 0, 15), body:mirror(1, 0, 0):translate(0, 0, 30)}
assert(tower:volume() > 0)
local peg = minkowski{cylinder{h = 4, r = 2, fn = 20} + cube(3), sphere{1, fn = 12}}
return {plate = plate, tower = tower:translate(60, 0, 0), peg = peg:translate(-20, 0, 0)}
"""
# Ten times as long as what is kept takes at least.
SLOW = """
local balls = {}
for i = 1, 10 do balls[i] = sphere{10, fn = 50}:rotate(17 * i, 29 * i, 0) end
return union(balls)
"""


class DiskCache(Case):
    def setUp(self):
        super().setUp()
        self.model = self.write("model.lua", MODEL)

    def run_model(self, *arguments, model=None, env=None):
        """The bytes of what is written, and the counts of nodes."""
        outcome = self.run_csgrun(model or self.model, "-o", "out.glb", "-o", "out.stl", "--stats=json", "--grid", "0.0001",
                                  *arguments, env=env)
        self.expect(outcome, 0)
        return self.written(), outcome.json()["nodes"], outcome

    def written(self, folder=""):
        data = b""
        for name in ("out.glb", "out.stl"):
            with open(self.path(folder + name), "rb") as file:
                data += file.read()
        return data

    def files(self, folder="cache"):
        path = self.path(folder)
        return sorted(os.path.join(path, name) for name in os.listdir(path)) if os.path.isdir(path) else []

    def test_the_same_bytes(self):
        without, nodes, _ = self.run_model("--no-cache")
        self.assertGreater(nodes["evaluated"], 0)
        cold, nodes, _ = self.run_model("--cache-dir", "cache")
        self.assertEqual(cold, without)
        self.assertGreater(nodes["evaluated"], 0)
        self.assertGreater(len(self.files()), 2)
        for threads in ("1", "2", "7"):
            warm, nodes, outcome = self.run_model("--cache-dir", "cache", "--threads", threads)
            self.assertEqual(warm, without)
            self.assertEqual(nodes["evaluated"], 0)
            self.assertGreater(nodes["disk"], 2)
            self.assertEqual(outcome.err, "")

    def test_an_edit(self):
        _, before, _ = self.run_model("--cache-dir", "cache")
        edited, nodes, _ = self.run_model("--cache-dir", "cache", "-D", "size=7")
        self.assertGreater(nodes["disk"], 2)
        self.assertLess(nodes["evaluated"], before["evaluated"] / 2)
        self.assertEqual(edited, self.run_model("--no-cache", "-D", "size=7")[0])

    def test_a_loop_that_goes_on(self):
        script = """
            local part = cube(20)
            for i = 1, %d do
              part = part - sphere{2, fn = 24}:translate(i * 7.3 %% 20, i * 3.1 %% 20, 20)
              assert(part:volume() < 8000)
            end
            return part
        """
        few, more = self.write("few.lua", script % 12), self.write("more.lua", script % 17)
        for model in (few, more, few, more):
            self.assertEqual(self.run_model("--cache-dir", "cache", model=model)[0],
                             self.run_model("--no-cache", model=model)[0])

    def test_meshes_that_cross_themselves(self):
        """Two tetrahedra in one mesh: what it encloses is found once."""
        self.write("star.off", "OFF\n8 8 0\n0 0 0\n4 0 0\n0 4 0\n0 0 4\n1 1 1\n-3 1 1\n1 -3 1\n1 1 -3\n"
                   "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n3 4 5 6\n3 4 7 5\n3 4 6 7\n3 5 7 6\n")
        model = self.write("star.lua", "return import('star.off')")
        first, nodes, outcome = self.run_model("--cache-dir", "cache", model=model)
        again, nodes, warm = self.run_model("--cache-dir", "cache", model=model)
        self.assertEqual(nodes["disk"], 1)
        self.assertEqual(again, first)
        self.assertIn("what is inside follows", outcome.json()["warnings"][0])
        self.assertEqual(warm.json()["warnings"], outcome.json()["warnings"])

    def test_damage(self):
        good, _, _ = self.run_model("--cache-dir", "cache")
        for i, path in enumerate(self.files()):
            with open(path, "rb") as file:
                data = file.read()
            with open(path, "wb") as file:
                half = len(data) // 2
                file.write([data[:half], b"", data[:half] + bytes([data[half] ^ 1]) + data[half + 1:], b"x" * len(data)][i % 4])
        again, nodes, outcome = self.run_model("--cache-dir", "cache")
        self.assertEqual(again, good)
        self.assertEqual(outcome.err, "")
        self.assertEqual(nodes["disk"], 0)
        self.assertEqual(self.run_model("--cache-dir", "cache")[1]["evaluated"], 0)

    def test_no_cache(self):
        self.run_model("--no-cache", "--cache-dir", "cache")
        self.assertEqual(self.files(), [])
        self.run_model("--cache-dir", "cache")
        self.assertEqual(self.run_model("--no-cache", "--cache-dir", "cache")[1]["disk"], 0)

    def test_the_folder_of_the_user(self):
        """There is what took long; what took little is not worth a file."""
        env = {"XDG_CACHE_HOME": self.path("xdg")}
        self.run_model(env=env)
        self.assertEqual(self.files("xdg/csgrun"), [])
        slow = self.write("slow.lua", SLOW)
        first, _, _ = self.run_model(model=slow, env=env)
        self.assertGreater(len(self.files("xdg/csgrun")), 0)
        again, nodes, _ = self.run_model(model=slow, env=env)
        self.assertEqual(again, first)
        self.assertGreater(nodes["disk"], 0)
        self.assertEqual(stat.S_IMODE(os.stat(self.files("xdg/csgrun")[0]).st_mode), 0o600)
        for home in ({"XDG_CACHE_HOME": "relative", "HOME": ""}, {"XDG_CACHE_HOME": "", "HOME": "/dev/null"}):
            again, nodes, outcome = self.run_model(model=slow, env=home)
            self.assertEqual((again, nodes["disk"], outcome.err), (first, 0, ""))

    def test_folders_that_are_none(self):
        self.write("file", "x")
        _, nodes, outcome = self.run_model("--cache-dir", "file/in/it")
        self.assertGreater(nodes["evaluated"], 0)
        self.assertEqual(outcome.json()["warnings"], ["the cache folder 'file/in/it' cannot be written to: Not a directory"])
        outcome = self.run_csgrun(self.model, "-o", "x.stl", "--cache-dir", "")
        self.expect(outcome, 2, "csgrun: --cache-dir needs the name of a folder")

    def test_several_at_once(self):
        good, _, _ = self.run_model("--no-cache")
        for _ in range(3):
            running = []
            for i in range(4):
                os.makedirs(self.path(f"w{i}"), exist_ok=True)
                running.append(subprocess.Popen(
                    [CSGRUN, self.model, "-o", f"w{i}/out.glb", "-o", f"w{i}/out.stl", "--grid", "0.0001", "--threads", "1",
                     "--cache-dir", "cache"], cwd=self.folder))
            self.assertEqual([process.wait() for process in running], [0] * 4)
            for i in range(4):
                self.assertEqual(self.written(f"w{i}/"), good)
        self.assertTrue(all(name.endswith(".mesh") for name in self.files()))


if __name__ == "__main__":
    main()
