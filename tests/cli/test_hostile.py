"""Files that mean harm: each is refused, with a reason, within a second (of the processor, for other tests run
meanwhile) and 200 MB."""
import base64
import io
import json
import os
import struct
import zipfile
import zlib

from support import SANITIZED, Case, main

RELATIONS = ('<Relationships><Relationship Target="/3D/m.model" Id="r" '
             'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>')
TETRAHEDRON = ('<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/>'
               '<vertex x="0" y="0" z="1"/></vertices><triangles><triangle v1="0" v2="2" v3="1"/>'
               '<triangle v1="0" v2="1" v3="3"/><triangle v1="0" v2="3" v3="2"/><triangle v1="1" v2="2" v3="3"/>'
               '</triangles></mesh>')
SECRET = "the secret of this folder"


def archive(model, **more):
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("_rels/.rels", more.pop("relations", RELATIONS))
        file.writestr("3D/m.model", model)
        for name, text in more.items():
            file.writestr(name, text)
    return data.getvalue()


def model_3mf(resources, build='<item objectid="1"/>'):
    return (f'<model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>{resources}'
            f'</resources><build>{build}</build></model>')


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(width, height, data, depth=8, colour=0):
    head = struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def glb(gltf, binary=b""):
    text = json.dumps(gltf).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<I4s", len(text), b"JSON") + text
    if binary:
        body += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


def gltf(uri=None, length=100, count=3, view=None, **more):
    """A triangle whose points are in a buffer at `uri`."""
    buffer = {"byteLength": length, **({"uri": uri} if uri is not None else {})}
    return {"asset": {"version": "2.0"}, "buffers": [buffer],
            "bufferViews": [{"buffer": 0, "byteLength": length if view is None else view}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3"}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "nodes": [{"mesh": 0}],
            "scenes": [{"nodes": [0]}], "scene": 0, **more}


def ply(vertices, faces, form="binary_little_endian"):
    return (f"ply\nformat {form} 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n"
            f"element face {faces}\nproperty list uchar int vertex_indices\nend_header\n").encode()


class Hostile(Case):

    def refuse(self, name, data, message, script=None, codes=(1,)):
        """As a model, or in a script where only scripts read such files."""
        with self.subTest(f"{name}: {message}"):
            self.write(name, data)
            if script is not None:
                self.write("model.lua", script)
            outcome = self.run_csgrun("model.lua" if script is not None else name, "--stats", "--no-cache")
            self.assertIn(outcome.code, codes, outcome.err)
            self.assertRegex(outcome.err, message)
            self.assertNotIn(SECRET, outcome.err)
            if not SANITIZED:
                self.assertLess(outcome.cpu_seconds, 1)
                self.assertLess(outcome.peak_mb, 200)

    def setUp(self):
        super().setUp()
        inner = os.path.join(self.folder, "inner")
        os.mkdir(inner)
        self.write("secret.bin", SECRET)
        self.write("secret.mtl", SECRET)
        self.outer, self.folder = self.folder, inner
        self.addCleanup(setattr, self, "folder", self.outer)

    def test_archives(self):
        self.refuse("a.3mf", archive(b" " * 300_000_000), "which no model does")
        # The directory lies about the size.
        bomb = archive(b" " * 100_000_000).replace(struct.pack("<I", 100_000_000), struct.pack("<I", 1000))
        self.refuse("a.3mf", bomb, "a.3mf: ")
        self.refuse("a.3mf", archive(model_3mf('<object id="1"><components><component objectid="2"/></components></object>'
                                               '<object id="2"><components><component objectid="1"/></components></object>')),
                    "nest too deep")
        tower = f'<object id="0">{TETRAHEDRON}</object>' + "".join(
            f'<object id="{n}"><components>' + f'<component objectid="{n - 1}"/>' * 10 + "</components></object>"
            for n in range(1, 30))
        self.refuse("a.3mf", archive(model_3mf(tower, '<item objectid="29"/>')), "multiply to more than a model would")
        # Documents that name each other, and more of them than a file of this size would have.
        other = '<object id="1"><components><component objectid="1" p:path="/{}"/></components></object>'
        self.refuse("a.3mf", archive(model_3mf(other.format("b.model")), **{"b.model": model_3mf(other.format("3D/m.model"))}),
                    "nest too deep")
        blanks = model_3mf(f'<object id="1">{TETRAHEDRON}</object>') + " " * 15_000_000
        many = {f"{i}.model": blanks for i in range(3)}
        self.refuse("a.3mf", archive(model_3mf("<object id='1'><components>" + "".join(
            f"<component objectid='1' p:path='/{i}.model'/>" for i in range(3)) + "</components></object>"), **many),
            "which no model does")
        self.refuse("a.3mf", archive("<model>" * 100_000), r"malformed XML|no resources|nested")
        self.refuse("a.3mf", archive("", relations=RELATIONS.replace("/3D/m.model", "../../secret.bin")), "a.3mf: ")
        self.refuse("a.3mf", archive(model_3mf(
            '<object id="1"><mesh><vertices/><triangles>' + '<triangle v1="0" v2="1" v3="2"/>' * 1000
            + "</triangles></mesh></object>")), "corner 0")
        self.refuse("a.3mf", archive('<!DOCTYPE m [<!ENTITY x SYSTEM "../secret.bin">]><model>&x;</model>'), "no resources")
        self.refuse("a.3mf", b"PK\3\4" + b"\xff" * 10_000, "a.3mf: ")

    def test_components_that_multiply(self):
        # Listed from the bottom, so that each is counted before what has it.
        chain = f'<object id="1">{TETRAHEDRON}</object>' + "".join(
            f'<object id="{n}"><components><component objectid="{n - 1}"/></components></object>' for n in range(2, 40_000))
        self.refuse("a.3mf", archive(model_3mf(chain, "".join(f'<item objectid="{n}"/>' for n in range(32, 40_000, 32)))),
                    "nest too deep")
        tower = "".join(f'<object id="{n}"><components>' + f'<component objectid="{n - 1}"/>' * 10 + "</components></object>"
                        for n in range(2, 6))
        points = TETRAHEDRON.replace("</vertices>", '<vertex x="0" y="0" z="0"/>' * 50_000 + "</vertices>")
        self.refuse("a.3mf", archive(model_3mf(f'<object id="1">{points}</object>{tower}', '<item objectid="5"/>')),
                    "multiply to more than a model would")
        # What is not built does not make the file a large model.
        triangles = TETRAHEDRON.replace("</triangles>", '<triangle v1="0" v2="0" v3="0"/>' * 100_000 + "</triangles>")
        tower += '<object id="6"><components>' + '<component objectid="5"/>' * 200 + "</components></object>"
        self.refuse("a.3mf", archive(model_3mf(f'<object id="1">{TETRAHEDRON}</object>{tower}<object id="9">{triangles}</object>',
                                               '<item objectid="6"/>')), "multiply to more than a model would")

    def test_amf(self):
        def mesh(more_points=0):
            points = "".join(f"<vertex><coordinates><x>{x}</x><y>{y}</y><z>{z}</z></coordinates></vertex>"
                             for x, y, z in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), *((0, 0, 0),) * more_points))
            faces = "".join(f"<triangle><v1>{a}</v1><v2>{b}</v2><v3>{c}</v3></triangle>"
                            for a, b, c in ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)))
            return f"<mesh><vertices>{points}</vertices><volume>{faces}</volume></mesh>"

        def things(kind, numbers, copies):
            return "".join(f'<{kind} id="{n}">' + f'<instance objectid="{n - 1}"/>' * copies + f"</{kind}>" for n in numbers)
        tetrahedron = f'<object id="0">{mesh()}</object>'
        self.refuse("a.amf", f'<amf>{tetrahedron}{things("constellation", range(1, 40_000), 1)}</amf>', "nest too deep")
        self.refuse("a.amf", f'<amf>{tetrahedron}{things("constellation", range(1, 10), 10)}</amf>', "multiply to more than")
        self.refuse("a.amf", f'<amf><object id="0">{mesh(20_000)}</object>{things("constellation", range(1, 6), 10)}</amf>',
                    "multiply to more than")
        # Objects have no instances: only constellations do.
        self.refuse("a.amf", f'<amf>{tetrahedron}{things("object", range(1, 10), 10)}</amf>',
                    'a.amf: instances of 9 objects are left out: .*first: object "1"', codes=(0,))
        # What contains itself is in nothing that is no part of it.
        own = '<constellation id="8"><instance objectid="9"/></constellation><constellation id="9"><instance objectid="8"/></constellation>'
        self.refuse("a.amf", f"<amf>{tetrahedron}{own}</amf>", "nest too deep")

    def test_colours(self):
        """Each triangle has its own: they are compared in no time, and rounded to what a file may have."""
        count = 40_000
        colours = "".join(f'<color color="#{i:06x}"/>' for i in range(count))
        points = "".join(f'<vertex x="{x + 2 * i}" y="{y}" z="{z}"/>' for i in range(count // 4)
                         for x, y, z in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)))
        triangles = "".join(
            f'<triangle v1="{4 * i + a}" v2="{4 * i + b}" v3="{4 * i + c}" pid="9" p1="{4 * i + k}"/>' for i in range(count // 4)
            for k, (a, b, c) in enumerate(((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))))
        self.write("a.3mf", archive(model_3mf(
            f'<colorgroup id="9">{colours}</colorgroup><object id="1"><mesh><vertices>{points}</vertices>'
            f'<triangles>{triangles}</triangles></mesh></object>')))
        outcome = self.run_csgrun("a.3mf", "-o", "a.glb")
        self.assertEqual(outcome.code, 0, outcome.err)
        self.assertRegex(outcome.err, "a.3mf: 40000 colours of faces were rounded to [0-9]+")
        if not SANITIZED:
            self.assertLess(outcome.cpu_seconds, 2)

    def test_pictures(self):
        script = 'return surface("a.png")'
        self.refuse("a.png", png(30_000, 30_000, zlib.compress(b"\0" * 1_000_000)), "a.png: ", script)
        self.refuse("a.png", png(0x7fffffff, 0x7fffffff, b""), "a.png: ", script)
        self.refuse("a.png", png(20_000, 20_000, zlib.compress(b"\0" * (20_001 * 20_000))), "a.png: ", script)
        self.refuse("a.png", png(100, 100, zlib.compress(b"\0" * 500_000_000)), "more data than its size needs", script)
        extra = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 2, 2, 8, 0, 0, 0, 0)) + chunk(
            b"zTXt", b"k\0\0" + zlib.compress(b"x" * 300_000_000))
        self.refuse("a.png", extra, "a.png: ", script)
        self.refuse("a.csv", "1 " * 10_000_000, "a.csv|a.txt|surface", 'return surface("a.csv")')

    def test_gltf(self):
        for uri in ("../secret.bin", "http://a.b/c.bin", "https://a.b/c", "file:///etc/passwd", "/etc/passwd", "%2e%2e/secret.bin",
                    "a/../../secret.bin", "..\\secret.bin", "//a.b/c"):
            self.refuse("a.gltf", json.dumps(gltf(uri)), "a.gltf: ")
        huge = 2**40
        self.refuse("a.gltf", json.dumps(gltf("data:application/octet-stream;base64,AAAA", huge, huge)), "a.gltf: ")
        self.refuse("a.glb", glb(gltf(None, 36, 2**31), b"\0" * 36), "a.glb: ")
        self.refuse("a.glb", glb(gltf(None, 36, 3, 2**31), b"\0" * 36), "a.glb: ")
        nested = gltf(None, 36)
        nested["nodes"] = [{"children": [1]}, {"children": [0], "mesh": 0}]
        self.refuse("a.glb", glb(nested, b"\0" * 36), "a.glb: ")
        nested["nodes"] = [{"children": [n + 1] * 10} for n in range(30)] + [{"mesh": 0}]
        self.refuse("a.glb", glb(nested, b"\0" * 36), "a.glb: ")
        self.refuse("a.gltf", "[" * 3_000_000, "a.gltf: ")
        self.refuse("a.gltf", '{"a":' * 1_000_000, "a.gltf: its JSON is nested more than 512 deep")
        self.refuse("a.glb", struct.pack("<4sII", b"glTF", 2, 0xffffffff) + struct.pack("<I4s", 0xfffffff0, b"JSON"), "a.glb: ")
        sparse = gltf(None, 36, 50_000_000)
        del sparse["accessors"][0]["bufferView"]
        self.refuse("a.glb", glb(sparse, b"\0" * 36), "a.glb: ")

    def test_gltf_that_multiplies(self):
        # A large file behind many buffers, and a large accessor behind many primitives: read once, and as far as used.
        self.write("big.bin", struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + b"\0" * 12_000_000)
        many = gltf("big.bin", 36)
        many["buffers"] *= 2000
        self.refuse("a.gltf", json.dumps(many), "not closed")
        many["bufferViews"] = [{"buffer": n, "byteLength": 36} for n in range(1000)]
        many["accessors"] = [{**many["accessors"][0], "bufferView": n} for n in range(1000)]
        self.refuse("a.gltf", json.dumps(many), "not closed")
        few = gltf("big.bin", 12_000_000, 1_000_000)
        few["accessors"].append({"componentType": 5125, "count": 3, "type": "SCALAR", "bufferView": 0})
        few["meshes"][0]["primitives"] = [{"attributes": {"POSITION": 0}, "indices": 1}] * 5000
        self.refuse("a.gltf", json.dumps(few), "not closed|without area|has no")
        # A mesh at many nodes, and its corners in many primitives.
        del few["meshes"][0]["primitives"][1:]
        few["accessors"][1]["count"] = 300_000
        few["nodes"] = [{"mesh": 0}] * 40_000
        few["scenes"] = [{"nodes": list(range(40_000))}]
        self.refuse("a.gltf", json.dumps(few), "multiply to more than a model would")

    def test_many_names(self):
        """One name of all, looks of all, and entries of an archive: found in no time."""
        count = 5000
        points = b"".join(struct.pack("<3f", *p) for p in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)))
        data = points + bytes([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3])
        document = gltf(None, len(data), 4)
        document["bufferViews"] = [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}]
        document["accessors"].append({"bufferView": 1, "componentType": 5121, "count": 12, "type": "SCALAR"})
        document["accessors"].append({"bufferView": 1, "componentType": 5121, "count": 0, "type": "SCALAR"})
        document["materials"] = [{"name": f"m{n}"} for n in range(8 * count)]
        document["meshes"][0]["primitives"] = [{"attributes": {"POSITION": 0}, "indices": 1}] + [
            {"attributes": {"POSITION": 0}, "indices": 2, "material": n} for n in range(8 * count)]
        self.refuse("a.glb", glb(document, data), "mesh: 4 triangles", codes=(0,))
        archive_files = {f"{n:x}": '<model><resources><object id="1"/></resources></model>' for n in range(4 * count)}
        build = "".join(f'<item objectid="1" p:path="/{n:x}"/>' for n in range(4 * count - 1, -1, -1))
        self.refuse("a.3mf", archive(model_3mf("", build), **archive_files), "more than 10000 documents")

    def test_materials(self):
        mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
        for name in ("../secret.mtl", "/etc/passwd", "http://a.b/c.mtl", "file:///etc/passwd", "a/../../secret.mtl", "..\\secret.mtl"):
            for command in ("a.obj", "model.lua"):
                self.write("a.obj", f"mtllib {name}\nusemtl a\n{mesh}")
                self.write("model.lua", "return import('a.obj')")
                outcome = self.run_csgrun(command, "--stats")
                self.assertNotIn(outcome.code, (0, 124))
                self.assertNotIn(SECRET, outcome.err)
                self.assertRegex(outcome.err, "a.obj:1: mtllib .* leads out of the file's folder: put that file "
                                              "beside the mesh and name it without a path, or take the line out")
        for name in ("C:\\models\\part.mtl", "d:/models/part.mtl"):  # exporters write these by habit
            self.write("a.obj", f"mtllib {name}\nusemtl a\n{mesh}")
            outcome = self.run_csgrun("a.obj", "--stats")
            self.expect(outcome, 0)
            self.assertRegex(outcome.err, "a.obj: line 1: no colours: mtllib .* leads out of the file's folder")
        self.refuse("a.obj", f"mtllib C:\\models\\..\\part.mtl\nusemtl a\n{mesh}", "leads out of the file's folder: put")
        self.refuse("a.obj", mesh.replace("f 1 3 2", "f 1 3 99999999999999999999"), "a.obj:5")
        self.refuse("a.obj", mesh + "f" + " 1" * 2_000_000 + "\n", "a.obj: 1 face without area was dropped", codes=(0,))
        os.symlink("../secret.mtl", self.path("x.mtl"))
        self.write("model.lua", "return import('a.obj')")
        self.write("a.obj", "mtllib x.mtl\nusemtl a\n" + mesh)
        outcome = self.run_csgrun("model.lua", "--stats")
        self.assertNotIn(SECRET, outcome.err)
        self.assertIn("no colours", outcome.err)

    def test_counts(self):
        for vertices, faces in ((2**62, 1), (3, 2**62), (2**64 - 1, 2**64 - 1), (10**30, 1)):
            self.refuse("a.ply", ply(vertices, faces) + b"\0" * 200, "a.ply:")
            self.refuse("a.ply", ply(vertices, faces, "ascii") + b"0 0 0\n" * 20, "a.ply:")
            self.refuse("a.off", f"OFF\n{vertices} {faces} 0\n" + "0 0 0\n" * 20, "a.off:")
        self.refuse("a.ply", ply(3, 1) + b"\0" * 36 + b"\xff" + b"\0" * 12, "a.ply:")
        self.refuse("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n", "a.off:")
        self.refuse("a.stl", b"\0" * 80 + struct.pack("<I", 0xffffffff) + b"\0" * 100, "a.stl:")
        self.refuse("a.stl", b"solid" + b" " * 75 + struct.pack("<I", 0x7fffffff) + b"\0" * 50, "a.stl:")
        self.refuse("a.stl", b"\0" * 80 + struct.pack("<I", 1) + struct.pack("<12fH", *[float("nan")] * 12, 0), "a.stl:")

    def test_drawings(self):
        script = 'return import("a.svg"):linear_extrude(1)'
        for entity in ("../secret.bin", "file:///etc/passwd", "http://a.b/c"):
            self.refuse("a.svg", f'<!DOCTYPE svg [<!ENTITY x SYSTEM "{entity}">]><svg><text>&x;</text><path d="&x;"/></svg>',
                        "a.svg:", script)
        laughs = '<!DOCTYPE svg [<!ENTITY a "' + "x" * 1000 + '">' + "".join(
            f'<!ENTITY {chr(98 + i)} "' + f"&{chr(97 + i)};" * 100 + '">' for i in range(8)) + ']><svg><path d="&i;"/></svg>'
        self.refuse("a.svg", laughs, "a.svg:", script)
        uses = "".join(f"<g id='n{i}'>" + (f"<use href='#n{i - 1}'/>" * 10 if i else "<rect width='1' height='1'/>") + "</g>"
                       for i in range(12))
        self.refuse("a.svg", f"<svg>{uses}</svg>", "unfolds to more than", script)
        self.refuse("a.svg", "<svg><g id='a'><use href='#a'/></g></svg>", "a.svg:", script)
        self.refuse("a.svg", "<g>" * 300_000, "a.svg:", script)
        self.refuse("a.svg", "<svg>" + "<g>" * 100_000 + "</g>" * 100_000 + "</svg>", "a.svg:", script)
        self.refuse("a.svg", "<svg><path d='" + "M0 0" + "h1e300" * 3 + "v1z'/></svg>", "a.svg: |import: ", script)
        for href in ("../secret.bin#a", "http://a.b/c#a"):
            self.refuse("a.svg", f"<svg><use href='{href}'/><image href='{href}'/></svg>", "a.svg:", script)
        dxf = "0\nSECTION\n2\nENTITIES\n{}0\nENDSEC\n0\nEOF\n"
        block = "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\na\n0\nINSERT\n2\na\n10\n0\n20\n0\n0\nENDBLK\n0\nENDSEC\n"
        self.refuse("a.dxf", block + dxf.format("0\nINSERT\n2\na\n10\n0\n20\n0\n"), "a.dxf:", script.replace("svg", "dxf"))
        blocks = "0\nSECTION\n2\nBLOCKS\n" + "".join(
            f"0\nBLOCK\n2\nb{i}\n" + (f"0\nINSERT\n2\nb{i - 1}\n" * 10 if i else "0\nCIRCLE\n10\n0\n20\n0\n40\n1\n") + "0\nENDBLK\n"
            for i in range(12)) + "0\nENDSEC\n"
        self.refuse("a.dxf", blocks + dxf.format("0\nINSERT\n2\nb11\n"), "a.dxf:", script.replace("svg", "dxf"))
        self.refuse("a.dxf", blocks + dxf.format("0\nINSERT\n2\nb0\n70\n30000\n71\n30000\n"), "a.dxf:", script.replace("svg", "dxf"))
        self.refuse("a.dxf", dxf.format("0\nLWPOLYLINE\n90\n2000000000\n70\n1\n10\n0\n20\n0\n"),
                    "a.dxf:8: expected an LWPOLYLINE of", script.replace("svg", "dxf"))

    def test_trees(self):
        self.refuse("a.csg", "union() {" * 200_000, "a.csg:1: the file ends")
        self.refuse("a.csg", "cube(size = " + "[" * 1_000_000, "a.csg:1: ")
        self.refuse("a.csg", 'import(file = "../secret.bin");', "a.csg:1: ")
        self.refuse("a.csg", 'import(file = "../secret.stl");', "a.csg:1: .*outside")
        self.refuse("a.csg", 'surface(file = "/etc/passwd");', "a.csg:1: .*outside")
        self.refuse("a.csg", "sphere($fn = 1e9, $fa = 1, $fs = 1, r = 1);", "a.csg:1: ")
        self.refuse("a.csg", "linear_extrude(height = 1, twist = 1e9, slices = 1e9, segments = 1e9) { square(size = [1, 1]); }",
                    "a.csg:1: ")
        self.refuse("a.csg", 'text(text = "' + "x" * 1_000_000, "a.csg:1: ")

    def test_values(self):
        self.refuse("a.json", "[" * 3_000_000, "read_json: ", 'return read_json("a.json")')
        self.refuse("a.json", '{"a":' * 1_000_000 + "1" + "}" * 1_000_000, "read_json: ", 'return read_json("a.json")')
        self.refuse("a.json", "[1e999]", "read_json: ", 'return read_json("a.json")')
        self.refuse("a.csv", '"' + "x" * 10_000_000, "read_csv: .*quote", 'return read_csv("a.csv")')
        for name in ("../secret.bin", "/etc/passwd"):
            self.refuse("x", "", "outside", f'return read_text("{name}")')
        os.symlink("../secret.bin", self.path("link.txt"))
        self.refuse("x", "", "outside", 'return read_text("link.txt")')
        self.refuse("a.ttf", b"\0\1\0\0" + b"\xff" * 100_000, "a.ttf", 'return text("a", {font = "a.ttf"})')


if __name__ == "__main__":
    main()
