"""The pages of the language: made from the tables, up to date, and every example in them runs."""
import json
import os
import re
import subprocess

from support import CSGRUN, SOURCE, TETRAHEDRON, Case, main, stl

PRELUDE = """
local part, shape, lid = cube(10), square(5), cube(3)
local plate, hole, slot = cube{20, 20, 2}, cylinder(5, 2), cube(1)
local a, b, c = cube(2), cube(3), sphere(1)
"""


def page(form):
    return subprocess.run([CSGRUN, "--help-api=" + form], check=True, stdout=subprocess.PIPE).stdout.decode()


class Pages(Case):
    def committed(self, name):
        with open(os.path.join(SOURCE, name), encoding="utf-8") as file:
            return file.read()

    def test_they_are_up_to_date(self):
        for form, name in (("markdown", "docs/lua-api.md"), ("luals", "lua_bindings/meta/csgrun.lua")):
            self.assertEqual(page(form), self.committed(name), f"write it anew: csgrun --help-api={form} > {name}")

    def test_definitions_are_lua(self):
        self.write("csgrun_meta.lua", page("luals"))
        self.expect(self.run_script("assert(load(read_text('csgrun_meta.lua'))) return cube(1)"), 0)

    def test_every_function_has_a_definition_and_options_have_fields(self):
        text = page("luals")
        for name in re.findall(r"^### (\w+)$", page("markdown"), re.MULTILINE):
            self.assertRegex(text, rf"\nfunction (\w+:)?{name}\(")
        self.assertIn("---@field center? boolean|boolean[] ", text)
        self.assertRegex(text, r"---@overload fun\(options: csgrun.cube\): Solid")

    def test_forms(self):
        self.expect(self.run_csgrun("--help-api=html"), 2, "csgrun: --help-api can be =markdown, =luals, =json or nothing")
        self.assertIn("\ncube(size, center)\n", self.run_csgrun("--help-api").out)


class Examples(Case):
    def setUp(self):
        super().setUp()
        for name in ("scan.stl", "part.stl"):
            self.write(name, stl(TETRAHEDRON))
        self.write("notes.txt", "x")
        self.write("sizes.json", json.dumps({"width": 3}))
        self.write("points.csv", "x,y\n1,2\n")
        self.write("tree.csg", "cube(size = [1, 2, 3], center = false);\n")
        self.write("parts/wheel.lua", "return 5")

    def test_every_one_runs(self):
        sections = re.split(r"\n### ", page("markdown"))[1:]
        self.assertGreater(len(sections), 100)
        for section in sections:
            name = section.split("\n")[0]
            blocks = re.findall(r"```lua\n(.*?)\n```", section, re.DOTALL)
            self.assertEqual(len(blocks), 1, name)
            example = blocks[0].strip()
            self.assertTrue(example, f"{name} has no example")
            self.assertRegex(example, rf"\b{name}\b", "an example shows its function")
            outcome = self.run_script(f"{PRELUDE}\nlocal _ = {example}\nemit(cube(1))")
            if outcome.code == 1 and "unexpected symbol" in outcome.first or "expected near" in outcome.first:
                outcome = self.run_script(f"{PRELUDE}\n{example}\nemit(cube(1))")
            elif outcome.code == 1 and "<name> expected" in outcome.first:
                outcome = self.run_script(f"{PRELUDE}\n{example}\nemit(cube(1))")
            self.assertEqual(outcome.code, 0, f"{name}: {example}: {outcome.err}")
            self.assertEqual(outcome.json()["warnings"], [], f"{name}: {example}")


class Library(Case):
    def test_every_function_of_the_shipped_modules_is_told(self):
        for form in ("markdown", "text"):
            text = page(form)
            for module in ("gears", "threads", "layout"):
                with open(os.path.join(SOURCE, f"lua_bindings/library/csg/{module}.lua"), encoding="utf-8") as file:
                    calls = re.findall(rf"^function ({module}\.\w+\(.*\))$", file.read(), re.MULTILINE)
                self.assertGreater(len(calls), 4)
                self.assertEqual([call for call in calls if f"`{call}`" not in text and f"\n{call}\n" not in text], [])
            self.assertIn("csg.options", text)


class Everything(Case):
    def test_the_model_of_everything_has_every_function(self):
        with open(os.path.join(SOURCE, "tests/conformance/everything.lua"), encoding="utf-8") as file:
            model = file.read()
        self.assertGreater(len(model.split("\n")), 200)
        names = re.findall(r"^### (\w+)$", page("markdown"), re.MULTILINE)
        self.assertEqual([name for name in names if not re.search(rf"\b{name}\b", model)], [])


class Init(Case):
    def test_it_writes_what_editors_want(self):
        self.expect(self.run_csgrun("--init"), 0)
        with open(self.path(".luarc.json")) as file:
            settings = json.load(file)
        self.assertEqual(settings["workspace.library"], [".csgrun/library"])
        with open(self.path(".csgrun/library/csgrun.lua"), encoding="utf-8") as file:
            self.assertEqual(file.read(), page("luals"))
        # The modules that a model may require, with what they take, give and mean; they are Lua.
        for module in ("gears", "threads", "layout", "options"):
            with open(self.path(f".csgrun/library/csg/{module}.lua"), encoding="utf-8") as file:
                text = file.read()
            self.assertTrue(text.startswith(f"---@meta csg.{module}\n"), module)
            with open(os.path.join(SOURCE, f"lua_bindings/library/csg/{module}.lua"), encoding="utf-8") as file:
                calls = re.findall(rf"^(?:return )?function (?:{module}\.\w+)?\(.*\)$", file.read(), re.MULTILINE)
            calls = calls or ["return function(name, given, rules, level)"]
            for call in calls:
                self.assertRegex(text, r"---@return .*\n" + re.escape(call) + " end\n", module)
                for name in re.findall(r"\w+", call[call.index("("):]):
                    self.assertRegex(text, rf"---@param {name}\?? ", call)
            if module != "options":
                self.assertTrue(text.endswith(f"\nreturn {module}\n"))
            self.expect(self.run_script(f"local module = (function()\n{text}\nend)()\nemit(cube(1))"), 0)
        self.expect(self.run_csgrun("--init"), 0)  # again: nothing is another one
        self.write(".luarc.json", "{}")
        self.expect(self.run_csgrun("--init"), 4, "csgrun: .luarc.json is there already")
        with open(self.path(".luarc.json")) as file:
            self.assertEqual(file.read(), "{}")
        self.expect(self.run_csgrun("--init", "model.lua"), 2, "csgrun: --init takes no model")


if __name__ == "__main__":
    main()
