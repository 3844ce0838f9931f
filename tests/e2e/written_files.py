#!/usr/bin/env python3
"""Every file that csgrun writes, under the eyes of admesh, the Khronos validator, manifold-3d, csgrun's
own `info`, and the readers of these tests.
"""
import base64
import json
import math
import os
import pathlib
import re
import struct

import support

MODELS = sorted(support.MODELS.glob("*.lua")) + sorted(support.EXAMPLES.glob("*.lua"))
ENDINGS = ("glb", "gltf", "stl", "obj", "off")
# Where 32-bit floats cannot hold the shape: far from the origin, or thinner than their step. What is
# in the file is then compared with what the file says, not with the exact solid.
COARSE = {"crossing"}

VALIDATOR = support.SOURCE / "tests" / "npm" / "validate.mjs"
PACKAGES = support.SOURCE / "tests" / "npm" / "node_modules" / "gltf-validator"
ADMESH_CLEAN = re.compile(
    r"^(Facets with \d disconnected edges? *: +0 +0|Total disconnected facets *: +0 +0"
    r"|Degenerate facets *: +0|Edges fixed *: +0|Facets (removed|added|reversed) *: +0"
    r"|Backwards edges *: +0|Normals fixed *: +0)$")
ADMESH_FINDINGS = re.compile(r"^(Facets with|Total disconnected|Degenerate|Edges fixed|Facets removed"
                             r"|Facets added|Facets reversed|Backwards|Normals fixed)")


def single(x):
    """The nearest 32-bit float."""
    return struct.unpack("<f", struct.pack("<f", x))[0]


def admesh_normal(a, b, c):
    """The normal as admesh computes it: each step in 64 bits, its result in 32."""
    u, v = ([single(y - x) for x, y in zip(a, end)] for end in (b, c))
    normal = [single(single(u[i] * v[j]) - u[j] * v[i]) for i, j in ((1, 2), (2, 0), (0, 1))]
    length = math.sqrt(sum(x * x for x in normal))
    return [single(x * (1 / length)) for x in normal] if length >= 1e-12 else [0, 0, 0]


class WrittenFiles(support.Case):
    """One run for each model writes all formats; the files are looked at by all tests."""

    @classmethod
    def setUpClass(cls):
        case = cls()
        case.setUp()
        cls.addClassCleanup(case.doCleanups)
        cls.files = case.folder
        cls.reports = {}
        for model in MODELS:
            outputs = [word for ending in ENDINGS for word in ("-o", cls.path(model, ending))]
            cls.reports[model.stem] = case.stats(model, *outputs)

    @classmethod
    def path(cls, model, ending):
        return cls.files / f"{model.stem}.{ending}"

    def parts(self, model):
        return self.reports[model.stem]["parts"]

    def test_solids_are_closed(self):
        for model in MODELS:
            with self.subTest(model.stem):
                self.assertTrue(self.parts(model))
                for part in self.parts(model):
                    self.assertTrue(part["closed"], part["name"])
                    self.assertGreater(part["volume"], 0, part["name"])

    def test_obj_has_every_part_closed_and_as_large_as_the_solid(self):
        for model in MODELS:
            with self.subTest(model.stem):
                path = self.path(model, "obj")
                meshes = support.read_obj(path)
                self.assertEqual([mesh.name for mesh in meshes],
                                 [part["name"] for part in self.parts(model)])
                materials = path.with_suffix(".mtl").read_text(encoding="utf-8")
                defined = set(re.findall(r"^newmtl (\S+)$", materials, re.M))
                for mesh, part in zip(meshes, self.parts(model)):
                    self.assertEqual(mesh.unpaired_edges(), set(), mesh.name)
                    self.assert_relative(mesh.volume(), part["volume"], 1e-9, mesh.name)
                    self.assertLessEqual(mesh.materials, defined)
                    self.assertTrue(mesh.materials, mesh.name)

    def test_off_is_closed_and_as_large_as_the_parts_together(self):
        for model in MODELS:
            with self.subTest(model.stem):
                mesh = support.read_off(self.path(model, "off"))
                self.assertEqual(mesh.unpaired_edges(), set())
                volumes = [part["volume"] for part in self.parts(model)]
                # Parts may share space, of which their union has it once.
                self.assertLessEqual(mesh.volume(), sum(volumes) * (1 + 1e-9))
                self.assertGreaterEqual(mesh.volume(), max(volumes) * (1 - 1e-9))

    def test_stl_is_closed_and_as_large_as_the_off(self):
        for model in MODELS:
            with self.subTest(model.stem):
                mesh = support.read_stl(self.path(model, "stl"))
                self.assertEqual(mesh.unbalanced_edges(), [])
                exact = support.read_off(self.path(model, "off"))
                tolerance = 1e-4 if model.stem in COARSE else 1e-6
                self.assert_relative(mesh.volume(), exact.volume(), tolerance)

    def test_stl_normals_are_rounded_step_by_step(self):
        for model in MODELS:
            with self.subTest(model.stem):
                data = self.path(model, "stl").read_bytes()
                count = (len(data) - 84) // 50
                for triangle in range(0, count, count // 500 + 1):
                    *normal, = struct.unpack_from("<3f", data, 84 + 50 * triangle)
                    corners = struct.unpack_from("<9f", data, 84 + 50 * triangle + 12)
                    self.assertEqual(normal, admesh_normal(corners[:3], corners[3:6], corners[6:]))

    def test_admesh_finds_nothing_to_repair(self):
        for model in MODELS:
            with self.subTest(model.stem):
                # It prints the header and what comes after it in its memory: any bytes.
                done = support.run("admesh", self.path(model, "stl"), errors="replace")
                self.assertEqual(done.returncode, 0, done.stderr)
                findings = [line for line in done.stdout.splitlines() if ADMESH_FINDINGS.match(line)]
                self.assertEqual(len(findings), 11, done.stdout)
                self.assertEqual([line for line in findings if not ADMESH_CLEAN.match(line)], [])

    def test_gltf_has_every_part(self):
        for model in MODELS:
            with self.subTest(model.stem):
                document = support.read_gltf(self.path(model, "glb"))
                nodes = {node["name"]: node for node in document["nodes"]}
                for part in self.parts(model):
                    name = part["name"] if part["name"] in nodes else part["name"].split("/")[-1]
                    self.assertIn("mesh", nodes[name])
                for mesh in document["meshes"]:
                    self.assertIn("EXT_mesh_manifold", mesh["extensions"])

    def test_gltf_has_one_mesh_for_parts_that_are_one_solid(self):
        document = support.read_gltf(self.files / "assembly.glb")
        legs, = [node for node in document["nodes"] if node["name"] == "legs"]
        meshes = {document["nodes"][child]["mesh"] for child in legs["children"]}
        self.assertEqual((len(legs["children"]), len(meshes)), (4, 1))

    def test_info_measures_what_was_written(self):
        for model in MODELS:
            with self.subTest(model.stem):
                solids = sum(part["volume"] for part in self.parts(model))
                meshes = {}
                for ending in ENDINGS:
                    if ending == "gltf":
                        continue  # info does not read it
                    report = self.info(self.path(model, ending))
                    self.assertEqual(pathlib.Path(report["file"]), self.path(model, ending))
                    self.assertTrue(all(part["closed"] for part in report["parts"]), ending)
                    meshes[ending] = report["parts"]
                volume = {ending: sum(part["volume"] for part in parts)
                          for ending, parts in meshes.items()}
                self.assert_relative(volume["obj"], solids, 1e-9, "obj")
                read = support.read_off(self.path(model, "off"))
                self.assert_relative(volume["off"], read.volume(), 1e-12, "off")
                read = support.read_stl(self.path(model, "stl"))
                self.assert_relative(volume["stl"], read.volume(), 1e-12, "stl")
                self.assert_relative(volume["glb"], glb_volume(self.path(model, "glb")), 1e-12, "glb")
                self.assertEqual([part["name"] for part in meshes["glb"]],
                                 [part["name"] for part in self.parts(model)])
                for mesh, part in zip(meshes["glb"], self.parts(model)):
                    for found, corner in zip(mesh["bbox"], part["bbox"]):
                        size = max(abs(c) for c in corner + part["bbox"][0])
                        self.assertLessEqual(math.dist(found, corner), 1e-6 * size, part["name"])

    def test_colours_are_linear_and_complete(self):
        document = support.read_gltf(self.files / "assembly.glb")
        surfaces = [material["pbrMetallicRoughness"] for material in document["materials"]]
        colours = {tuple(round(c, 4) for c in surface.get("baseColorFactor", (1, 1, 1, 1)))
                   for surface in surfaces}

        def linear(*srgb, alpha=1.0):
            return (*(round(c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055)**2.4, 4)
                      for c in srgb), alpha)

        self.assertLessEqual({
            linear(0.2, 0.4, 0.8), linear(0x33 / 255, 0x66 / 255, 0x99 / 255),
            linear(1, 215 / 255, 0, alpha=0.5), linear(178 / 255, 34 / 255, 34 / 255), linear(1, 1, 1)
        }, colours)
        tray, = [m for m in document["meshes"] if m["name"] == "tray"]
        self.assertEqual(len({p["material"] for p in tray["primitives"]}), 2)
        meshes = {mesh.name: mesh for mesh in support.read_obj(self.files / "assembly.obj")}
        self.assertEqual(len(meshes["tray"].materials), 2)

    def test_gltf_and_glb_are_the_same_model(self):
        for model in MODELS:
            with self.subTest(model.stem):
                glb = self.path(model, "glb")
                one, other = (support.read_gltf(glb), support.read_gltf(self.path(model, "gltf")))
                embedded = other["buffers"][0].pop("uri").partition(";base64,")[2]
                self.assertEqual(one, other)
                data = glb.read_bytes()
                size, = struct.unpack_from("<I", data, 12)
                length = one["buffers"][0]["byteLength"]
                self.assertEqual(base64.b64decode(embedded), data[20 + size + 8:][:length])

    def test_validators_find_nothing(self):
        if not PACKAGES.is_dir():
            self.assertFalse(support.IN_CI, f"{PACKAGES} is not there")
            self.skipTest(f"{PACKAGES} is not there: run npm ci in tests/npm")
        # What a .gltf says a .glb says too; one of them shows that it is well-formed.
        paths = [self.path(model, "glb") for model in MODELS] + [self.path(MODELS[0], "gltf")]
        done = support.run(os.environ.get("NODE_PROGRAM", "node"), VALIDATOR, *paths)
        reports = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual(len(reports), len(paths), done.stderr)
        for report, path in zip(reports, paths):
            with self.subTest(path.name):
                self.assertEqual((report["numErrors"], report["numWarnings"]), (0, 0), report)
                self.assertTrue(all(mesh["manifold"] for mesh in report["meshes"]), report)
                if path.suffix == ".glb":
                    self.assert_relative(report["volume"], glb_volume(path), 1e-6, "of the file")
                if path.stem not in COARSE:
                    volume = sum(part["volume"] for part in self.reports[path.stem]["parts"])
                    self.assert_relative(report["volume"], volume, 1e-6, "of the solids")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_rounding_is_told(self):
        """Of a model whose faces are thinner than 32-bit floats can tell apart."""
        warnings = "\n".join(self.reports["imported"]["warnings"])
        for ending in ("glb", "gltf", "stl"):
            self.assertRegex(warnings, rf"imported\.{ending}: \d+ triangles .* thinner than the file's")
        self.assertNotRegex(warnings, r"imported\.(obj|off)")
        self.assertEqual(self.reports["touching"]["warnings"], [])


def glb_volume(path):
    """Of a GLB, exactly, from the indices of the manifold; nodes but for the wrapper may only move."""
    data = path.read_bytes()
    json_size, = struct.unpack_from("<I", data, 12)
    binary = 20 + json_size + 8
    document = support.read_gltf(path)

    def view(index, extra=0):
        return binary + document["bufferViews"][index].get("byteOffset", 0) + extra

    def values(start, form, count):
        return struct.unpack_from(f"<{count}{form}", data, start)

    total = 0.0
    for node in document["nodes"]:
        if "mesh" not in node:
            continue
        mesh = document["meshes"][node["mesh"]]
        manifold = mesh["extensions"]["EXT_mesh_manifold"]
        positions = document["accessors"][manifold["manifoldPrimitive"]["attributes"]["POSITION"]]
        indices = document["accessors"][manifold["manifoldPrimitive"]["indices"]]
        start = view(positions["bufferView"], positions.get("byteOffset", 0))
        numbers = values(start, "f", 3 * positions["count"])
        corners = list(values(view(indices["bufferView"], indices.get("byteOffset", 0)), "I",
                              indices["count"]))
        if "sparse" in indices:
            sparse = indices["sparse"]
            where, what = (values(view(sparse[key]["bufferView"], sparse[key].get("byteOffset", 0)),
                                  "I", sparse["count"]) for key in ("indices", "values"))
            for i, value in zip(where, what):
                corners[i] = value
        solid = support.Mesh(mesh["name"])
        solid.points = [numbers[i:i + 3] for i in range(0, len(numbers), 3)]
        solid.faces = [corners[i:i + 3] for i in range(0, len(corners), 3)]
        if solid.unpaired_edges():
            raise AssertionError(f"{path}: {mesh['name']} is not closed")
        total += solid.volume()
    return total


if __name__ == "__main__":
    support.main()
