#!/usr/bin/env python3
"""Checks the house: includes against the arrows, libraries in their places, sizes, stray paths.

usage: check_layers.py ROOT      prints what is wrong, one finding a line; exit 1 if there is any
       check_layers.py --self-test
"""
import os
import re
import sys
import tempfile

# What the files of a folder may include of ours. The longest matching folder decides. `own` is a
# list of prefixes of "quoted" includes, `public` of <csgrun/...> ones.
ENGINE_PUBLIC = ["csgrun/engine/"]
ARROWS = {
    "engine/include": ([], ENGINE_PUBLIC),
    "engine/base": (["engine/base/"], ["csgrun/engine/heap.h"]),
    "engine/exact": (["engine/exact/", "engine/base/"], []),
    "engine/bsp": (["engine/bsp/", "engine/exact/", "engine/base/"], ENGINE_PUBLIC),
    "engine/mesh": (["engine/mesh/", "engine/bsp/", "engine/exact/", "engine/base/"],
                    ENGINE_PUBLIC),
    "engine/csg": (["engine/csg/", "engine/bsp/", "engine/mesh/", "engine/exact/", "engine/base/"],
                   ENGINE_PUBLIC),
    "primitives": (["primitives/"], ["csgrun/primitives/"] + ENGINE_PUBLIC),
    "primitives/include": ([], ["csgrun/primitives/"] + ENGINE_PUBLIC),
    "export": (["export/"], ["csgrun/export/"] + ENGINE_PUBLIC),
    "export/include": ([], ["csgrun/export/"] + ENGINE_PUBLIC),
    "lua_bindings": (["lua_bindings/"],
                     ["csgrun/lua/", "csgrun/primitives/", "csgrun/export/"] + ENGINE_PUBLIC),
}
# Where a library may be included at all: a pattern of the header, and prefixes of files.
LIBRARIES = [
    (r"OpenMesh/", ["engine/mesh/openmesh_bridge"]),
    (r"tiny_gltf", ["export/gltf.cpp", "export/tinygltf.cpp"]),
    (r"(lua|lualib|lauxlib|luaconf)\.h(pp)?$", ["lua_bindings/", "tests/"]),
    (r"hb(-ot)?\.h$", ["primitives/text/harfbuzz.h"]),
    (r"pugixml\.hpp$", ["primitives/files/"]),
    (r"CLI/", ["lua_bindings/", "tests/"]),
    (r"minizip/", ["export/zip_file.cpp"]),
    (r"zlib\.h", ["primitives/files/unzip.cpp"]),
    (r"(gmp|gmpxx)\.h$", ["tests/"]),
    (r"boost/polygon/", ["primitives/shape2d/roof_voronoi.cpp"]),
    (r"boost/(?!polygon/)", ["tests/"]),
    (r"CGAL/", ["tests/experiments/cgal_"]),  # GPL: a peer to compare with, no part of the product
    (r"(gtest|gmock|benchmark)/", ["tests/"]),
]
SOURCES = (".h", ".hpp", ".cpp", ".cc", ".lua", ".py", ".mjs", ".sh", ".cmake")
TEXTS = SOURCES + (".md", ".txt", ".json", ".npmrc", ".yml", ".yaml")
LONGEST = 600
GENERATED = {"lua_bindings/meta/csgrun.lua"}  # by csgrun --help-api=luals
SKIPPED = {".git", "build", "node_modules", ".cache"}

# A type that headers define, by its first line; what is in a namespace of its own or in another type is
# not at the start of a line, or is not ours to tell apart.
TYPE = re.compile(r"^(?:class|struct|enum(?: class)?)\s+(\w+)(?:\s+final)?\s*(?::[^:]|\{)", re.MULTILINE)
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
# Spelled in pieces, so that this file does not find itself.
STRAY = [
    (re.compile("/" + r"work/|/" + r"farm/|/" + r"root/"), "a path of one machine"),
    (re.compile(r"https?://[^\s\"'<>]*(regis" + r"try|npm" + r"js|arti" + r"factory|nex" + r"us)"),
     "the host of a package index"),
]


def folder_rule(path):
    best = None
    for folder in ARROWS:
        if path.startswith(folder + "/") and (best is None or len(folder) > len(best)):
            best = folder
    return best


def include_findings(path, kind, header):
    """What is wrong with one include of one file."""
    for pattern, places in LIBRARIES:
        if re.match(pattern, header) and not any(path.startswith(place) for place in places):
            yield f"{header} is not for this file"
    rule = folder_rule(path)
    if rule is None:
        return  # tests and examples may look everywhere
    own, public = ARROWS[rule]
    if kind == '"':
        if not any(header.startswith(prefix) for prefix in own):
            yield f'"{header}" goes against the arrows of {rule}'
    elif header.startswith("csgrun/") and not any(header.startswith(p) for p in public):
        yield f"<{header}> goes against the arrows of {rule}"


def text_findings(path, text):
    for pattern, what in STRAY:
        for match in pattern.finditer(text):
            yield text.count("\n", 0, match.start()) + 1, f"{what}: {match.group()}"
    if path.endswith("package-lock.json") and ("://" in text or '"resolved"' in text):
        yield 1, "a lock file without addresses was agreed on"
    lines = text.count("\n")
    if path.endswith(SOURCES) and lines > LONGEST and path not in GENERATED:
        yield lines, f"longer than {LONGEST} lines"


def files_of(root):
    for folder, folders, files in os.walk(root):
        folders[:] = sorted(f for f in folders if f not in SKIPPED)
        for name in sorted(files):
            path = os.path.relpath(os.path.join(folder, name), root).replace(os.sep, "/")
            if name.endswith(TEXTS) or path in ("dev", ".ci/run", "debian/control"):
                yield path


def check(root):
    findings, count = [], 0
    types = {}  # of the product: they are linked into one program
    for path in files_of(root):
        with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
            text = file.read()
        count += 1
        findings += [f"{path}:{line}: {what}" for line, what in text_findings(path, text)]
        if path.endswith(".h") and not path.startswith("tests/"):
            for match in TYPE.finditer(text):
                other = types.setdefault(match.group(1), path)
                if other != path:
                    line = text.count("\n", 0, match.start()) + 1
                    findings.append(f"{path}:{line}: {match.group(1)} is a type of {other}, too")
        if path.endswith((".h", ".hpp", ".cpp", ".cc")):
            for match in INCLUDE.finditer(text):
                line = text.count("\n", 0, match.start(2)) + 1
                findings += [f"{path}:{line}: {what}"
                             for what in include_findings(path, match.group(1), match.group(2))]
    return findings, count


def self_test():
    """A tree of small faults: every one must be found, and nothing else."""
    good = {
        "engine/exact/point.h": '#include "engine/exact/plane.h"\n#include <array>\n',
        "engine/bsp/cell.cpp": '#include "engine/exact/plane.h"\n#include <csgrun/engine/solid.h>\n',
        "engine/mesh/openmesh_bridge.cpp": "#include <OpenMesh/Core/Mesh/Traits.hh>\n",
        "engine/mesh/tree.h": "class Tree final : public Base {\n};\nclass Leaf;\n",
        "primitives/leaf.h": "class Leaf;\nstruct Leaf::Data {\n};\n",
        "export/gltf.cpp": "#include <tiny_gltf.h>\n#include <csgrun/engine/solid.h>\n",
        "lua_bindings/bind.cpp": "#include <lua.hpp>\n#include <csgrun/export/write.h>\n",
        "tests/unit/exact/point_test.cpp": '#include <gmp.h>\n#include "engine/exact/plane.h"\n',
    }
    bad = {
        "engine/exact/up.h": '#include "engine/bsp/cell.h"\n',
        "engine/exact/edge.h": "#include <csgrun/engine/solid.h>\n",
        "engine/bsp/side.cpp": '#include "engine/mesh/triangulate.h"\n',
        "primitives/tree.h": "class Tree {\n};\n",  # one of the two of that name
        "engine/mesh/side.cpp": '#  include "engine/csg/scene.h"\n',
        "engine/csg/up.cpp": "#include <csgrun/primitives/solids.h>\n",
        "engine/include/csgrun/engine/leak.h": '#include "engine/csg/cache.h"\n',
        "engine/mesh/other.cpp": "#include <OpenMesh/Core/IO/MeshIO.hh>\n",
        "engine/csg/oracle.cpp": "#include <gmpxx.h>\n",
        "primitives/cross.cpp": "#include <csgrun/export/write.h>\n",
        "primitives/near.cpp": '#include "trig.h"\n',
        "export/private.cpp": '#include "engine/csg/cache.h"\n',
        "export/stl.cpp": '#include "tiny_gltf.h"\n',
        "lua_bindings/private.cpp": '#include "engine/bsp/kernel.h"\n',
        "primitives/long.cpp": "\n" * (LONGEST + 1),
        "docs/path.md": "see /" + "work/main\n",
        "tests/npm/package-lock.json": '{"resolved": "https:' + '//somewhere/a.tgz"}\n',
    }
    with tempfile.TemporaryDirectory() as root:
        for path, text in (good | bad).items():
            os.makedirs(os.path.dirname(os.path.join(root, path)), exist_ok=True)
            with open(os.path.join(root, path), "w", encoding="utf-8") as file:
                file.write(text)
        findings, _ = check(root)
    found = {finding.split(":")[0] for finding in findings}
    for path in sorted(set(bad) - found):
        print(f"self-test: nothing was found in {path}")
    for path in sorted(found - set(bad)):
        print(f"self-test: a false alarm in {path}")
    return found != set(bad)


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    findings, count = check(arguments[0])
    for finding in findings:
        print(finding)
    print(f"{count} files, {len(findings)} findings")
    return bool(findings) or count == 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
