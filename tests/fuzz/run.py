#!/usr/bin/env python3
"""Runs the libFuzzer targets for a while each; ./dev fuzz calls it.

usage: run.py BUILD TREEFUZZ MINUTES [TARGET...]
       BUILD: the folder of the preset "fuzz"; TREEFUZZ: that program, for the target "trees"

Targets run two at a time. What a target learns is kept in BUILD/corpus/TARGET and used the next
time. A finding is made small and kept as tests/fuzz/regress/TARGET/..., which every later test run
replays; its report is in BUILD/logs. Exit status: 0 without findings, 1 with, 2 for wrong usage.
"""
import concurrent.futures
import hashlib
import os
import pathlib
import re
import secrets
import signal
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
AT_A_TIME = 2
SECONDS_PER_INPUT = 60
MEMORY_MB = 4096
LONGEST_INPUT = {"kernel": 128, "mesh": 512, "number": 64, "definition": 256}  # others: 4096
SECONDS_TO_SHRINK = 120
SECONDS_PER_STEP = 15
# A script that does not stop by itself ends the process with this code, as it must.
OUT_OF_TIME = 124
ENVIRONMENT = dict(os.environ, ASAN_OPTIONS="detect_leaks=1:allocator_may_return_null=1",
                   UBSAN_OPTIONS="print_stacktrace=1")


class Target:
    def __init__(self, build, name):
        self.name = name
        self.program = build / f"fuzz_{name}"
        self.learned = build / "corpus" / name
        self.artifacts = build / "found" / name
        self.log = build / "logs" / f"{name}.log"
        for folder in (self.learned, self.artifacts, self.log.parent):
            folder.mkdir(parents=True, exist_ok=True)
        self.executions = self.coverage = self.features = 0
        self.kept = []

    def options(self):
        options = [f"-timeout={SECONDS_PER_INPUT}", f"-rss_limit_mb={MEMORY_MB}",
                   f"-max_len={LONGEST_INPUT.get(self.name, 4096)}", "-len_control=20",
                   f"-artifact_prefix={self.artifacts}/", "-print_final_stats=1"]
        words = HERE / "dict" / f"{self.name}.dict"
        return options + ([f"-dict={words}"] if words.exists() else [])

    def run(self, minutes):
        """Fuzzes until the time is over, also after findings."""
        end = time.monotonic() + 60 * minutes
        seeds = [str(f) for f in (HERE / "corpus" / self.name, HERE / "regress" / self.name) if f.is_dir()]
        self.log.write_text("")
        while (left := int(end - time.monotonic())) > 0:
            for old in self.artifacts.iterdir():
                old.unlink()
            command = [self.program, *self.options(), f"-max_total_time={left}", self.learned, *seeds]
            with open(self.log, "a", encoding="utf-8") as log:
                begin = log.tell()
                status = subprocess.run(command, stdout=log, stderr=log, env=ENVIRONMENT, check=False).returncode
            self.read_statistics(begin)
            if status in (0, OUT_OF_TIME):
                continue
            findings = sorted(f for f in self.artifacts.iterdir() if not f.name.startswith("slow-unit"))
            if not findings:
                raise RuntimeError(f"{self.name}: ended with status {status}, see {self.log}")
            self.keep(findings[0])
            if len(self.kept) >= 5:  # the same again and again: somebody has to look at it first
                break
        return self

    @property
    def found(self):
        return bool(self.kept)

    def summary(self):
        return (f"{self.executions} executions, coverage {self.coverage}, features {self.features}, "
                f"findings {len(self.kept)}")

    def read_statistics(self, begin):
        last = 0
        with open(self.log, encoding="utf-8", errors="replace") as log:
            log.seek(begin)
            for line in log:
                if match := re.match(r"#(\d+)\s.*cov: (\d+) ft: (\d+)", line):
                    last, self.coverage, self.features = map(int, match.groups())
                if match := re.match(r"stat::number_of_executed_units:\s*(\d+)", line):
                    last = int(match[1])
        self.executions += last

    def keep(self, finding):
        """Makes the input small and stores it with the sources."""
        small = self.artifacts / "small"
        kind = finding.name.split("-")[0]
        if kind in ("crash", "leak"):
            # Every smaller one is written anew; the last that still fails is the result.
            command = [self.program, *self.options(), "-minimize_crash=1", f"-max_total_time={SECONDS_PER_STEP}",
                       f"-exact_artifact_path={small}", finding]
            with open(self.log, "a", encoding="utf-8") as log:
                shrinking = subprocess.Popen(command, stdout=log, stderr=log, env=ENVIRONMENT, start_new_session=True)
                try:
                    shrinking.wait(SECONDS_TO_SHRINK)
                except subprocess.TimeoutExpired:
                    os.killpg(shrinking.pid, signal.SIGKILL)  # it runs each step in a process of its own
                    shrinking.wait()
        data = (small if small.exists() else finding).read_bytes()
        name = f"{kind}-{hashlib.sha1(data).hexdigest()[:10]}"
        folder = HERE / "regress" / self.name
        folder.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(data)
        self.kept.append(folder / name)
        print(f"FINDING in {self.name}: {len(data)} bytes, kept as tests/fuzz/regress/{self.name}/{name}\n"
              f"  replay: {self.program} {folder / name}\n  report: {self.log}", flush=True)


class Trees:
    """Random trees against the reference. The program shrinks what differs and prints it."""

    name = "trees"

    def __init__(self, build, program):
        self.program = program
        self.log = build / "logs" / "trees.log"
        self.log.parent.mkdir(parents=True, exist_ok=True)
        self.found = False
        self.last_line = ""

    def run(self, minutes):
        seed = secrets.randbits(63)
        with open(self.log, "w", encoding="utf-8") as log:
            command = [self.program, "--seed", str(seed), "--minutes", f"{minutes:g}"]
            status = subprocess.run(command, stdout=log, stderr=log, check=False).returncode
        lines = self.log.read_text(encoding="utf-8", errors="replace").strip().split("\n")
        self.last_line = lines[-1]
        if status != 0:
            self.found = True
            print(f"FINDING in trees: see {self.log}; keep the case that it ends with in tests/property/cases",
                  flush=True)
        return self

    def summary(self):
        return self.last_line


def main():
    if len(sys.argv) < 4:
        print(__doc__, file=sys.stderr)
        return 2
    build = pathlib.Path(sys.argv[1]).resolve()
    minutes = float(sys.argv[3])
    known = sorted(p.stem for p in (HERE / "targets").glob("*.cpp")) + [Trees.name]
    names = sys.argv[4:] or known
    for name in names:
        if name not in known:
            print(f"fuzz: there is no target '{name}'; there are {', '.join(known)}", file=sys.stderr)
            return 2
    print(f"{len(names)} targets, {minutes:g} minutes each, {AT_A_TIME} at a time", flush=True)
    targets = []
    with concurrent.futures.ThreadPoolExecutor(AT_A_TIME) as pool:
        running = []
        for name in names:
            target = Trees(build, sys.argv[2]) if name == Trees.name else Target(build, name)
            running.append(pool.submit(target.run, minutes))
        for done in concurrent.futures.as_completed(running):
            targets.append(done.result())
            print(f"{targets[-1].name}: {targets[-1].summary()}", flush=True)
    return 1 if any(target.found for target in targets) else 0


if __name__ == "__main__":
    sys.exit(main())
