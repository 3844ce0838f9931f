"""Breaks the kernel in every place that instrument.py finds, one at a time, and asks the tests whether
they notice.

One build holds all mutants, switched by an environment variable. Each test runs alone first, without
a mutant, to learn its time and the mutants whose places would have another outcome in it. A mutant is
then tried on those tests, short ones and ones that noticed its neighbours first, until one fails,
crashes, or takes far longer than it should.

A mutant that no test notices must stand in explained.txt with the reason; otherwise the exit status is
1. Explained mutants are not tried unless asked for.
"""
import argparse
import concurrent.futures
import hashlib
import json
import math
import os
import re
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import instrument

ROOT = Path(__file__).resolve().parents[2]
WORK = ROOT / "build" / "mutate"
SOURCE, BUILD = WORK / "source", WORK / "build"
NOTICED = WORK / "noticed.jsonl"  # kept from run to run, for --resume
EXPLAINED = Path(__file__).with_name("explained.txt")
MUTATED = ("engine/exact", "engine/bsp")
PARTS = ("CMakeLists.txt", "engine", "primitives", "tests/CMakeLists.txt", "tests/unit", "tests/property",
         "tests/support", "tests/bench", "docs/numerics.md")  # what the tests below are built from
LEFT_OUT = ("tests/bench/CMakeLists.txt",)
# Executables with environment and filter, strong ones for their time first. CSGRUN_CASES thins out
# random cases: most mutants need few of them.
QUICK = (("unit_exact", {}), ("unit_bsp", {}), ("property", {"CSGRUN_CASES": "4"}),
         ("unit_mesh", {}), ("unit_csg", {}))
THOROUGH = (("property", {}),)
TOGETHER_SECONDS = 0.25  # short tests of one executable run in one process, up to this time
START_SECONDS = 0.03  # what a process costs besides
# A test of one file's mutants is worth more than its share of time.
SPECIAL, SPECIAL_TIMES = 900, 10
PLACES = WORK / "places.json"
NUMBERS = 64  # each file's mutants have numbers from a multiple of this on
MOST = 1 << 15  # kMost of mutant.h
MEMORY_BYTES = 6 << 30


class Test:
    def __init__(self, executable, environment, name, seconds, different):
        self.executable, self.environment, self.name, self.seconds = executable, environment, name, seconds
        self.different = different  # mutants that can make a difference


class Stage:
    """Tests of one executable that run in one process."""

    def __init__(self, test):
        self.tests, self.executable, self.environment = [test], test.executable, test.environment
        self.count = {}  # by file: [mutants that were tried, noticed], older ones counting less

    @property
    def seconds(self):
        return sum(t.seconds for t in self.tests)

    @property
    def name(self):
        cases = "".join(f" ({v} cases)" for v in self.environment.values())
        others = f" and {len(self.tests) - 1} more" if len(self.tests) > 1 else ""
        return f"{self.executable} {self.tests[0].name}{others}{cases}"

    def tests_for(self, mutant):
        return [t for t in self.tests if mutant.number in t.different]

    def gain(self, mutant):
        """How likely this stage is to notice the mutant, for its time."""
        tried, noticed = self.count.get(mutant.file, (0, 0))
        all_tried, all_noticed = self.count.get("", (0, 0))
        chance = (noticed + (all_noticed + 1) / (all_tried + 5)) / (tried + 1)
        return chance / (START_SECONDS + sum(t.seconds for t in self.tests_for(mutant)))

    def run(self, mutant):
        """None, or how the mutant was noticed."""
        tests = self.tests_for(mutant)
        cpu = int(2 + 6 * sum(t.seconds for t in tests))
        code = run_tests(self.executable, [t.name for t in tests], self.environment, cpu,
                         CSGRUN_MUTANT=str(mutant.number))[0]
        for key, kept in ((mutant.file, 0.9), ("", 0.99)):
            tried, noticed = self.count.get(key, (0, 0))
            self.count[key] = (kept * tried + 1, kept * noticed + (code != 0))
        if code == 0:
            return None
        if code in (-signal.SIGXCPU, -signal.SIGKILL):
            return "too long"
        return "crash" if code < 0 and code != -signal.SIGTRAP else "failure"


def run_tests(executable, tests, environment, cpu_seconds, **more):
    """Exit status (negative: signal) and CPU seconds."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (cpu_seconds, cpu_seconds + 1))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    command = [BUILD / executable, "--gtest_brief=1", "--gtest_break_on_failure",
               "--gtest_filter=" + ":".join(tests)]
    process = subprocess.Popen(command, env={**os.environ, **environment, **more}, preexec_fn=limit,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=WORK)
    # A deadlock uses no CPU time. The machine may be busy with other things: be patient.
    alarm = time.monotonic() + 60 + 20 * cpu_seconds
    while True:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        if pid:
            break
        if time.monotonic() > alarm:
            process.kill()
        time.sleep(0.002)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, usage.ru_utime + usage.ru_stime


class Places:
    """Where each file's numbers begin. With room, and kept from run to run, so that a few mutants more
    or less do not change the other files."""

    def __init__(self, kept=None):
        if kept is None:
            kept = json.loads(PLACES.read_text()) if PLACES.exists() else {}
        self.first_and_end = kept

    def first(self, name, count):
        first, end = self.first_and_end.get(name, (0, 0))
        if count > end - first:
            first = max((end for _, end in self.first_and_end.values()), default=0)
            end = -(-(first + count + NUMBERS // 4) // NUMBERS) * NUMBERS
            if end > MOST:
                PLACES.unlink(missing_ok=True)
                sys.exit("mutate: the numbers are used up; they start anew in the next run (if that does "
                         "not help: more of them, MOST here and kMost in mutant.h)")
            self.first_and_end[name] = [first, end]
        return first

    def save(self):
        WORK.mkdir(parents=True, exist_ok=True)
        PLACES.write_text(json.dumps(self.first_and_end))


def write_sources(names):
    """Copies the sources to build/mutate/source with all mutants in them; returns the mutants."""
    fresh = {}
    for part in PARTS:
        path = ROOT / part
        for file in sorted(path.rglob("*")) if path.is_dir() else [path]:
            name = file.relative_to(ROOT)
            if file.is_file() and str(name) not in LEFT_OUT and "__pycache__" not in file.parts:
                fresh[name] = file.read_bytes()
    mutants, places = [], Places()
    for name, content in fresh.items():
        if name.suffix in (".h", ".cpp") and str(name.parent) in names:
            count = instrument.count_mutants(str(name), content.decode())
            file = instrument.Instrumenter(str(name), content.decode(), places.first(str(name), count))
            fresh[name] = file.run().encode()
            instrument.number_keys(file.mutants)
            mutants += file.mutants
    places.save()
    fresh[Path("mutant.h")] = Path(__file__).with_name("mutant.h").read_bytes()
    for old in sorted(SOURCE.rglob("*")) if SOURCE.exists() else ():
        if old.is_file() and old.relative_to(SOURCE) not in fresh:
            old.unlink()
    for name, content in fresh.items():
        file = SOURCE / name
        if not file.exists() or file.read_bytes() != content:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(content)
    return mutants


def build(executables):
    # Assertions off: the tests themselves must notice. Those of the standard library make a step
    # outside an array a crash instead of a matter of luck.
    flags = "-O2 -DNDEBUG -D_GLIBCXX_ASSERTIONS -w"
    subprocess.run(["cmake", "-S", SOURCE, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None",
                    f"-DCMAKE_CXX_FLAGS={flags}", "-DCSGRUN_TESTS=ON"],
                   check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", BUILD, "--target", *executables], check=True)


def list_tests(executable):
    text = subprocess.run([BUILD / executable, "--gtest_list_tests"], check=True, text=True,
                          stdout=subprocess.PIPE, env={**os.environ, "CSGRUN_MUTANT": "16383"}).stdout
    tests, suite = [], ""
    for line in text.splitlines():
        if re.match(r"\S+\.(\s|$)", line):
            suite = line.split()[0]
        elif line.startswith("  "):
            tests.append(suite + line.split()[0])
    return [t for t in tests if "DISABLED" not in t]


def make_stages(configurations, pool, arguments):
    """Runs every test once without a mutant."""
    def measure(job):
        number, executable, environment, test = job
        trace = WORK / f"trace{number}"
        code, seconds = run_tests(executable, [test], environment, 3600,
                                     CSGRUN_MUTANT_TRACE=str(trace))
        if code:
            sys.exit(f"mutate: {executable} {test} fails without a mutant")
        different = [int(n) for n in trace.read_text().split()]
        trace.unlink()
        return seconds, different

    # Kept with the time of the executable, and only for tests that are asked for.
    saved = WORK / "tests.json"
    known = json.loads(saved.read_text()) if saved.exists() else {}
    jobs, keys = [], []
    for executable, environment in configurations:
        built = (BUILD / executable).stat().st_mtime_ns
        for name in list_tests(executable):
            if re.search(arguments.tests, f"{executable} {name}"):
                jobs.append((len(jobs), executable, environment, name))
                keys.append(json.dumps([executable, built, environment, name]))
    missing = [job for job, key in zip(jobs, keys) if key not in known]
    for job, (seconds, different) in zip(missing, pool.map(measure, missing)):
        known[keys[job[0]]] = [seconds, different]
    if missing:
        current = {(e, (BUILD / e).stat().st_mtime_ns) for e, _ in QUICK + THOROUGH if (BUILD / e).exists()}
        known = {key: value for key, value in known.items() if tuple(json.loads(key)[:2]) in current}
        saved.write_text(json.dumps(known))
    tests = [Test(*job[1:], known[key][0], set(known[key][1])) for job, key in zip(jobs, keys)]
    stages = []
    for t in tests:
        last = stages[-1] if stages else None
        special = len(t.different) < SPECIAL
        if not t.different or t.seconds > arguments.quick * (SPECIAL_TIMES if special else 1):
            continue
        if last and last.executable == t.executable and last.environment == t.environment and \
                t.seconds < TOGETHER_SECONDS / 4 and last.seconds + t.seconds < TOGETHER_SECONDS:
            last.tests.append(t)
        else:
            stages.append(Stage(t))
    if arguments.verbose:
        for s in sorted(stages, key=lambda s: s.seconds):
            print(f"{s.seconds:6.2f} s {len(set().union(*(t.different for t in s.tests))):5} mutants of {s.name}")
    return stages


def read_explained():
    """Reason by key. The file's paragraphs: `== reason` in one or more lines, then one key a line."""
    explained, reason, in_reason = {}, "", False
    for line in EXPLAINED.read_text().splitlines():
        line = line.strip()
        if line.startswith("=="):
            text = line[2:].strip()
            reason = f"{reason} {text}" if in_reason else text
            in_reason = True
        elif line and not line.startswith("#!"):
            in_reason = False
            explained[line] = reason
    return explained


def source_hash(name):
    return hashlib.sha256((ROOT / name).read_bytes()).hexdigest()


def read_noticed():
    """By key of a mutant that was noticed: the hash of its file then."""
    if not NOTICED.exists():
        return {}
    return dict(json.loads(line) for line in NOTICED.read_text().splitlines())


def choose(mutants, arguments, explained):
    chosen = [m for m in mutants if not arguments.only or any(t in m.key for t in arguments.only)]
    if arguments.again:
        survived = set(json.loads((WORK / "survivors.json").read_text()))
        chosen = [m for m in chosen if m.key in survived]
    if arguments.resume:
        before = read_noticed()
        chosen = [m for m in chosen if before.get(m.key) != source_hash(m.file)]
    if not arguments.explained:
        chosen = [m for m in chosen if m.key not in explained]
    if arguments.count and arguments.count < len(chosen):
        chosen = [chosen[i * len(chosen) // arguments.count] for i in range(arguments.count)]
    return chosen


def parse_arguments():
    parser = argparse.ArgumentParser(prog="./dev mutate", description=__doc__.split("\n\n")[0])
    parser.add_argument("count", type=int, nargs="?", help="try so many, evenly spread (default: all)")
    parser.add_argument("--only", action="append", metavar="TEXT",
                        help="those whose `file: line` has TEXT; may be given several times")
    parser.add_argument("--again", action="store_true", help="those that survived the last run")
    parser.add_argument("--resume", action="store_true",
                        help="leave out what earlier runs noticed, in files that are the same since")
    parser.add_argument("--quick", type=float, default=math.inf, metavar="SECONDS",
                        help="leave out tests that take longer (of few mutants: than ten times), and the "
                             "thorough ones")
    parser.add_argument("--tests", default="", metavar="REGEX", help="on tests of such names only")
    parser.add_argument("--program", action="append", metavar="NAME",
                        help="on tests of this executable only; may be given several times")
    parser.add_argument("--explained", action="store_true", help="try the explained ones too")
    parser.add_argument("--list", action="store_true", help="print the mutants and stop")
    parser.add_argument("--verbose", action="store_true", help="say what the tests cost")
    parser.add_argument("--nice", type=int, default=19, metavar="N",
                        help="how far to stand back for what else runs (default: 19)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    start = time.monotonic()
    mutants = write_sources(MUTATED)
    explained = read_explained()
    stale = sorted(set(explained) - {m.key for m in mutants})
    chosen = choose(mutants, arguments, explained)
    if arguments.list:
        for m in mutants:
            print(f"{m.number:5} {m.file}:{m.line}: {m.text}")
        return 0
    os.nice(arguments.nice)
    configurations = [c for c in QUICK + (THOROUGH if arguments.quick == math.inf else ())
                      if not arguments.program or c[0] in arguments.program]
    build(sorted({executable for executable, _ in configurations}))
    pool = concurrent.futures.ThreadPoolExecutor(arguments.jobs)
    stages = make_stages(configurations, pool, arguments)
    print(f"{len(mutants)} mutants, {len(explained) - len(stale)} of them explained; trying {len(chosen)} "
          f"on {sum(len(s.tests) for s in stages)} tests "
          f"({sum(s.seconds for s in stages):.0f} s of CPU without a mutant)", flush=True)

    def try_one(mutant):
        left = [s for s in stages if s.tests_for(mutant)]
        for stage in sorted(left, key=lambda s: -s.gain(mutant)):
            how = stage.run(mutant)
            if how:
                return mutant, how, stage
        return mutant, None, None

    noticed, survivors = {}, []
    for done, (mutant, how, stage) in enumerate(pool.map(try_one, chosen), 1):
        if how:
            noticed.setdefault((stage.executable, how), []).append(mutant)
            with NOTICED.open("a") as record:
                record.write(json.dumps([mutant.key, source_hash(mutant.file)]) + "\n")
            if mutant.key in explained:
                print(f"explained, but noticed by {stage.name}: {mutant.key}")
        elif mutant.key not in explained:
            survivors.append(mutant)
            different = any(s.tests_for(mutant) for s in stages)
            print(f"{mutant.file}:{mutant.line}: {'survived' if different else 'no difference'}: {mutant.text}",
                  flush=True)
        if done % 200 == 0:
            print(f"... {done} of {len(chosen)}, {time.monotonic() - start:.0f} s", flush=True)
    (WORK / "survivors.json").write_text(json.dumps([m.key for m in survivors], indent=1))

    for (executable, how), list_of in sorted(noticed.items()):
        print(f"{len(list_of):5} noticed by {executable} ({how})")
    for key in stale:
        print(f"explained.txt names what is no mutant: {key}")
    print(f"{len(mutants)} mutants: {len(chosen)} tried, {sum(map(len, noticed.values()))} noticed, "
          f"{len(survivors)} survived; {len(explained) - len(stale)} explained "
          f"({time.monotonic() - start:.0f} s)")
    return 1 if survivors or stale else 0


if __name__ == "__main__":
    sys.exit(main())
