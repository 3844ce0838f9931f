"""Running csgrun in a folder of its own, and looking at what it said."""
import json
import os
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest

CSGRUN = os.environ["CSGRUN"]
SOURCE = os.environ["CSGRUN_SOURCE"]
SANITIZED = b"__asan_init" in open(CSGRUN, "rb").read() or b"__tsan_init" in open(CSGRUN, "rb").read()


class Outcome:
    def __init__(self, code, out, err, seconds, cpu_seconds, peak_mb):
        self.code, self.out, self.err = code, out, err
        self.seconds, self.cpu_seconds, self.peak_mb = seconds, cpu_seconds, peak_mb
        self.first = err.split("\n")[0]

    def json(self):
        return json.loads(self.out)


class Case(unittest.TestCase):
    """A test with a folder that is gone afterwards."""

    maxDiff = None

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="csgrun_cli_")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        path = self.path(name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(text if isinstance(text, bytes) else text.encode())
        return path

    def run_csgrun(self, *arguments, stdin=b"", env=None, cwd=None, wall=120, nice=0, file_limit=None):
        """Runs csgrun in the test's folder. It must end by itself, not by a signal."""
        def prepare():
            os.nice(nice)
            if file_limit is not None:
                resource.setrlimit(resource.RLIMIT_FSIZE, (file_limit, file_limit))
        start = time.monotonic()
        out, err = tempfile.TemporaryFile(), tempfile.TemporaryFile()
        process = subprocess.Popen([CSGRUN, *arguments], cwd=cwd or self.folder, stdin=subprocess.PIPE, stdout=out,
                                   stderr=err, env={**os.environ, "XDG_CACHE_HOME": self.path("user_cache"), **(env or {})},
                                   preexec_fn=prepare)
        try:
            process.stdin.write(stdin)
            process.stdin.close()
        except BrokenPipeError:
            pass
        # wait4 tells the peak of this child alone.
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            if time.monotonic() - start > wall:
                process.kill()
                process.wait()
                self.fail(f"{arguments} did not end within {wall} s")
            time.sleep(0.002)
        process.returncode = os.waitstatus_to_exitcode(status)
        seconds = time.monotonic() - start
        texts = []
        for file in (out, err):
            file.seek(0)
            texts.append(file.read().decode(errors="replace"))
            file.close()
        self.assertGreaterEqual(process.returncode, 0, f"{arguments} was ended by a signal:\n{texts[1]}")
        return Outcome(process.returncode, texts[0], texts[1], seconds, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)

    def run_script(self, text, *arguments, **options):
        """Runs a script of this text as model.lua; asks for measures when for nothing else."""
        self.write("model.lua", text)
        return self.run_csgrun("model.lua", *(arguments or ("--stats=json",)), **options)

    def expect(self, outcome, code, start=None):
        self.assertEqual(outcome.code, code, outcome.err)
        if start is not None:
            self.assertTrue(outcome.err.startswith(start), f"{outcome.err!r} does not start with {start!r}")

    def read_glb(self, name):
        """The JSON of a GLB, without the lengths of its buffers."""
        with open(self.path(name), "rb") as file:
            data = file.read()
        gltf = json.loads(data[20:20 + struct.unpack("<I", data[12:16])[0]])
        for buffer in gltf["buffers"]:
            buffer.pop("byteLength")
        return gltf

    def left_over(self):
        """Temporary files that a run should have removed."""
        return [n for n in os.listdir(self.folder) if "tmp" in n or n.startswith(".")]


def stl(triangles, count=None):
    """A binary STL; `count` may lie."""
    import struct
    data = b"\0" * 80 + struct.pack("<I", len(triangles) if count is None else count)
    for corners in triangles:
        data += struct.pack("<12fH", 0, 0, 0, *[x for corner in corners for x in corner], 0)
    return data


A, B, C, D = (0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)
TETRAHEDRON = [(A, C, B), (A, B, D), (A, D, C), (B, C, D)]


def off(points, faces):
    lines = ["OFF", f"{len(points)} {len(faces)} 0"]
    lines += [" ".join(str(x) for x in p) for p in points]
    lines += [" ".join(str(i) for i in (len(f), *f)) for f in faces]
    return "\n".join(lines) + "\n"


def main():
    unittest.main(verbosity=1, argv=[sys.argv[0]])
