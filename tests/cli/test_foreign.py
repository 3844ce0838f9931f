"""Files as other programs write them: variants of the formats that csgrun itself never writes."""
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
        self.expect(self.run_csgrun(name, "--stats"), 1, name + ": " + message)

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


if __name__ == "__main__":
    main()
