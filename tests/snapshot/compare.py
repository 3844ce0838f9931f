"""Runs an example and compares what it makes with its snapshot, a readable text.

usage: compare.py --csgrun PROGRAM --examples DIR --snapshots DIR (NAME | --complete | --self-test)

With CSGRUN_UPDATE_SNAPSHOTS=1 the snapshot is written instead. Every number in it is determined by the
exact result and printed in full: volumes and boxes are correctly rounded, the hash covers geometry,
faces and appearances. Nothing in it depends on the machine, the number of threads, or the time.
"""
import argparse
import difflib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile


def number(value):
    """The shortest decimal that reads back as the same double; whole numbers without a point."""
    return str(int(value)) if float(value).is_integer() and abs(value) < 1e15 else repr(float(value))


def point(values):
    return "(" + ", ".join(number(value) for value in values) + ")"


def text_of(stats, folder):
    """The snapshot of one run. `folder` is where the output went; it is cut from the warnings."""
    lines = [f"grid {number(stats['grid_mm'])} mm"]
    for part in stats["parts"]:
        lines += ["", f"part {part['name']}",
                  f"  triangles  {part['triangles']}",
                  f"  vertices   {part['vertices']}",
                  f"  faces      {part['faces']}",
                  f"  volume     {number(part['volume'])}",
                  f"  area       {number(part['area'])}"]
        if part["bbox"] is not None:
            lines += [f"  from       {point(part['bbox'][0])}", f"  to         {point(part['bbox'][1])}"]
        lines += [f"  components {part['components']}",
                  f"  genus      {part['genus']}",
                  f"  closed     {'yes' if part['closed'] else 'NO'}",
                  f"  hash       {part['hash']}"]
    if stats["warnings"]:
        lines += ["", "warnings"] + ["  " + warning.replace(folder + os.sep, "") for warning in stats["warnings"]]
    return "\n".join(lines) + "\n"


def run(csgrun, examples, name):
    """The snapshot of an example as it is now."""
    with tempfile.TemporaryDirectory(prefix="csgrun_snapshot_") as folder:
        output = os.path.join(folder, name + ".glb")
        outcome = subprocess.run([csgrun, name + ".lua", "-o", output, "--stats=json", "--quiet"], cwd=examples,
                                 capture_output=True, text=True, check=False)
        if outcome.returncode != 0:
            sys.exit(f"examples/{name}.lua ended with exit code {outcome.returncode}:\n{outcome.stderr}")
        if not os.path.exists(output):
            sys.exit(f"examples/{name}.lua wrote no file")
        return text_of(json.loads(outcome.stdout), folder)


def difference(expected, found, name):
    return "".join(difflib.unified_diff(expected.splitlines(True), found.splitlines(True),
                                        f"tests/snapshot/{name}.txt", f"examples/{name}.lua now"))


def compare(csgrun, examples, snapshots, name):
    found = run(csgrun, examples, name)
    path = snapshots / (name + ".txt")
    if os.environ.get("CSGRUN_UPDATE_SNAPSHOTS") == "1":
        path.write_text(found, encoding="utf-8")
        return
    if not path.exists():
        sys.exit(f"tests/snapshot/{name}.txt is missing; `./dev snapshots` writes it. It would hold\n\n{found}")
    changes = difference(path.read_text(encoding="utf-8"), found, name)
    if changes:
        sys.exit(f"examples/{name}.lua makes something else than its snapshot says. When that is meant,\n"
                 f"`./dev snapshots` writes the snapshots anew.\n\n{changes}")


def complete(examples, snapshots):
    """Examples, snapshots and the list in examples/README.md name the same scripts."""
    names = {path.stem for path in examples.glob("*.lua")}
    update = os.environ.get("CSGRUN_UPDATE_SNAPSHOTS") == "1"
    problems = []
    for path in sorted(snapshots.glob("*.txt")):
        if path.name != "CMakeLists.txt" and path.stem not in names:
            if update:
                path.unlink()
            else:
                problems.append(f"tests/snapshot/{path.name} has no example")
    listed = set(re.findall(r"\]\((\w+)\.lua\)", (examples / "README.md").read_text(encoding="utf-8")))
    problems += [f"examples/README.md does not list {name}.lua" for name in sorted(names - listed)]
    problems += [f"examples/README.md lists {name}.lua, which is not there" for name in sorted(listed - names)]
    if problems:
        sys.exit("\n".join(problems))


def self_test():
    """Each value that a snapshot holds makes a difference when it changes."""
    part = {"name": "a", "triangles": 12, "vertices": 8, "faces": 6, "volume": 0.1, "area": 6.0,
            "bbox": [[0.0, 0.0, 0.0], [1.0, 1.0, 0.1]], "components": 1, "genus": 0, "closed": True, "hash": "00ff"}
    stats = {"grid_mm": 1e-06, "parts": [part], "warnings": []}
    text = text_of(stats, "folder")
    assert "volume     0.1\n" in text and "to         (1, 1, 0.1)" in text, text
    assert difference(text, text_of(stats, "folder"), "a") == ""
    changes = {"name": "b", "triangles": 13, "vertices": 9, "faces": 7, "volume": 0.1 + 2**-56, "area": 6.1,
               "bbox": None, "components": 2, "genus": 1, "closed": False, "hash": "01ff"}
    for key, value in changes.items():
        other = {**stats, "parts": [{**part, key: value}]}
        assert difference(text, text_of(other, "folder"), "a"), key
    for other in ({**stats, "warnings": ["w"]}, {**stats, "grid_mm": 1e-05}, {**stats, "parts": [part, part]}):
        assert difference(text, text_of(other, "folder"), "a"), other
    warned = text_of({**stats, "warnings": [os.path.join("folder", "a.glb") + ": w"]}, "folder")
    assert "\n  a.glb: w\n" in warned, warned


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--csgrun", required=True)
    parser.add_argument("--examples", required=True, type=pathlib.Path)
    parser.add_argument("--snapshots", required=True, type=pathlib.Path)
    parser.add_argument("--complete", action="store_true")
    parser.add_argument("--self-test", action="store_true")
    parser.add_argument("name", nargs="?")
    options = parser.parse_args()
    if options.complete:
        complete(options.examples, options.snapshots)
    elif options.self_test:
        self_test()
    else:
        compare(options.csgrun, options.examples, options.snapshots, options.name)


if __name__ == "__main__":
    main()
