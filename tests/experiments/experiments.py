#!/usr/bin/env python3
"""The experiments of Campen & Kobbelt 2010, chapter 7, and a few more: runs csgbench, draws pictures and
writes docs/experiments.md.

usage: experiments.py [--quick] [--keep] [--up-to FACES] [NAME...]   (by default all experiments)

What an experiment measured is kept beside the programs, in experiments/, so that one of them can be run
again; the document is written from what is there. --keep does not measure again what was measured before;
--up-to leaves out larger models. --quick takes small models, writes everything to experiments/quick there,
and checks that all experiments still work.
"""
import argparse
import json
import math
import os
import pathlib
import platform
import subprocess
import sys

import pictures

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
BINARIES = pathlib.Path(os.environ.get("CSGRUN_BINARIES", SOURCE / "build" / "release"))
SHARED = pathlib.Path(os.environ.get("CSGRUN_SHARED") or SOURCE.parent / "shared") / "meshes"
CLEAN = ("c3_nefertiti.obj", "lg_armadillo.obj", "lg_bunny.off", "lg_decimated-knight.off",
         "lg_elephant.obj", "lg_fandisk.off", "lg_fertility.off", "th_112932.stl",
         "th_1514499.stl", "th_472042.stl", "th_65004.stl")
THOUSAND = 1000


class Laboratory:
    """Where things are, and how programs are run."""

    def __init__(self, quick=False, keep=False, up_to=math.inf):
        self.quick, self.up_to = quick, up_to
        self.folder = BINARIES / "experiments" / ("quick" if quick else "")
        self.images = self.folder if quick else SOURCE / "docs" / "images"
        self.document = self.folder / "experiments.md" if quick else SOURCE / "docs" / "experiments.md"
        for folder in (self.folder, self.images):
            folder.mkdir(parents=True, exist_ok=True)
        self.figures = self.folder / "figures.json"
        self.known = json.loads(self.figures.read_text()) if keep and self.figures.exists() else {}

    def run(self, program, *words):
        """What the program prints; from an earlier run if that is to be kept."""
        command = [str(BINARIES / program), *map(str, words)]
        key = " ".join(word.rsplit("/", 1)[-1] for word in command)
        if key in self.known:
            return self.known[key]
        print("+", key, file=sys.stderr, flush=True)
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}: {done.stderr}")
        if not done.stdout.strip():
            return None
        self.known[key] = json.loads(done.stdout)
        self.figures.write_text(json.dumps(self.known), encoding="utf-8")
        return self.known[key]

    def sizes(self, faces):
        """Those numbers of faces that are not too large."""
        return [n for n in faces if n <= self.up_to]

    def cgal(self, op, a, b, result):
        """CGAL's figures, or why there are none."""
        try:
            return self.run("cgal_boolean", "nef", op, "once", result, a, b)
        except RuntimeError as error:
            print(error, file=sys.stderr)
            return {"failed": "no closed manifold to CGAL" if "manifold" in str(error) else "crashed"}

    def bench(self, *words):
        return self.run("csgbench", *words)

    def model(self, name, faces):
        """A model of our own as a file."""
        path = self.folder / f"{name}_{short(faces)}.off"
        if not path.exists():
            self.bench("model", name, faces, path)
        return path

    def shared(self, *names):
        """Those of these shared models that are there, and not too large: 40 bytes a face or more."""
        paths = [SHARED / name for name in names]
        return [p for p in paths if p.exists() and p.stat().st_size <= 40 * self.up_to]

    def picture(self, name, *rows):
        """A PNG of panels: each a mesh and the options of csgpicture."""
        panels = []
        for y, row in enumerate(rows):
            panels.append([])
            for x, (mesh, *options) in enumerate(row):
                pixmap = self.folder / f"{name}_{y}_{x}.ppm"
                self.run("csgpicture", mesh, pixmap, *options)
                panels[-1].append(pixmap)
        pictures.write_png(self.images / f"{name}.png", panels)

    def has_cgal(self):
        return (BINARIES / "cgal_boolean").exists()


def short(faces):
    return f"{faces // THOUSAND}k" if faces >= THOUSAND and faces % THOUSAND == 0 else str(faces)


def seconds(value):
    return f"{value:.3g}" if value < 100 else f"{value:.0f}"


def table(head, rows):
    """Markdown, numbers to the right."""
    def is_number(column):
        return all(str(row[column])[:1] in "0123456789-" for row in rows if row[column] != "")
    marks = [" ---: " if is_number(c) else " --- " for c in range(len(head))]
    lines = ["| " + " | ".join(head) + " |", "|" + "|".join(marks) + "|"]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


# ---- 1. round trip


def measure_round_trip(lab):
    own = ([("statue", n) for n in (72, 512, 5000, 25000, 50000, 100000, 400000, 1000000)] +
           [("sieve", 15000), ("sieve", 100000), ("twins", 10000), ("twins", 200000),
            ("ring", 2000), ("ring", 50000)])
    if lab.quick:
        own = [("statue", 72), ("ring", 512)]
    files = [] if lab.quick else lab.shared(*CLEAN)
    files += [lab.model(*one) for one in own if lab.sizes(one[1:])]
    return [lab.bench("roundtrip", path) for path in files]


def tell_round_trip(lab, runs):
    rows = [(run["name"].split()[1], run["n_in_tris"] // 2, f"{run['counters']['grid_mm']:.3g}",
             "scaled and snapped" if run["counters"]["snapped"] else "exact",
             run["counters"]["hausdorff_mm"], seconds(run["cpu_s"])) for run in runs]
    return f"""## Round trip

The paper takes 25 models of 36 to 1M faces into planes, from there into BSPs, and back into polygons: in
all cases the Hausdorff distance between the vertices before and after is zero. We do the same with
{len(runs)} models (`csgbench roundtrip FILE`): every polygon of the model is cut by the labelled BSP of its
copy in every cell, trees are merged and the boundary is extracted, as the paper has it. The grid holds the
coordinates of the file exactly; a file in single precision whose numbers are spread over too many binary
digits for any grid of 27 bits is scaled by a power of two and snapped to 2^-20 mm first.

""" + table(("model", "faces", "grid, mm", "input on it", "distance", "CPU s"), rows)


# ---- 2. the smallest shift


def measure_shift(lab):
    files = lab.shared(*CLEAN[3:4]) if lab.quick else lab.shared(*CLEAN)
    own = [("ring", 512)] if lab.quick else [("statue", 2000), ("statue", 25000), ("statue", 100000),
                                             ("sieve", 15000), ("ring", 20000)]
    files += [lab.model(*one) for one in own if lab.sizes(one[1:])]
    runs = []
    for path in files:
        inputs = lab.folder / f"shift_{path.stem}_"
        result = lab.folder / f"shift_{path.stem}.off"
        run = lab.bench("ulp", path, "--write-inputs", inputs, "--write", result)
        if lab.has_cgal() and not lab.quick and run["n_in_tris"] <= 2 * 26 * THOUSAND:
            other = lab.folder / f"shift_{path.stem}_cgal.off"
            run["cgal"] = lab.cgal("difference", f"{inputs}0.off", f"{inputs}1.off", other)
            if "failed" not in run["cgal"]:
                run["distance"] = lab.run("csgdistance", result, other)
        runs.append(run)
    return runs


def tell_shift(lab, runs):
    rows = []
    for run in runs:
        cgal, distance = run.get("cgal"), run.get("distance")
        rows.append((run["name"].split()[1], run["n_in_tris"] // 2, run["n_out_tris"],
                     f"{run['volume']:.6g}", seconds(run["cpu_s"]), f"{run['rss_mb']:.0f}",
                     *((seconds(cgal["cpu_s"]), f"{cgal['rss_mb']:.0f}",
                        f"{distance['distance']:.2g}", f"{distance['distance_of_floats']:.2g}")
                       if distance else (cgal["failed"] if cgal else "", "", "", ""))))
    return """## Shifted copies

As the paper does, a copy is shifted as slightly as possible, and taken away from the original
(`csgbench ulp FILE`). The model is scaled by a power of two so that its largest coordinate lies in
[64, 128) mm and snapped to 2^-20 mm; each vertex of the copy is one unit in the last place of a float32
further along x. In the paper the result is always a closed manifold whose distance to that of CGAL is zero
when rounded to the precision of the input. Here each run proves that the result is a closed manifold, and
that its volume is exactly vol(A) - vol(A ∩ B), modulo two primes of 61 bits. The columns to the right are
CGAL's Nef polyhedra with the same input, and the largest distance from a vertex of either result to the
surface of the other: in doubles, and with both results rounded to float32 (one unit in the last place is
7.6e-6 mm at 64 mm).

""" + table(("model", "faces", "faces of A - B", "volume, mm³", "CPU s", "MB", "CGAL CPU s", "CGAL MB",
             "distance, mm", "as float32"), rows)


# ---- 3. the IPHIGENIE experiment

STATUES = (25, 50, 100, 200, 400, 800, 1600, 3200)
ANGLES = (30, 60, 90)
PAPER_CELLS = {30: (1700, 2400, 3300, 4700, 7200, 8600, 12900, 16500),
               60: (900, 1300, 1800, 2500, 3400, 4800, 7200, 9100),
               90: (700, 1000, 1300, 1800, 2500, 3400, 5200, 6500)}
PAPER_SECONDS = {30: (6.9, 10.4, 14.0, 19.1, 27.4, 40.0, 59.2, 95.8),
                 60: (4.2, 5.8, 8.4, 11.8, 16.7, 25.5, 38.1, 65.3),
                 90: (3.3, 4.6, 6.4, 8.9, 13.6, 21.0, 32.8, 56.6)}
PAPER_CGAL = {30: (17.6, 33.5, 81.3, 113.9), 60: (16.9, 31.4, 60.5, 117.0),
              90: (16.1, 31.1, 60.6, 114.0)}


def measure_turned(lab):
    sizes = [n // THOUSAND for n in lab.sizes([n * THOUSAND for n in STATUES])]
    sizes = sizes[:1] if lab.quick else sizes
    runs = {}
    for angle in ANGLES:
        runs[angle] = []
        for size in sizes:
            model = lab.model("statue", (2 if lab.quick else size) * THOUSAND)
            extra = []
            if size == (25 if lab.quick else 50) and angle == 90:
                extra = ["--write", lab.folder / "turned.off", "--write-cells",
                         lab.folder / "turned_cells.txt"]
            inputs = ["--write-inputs", lab.folder / f"turned_{angle}_"] if size == 25 else []
            run = lab.bench("rot", model, angle, *extra, *inputs)
            if size == 25 and lab.has_cgal() and not lab.quick:
                parts = [lab.folder / f"turned_{angle}_{i}.off" for i in (0, 1)]
                run["cgal"] = lab.cgal("union", *parts, lab.folder / "turned_cgal.off")
            runs[angle].append(run)
    view = ("--view", 60, 8, "--size", 300, 420, "--zoom", 0.5, 0.5, 0.5, 1.0)
    lab.picture("turned_union", [
        (lab.model("statue", (2 if lab.quick else 50) * THOUSAND), *view),
        (lab.folder / "turned.off", *view),
        (lab.folder / "turned.off", "--cells", lab.folder / "turned_cells.txt", *view)])
    return runs


def growth(runs, value):
    """The exponent of a power law through the first and the last run."""
    first, last = runs[0], runs[-1]
    if first is last:
        return "-"
    ratio = math.log(value(last) / value(first)) / math.log(last["n_in_tris"] / first["n_in_tris"])
    return f"{ratio:.2f}"


def tell_turned(lab, runs):
    rows = []
    for angle in ANGLES:
        for i, run in enumerate(runs[str(angle)]):
            counters = run["counters"]
            cgal = run.get("cgal")
            rows.append((f"{angle}°", f"{run['n_in_tris'] // 2}", counters["solved_cells"],
                         PAPER_CELLS[angle][i], seconds(counters["import_cpu_s"]),
                         seconds(counters["op_cpu_s"]), seconds(counters["export_cpu_s"]),
                         seconds(run["cpu_s"]), PAPER_SECONDS[angle][i], f"{run['rss_mb']:.0f}",
                         f"{seconds(cgal['cpu_s'])} s, {cgal['rss_mb']:.0f} MB" if cgal else "",
                         PAPER_CGAL[angle][i] if i < len(PAPER_CGAL[angle]) else "-"))
    growths = []
    for angle in ANGLES:
        these = runs[str(angle)]
        counters = [lambda r, k=k: r["counters"][k]
                    for k in ("solved_cells", "import_cpu_s", "op_cpu_s", "export_cpu_s")]
        growths.append((f"{angle}°", *(growth(these, c) for c in counters),
                        growth(these, lambda r: r["cpu_s"])))
    return """## A statue and its turned copy

The paper's figure 7: the union of a statue with a copy that is turned about the vertical through its
middle, at 25K to 3200K faces (`csgbench rot FILE ANGLE`). The IPHIGENIE model is not to be had; ours is a
bumpy upright body of the same kind (`csgbench model statue`), so the numbers of cells can be compared in
their growth only. Times are CPU seconds from arrays to arrays, the paper's are seconds on a Core i7 of
2.67 GHz.

![A statue, its union with a copy turned by 90 degrees, and the critical region in yellow](images/turned_union.png)

""" + table(("angle", "faces", "critical cells", "paper's", "import", "operation", "export", "CPU s",
             "paper's s", "MB", "CGAL", "paper's CGAL s"), rows) + """
How each phase grows, as the exponent of the number of faces from the first row to the last. The paper finds
about 0.5 for the critical cells and almost so for the time; import and export are linear of course, and are
all that is left of the growth.

""" + table(("angle", "critical cells", "import", "operation", "export", "all"), growths)


# ---- 4. repair


def measure_repair(lab):
    names = ("c3_cow.obj", "mf_self_intersectA.obj", "mf_self_intersectB.obj",
             "mf_Generic_Twin_7081.1.t0_left.obj", "mf_Generic_Twin_7081.1.t0_right.obj")
    body = lab.model("contortionist", (2 if lab.quick else 12) * THOUSAND)
    cow = lab.shared(names[0])
    files = [body] + (cow if lab.quick else lab.shared(*names))
    runs = []
    for path in files:
        hull = lab.folder / f"hull_{path.stem}.off"
        runs.append(lab.bench("hull", path, "--write", hull))
    # Whole, then cut open where it crosses itself, before and after.
    looks = [(body, ("--view", 30, 20, "--zoom", 0.5, 0.5, 0.5, 0.8),
              ("--view", 0, 0, "--cut", 0, -1, 0, 0.5, "--zoom", 0.42, 0.5, 0.3, 0.4))]
    if cow:
        looks.append((cow[0], ("--view", -20, 65, "--zoom", 0.5, 0.5, 0.5, 0.9),
                      ("--view", 0, 90, "--cut", 0, 0, 1, 0.503, "--zoom", 0.09, 0.76, 0.5, 0.22)))
    size = ("--size", 300, 250)
    rows = [[(path, *size, *whole), (path, *size, *inside),
             (lab.folder / f"hull_{path.stem}.off", *size, *inside)]
            for path, whole, inside in looks]
    lab.picture("repair", *rows)
    return runs


def tell_repair(lab, runs):
    rows = [(run["name"].split()[1], run["n_in_tris"], run["counters"]["crossings_in"],
             run["n_out_tris"], run["counters"]["crossings_out"], seconds(run["cpu_s"]))
            for run in runs]
    return """## Repair by outer hulls

The paper repairs COW (6K faces, 1.2 s) and WOMAN (12K faces, 1.9 s), whose self-intersections come from
bending parts of the model, and verifies by exact tests of triangles that nothing crosses any more. We have
the cow; for the other one we take a body of our own that is folded at neck, waist and knees
(`csgbench model contortionist`), and a few models as they are found (`csgbench hull FILE`). Crossings are
pairs of triangles that meet in more than common corners and edges, found exactly, in the file and in the
result as it is rounded to doubles.

![A folded body and a cow; cut open before and after, the curves of the cut in yellow](images/repair.png)

""" + table(("model", "faces", "crossings", "faces of the hull", "crossings left", "CPU s"), rows)


# ---- 5. front tracking


def measure_front(lab):
    sizes = (2,) if lab.quick else [n // THOUSAND for n in lab.sizes([15000, 50000, 400000])]
    steps = 6 if lab.quick else 15
    runs = [lab.bench("front", lab.model("sieve", size * THOUSAND), steps) for size in sizes]
    models = [lab.model(name, (2 if lab.quick else 15) * THOUSAND) for name in ("sieve", "twins")]
    for model in models:
        lab.bench("front", model, steps, "--write-steps", lab.folder / f"front_{model.stem}_")
    looks = [("--size", 300, 230, "--view", 30, 50, "--zoom", 0.5, 0.5, 0.5, 0.75),
             ("--size", 300, 180, "--view", 0, 15, "--zoom", 0.5, 0.5, 0.5, 0.6)]
    rows = [[(mesh, *look) for mesh in (model, *(lab.folder / f"front_{model.stem}_{step}.off"
                                                 for step in (steps // 3, steps)))]
            for model, look in zip(models, looks)]
    lab.picture("front", *rows)
    return runs


def tell_front(lab, runs):
    paper = {15: ("100", ""), 50: ("300", ""), 400: ("1600", "5200 (nine)")}
    rows = []
    for run in runs:
        steps = run["counters"]["steps"]
        calm = [s for s in steps if s["events"] == 0]
        busy = [s for s in steps if s["events"] > 0]
        first = busy[0] if busy else None
        thousands = round(run["n_in_tris"] / THOUSAND)
        nearest = min(paper, key=lambda n: abs(n - thousands))

        def mean(some):
            return f"{sum(s['cpu_ms'] for s in some) / len(some):.0f}" if some else "-"
        rows.append((run["n_in_tris"], mean(calm), paper[nearest][0],
                     f"{first['cpu_ms']:.0f} ({first['events']})" if first else "-",
                     paper[nearest][1] or "-", mean(busy), len(calm), len(busy)))
    return """## Front tracking

A closed surface moves along its vertex normals; after each step the orientation-sensitive outer hull
resolves what has come to cross (`csgbench front FILE STEPS`). The model is a plate with nine dimples on
either side (`csgbench model sieve`): moved inwards, the sides pass through each other in nine places, and
the plate has nine holes; moved outwards again they close, one by one. Times are CPU milliseconds for a step
from arrays to arrays. A step without events only pays for finding out that there are none.

![A plate, its holes, and how they close again; twins that merge](images/front.png)

""" + table(("faces", "without events", "paper's", "first with events (how many)", "paper's",
             "mean with events", "steps without", "steps with"), rows)


# ---- 6. the cell limit


def measure_cells(lab):
    model = lab.model("statue", (2 if lab.quick else 100) * THOUSAND)
    limits = (5, 17) if lab.quick else (1, 3, 5, 9, 13, 17, 25, 33, 65, 129, 257)
    return {str(m): lab.bench("rot", model, 60, "--cell-limit", m) for m in limits}


def tell_cells(lab, runs):
    rows = [(m, run["counters"]["solved_cells"], seconds(run["counters"]["op_cpu_s"]),
             f"{run['rss_mb']:.0f}") for m, run in runs.items()]
    volumes = {run["volume"] for run in runs.values()}
    if len(volumes) != 1:
        raise RuntimeError(f"the result depends on m: {volumes}")
    return """## How many polygons a cell may hold

The paper divides cells down to m polygons, with m = 17 in its experiments. The union of a statue of 100K
faces with its copy turned by 60 degrees (`csgbench rot FILE 60 --cell-limit M`); the result is the same for
every m.

""" + table(("m", "critical cells", "operation, CPU s", "MB"), rows)


EXPERIMENTS = {"roundtrip": (measure_round_trip, tell_round_trip),
               "shift": (measure_shift, tell_shift),
               "turned": (measure_turned, tell_turned),
               "repair": (measure_repair, tell_repair),
               "front": (measure_front, tell_front),
               "cells": (measure_cells, tell_cells)}


def processor():
    try:
        for line in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").split("\n"):
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.machine()


def main(words):
    parser = argparse.ArgumentParser()
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("--up-to", type=int, default=math.inf)
    parser.add_argument("names", nargs="*", metavar="NAME")
    asked = parser.parse_args(words)
    unknown = [name for name in asked.names if name not in EXPERIMENTS]
    if unknown:
        sys.exit(f"there is no experiment '{unknown[0]}'; there are {', '.join(EXPERIMENTS)}")
    lab = Laboratory(asked.quick, asked.keep, asked.up_to)
    for name in asked.names or EXPERIMENTS:
        result = EXPERIMENTS[name][0](lab)
        (lab.folder / f"{name}.json").write_text(json.dumps(result), encoding="utf-8")
    text = f"""# Experiments

What Campen and Kobbelt measured in chapter 7 of "Exact and Robust (Self-)Intersections for Polygonal
Meshes" (2010), measured again, and a few figures more. `./dev experiments` writes this page and its
pictures; `./dev experiments NAME` one part of it ({', '.join(EXPERIMENTS)}). One thread of a machine with
{processor()}; CPU seconds, as the machine was shared. Each run proves what it is about, and fails if it
does not hold.
"""
    for name, (_, tell) in EXPERIMENTS.items():
        stored = lab.folder / f"{name}.json"
        if not stored.exists():
            print(f"{name} was not measured yet: run `./dev experiments {name}`", file=sys.stderr)
            continue
        text += "\n" + tell(lab, json.loads(stored.read_text(encoding="utf-8")))
    lab.document.write_text(text, encoding="utf-8")
    print(f"wrote {lab.document}", file=sys.stderr)


if __name__ == "__main__":
    main(sys.argv[1:])
