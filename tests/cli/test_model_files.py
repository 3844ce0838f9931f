"""3MF and AMF as other programs write them, and as nobody should."""
import io
import zipfile

from support import SANITIZED, Case, main

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
MATERIAL = "http://schemas.microsoft.com/3dmanufacturing/material/2015/02"


class ModelFiles(Case):
    def model_3mf(self, resources, build, attributes='unit="millimeter"'):
        text = io.BytesIO()
        with zipfile.ZipFile(text, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("_rels/.rels", '<Relationships><Relationship Target="/3D/m.model" Id="r" '
                             'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>')
            archive.writestr("3D/m.model", f'<model {attributes} xmlns="{CORE}" xmlns:m="{MATERIAL}"><resources>'
                             f'{resources}</resources><build>{build}</build></model>')
        self.write("a.3mf", text.getvalue())

    TETRAHEDRON = ('<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/>'
                   '<vertex x="0" y="0" z="1"/></vertices><triangles><triangle v1="0" v2="2" v3="1"/>'
                   '<triangle v1="0" v2="1" v3="3"/><triangle v1="0" v2="3" v3="2"/><triangle v1="1" v2="2" v3="3"/>'
                   '</triangles></mesh>')

    def test_units_transforms_and_components(self):
        self.model_3mf(f'<object id="1">{self.TETRAHEDRON}</object><object id="2" name="pair"><components>'
                       '<component objectid="1"/><component objectid="1" transform="-1 0 0 0 1 0 0 0 1 -5 0 0"/></components>'
                       '</object>', '<item objectid="2" transform="2 0 0 0 2 0 0 0 2 0 0 1"/><item objectid="1"/>',
                       'unit="inch"')
        outcome = self.run_csgrun("a.3mf", "--stats=json")
        self.expect(outcome, 0)
        pair, single = outcome.json()["parts"]
        self.assertEqual((pair["name"], single["name"]), ("pair", "part1"))
        self.assertAlmostEqual(single["volume"], 25.4 ** 3 / 6, delta=1e-6)
        self.assertAlmostEqual(pair["volume"], 25.4 ** 3 / 6 * 16, delta=1e-5)
        self.assertEqual(pair["bbox"], [[-304.8, 0, 25.4], [50.8, 50.8, 76.2]])

    def test_colour_groups(self):
        self.model_3mf('<m:colorgroup id="4"><m:color color="#FF0000"/><m:color color="#0000FF80"/></m:colorgroup>'
                       f'<object id="1" pid="4" pindex="1">{self.TETRAHEDRON}</object>', '<item objectid="1"/>')
        self.expect(self.run_csgrun("a.3mf", "-o", "a.glb"), 0)
        (look,) = [m["pbrMetallicRoughness"] for m in self.read_glb("a.glb")["materials"]]
        self.assertEqual(look["baseColorFactor"][:3], [0, 0, 1])

    VERTICES = "<vertices>" + "".join(
        f"<vertex><coordinates><x>{x}</x><y>{y}</y><z> {z} </z></coordinates></vertex>"
        for x, y, z in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))) + "</vertices>"
    TRIANGLES = [f"<triangle><v1>{a}</v1><v2>{b}</v2><v3>{c}</v3></triangle>"
                 for a, b, c in ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))]
    VOLUME = f'<volume>{"".join(TRIANGLES)}</volume>'

    def amf(self, content, attributes="", name="a.amf"):
        self.write(name, f'<?xml version="1.0" encoding="UTF-8"?>\n<!-- by hand -->\n<amf {attributes}>{content}</amf>')

    def test_amf_objects_units_and_constellations(self):
        mesh = f"<mesh>{self.VERTICES}{self.VOLUME}</mesh>"
        self.amf(f'<object id="1"><metadata type="name">one</metadata>{mesh}</object><object id="2">{mesh}</object>'
                 '<constellation id="3"><metadata type="name">pair</metadata><instance objectid="2"/>'
                 '<instance objectid="2"><deltax>5</deltax><rz>90</rz></instance></constellation>', 'unit="inch"')
        outcome = self.run_csgrun("a.amf", "--stats=json")
        self.expect(outcome, 0)
        one, pair = outcome.json()["parts"]
        self.assertEqual((one["name"], pair["name"]), ("one", "pair"))
        self.assertAlmostEqual(one["volume"], 25.4 ** 3 / 6, delta=1e-6)
        self.assertAlmostEqual(pair["volume"], 25.4 ** 3 / 3, delta=1e-6)
        self.assertEqual(pair["bbox"], [[0, 0, 0], [127, 25.4, 25.4]])
        for part, told in zip(self.run_csgrun("info", "a.amf", "--json").json()["parts"], (one, pair)):
            self.assertAlmostEqual(part["volume"], told["volume"], delta=1e-9)

    def test_amf_volumes_of_one_object(self):
        # Two volumes that share a wall, as their two sides: inside they are one solid.
        wall = self.TRIANGLES[3].replace("<v1>1</v1><v2>2</v2>", "<v1>2</v1><v2>1</v2>")
        far = self.VERTICES.replace("</vertices>", "<vertex><coordinates><x>1</x><y>1</y><z>1</z></coordinates></vertex></vertices>")
        other = wall + "".join(f"<triangle><v1>{a}</v1><v2>{b}</v2><v3>4</v3></triangle>" for a, b in ((1, 2), (2, 3), (3, 1)))
        self.amf(f'<object id="1"><mesh>{far}{self.VOLUME}<volume>{other}</volume></mesh></object>')
        text = "import(file = \"a.amf\", origin = [0, 0], scale = 1, center = false, convexity = 1, timestamp = 0);\n"
        self.write("m.csg", text)
        for outcome in (self.run_csgrun("m.csg", "--stats=json"), self.run_script('return import("a.amf")', "--stats=json")):
            self.expect(outcome, 0)
            (part,) = outcome.json()["parts"]
            self.assertAlmostEqual(part["volume"], 1 / 6 + 1 / 3, delta=1e-12)
            self.assertEqual(part["components"], 1)

    def test_amf_colours(self):
        red, green, blue = ("<color>" + "".join(f"<{n}>{int(n == c)}</{n}>" for n in "rgb") + "</color>" for c in "rgb")
        own = self.TRIANGLES[0].replace("</v3>", "</v3>" + red)
        self.amf(f'<material id="7">{blue}</material><object id="1"><mesh>{self.VERTICES}<volume materialid="7">'
                 f'{own}{"".join(self.TRIANGLES[1:])}</volume></mesh></object>'
                 f'<object id="2">{green}<mesh>{self.VERTICES}{self.VOLUME}</mesh></object>')
        self.expect(self.run_csgrun("a.amf", "-o", "a.glb"), 0)
        looks = sorted(m["pbrMetallicRoughness"].get("baseColorFactor", [1] * 4)[:3] for m in self.read_glb("a.glb")["materials"])
        self.assertEqual(looks, [[0, 0, 1], [0, 1, 0], [1, 0, 0]])

    def test_centered(self):
        # The middle of the box of all parts, as OpenSCAD has it, and as a tree says it.
        self.amf(f'<object id="1"><mesh>{self.VERTICES}{self.VOLUME}</mesh></object><object id="2"><mesh>{self.VERTICES}'
                 f'{self.VOLUME}</mesh></object><constellation id="3"><instance objectid="1"><deltax>7</deltax></instance>'
                 '<instance objectid="2"/></constellation>')
        self.write("m.csg", 'import(file = "a.amf", origin = [0, 0], scale = 1, center = true, convexity = 1, timestamp = 0);')
        box = [[-4, -0.5, -0.5], [4, 0.5, 0.5]]
        tree = self.run_csgrun("m.csg", "--stats=json")
        whole = self.run_script('return import("a.amf", {center = true})', "--stats=json")
        parts = self.run_script('return union(import("a.amf", {center = true, parts = true}))', "--stats=json")
        for outcome in (tree, whole, parts):
            self.expect(outcome, 0)
            (part,) = outcome.json()["parts"]
            self.assertEqual(part["bbox"], box)
            self.assertAlmostEqual(part["volume"], 1 / 3, delta=1e-12)

    def test_zipped_amf(self):
        self.amf(f'<object id="1"><mesh>{self.VERTICES}{self.VOLUME}</mesh></object>', name="plain.amf")
        text = io.BytesIO()
        with zipfile.ZipFile(text, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("note.txt", "not this one")
            archive.write(self.path("plain.amf"), "model.amf")
        self.write("a.amf", text.getvalue())
        for name in ("a.amf", "plain.amf"):
            self.assertAlmostEqual(self.run_csgrun(name, "--stats=json").json()["parts"][0]["volume"], 1 / 6, delta=1e-12)

    def refuse(self, message, name="a.3mf"):
        for command in ((name, "--stats"), ("info", name)):
            outcome = self.run_csgrun(*command)
            self.expect(outcome, 1, name + ": ")
            self.assertIn(message, outcome.first)
            if not SANITIZED:
                self.assertLess(outcome.seconds, 1)
                self.assertLess(outcome.peak_mb, 200)

    def test_hostile_amf(self):
        mesh = f"<mesh>{self.VERTICES}{self.VOLUME}</mesh>"
        for content, message in (
                (f'<object id="1"><mesh>{self.VERTICES}{self.VOLUME.replace("<v1>1", "<v1>9")}</mesh></object>', "corner 9"),
                (f'<object id="1"><mesh>{self.VERTICES.replace("<x>1<", "<x>nan<")}{self.VOLUME}</mesh></object>', "no finite x"),
                (f'<object id="1"><mesh>{self.VERTICES}{self.VOLUME.replace("<v1>1<", "<v1>-1<")}</mesh></object>', "no v1"),
                (f'<object id="1">{mesh}</object><object id="1">{mesh}</object>', "the same id"),
                ('<constellation id="1"><instance objectid="2"/></constellation>', "there is no object"),
                ('<constellation id="1"><instance objectid="1"/></constellation>', "nest too deep"),
                ('<object id="1"/>', "has no faces"), ("<object", "malformed XML")):
            self.amf(content)
            self.refuse(message, "a.amf")
        self.amf("", 'unit="cubit"')
        self.refuse("there is no unit", "a.amf")
        self.write("a.amf", "PK no zip")
        self.refuse("it is no zip file", "a.amf")
        self.write("a.amf", "<stl/>")
        self.refuse("it is no AMF file", "a.amf")
        # Bombs: by compression, by constellations, by entities (which are not expanded).
        text = io.BytesIO()
        with zipfile.ZipFile(text, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("m.amf", b" " * 300_000_000)
        self.write("a.amf", text.getvalue())
        self.refuse("which no model does", "a.amf")
        tower = f'<object id="1">{mesh}</object>'
        for n in range(2, 31):
            tower += f'<constellation id="{n}">' + f'<instance objectid="{n - 1}"/>' * 10 + "</constellation>"
        self.amf(tower)
        self.refuse("multiply to more than a model would", "a.amf")
        self.write("a.amf", '<!DOCTYPE m [<!ENTITY a "' + "x" * 1000 + '">' + "".join(
            f'<!ENTITY {chr(98 + i)} "' + f"&{chr(97 + i)};" * 100 + '">' for i in range(8)) + "]><amf>&i;</amf>")
        self.refuse("has no faces", "a.amf")

    def test_hostile_3mf(self):
        self.write("a.3mf", "no zip")
        self.refuse("it is no zip file")
        item = '<item objectid="1"/>'
        for resources, build, message in (
                ("", item, "there is no object 1"),
                (f'<object id="1">{self.TETRAHEDRON}</object>', '<item objectid="1" transform="1 2 3"/>', "twelve finite numbers"),
                (f'<object id="1">{self.TETRAHEDRON}</object>', '<item objectid="1" p:path="/x"/>', 'it has no "x"'),
                (f'<object id="1">{self.TETRAHEDRON.replace(chr(34) + "3" + chr(34), chr(34) + "9" + chr(34))}</object>', item,
                 "corner 9"),
                ('<object id="1"><components><component objectid="1"/></components></object>', item, "nest too deep"),
                ('<object id="1"><mesh/></object>', item, "has no faces"),
                (f'<object id="1" pid="3" pindex="1">{self.TETRAHEDRON}</object><basematerials id="3"/>', item, "no material 1"),
                ('<basematerials id="3"><base name="x" displaycolor="red"/></basematerials>', "", "#RRGGBB")):
            self.model_3mf(resources, build)
            self.refuse(message)
        self.model_3mf(f'<object id="1">{self.TETRAHEDRON}</object>', item, 'unit="cubit"')
        self.refuse("there is no unit")

    def test_bombs(self):
        # By compression: a gigabyte of blanks.
        text = io.BytesIO()
        with zipfile.ZipFile(text, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("_rels/.rels", '<Relationships><Relationship Target="/m" Type="x/3dmodel"/></Relationships>')
            archive.writestr("m", b" " * 300_000_000)
        self.write("a.3mf", text.getvalue())
        self.refuse("which no model does")
        # By components: each of thirty objects is ten of the one before.
        tower = f'<object id="1">{self.TETRAHEDRON}</object>'
        for n in range(2, 31):
            tower += f'<object id="{n}"><components>' + f'<component objectid="{n - 1}"/>' * 10 + "</components></object>"
        self.model_3mf(tower, '<item objectid="30"/>')
        self.refuse("multiply to more than a model would")
        # By entities: they are not expanded.
        text = io.BytesIO()
        with zipfile.ZipFile(text, "w") as archive:
            archive.writestr("_rels/.rels", '<Relationships><Relationship Target="/m" Type="x/3dmodel"/></Relationships>')
            archive.writestr("m", '<!DOCTYPE m [<!ENTITY a "' + "x" * 1000 + '">' + "".join(
                f'<!ENTITY {chr(98 + i)} "' + f"&{chr(97 + i)};" * 100 + '">' for i in range(8)) + "]><model>&i;</model>")
        self.write("a.3mf", text.getvalue())
        self.refuse("no resources")


if __name__ == "__main__":
    main()
