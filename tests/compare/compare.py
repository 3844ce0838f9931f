#!/usr/bin/env python3
"""csgrun beside its peers: CGAL's Nef polyhedra and its corefinement, OpenSCAD (all of Debian) and manifold-3d
(npm), on the workloads of csgbench. Prints the table of docs/performance.md.

usage: compare.py [--repeat N] [--patience S] [--timeout S] [--without PEER] [--also NAME=PROGRAM]
                  [--pairs N --model FILE --model FILE...] [WORKLOAD...]

Every peer is given the arrays that csgrun itself has, as OFF, and its result as OFF must have csgrun's volume.
The runs of all peers take turns; the table has medians of CPU seconds (user and system), and ratios of medians:
how many times as long the peer takes as csgrun; below one, csgrun loses. A peer that took longer than
--patience CPU seconds is not run again, one that takes longer than --timeout seconds is given up.
--also measures one more program: PROGRAM union|difference once|each OUT.off IN.off..., which prints a line of
JSON with cpu_s; `each` makes one operation after the other, each result with box and volume.
--pairs measures union, difference and intersection of N random pairs of the closed models, scaled to one box, the
second turned at random: a row of geometric means.
"""
import argparse
import collections
import itertools
import json
import math
import os
import pathlib
import random
import re
import resource
import shutil
import statistics
import struct
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
BINARIES = pathlib.Path(os.environ.get("CSGRUN_BINARIES", SOURCE / "build" / "release"))
NPM = SOURCE / "tests" / "npm"
CSGRUN = "csgrun"

# What csgbench is asked for (a number is a statue of so many faces), and the same for a peer.
Workload = collections.namedtuple("Workload", "bench op asking")
WORKLOADS = {
    "rot 25K": Workload(("rot", 25000, "30"), "union", "once"),
    "rot 100K": Workload(("rot", 100000, "30"), "union", "once"),
    "rot 800K": Workload(("rot", 800000, "30"), "union", "once"),
    "chain 100": Workload(("chain", "100"), "difference", "each"),
    "batch 300": Workload(("batch", "300"), "difference", "once"),
    "batch 1000": Workload(("batch", "1000"), "difference", "once"),
    "menger 3": Workload(("menger", "3"), "difference", "once"),
    "grid 20": Workload(("grid", "20"), "union", "once"),
    "grid 40": Workload(("grid", "40"), "union", "once"),
    "cubegrid 10": Workload(("cubegrid", "10"), "union", "each"),
    "dome 300": Workload(("dome", "300"), "difference", "each"),
    "shells 12": Workload(("shells", "12"), "union", "once"),
    "common 12": Workload(("common", "12"), "intersection", "once"),
    "rods 200": Workload(("rods", "200"), "union", "once"),
    "plates 800": Workload(("plates", "800"), "union", "once"),
    "process": None,  # a block less 100 spheres: from a script to an STL file
}
LARGE = ("rot 800K",)  # only when asked for

# A peer: its program, how far its volume may be off for the digits that it keeps, and the workloads that are not
# tried since they are known to take it minutes (a Nef polyhedron of each operand) or more.
Peer = collections.namedtuple("Peer", "name command tolerance left_out", defaults=((),))
# One that takes part: run() gives CPU seconds and the volume.
Contender = collections.namedtuple("Contender", "name run tolerance")
Failure = collections.namedtuple("Failure", "reason")


class Refused(Exception):
    """The peer has no result; the message says why."""


# ---- volumes


def read_off(text):
    words = iter(re.sub(r"#.*", "", text).split())
    if next(words) != "OFF":
        raise ValueError("no OFF file")
    points, faces, _ = (int(next(words)) for _ in range(3))
    vertices = [tuple(float(next(words)) for _ in range(3)) for _ in range(points)]
    loops = [[int(next(words)) for _ in range(int(next(words)))] for _ in range(faces)]
    return [[vertices[v] for v in loop] for loop in loops]


def read_stl(data):
    if data[:5] == b"solid" and b"facet" in data[:300]:
        corners = [tuple(map(float, line.split()[1:])) for line in data.decode().splitlines()
                   if line.split()[:1] == ["vertex"]]
        return [corners[i:i + 3] for i in range(0, len(corners), 3)]
    return [(t[3:6], t[6:9], t[9:12]) for t in struct.iter_unpack("<12fH", data[84:])]


def volume(path):
    """Of the polygons of a file; about one of its points, so that few digits cancel."""
    data = pathlib.Path(path).read_bytes()
    faces = read_stl(data) if str(path).endswith(".stl") else read_off(data.decode())
    if not faces:
        return 0.0
    o = faces[0][0]
    total = 0.0
    for face in faces:
        (ax, ay, az), *rest = [(p[0] - o[0], p[1] - o[1], p[2] - o[2]) for p in face]
        for (bx, by, bz), (cx, cy, cz) in zip(rest, rest[1:]):
            total += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    return total / 6


# ---- runs


class Runner:
    """Runs programs, and keeps files beside them."""

    def __init__(self, timeout):
        self.timeout = timeout
        self.folder = BINARIES / "compare"
        self.folder.mkdir(parents=True, exist_ok=True)

    def run(self, *command):
        """What a program prints, and its CPU seconds as a whole process."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        try:
            done = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                                  timeout=self.timeout, env={**os.environ, "QT_QPA_PLATFORM": "offscreen"})
        except subprocess.TimeoutExpired:
            raise Refused(f"over {self.timeout:.0f} s") from None
        if done.returncode != 0:
            said = done.stderr.strip().split("\n")[-1].split(": ")[-1]
            raise Refused(said[:60] or f"ends with {done.returncode}")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return done.stdout, (after.ru_utime - before.ru_utime) + (after.ru_stime - before.ru_stime)

    def bench(self, workload, *options):
        words = list(workload.bench)
        if isinstance(words[1], int):
            model = self.folder / f"statue_{words[1]}.off"
            if not model.exists():
                self.run(BINARIES / "csgbench", "model", "statue", words[1], model)
            words[1] = model
        line = json.loads(self.run(BINARIES / "csgbench", *words, *options)[0])
        return line["cpu_s"], line["volume"]

    def arrays(self, name, workload, peers):
        """Those that take part in a workload of csgbench."""
        prefix = self.folder / (name.replace(" ", "_") + "_in_")
        for old in self.folder.glob(prefix.name + "*.off"):
            old.unlink()
        self.bench(workload, "--write-inputs", prefix)
        count = len(list(self.folder.glob(prefix.name + "*.off")))
        inputs = [f"{prefix}{i}.off" for i in range(count)]
        out = self.folder / "result.off"

        def peer_run(peer):
            printed, _ = self.run(*peer.command, workload.op, workload.asking, out, *inputs)
            return json.loads(printed)["cpu_s"], volume(out)
        return [Contender(CSGRUN, lambda: self.bench(workload), 0)] + [
            Contender(p.name, lambda p=p: peer_run(p), p.tolerance) for p in peers
            if name.split()[0] not in p.left_out]

    def processes(self, openscad):
        """A script each, whole processes, one thread, no cache; places to three digits are both's doubles."""
        source = random.Random(100)
        places = [f"{source.uniform(0, 100):.3f},{source.uniform(0, 100):.3f},20" for _ in range(100)]
        lua, scad = self.folder / "block.lua", self.folder / "block.scad"
        lua.write_text("local part = cube{100, 100, 20}\nfor _, p in ipairs{" +
                       ",".join(f"{{{p}}}" for p in places) + "} do\n"
                       "  part = part - sphere(1.5, {fn = 32}):translate(p[1], p[2], p[3])\nend\nreturn part\n")
        scad.write_text("difference() {\n  cube([100, 100, 20]);\n  for (p = [" +
                        ",".join(f"[{p}]" for p in places) + "]) translate(p) sphere(r = 1.5, $fn = 32);\n}\n")
        commands = [(CSGRUN, 0, lua, [BINARIES / "csgrun", "-q", "--no-cache", "--threads", "1"])]
        if openscad:
            commands.append(("OpenSCAD", 1e-5, scad, [openscad]))

        def run(model, command):
            out = self.folder / "result.stl"
            _, seconds = self.run(*command, model, "-o", out)
            return seconds, volume(out)
        return [Contender(name, lambda m=model, c=command: run(m, c), tolerance)
                for name, tolerance, model, command in commands]


def measure(contenders, repeat, patience):
    """CPU seconds by name, or a Failure; csgrun comes first. Runs take turns, volumes are compared."""
    results, truth = {c.name: [] for c in contenders}, None
    for turn in range(repeat):
        for c in contenders:
            known = results[c.name]
            if isinstance(known, Failure) or (turn > 0 and max(known) > patience):
                continue
            try:
                seconds, found = c.run()
            except Refused as why:
                if c.name == CSGRUN:
                    raise
                results[c.name] = Failure(str(why))
                continue
            truth = found if truth is None else truth
            if abs(found - truth) > max(c.tolerance, 1e-12) * abs(truth):
                if c.name == CSGRUN:
                    raise Refused(f"csgrun's volume was {truth}, and is {found}")
                results[c.name] = Failure(f"wrong volume: {found:.12g}, not {truth:.12g}")
            else:
                known.append(seconds)
    return results


def random_pairs(models, count):
    """Names and workloads of all operations of pairs of different models, always the same."""
    source = random.Random(count)
    all_pairs = list(itertools.permutations(models, 2))
    for seed in range(count):
        a, b = source.choice(all_pairs)
        for op in ("union", "difference", "intersection"):
            yield f"pair {seed} {op}", Workload(("pair", a, b, str(seed), op), op, "once")


def geometric_means(runs):
    """One result in place of several: geometric means of medians, of those peers that had all volumes right. (Their
    ratio is the geometric mean of the ratios.)"""
    means = {}
    for name in runs[0]:
        results = [run[name] for run in runs]
        failed = [result for result in results if isinstance(result, Failure)]
        means[name] = Failure(f"{failed[0].reason} ({len(failed)} of {len(results)})") if failed else [
            math.exp(statistics.fmean(math.log(statistics.median(result)) for result in results))]
    return means


# ---- the table


def digits(value):
    return f"{value:.3g}" if value < 100 else f"{value:.0f}"


def cell(peer, own):
    """Median and ratio; in bold where csgrun loses."""
    if peer is None:
        return ""
    if isinstance(peer, Failure):
        return peer.reason
    ratio = statistics.median(peer) / statistics.median(own)
    return f"{digits(statistics.median(peer))} ({f'{digits(ratio)}x' if ratio >= 1 else f'**{digits(ratio)}x**'})"


def table(results, names):
    lines = ["| workload | " + " | ".join([CSGRUN, *names]) + " |", "| --- |" + " ---: |" * (1 + len(names))]
    for workload, runs in results.items():
        own = runs[CSGRUN]
        cells = [digits(statistics.median(own)), *(cell(runs.get(name), own) for name in names)]
        lines.append(f"| {workload} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def first_line(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    return (done.stdout + done.stderr).strip().split("\n")[0]


def find_peers(also):
    """The peers that are there, and OpenSCAD; says which are not, and the versions."""
    peers, openscad, cgal = [], shutil.which("openscad"), BINARIES / "cgal_boolean"
    if cgal.exists():
        # Nef polyhedra have no volume to ask for; corefinement takes one operation after the other anyway.
        peers += [Peer("CGAL Nef", [cgal, "nef"], 1e-9,
                       ("chain", "batch", "menger", "grid", "cubegrid", "dome", "shells", "common", "rods", "plates")),
                  Peer("CGAL corefinement", [cgal, "corefine"], 1e-9)]
        print("CGAL", first_line("dpkg-query", "-W", "-f=${Version}", "libcgal-dev"), file=sys.stderr)
    else:
        print("CGAL is skipped: libcgal-dev is not installed", file=sys.stderr)
    package = NPM / "node_modules" / "manifold-3d" / "package.json"
    if package.exists() and shutil.which("node"):
        peers.append(Peer("manifold-3d", ["node", NPM / "manifold_boolean.mjs"], 1e-5))
        print("manifold-3d", json.loads(package.read_text())["version"], "on node", first_line("node", "--version"),
              file=sys.stderr)
    else:
        print("manifold-3d is skipped: the packages of tests/npm are not installed", file=sys.stderr)
    print(first_line(openscad, "--version") if openscad else "OpenSCAD is skipped: openscad is not installed",
          file=sys.stderr)
    for name, _, program in (word.partition("=") for word in also):
        peers.append(Peer(name, [program], 1e-6))
    return peers, openscad


def main(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--patience", type=float, default=10)
    parser.add_argument("--timeout", type=float, default=300)
    parser.add_argument("--without", action="append", default=[], metavar="PEER")
    parser.add_argument("--also", action="append", default=[], metavar="NAME=PROGRAM")
    parser.add_argument("--pairs", type=int, default=0, metavar="N")
    parser.add_argument("--model", action="append", default=[], metavar="FILE")
    parser.add_argument("names", nargs="*", metavar="WORKLOAD", help=", ".join(WORKLOADS))
    asked = parser.parse_args(words)
    names = asked.names or ([] if asked.pairs else [name for name in WORKLOADS if name not in LARGE])
    if asked.pairs and len(asked.model) < 2:
        sys.exit("--pairs needs models: two or more --model FILE")
    unknown = [name for name in names if name not in WORKLOADS]
    if unknown:
        sys.exit(f"there is no workload '{unknown[0]}'; there are {', '.join(WORKLOADS)}")
    runner, results = Runner(asked.timeout), {}
    peers, openscad = find_peers(asked.also)
    peers = [peer for peer in peers if peer.name not in asked.without]
    for name in names:
        print("+", name, file=sys.stderr, flush=True)
        contenders = runner.arrays(name, WORKLOADS[name], peers) if WORKLOADS[name] else runner.processes(openscad)
        results[name] = measure(contenders, asked.repeat, asked.patience)
        print(" ", results[name], file=sys.stderr, flush=True)
    if asked.pairs:
        runs = []
        for name, workload in random_pairs(asked.model, asked.pairs):
            runs.append(measure(runner.arrays(name, workload, peers), asked.repeat, asked.patience))
            print(name, *workload.bench[1:3], runs[-1], file=sys.stderr, flush=True)
        results[f"{asked.pairs} random pairs"] = geometric_means(runs)
    columns = [p.name for p in peers] + (["OpenSCAD"] if openscad else [])
    print(table(results, [c for c in columns if any(c in runs for runs in results.values())]))
    if any(isinstance(r, Failure) and r.reason.startswith("wrong") for runs in results.values() for r in runs.values()):
        sys.exit("a peer's volume differs from csgrun's")


if __name__ == "__main__":
    main(sys.argv[1:])
