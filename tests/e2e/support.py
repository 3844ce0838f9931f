"""What the end-to-end tests share: they run the real programs, and read what those wrote with readers
of their own.

The environment says what to test: CSGRUN_PROGRAM, CSGBENCH_PROGRAM, and where the shared data is,
CSGRUN_SHARED or `../shared` beside the source folder.
"""
import collections
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parent.parent
MODELS = HERE / "models"
EXAMPLES = SOURCE / "examples"
SHARED = pathlib.Path(os.environ.get("CSGRUN_SHARED") or SOURCE.parent / "shared")
PROGRAM = os.environ.get("CSGRUN_PROGRAM", str(SOURCE / "build" / "release" / "csgrun"))
BENCHMARK = os.environ.get("CSGBENCH_PROGRAM", str(SOURCE / "build" / "release" / "csgbench"))
IN_CI = os.environ.get("CI") == "true"

# A hanging program is a failure; none of these runs takes more than a few seconds.
PATIENCE_SECONDS = 600


def run(*command, cwd=None, env=None, text="", errors="strict"):
    """A finished process with its output as text; `env` is added to the environment."""
    return subprocess.run([str(word) for word in command], cwd=cwd, input=text, text=True,
                          errors=errors, capture_output=True, timeout=PATIENCE_SECONDS,
                          env={**os.environ, **(env or {})})


class Case(unittest.TestCase):
    """A test with a folder of its own, and csgrun at hand."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="csgrun-e2e-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def csgrun(self, *arguments, code=0, **options):
        done = run(PROGRAM, *arguments, **options)
        self.assertEqual(done.returncode, code, f"csgrun {arguments}: {done.stderr}")
        return done

    def stats(self, model, *arguments, **options):
        """What --stats=json says of a run that must succeed."""
        return json.loads(self.csgrun(model, "--stats=json", *arguments, **options).stdout)

    def script(self, text, *arguments, **options):
        """The same for a script given as text."""
        model = self.folder / "model.lua"
        model.write_text(text, encoding="utf-8")
        return self.stats(model, *arguments, **options)

    def info(self, path):
        return json.loads(self.csgrun("info", path, "--json").stdout)

    def assert_relative(self, value, expected, tolerance, what=""):
        if value != expected:
            error = abs(value - expected) / max(abs(value), abs(expected))
            self.assertLessEqual(error, tolerance, f"{what}: {value!r}, expected {expected!r}")


def needs_shared(folder):
    """For tests of data that is not part of the repository."""
    path = SHARED / folder
    return unittest.skipUnless(path.is_dir(), f"{path} is not there (CSGRUN_SHARED names the folder)")


def main():
    """Runs the tests of the calling script. Exit: 77 when all of them were skipped."""
    result = unittest.main(verbosity=2, exit=False).result
    if not result.wasSuccessful():
        sys.exit(1)
    sys.exit(77 if result.testsRun and len(result.skipped) == result.testsRun else 0)


class Mesh:
    """Polygons over points, as some file has them: the independent reading of the tests."""

    def __init__(self, name=""):
        self.name = name
        self.points = []
        self.faces = []
        self.materials = set()

    def unpaired_edges(self):
        """Directed edges that are there twice, or whose reverse is not there: none if closed."""
        seen, bad = set(), set()
        for face in self.faces:
            for a, b in zip(face, face[1:] + face[:1]):
                bad.update([(a, b)] if (a, b) in seen or a == b else [])
                seen.add((a, b))
        return bad | {(a, b) for a, b in seen if (b, a) not in seen}

    def unbalanced_edges(self):
        """Edges that are there more often in one direction than in the other, as a file without
        indices may have more than two triangles at an edge."""
        balance = collections.Counter()
        for face in self.faces:
            for a, b in zip(face, face[1:] + face[:1]):
                balance[min(a, b), max(a, b)] += 1 if a < b else -1
        return [edge for edge, count in balance.items() if count]

    def volume(self):
        """Exact on the file's coordinates, faces taken as fans."""
        ratios = [[c.as_integer_ratio() for c in point] for point in self.points]
        scale = max((d for point in ratios for _, d in point), default=1)
        grid = [[n * (scale // d) for n, d in point] for point in ratios]
        six_volumes = 0
        for face in self.faces:
            a = grid[face[0]]
            for i, j in zip(face[1:], face[2:]):
                b, c = grid[i], grid[j]
                six_volumes += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                                + a[2] * (b[0] * c[1] - b[1] * c[0]))
        return float(Fraction(six_volumes, 6 * scale**3))


def read_stl(path):
    """Binary STL; corners of equal coordinates are one point."""
    data = pathlib.Path(path).read_bytes()
    count, = struct.unpack_from("<I", data, 80)
    if len(data) != 84 + 50 * count:
        raise ValueError(f"{path}: {len(data)} bytes for {count} triangles")
    mesh, known = Mesh(), {}
    for triangle in range(count):
        corners = struct.unpack_from("<9f", data, 84 + 50 * triangle + 12)
        face = []
        for k in (0, 3, 6):
            point = corners[k:k + 3]
            if point not in known:
                known[point] = len(mesh.points)
                mesh.points.append(point)
            face.append(known[point])
        mesh.faces.append(face)
    return mesh


def read_off(path):
    words = pathlib.Path(path).read_text(encoding="utf-8").split("\n")
    if words[0] != "OFF":
        raise ValueError(f"{path}: {words[0]!r}")
    points, faces, _ = (int(word) for word in words[1].split())
    mesh = Mesh()
    mesh.points = [tuple(float(c) for c in line.split()) for line in words[2:2 + points]]
    for line in words[2 + points:2 + points + faces]:
        numbers = line.split()
        size = int(numbers[0])
        mesh.faces.append([int(n) for n in numbers[1:1 + size]])
    return mesh


def read_obj(path):
    """The objects of a file, each with the names of the materials that its faces have."""
    objects, points, material = [], [], None
    for line in pathlib.Path(path).read_text(encoding="utf-8").split("\n"):
        key, _, rest = line.partition(" ")
        if key == "o":
            objects.append(Mesh(rest))
        elif key == "v":
            points.append(tuple(float(c) for c in rest.split()[:3]))
        elif key == "usemtl":
            material = rest
        elif key == "f":
            objects[-1].faces.append([int(n.split("/")[0]) - 1 for n in rest.split()])
            objects[-1].materials.add(material)
    for mesh in objects:
        mesh.points = points
    return objects


def read_gltf(path):
    """The JSON of a .glb or .gltf."""
    data = pathlib.Path(path).read_bytes()
    if data[:4] == b"glTF":
        size, = struct.unpack_from("<I", data, 12)
        data = data[20:20 + size]
    return json.loads(data)
