"""Projects that use the libraries: examples/cpp against an installation, and one that has csgrun as
a folder of its own."""

import json
import math
import os
import pathlib
import struct
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["CSGRUN_SOURCE"])
BUILD = os.environ["CSGRUN_BUILD"]
CMAKE = os.environ["CMAKE"]


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{command}\n{done.stdout}\n{done.stderr}")
    return done


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        cls.prefix, build = cls.folder / "prefix", cls.folder / "build"
        run(CMAKE, "--install", BUILD, "--prefix", cls.prefix)
        run(CMAKE, "-S", SOURCE / "examples/cpp", "-B", build,
            f"-DCMAKE_PREFIX_PATH={cls.prefix}", "-DCMAKE_BUILD_TYPE=Release")
        run(CMAKE, "--build", build)
        cls.program = build / "drilled_plate"

    def test_nothing_points_back(self):
        paths = list(self.prefix.rglob("*.cmake"))
        self.assertTrue(paths)
        for path in paths:
            text = path.read_text()
            self.assertNotIn(str(SOURCE), text, path)
            self.assertNotIn("-Wall", text, path)

    def test_program(self):
        done = run(self.prefix / "bin/csgrun", "--version")
        self.assertIn("csgrun", done.stdout)

    def test_example(self):
        out = self.folder / "plate.glb"
        said = run(self.program, out, 7)
        self.assertEqual(said.stderr, "")
        # A hole of 64 sides in a circle of radius 3 through 5 mm.
        base = 64 / 2 * 9 * math.sin(2 * math.pi / 64)
        side = 64 * 2 * 3 * math.sin(math.pi / 64)
        words = said.stdout.replace(",", "").split()
        self.assertAlmostEqual(float(words[1]), 8000 - 7 * base * 5, delta=1e-3)
        area = 2 * (80 * 20 + 80 * 5 + 20 * 5) - 2 * 7 * base + 7 * side * 5
        self.assertAlmostEqual(float(words[words.index("area") + 1]), area, delta=1e-3)
        self.assertEqual(words[words.index("genus") + 1], "7")
        data = out.read_bytes()
        magic, version, length = struct.unpack("<4sII", data[:12])
        self.assertEqual((magic, version, length), (b"glTF", 2, len(data)))
        size = struct.unpack("<I", data[12:16])[0]
        gltf = json.loads(data[20:20 + size])
        indices = gltf["meshes"][0]["primitives"][0]["indices"]
        self.assertEqual(gltf["accessors"][indices]["count"], 3 * int(words[-2]))

    def test_errors_are_said(self):
        nowhere = self.folder / "none/plate.glb"
        said = subprocess.run([self.program, nowhere, "1"], capture_output=True, text=True)
        self.assertEqual(said.returncode, 1)
        self.assertIn(str(nowhere), said.stderr)


class AsAFolder(unittest.TestCase):
    def test_as_a_folder(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        project, build = (pathlib.Path(scratch.name) / name for name in ("project", "build"))
        project.mkdir()
        (project / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\n"
            "project(other LANGUAGES CXX)\n"
            "set(CMAKE_EXPORT_COMPILE_COMMANDS ON)\n"
            f'add_subdirectory("{SOURCE}" csgrun)\n'
            "add_executable(other other.cpp)\n"
            "target_link_libraries(other PRIVATE csgrun::engine csgrun::export)\n")
        (project / "other.cpp").write_text("int main() {}\n")
        run(CMAKE, "-S", project, "-B", build)
        commands = json.loads((build / "compile_commands.json").read_text())
        own = [c["command"] for c in commands if c["file"].endswith("/other.cpp")]
        self.assertEqual(len(own), 1)
        self.assertIn(f"{SOURCE}/engine/include", own[0])
        for option in ("-Wall", "-Wshadow", "-ffp-contract", "-fno-tree-slp-vectorize",
                       f"-I{SOURCE} "):
            self.assertNotIn(option, own[0])
        theirs = [c["command"] for c in commands if c["file"].endswith("/gltf.cpp")]
        self.assertTrue(all("-ffp-contract=off" in c for c in theirs) and theirs)
        self.assertFalse([c for c in commands if "/tests/" in c["file"]])


if __name__ == "__main__":
    unittest.main(verbosity=2)
