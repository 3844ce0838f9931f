"""Files as other programs write them: variants of the formats that csgrun itself never writes."""
import base64
import json
import re
import struct
import zlib

from support import Case, main

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
PRODUCTION = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06"
RELATIONS = ('<Relationships><Relationship Target="/3D/m.model" Id="r" '
             'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>')
POINTS = ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))  # a sixth of a unit cube
FACES = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))
MESH = ("<mesh><vertices>" + "".join('<vertex x="%d" y="%d" z="%d"/>' % p for p in POINTS) + "</vertices><triangles>"
        + "".join('<triangle v1="%d" v2="%d" v3="%d"/>' % f for f in FACES) + "</triangles></mesh>")
TETRAHEDRON = f'<object id="1">{MESH}</object>'


def zip64(files, front=b"", wrong_checksum=False):
    """A zip file all of whose sizes and offsets stand in the fields of Zip64, as some libraries write every one."""
    data, directory = b"", b""
    for name, text in files.items():
        name, text = name.encode(), text.encode()
        packer = zlib.compressobj(wbits=-15)
        packed = packer.compress(text) + packer.flush()
        check = zlib.crc32(text) ^ wrong_checksum
        sizes = struct.pack("<QQ", len(text), len(packed))
        extra = struct.pack("<HH", 1, 16) + sizes
        offset = len(data)
        common = struct.pack("<HHHHHIII", 45, 0, 8, 0, 0, check, 0xffffffff, 0xffffffff)
        data += b"PK\3\4" + common + struct.pack("<HH", len(name), len(extra)) + name + extra + packed
        extra = struct.pack("<HHB", 0x5455, 1, 7) + struct.pack("<HH", 1, 24) + sizes + struct.pack("<Q", offset)
        directory += (b"PK\1\2" + struct.pack("<H", 45) + common + struct.pack("<HHHHHII", len(name), len(extra), 0, 0, 0, 0,
                                                                                0xffffffff) + name + extra)
    end = b"PK\6\6" + struct.pack("<QHHIIQQQQ", 44, 45, 45, 0, 0, len(files), len(files), len(directory), len(data))
    locator = b"PK\6\7" + struct.pack("<IQI", 0, len(front) + len(data) + len(directory), 1)
    last = b"PK\5\6" + struct.pack("<HHHHIIH", 0, 0, 0xffff, 0xffff, 0xffffffff, 0xffffffff, 4) + b"note"
    return front + data + directory + end + locator + last


def model(resources, build="", unit="millimeter"):
    return (f'<model unit="{unit}" xmlns="{CORE}" xmlns:p="{PRODUCTION}"><resources>{resources}</resources>'
            f"<build>{build}</build></model>")


def gltf(primitives, accessors, data, **more):
    """A document whose only mesh is at its root: views of the data are (offset, length) or (offset, length, stride)."""
    views = more.pop("views", [(0, len(data))])
    return {"asset": {"version": "2.0"}, "buffers": [{"byteLength": len(data)}], "nodes": [{"mesh": 0}],
            "bufferViews": [{"buffer": 0, "byteOffset": v[0], "byteLength": v[1], **({"byteStride": v[2]} if v[2:] else {})}
                            for v in views],
            "accessors": accessors, "meshes": [{"primitives": primitives}], **more}


class Foreign(Case):
    def parts_of(self, name, data, warnings=0):
        self.write(name, data)
        outcome = self.run_csgrun(name, "--stats=json")
        self.expect(outcome, 0)
        stats = outcome.json()
        self.assertEqual(len(stats["warnings"]), warnings, stats["warnings"])
        self.warnings = stats["warnings"]
        return [(p["name"], round(p["volume"], 9), p["bbox"]) for p in stats["parts"]]

    def refuse(self, name, data, message):
        self.write(name, data)
        start = message if message.startswith(name) else name + ": " + message
        self.expect(self.run_csgrun(name, "--stats"), 1, start)

    UNIT = [[0, 0, 0], [1, 1, 1]]
    SIXTH = round(1 / 6, 9)

    def test_zip64(self):
        files = {"3D/m.model": model(TETRAHEDRON, '<item objectid="1"/>'), "_rels/.rels": RELATIONS}
        self.assertEqual(self.parts_of("a.3mf", zip64(files)), [("part1", self.SIXTH, self.UNIT)])
        self.refuse("a.3mf", zip64(files, wrong_checksum=True), "_rels/.rels: the zip file is damaged")
        self.refuse("a.3mf", zip64(files)[:-30], "it is no zip file, or a truncated one")

    def test_paths_in_archives(self):
        files = {"3d\\M.model": model(TETRAHEDRON, '<item objectid="1"/>'), "_RELS/.rels": RELATIONS}
        self.assertEqual(self.parts_of("a.3mf", zip64(files)), [("part1", self.SIXTH, self.UNIT)])

    def test_models_in_several_documents(self):
        # What slicers write: objects stand in documents of their own, which number them anew and have their own units.
        root = model('<object id="1" name="both"><components><component objectid="1" p:path="/3D/inner/a.model"/><component '
                     'objectid="2" p:path="/3D/b.model" transform="1 0 0 0 1 0 0 0 1 5 0 0"/></components></object>',
                     '<item objectid="1" transform="2 0 0 0 2 0 0 0 2 0 0 10"/><item objectid="2" p:path="/3D/b.model"/>')
        inner = model('<object id="2" name="b"><components><component objectid="1"/></components></object>' + TETRAHEDRON,
                      unit="centimeter")
        files = {"_rels/.rels": RELATIONS, "3D/m.model": root, "3D/inner/a.model": model(TETRAHEDRON), "3D/b.model": inner}
        self.assertEqual(self.parts_of("a.3mf", zip64(files)), [
            ("both", round(8 / 6 + 8000 / 6, 9), [[0, 0, 10], [30, 20, 30]]), ("b", round(1000 / 6, 9), [[0, 0, 0], [10] * 3])])
        files["3D/b.model"] = inner.replace('<object id="1"', '<object id="3"')
        self.refuse("a.3mf", zip64(files), "3D/b.model: there is no object 1, which is used")
        files["3D/b.model"] = "<model"
        self.refuse("a.3mf", zip64(files), "3D/b.model: malformed XML")
        del files["3D/b.model"]
        self.refuse("a.3mf", zip64(files), 'it has no "3D/b.model"')

    def test_what_of_3mf_is_left_out(self):
        beams = MESH.replace("</mesh>", '<b:beamlattice radius="1"><b:beams/></b:beamlattice></mesh>')
        files = {"_rels/.rels": RELATIONS, "3D/m.model": model(
            f'<object id="1" name="cage">{beams}</object><object id="2"><s:shape/></object>',
            '<item objectid="1"/><item objectid="2"/>')}
        self.assertEqual(self.parts_of("a.3mf", zip64(files), 2), [("cage", self.SIXTH, self.UNIT)])
        self.assertEqual(self.warnings, [
            'a.3mf: object 1 "cage": its beams (beam lattice extension) are left out',
            'a.3mf: object 2 is left out: it is a "shape", which is not read'])

    def test_objects_of_3mf_that_are_no_model(self):
        def files(resources, build, **attributes):
            text = model(resources, build)
            for name, value in attributes.items():
                text = text.replace("<model ", f'<model {name.replace("_", ":")}="{value}" ', 1)
            return zip64({"_rels/.rels": RELATIONS, "3D/m.model": text})
        others = "".join(f'<object id="{n}" type="{t}">{MESH}</object>' for n, t in ((2, "support"), (3, "other"), (4, "solidsupport")))
        moved = "".join(f'<component objectid="{n}" transform="1 0 0 0 1 0 0 0 1 {9 * n} 0 0"/>' for n in (2, 3, 4))
        both = f'<object id="5" type="model"><components><component objectid="1"/>{moved}</components></object>'
        # Nothing is said of what nothing refers to.
        unused = '<object id="6"><s:shape/></object>'
        self.assertEqual(self.parts_of("a.3mf", files(TETRAHEDRON + others + both + unused, '<item objectid="5"/>'), 3),
                         [("part1", self.SIXTH, self.UNIT)])
        self.assertEqual(self.warnings, [f'a.3mf: object {n} is left out: it is of the type "{t}"'
                                         for n, t in ((2, "support"), (3, "other"), (4, "solidsupport"))])
        self.refuse("a.3mf", files(others, '<item objectid="2"/>'),
                    '3D/m.model: has no faces: object 2 is left out: it is of the type "support"')
        item = '<item objectid="1"/>'
        self.refuse("a.3mf", files(TETRAHEDRON, item, requiredextensions="p zz", xmlns_zz="http://a.b/secure"),
                    '3D/m.model: the model needs the extension "zz" of http://a.b/secure, which is not read')
        self.parts_of("a.3mf", files(TETRAHEDRON, item, requiredextensions="p"))

    @staticmethod
    def amf_mesh(points, *volumes):
        return ("<mesh><vertices>" + "".join("<vertex><coordinates><x>%g</x><y>%g</y><z>%g</z></coordinates></vertex>" % tuple(p)
                                             for p in points) + "</vertices>"
                + "".join("<volume>" + "".join("<triangle><v1>%d</v1><v2>%d</v2><v3>%d</v3></triangle>" % f for f in faces)
                          + "</volume>" for faces in volumes) + "</mesh>")

    def test_volumes_of_amf(self):
        # Two that have a face in common, and two that lie in each other in part.
        beside = [(1, 3, 2), (1, 2, 4), (2, 3, 4), (3, 1, 4)]
        data = "<amf><object id='1'>%s</object></amf>"
        self.assertEqual(self.parts_of("a.amf", data % self.amf_mesh((*POINTS, (1, 1, 1)), FACES, beside)),
                         [("part1", 0.5, self.UNIT)])
        moved = [tuple(c / 2 for c in p) for p in POINTS]
        moved = [(x + 0.25, y, z) for x, y, z in moved]
        inside = [tuple(i + 4 for i in f) for f in FACES]
        parts = self.parts_of("a.amf", data % self.amf_mesh((*POINTS, *moved), FACES, inside))
        self.assertEqual(parts, [("part1", self.SIXTH, self.UNIT)])
        # Volumes that are closed together only are colours of one solid.
        parts = self.parts_of("a.amf", data % self.amf_mesh(POINTS, FACES[:2], FACES[2:]))
        self.assertEqual(parts, [("part1", self.SIXTH, self.UNIT)])
        outcome = self.run_script("local p = import('a.amf', {parts = true}) assert(#p == 1) return p[1]", "--stats")
        self.expect(outcome, 0)

    def test_info_tells_what_is_left_out(self):
        self.write("a.amf", f"<amf><object id='1'>{self.amf_mesh(POINTS, FACES)}<instance objectid='1'/></object></amf>")
        outcome = self.run_csgrun("info", "a.amf")
        self.assertEqual((outcome.code, outcome.err), (0, (
            'warning: a.amf: instances of 1 object are left out: only constellations have some (first: object "1")\n')))

    FLOATS = b"".join(struct.pack("<3f", *p) for p in POINTS)
    CORNERS = [i for f in FACES for i in f]
    # glTF is in metres with Y up.
    THOUSAND = [("mesh", round(1e9 / 6, 9), [[0, -1000, 0], [1000, 0, 1000]])]

    def test_gltf_with_its_buffers_beside_it(self):
        document = gltf([{"attributes": {"POSITION": 0}, "indices": 1}],
                        [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                         {"bufferView": 1, "componentType": 5121, "count": 12, "type": "SCALAR"}], b"",
                        buffers=[{"byteLength": 48, "uri": "of%20it/points.bin"},
                                 {"byteLength": 12, "uri": "data:;base64," + base64.b64encode(bytes(self.CORNERS)).decode()}],
                        bufferViews=[{"buffer": 0, "byteLength": 48}, {"buffer": 1, "byteLength": 12}])
        self.write("of it/points.bin", self.FLOATS)
        self.assertEqual(self.parts_of("a.gltf", json.dumps(document)), self.THOUSAND)
        self.expect(self.run_script("return import('a.gltf')", "--stats"), 0)
        self.expect(self.run_csgrun("info", "a.gltf"), 0)
        self.write("of it/points.bin", self.FLOATS[:-1])
        self.refuse("a.gltf", json.dumps(document), "buffers[0] has 47 bytes, and byteLength says 48")
        self.write("of it/points.bin", self.FLOATS + b"more")
        self.assertEqual(self.parts_of("a.gltf", json.dumps(document)), self.THOUSAND)
        # What is beyond a view, or beyond what a buffer says that it has, belongs to others.
        for change, said in (({"bufferViews": [{"buffer": 0, "byteLength": 47}, {"buffer": 1, "byteLength": 12}]},
                              "accessors[0] reaches beyond the end of its view"),
                             ({"bufferViews": [{"buffer": 0, "byteLength": 49}, {"buffer": 1, "byteLength": 12}]},
                              "bufferViews[0] reaches beyond the end of the data"),
                             ({"buffers": [{**document["buffers"][0], "byteLength": 40}, document["buffers"][1]]},
                              "bufferViews[0] reaches beyond the end of the data")):
            self.refuse("a.gltf", json.dumps({**document, **change}), said)

    def glb(self, primitives, accessors, data, **more):
        text = json.dumps(gltf(primitives, accessors, data, **more)).encode()
        text += b" " * (-len(text) % 4)
        data += b"\0" * (-len(data) % 4)
        body = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
        return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body

    ACCESSORS = [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                 {"bufferView": 1, "componentType": 5121, "count": 12, "type": "SCALAR"}]

    def simple_glb(self, **more):
        return self.glb([{"attributes": {"POSITION": 0}, "indices": 1}], self.ACCESSORS, self.FLOATS + bytes(self.CORNERS),
                        views=[(0, 48), (48, 12)], **more)

    def test_gltf_reads_the_buffers_that_it_uses(self):
        # One buffer is not there and not used; the others are one file, with dots in its name, by two names.
        self.write("v1..2.bin", self.FLOATS + bytes(self.CORNERS))
        document = gltf([{"attributes": {"POSITION": 0}, "indices": 1}], self.ACCESSORS, b"",
                        buffers=[{"byteLength": 60, "uri": "v1..2.bin"}, {"byteLength": 9, "uri": "gone.bin"},
                                 {"byteLength": 60, "uri": "./v1..2.bin"}],
                        bufferViews=[{"buffer": 0, "byteLength": 48}, {"buffer": 2, "byteOffset": 48, "byteLength": 12}],
                        images=[{"uri": "C:/textures/a.png"}, {"uri": "https://a.b/c.png"}, {"uri": "../d.png"}])
        self.assertEqual(self.parts_of("a.gltf", json.dumps(document)), self.THOUSAND)

    def test_gltf_extensions(self):
        self.assertEqual(self.parts_of("a.glb", self.simple_glb(extensionsRequired=[
            "KHR_mesh_quantization", "KHR_texture_transform", "KHR_materials_unlit"])), self.THOUSAND)
        for name in ("EXT_mesh_gpu_instancing", "FOO_bar"):
            self.refuse("a.glb", self.simple_glb(extensionsRequired=[name]), f'it needs the extension "{name}", which is not read')
        instances = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}}
        nodes = [{"mesh": 0, "skin": 0, "weights": [0.5], "extensions": instances}]
        self.assertEqual(self.parts_of("a.glb", self.simple_glb(nodes=nodes), 3), self.THOUSAND)
        self.assertEqual(sorted(self.warnings), [
            "a.glb: instances are left out, their mesh stands once: EXT_mesh_gpu_instancing (1 node)",
            "a.glb: skins are passed over, their meshes are not bent (1 node)",
            "a.glb: weights of morph targets are passed over (1 node)"])
        self.assertEqual(self.parts_of("a.glb", self.simple_glb(nodes=[{"mesh": 0, "weights": [0, 0]}])), self.THOUSAND)

    def test_rotations_of_gltf_are_rounded(self):
        # Quaternions of single precision have not quite length 1, and a right angle is one for all that.
        for q in (0.7071067690849304, 0.7071068286895752, 0.7071067811865476, 1.414):
            nodes = [{"mesh": 0, "rotation": [0, 0, 0, 1]}, {"mesh": 0, "rotation": [0, 0, q, q], "translation": [0, 1, 0]}]
            parts = self.parts_of("a.glb", self.simple_glb(nodes=nodes))
            # (x, y, z) goes to (-y, x + 1, z), in millimetres and Z up to (-y, -z, x + 1).
            self.assertEqual([p[2] for p in parts], [self.THOUSAND[0][2], [[-1000, -1000, 1000], [0, 0, 2000]]], q)
        self.refuse("a.glb", self.simple_glb(nodes=[{"mesh": 0, "rotation": [0, 0, 0, 0]}]),
                    "nodes[0]: its rotation is no unit quaternion")

    def looks_of(self, name, data):
        """Name and colour in bytes of the file's faces; none of what has no colour."""
        if data is not None:
            self.write(name, data)
        self.expect(self.run_csgrun(name, "-o", "looks.exact.json"), 0)
        with open(self.path("looks.exact.json")) as file:
            (part,) = json.load(file)["parts"]
        return [(a["name"], [round(255 * c) for c in a["color"]]) for a in part["appearances"] if not a["default"]]

    def test_materials_named_default(self):
        # So our own files name what has no colour; other programs give such a material any.
        def glb(factor, **more):
            look = {"name": "default", "pbrMetallicRoughness": {"baseColorFactor": factor}, **more}
            return self.glb([{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}], self.ACCESSORS,
                            self.FLOATS + bytes(self.CORNERS), views=[(0, 48), (48, 12)], materials=[look])

        def three(colour):
            return zip64({"_rels/.rels": RELATIONS, "3D/m.model": model(
                TETRAHEDRON.replace('<object id="1"', '<object id="1" pid="7" pindex="0"') +
                f'<basematerials id="7"><base name="default" displaycolor="{colour}"/></basematerials>',
                '<item objectid="1"/>')})

        def obj(colour):
            self.write("a.mtl", f"newmtl default\nKd {colour}\n")
            return "mtllib a.mtl\nusemtl default\n" + self.OBJ

        green = [("default", [0, 255, 0, 255])]
        self.assertEqual(self.looks_of("a.glb", glb([0, 1, 0, 1])), green)
        self.assertEqual(self.looks_of("a.3mf", three("#00FF00FF")), green)
        self.assertEqual(self.looks_of("a.obj", obj("0 1 0")), green)
        self.assertEqual(self.looks_of("a.3mf", three("#F9D72CFF")), [])
        self.assertEqual(self.looks_of("a.obj", obj("0.976 0.843 0.173")), [])
        for kind in ("glb", "3mf", "obj"):
            self.expect(self.run_script("return cube(1)", "-o", "own." + kind), 0)
            self.assertEqual(self.looks_of("own." + kind, None), [], kind)
        # What is opaque has no alpha.
        for mode, alpha in ((None, 255), ("OPAQUE", 255), ("BLEND", 64), ("MASK", 64)):
            more = {} if mode is None else {"alphaMode": mode}
            self.assertEqual(self.looks_of("a.glb", glb([0, 1, 0, 0.25], **more)), [("default", [0, 255, 0, alpha])], mode)

    def test_names_of_parts(self):
        names = ["a", "..", "x/../y\\z", "a", "b\tc", "n" * 300]
        parts = self.parts_of("a.glb", self.simple_glb(nodes=[{"mesh": 0, "name": n} for n in names]), 1)
        self.assertEqual([p[0] for p in parts], ["a", "part1", "x/y_z", "a_2", "b_c", "n" * 180])
        self.assertEqual(self.warnings, ["a.glb: 4 names of parts are changed to what parts can be called"])

    def test_strips_and_fans(self):
        # The strip 0 1 2 3 0 1 goes around a tetrahedron: 012 132 230 (3 2 0 turned) 301; the fan has the faces at a corner.
        positions = {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}
        for mode, indices in ((5, [0, 2, 1, 3, 0, 2]), (5, [0, 2, 1, 3, 0, 2, 2, 2])):
            data = self.FLOATS + bytes(indices)
            accessors = [positions, {"bufferView": 1, "componentType": 5121, "count": len(indices), "type": "SCALAR"}]
            self.assertEqual(self.parts_of("a.glb", self.glb(
                [{"attributes": {"POSITION": 0}, "indices": 1, "mode": mode}], accessors, data,
                views=[(0, 48), (48, len(indices))])), self.THOUSAND)
        data = self.FLOATS + bytes([0, 2, 1, 3, 2]) + bytes([1, 2, 3]) + bytes([0, 1])
        accessors = [positions] + [{"bufferView": v, "componentType": 5121, "count": n, "type": "SCALAR"}
                                   for v, n in ((1, 5), (2, 3), (3, 2))]
        primitives = [{"attributes": {"POSITION": 0}, "indices": i, "mode": m} for i, m in ((1, 6), (2, 4), (3, 1))]
        views = [(0, 48), (48, 5), (53, 3), (56, 2)]
        self.assertEqual(self.parts_of("a.glb", self.glb(primitives, accessors, data, views=views), 1), self.THOUSAND)
        self.assertEqual(self.warnings, ["a.glb: points and lines are left out: 1 primitive"])
        self.refuse("a.glb", self.glb([{"attributes": {"POSITION": 0}, "mode": 7}], accessors, data, views=views),
                    "meshes[0].primitives[0].mode must be from 0 to 6")

    def test_sparse_and_small_positions(self):
        indices = {"bufferView": 1, "componentType": 5121, "count": 12, "type": "SCALAR"}
        primitive = [{"attributes": {"POSITION": 0}, "indices": 1}]
        # All points in the origin but those that the sparse part moves.
        data = b"\1\2\3\0" + self.FLOATS[12:] + bytes(self.CORNERS)
        sparse = {"count": 3, "indices": {"bufferView": 0, "componentType": 5121}, "values": {"bufferView": 2}}
        views = [(0, 3), (40, 12), (4, 36)]
        positions = {"componentType": 5126, "count": 4, "type": "VEC3", "sparse": sparse}
        self.assertEqual(self.parts_of("a.glb", self.glb(primitive, [positions, indices], data, views=views)), self.THOUSAND)
        for count, said in ((10**9, "accessors[0] has no data, and no end"), (3, "accessors[0].sparse: an index is out of range")):
            self.refuse("a.glb", self.glb(primitive, [{**positions, "count": count}, indices], data, views=views), said)
        # KHR_mesh_quantization: whole numbers, or fractions of the largest one; points begin at multiples of four bytes.
        for kind, code, full in (("b", 5120, 127), ("B", 5121, 255), ("h", 5122, 32767), ("H", 5123, 65535)):
            for normalized, unit in ((False, 1), (True, full)):
                stride = 4 if code < 5122 else 8
                points = b"".join(struct.pack("<3" + kind, *(c * unit for c in p)).ljust(stride, b"\xff") for p in POINTS)
                data = points + bytes(self.CORNERS)
                positions = {"bufferView": 0, "componentType": code, "normalized": normalized, "count": 4, "type": "VEC3"}
                views = [(0, len(points), stride), (len(points), 12)]
                self.assertEqual(self.parts_of("a.glb", self.glb(primitive, [positions, indices], data, views=views)),
                                 self.THOUSAND, (kind, normalized))

    def test_gltf_that_is_not_read_says_why(self):
        positions = {"componentType": 5126, "count": 4, "type": "VEC3"}
        draco = [{"attributes": {"POSITION": 0}, "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0}}}]
        self.refuse("a.glb", self.glb(draco, [positions], self.FLOATS), "its meshes are compressed (KHR_draco_mesh_compression)")
        document = gltf([{"attributes": {"POSITION": 0}}], [{**positions, "bufferView": 0}], self.FLOATS)
        document["bufferViews"][0]["extensions"] = {"EXT_meshopt_compression": {"buffer": 0}}
        self.refuse("a.gltf", json.dumps(document), "its meshes are compressed (EXT_meshopt_compression)")
        self.refuse("a.gltf", '{"asset": {"version": "1.0"}, "buffers": {}}', "only version 2 of glTF is read")

    OBJ = "".join("v %d %d %d\n" % p for p in POINTS) + "".join("f %d %d %d\n" % tuple(i + 1 for i in f) for f in FACES)
    OFF = "OFF\n4 4 0\n" + "".join("%d %d %d\n" % p for p in POINTS) + "".join("3 %d %d %d\n" % f for f in FACES)
    STL = "solid x\n" + "".join("facet normal 0 0 0\nouter loop\n" + "".join("vertex %d %d %d\n" % POINTS[i] for i in f)
                                + "endloop\nendfacet\n" for f in FACES) + "endsolid x\n"
    PLY = ("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 4\nproperty list uchar int vertex_indices\nend_header\n") + OFF.split("\n", 2)[2]

    def good(self, name, data, *warnings):
        self.assertEqual(self.parts_of(name, data, len(warnings)), [("part1", self.SIXTH, self.UNIT)])
        self.assertEqual(self.warnings, [f"{name}: {w}" for w in warnings])

    def test_names_that_end_in_a_backslash(self):
        # Of a folder: what follows is a statement of its own.
        lines = self.OBJ.splitlines()
        for name in ("g C:\\dir\\", "o C:\\dir\\", "usemtl a\\", "unheard_of C:\\"):
            for place in (0, len(lines) - 4, len(lines) - 1):
                text = "\n".join(lines[:place] + [name] + lines[place:]) + "\n"
                with self.subTest(f"{name} {place}"):
                    self.write("a.obj", text)
                    outcome = self.run_csgrun("a.obj", "--stats=json")
                    self.expect(outcome, 0)
                    self.assertEqual(round(outcome.json()["parts"][0]["volume"], 9), self.SIXTH)

    def test_line_ends_and_byte_order_marks(self):
        for name, text in (("a.obj", self.OBJ), ("a.off", self.OFF), ("a.stl", self.STL), ("a.ply", self.PLY)):
            for end in ("\n", "\r\n", "\r"):
                for mark in ("", "\ufeff"):
                    with self.subTest(f"{name} {end!r} {mark!r}"):
                        self.good(name, mark + text.replace("\n", end))
        # The header alone, before binary data with line feeds in it.
        header = self.PLY[:self.PLY.index("end_header\n")].replace("ascii", "binary_little_endian").replace("float", "int")
        points = b"".join(struct.pack("<3i", *(10 * c for c in p)) for p in POINTS)
        faces = b"".join(struct.pack("<B3i", 3, *f) for f in FACES)
        parts = self.parts_of("a.ply", (header + "end_header\n").replace("\n", "\r").encode() + points + faces)
        self.assertEqual(parts, [("part1", round(1000 / 6, 9), [[0] * 3, [10] * 3])])

    def test_obj(self):
        self.good("a.obj", "vw 0 0 1.0\nt crease 1\n" + self.OBJ + "vw 1\n",
                  '3 lines with statements that OBJ does not know passed over (first: line 1: "vw")')
        self.good("a.obj", self.OBJ + "f 1 2\nf 3\n", "2 faces of fewer than three corners left out (first: line 9)")
        self.good("a.obj", "mtllib C:\\Users\\me\\a.mtl\n" + self.OBJ,
                  'line 1: no colours: mtllib "C:\\Users\\me\\a.mtl" leads out of the file\'s folder')
        self.good("a.obj", "mtllib a..b.mtl\n" + self.OBJ, "no colours: cannot read 'a..b.mtl': No such file or directory")
        self.good("a.obj", self.OBJ.upper())
        self.refuse("a.obj", self.OBJ.replace("f", "face"), "a.obj: has no faces; 4 lines with statements that OBJ does "
                    'not know passed over (first: line 5: "face")')

    def test_lines_of_obj_that_go_on(self):
        for end in ("\\\n", " \\\n", "\\ \r\n ", "\\\n\\\n"):
            self.good("a.obj", self.OBJ.replace(" ", end))
            # Also where nobody looks: nothing of it is a statement.
            passed_over = "vt 0" + end + "0.5\nl 1 2" + end + "v 3\nv 9 9 9 1" + end + "0.5 0.5\n"
            self.good("a.obj", self.OBJ + passed_over)
        self.good("a.obj", self.OBJ[:-1] + "\\")
        self.good("a.obj", self.OBJ.replace("\nf", " # not here \\\nf"))
        self.refuse("a.obj", self.OBJ + "f 1\\ 2 3\n", r'a.obj:9: expected a face index, got "1\"')
        self.refuse("a.obj", self.OBJ + "f 1 x\\\n3\n", 'a.obj:9: expected a face index, got "x"')

    def test_comments_without_a_blank(self):
        self.good("a.obj", self.OBJ.replace("\n", "#x\n"))
        self.good("a.off", self.OFF.replace("\n", "#x\n"))
        parts = self.parts_of("a.obj", "o one#1 # first\n" + self.OBJ + "o two#2\n" + self.OBJ.replace("v ", "v 1").replace(
            "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4", "f -4 -2 -3\nf -4 -3 -1\nf -4 -1 -2\nf -3 -2 -1"))
        self.assertEqual([name for name, *_ in parts], ["one#1", "two#2"])

    def test_several_material_files(self):
        self.write("red.mtl", "newmtl x\nKd 1 0 0\n")
        self.write("blue.mtl", "newmtl y\nKd 0 0 1\n")
        self.write("with blanks.mtl", "newmtl x\nKd 1 0 0\nnewmtl y\nKd 0 0 1\n")
        body = "v 0 0 0\nv 6 0 0\nv 0 6 0\nv 0 0 6\nusemtl x\nf 1 3 2\nf 1 2 4\nusemtl y\nf 1 4 3\nf 2 3 4\n"
        outputs = []
        for lines in ("mtllib red.mtl\nmtllib blue.mtl\n", "mtllib red.mtl blue.mtl\n", "mtllib with blanks.mtl\n"):
            self.write("a.obj", lines + body)
            outcome = self.run_csgrun("a.obj", "-o", "a.glb")
            self.expect(outcome, 0)
            self.assertEqual(outcome.err, "")
            with open(self.path("a.glb"), "rb") as file:
                outputs.append(file.read())
        self.assertEqual(outputs[1:], outputs[:1] * 2)
        for lines, said in (("mtllib red.mtl none.mtl\n", "a.obj: no colours: cannot read 'none.mtl': No such file or directory"),
                            ("mtllib red.mtl\n", "a.obj: no colours: the material 'y' is in none of its material files"),
                            ("mtllib ../red.mtl blue.mtl\n", None)):
            self.write("a.obj", lines + body)
            outcome = self.run_csgrun("a.obj", "-o", "a.glb")
            self.expect(outcome, 0 if said else 1)
            if said:
                self.assertIn("warning: " + said + "\n", outcome.err)
        self.refuse("a.obj", "L\1\2\0.text", r'a.obj:1: not an OBJ statement: "L\x01\x02\x00.text"')

    def test_objects_of_obj(self):
        def obj(name, place, side, first, turned=False):
            points = "".join("v %g %g %g\n" % tuple(p + side * c for p, c in zip(place, q)) for q in POINTS)
            return f"o {name}\n" + points + "".join("f %d %d %d\n" % tuple(first + i for i in (f[::-1] if turned else f))
                                                    for f in FACES)
        two = obj("one", (0, 0, 0), 1, 1) + obj("two", (5, 0, 0), 1, 5)
        box = [[5, 0, 0], [6, 1, 1]]
        self.assertEqual(self.parts_of("a.obj", two), [("one", self.SIXTH, self.UNIT), ("two", self.SIXTH, box)])
        outcome = self.run_script("local p = import('a.obj', {parts = true}) assert(#p == 2) "
                                  "assert(math.abs(import('a.obj'):volume() - 1 / 3) < 1e-9) return p[2]", "--stats=json")
        self.expect(outcome, 0)
        self.assertEqual(outcome.json()["parts"][0]["bbox"], box)
        self.expect(self.run_csgrun("a.obj", "-o", "a.3mf"), 0)
        outcome = self.run_csgrun("a.3mf", "--stats=json")
        self.assertEqual([p["name"] for p in outcome.json()["parts"]], ["one", "two"])
        # Names may begin with what else begins a comment.
        names = [p[0] for p in self.parts_of("a.obj", obj("#1 left", (0, 0, 0), 1, 1) + obj("b # c", (5, 0, 0), 1, 5))]
        self.assertEqual(names, ["#1 left", "b"])
        # Objects that are closed together only are surfaces of one; so is a void of the other.
        halves = self.OBJ.replace("f 1 4 3", "o rest\nf 1 4 3")
        self.good("a.obj", halves)
        parts = self.parts_of("a.obj", obj("outer", (0, 0, 0), 1, 1) + obj("void", (0.1, 0.1, 0.1), 0.2, 5, True))
        self.assertEqual(parts, [("part1", round(1 / 6 - 0.008 / 6, 9), self.UNIT)])

    def test_off(self):
        self.good("a.off", self.OFF.replace("OFF\n", "OFF"))
        self.good("a.off", self.OFF.replace("\n3 0 2 1\n", "\n3 0\n2 \n1\n"))
        self.good("a.off", self.OFF.replace("4 4 0", "4 6 0") + "2 0 1\n1 3\n",
                  "2 faces of fewer than three corners left out (first: face 4)")
        self.good("a.off", self.OFF.replace("4 4 0", "4 44 0") + "0\n" * 40,
                  "40 faces of fewer than three corners left out (first: face 4)")
        self.refuse("a.off", "OFFSET 4 4 0", 'a.off:1: not an OFF file: it starts with "OFFSET"')
        self.good("a.off", self.OFF.replace("OFF", "off"))
        for name in ("4OFF", "nOFF", "ST4nOFF"):
            self.refuse("a.off", self.OFF.replace("OFF", name),
                        f'a.off:1: OFF with points of other than three coordinates is not supported: "{name}"')
        for text in ("OFF3\n4 4 0", "OFF3 4 4 0"):
            self.refuse("a.off", self.OFF.replace("OFF\n4 4 0", text), 'a.off:1: not an OFF file: it starts with "OFF3"')
        for name in ("noff", "coff", "OFFn"):
            self.refuse("a.off", self.OFF.replace("OFF", name), f'a.off:1: not an OFF file: it starts with "{name}"')

    def test_what_points_of_off_have(self):
        head, points, faces = "OFF\n4 4 0\n", self.OFF.split("\n")[2:6], self.OFF.split("\n")[6:]
        for name, more in (("N", " 0 0 1"), ("ST", " 0.5 1"), ("STN", " 0 0 1 0.5 1"), ("C", " 255 0 0"),
                           ("C", " 255 0 0 255"), ("CN", " 0 0 1 255 0 0"), ("STC", " 255 0 0 0.5 1"),
                           ("STC", " 255 0 0 255 0.5 1"), ("STCN", " 0 0 1 1.0 0 0 1 0 0")):
            self.good("a.off", name + head + "\n".join([p + more for p in points] + faces))
            self.expect(self.run_csgrun("a.off", "-o", "a.glb"), 0)
            colours = [m["pbrMetallicRoughness"]["baseColorFactor"][:3] for m in self.read_glb("a.glb")["materials"]]
            self.assertEqual(colours == [[1, 0, 0]], "C" in name, name + more)

    def test_off_on_one_line(self):
        points, faces = self.OFF.split("\n")[2:6], self.OFF.split("\n")[6:]
        for name, more in (("OFF", ""), ("off", ""), ("NOFF", " 0 0 1"), ("STNOFF", " 0 0 1 0.5 1")):
            numbers = " ".join([p + more for p in points] + faces)
            for counts in ("4 4 0 ", "4 4 0\n", "4 4\n\n"):
                text = f"{name} {counts}{numbers}".strip()
                self.good("a.off", text)
                self.good("a.off", text + "\n \n# and no more\n")
                for end in range(5, len(text), 31):
                    self.write("a.off", text[:end])
                    self.expect(self.run_csgrun("info", "a.off"), 1)
                self.refuse("a.off", text + " 3 0 1 2", f'a.off:{1 + text.count(chr(10))}: more data after the last face')
        self.refuse("a.off", "COFF 4 4 0 " + " ".join([p + " 1 0 0" for p in points] + faces),
                    "a.off:1: one line follows the counts, but points with colours need one each")
        self.refuse("a.off", "OFF 400 4 0 " + " ".join(points + faces), f"a.off:1: 400 points promised, but only {len(' '.join(points + faces)) + 1} bytes follow")

    def test_stl(self):
        binary = b"solid by nobody".ljust(80) + struct.pack("<I", 4) + b"".join(
            struct.pack("<12fH", 0, 0, 0, *(c for i in f for c in POINTS[i]), 0) for f in FACES)
        self.good("a.stl", binary)
        self.good("a.stl", b"\xef\xbb\xbf".ljust(80) + binary[80:])
        self.good("a.stl", b"\0" * 80 + binary[80:] + b"more", "4 bytes after the last triangle passed over")
        self.refuse("a.stl", b"\0" * 80 + binary[80:-1], "byte 80: not an STL file, or truncated")
        for end in (b"\x1a", b"\0", b"\x1a\0\0\0"):
            self.good("a.stl", self.STL.encode() + end)
        self.refuse("a.stl", self.STL.replace("endsolid", "\x1a\x7f"),
                    r'a.stl:30: expected "facet" or "endsolid", got "\x1a\x7f"')

    NO_END = 'ends without "endsolid"; solids behind it may be missing'

    def test_stl_without_its_end(self):
        facets = self.STL.replace("endsolid x\n", "")
        self.good("a.stl", facets, self.NO_END)
        self.good("a.stl", facets + "\x1a", self.NO_END)
        # A file that is cut off looks the same, or ends elsewhere.
        between = [m.end() for m in re.finditer("endfacet\n", facets)][:-1]
        for end in (*range(10, len(facets) - 10, 31), *between):
            self.write("a.stl", facets[:end])
            outcome = self.run_csgrun("info", "a.stl")
            self.expect(outcome, 1)
            if end in between:
                self.assertIn('the file ends where "facet" or "endsolid" should be', outcome.err)
        self.refuse("a.stl", self.STL + "solid y\n", "a.stl:32: the file ends where")

    def test_ply(self):
        strips = self.PLY[:self.PLY.index("3 0 2 1")].replace("face 4", "tristrips 1").replace("uchar int", "int int")
        self.good("a.ply", strips + "6 0 2 1 3 0 2\n")
        # The same in two strips, with a triangle between that is none.
        self.good("a.ply", strips + "10 0 2 1 3 -1 1 3 0 2 2\n")
        self.good("a.ply", self.PLY.replace("face 4", "face 6") + "2 0 1\n0\n",
                  "2 faces of fewer than three corners left out (first: face 4)")
        self.good("a.ply", self.PLY + "\n \n")
        self.good("a.ply", self.PLY + "3 0 1 2\n", 'data after the last element (line 18: "3") passed over')
        binary = self.PLY[:self.PLY.index("0 0 0")].replace("ascii", "binary_big_endian").encode() + b"".join(
            struct.pack(">3f", *p) for p in POINTS) + b"".join(struct.pack(">B3i", 3, *f) for f in FACES)
        self.good("a.ply", binary)
        self.good("a.ply", binary + b"\n", "1 byte after the last element passed over")
        self.good("a.ply", binary + b"more", "4 bytes after the last element passed over")
        self.refuse("a.ply", binary[:-1], "byte ")
        cloud = self.PLY[:self.PLY.index("element face")] + "end_header\n0 0 0\n" * 1 + "0 0 1\n" * 3
        self.refuse("a.ply", cloud, "has no faces: there are points only")


if __name__ == "__main__":
    main()
