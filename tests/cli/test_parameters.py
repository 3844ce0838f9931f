"""Parameters from files and from the command line, and the schema that says which there are."""
import json

from support import Case, main

MODEL = """
local n = param("n", 4, {min = 1, max = 10, step = 0.5, doc = "how long"})
local label = param("label", "a", {choices = {"a", "b"}})
local size = param("size", {1, 2, 3}, {min = 0.5})
local on = param("on", true)
assert(var("Radius of the hole", 3) > 0)
return cube{n, size[2], on and 1 or 2}
"""


class Files(Case):
    def setUp(self):
        super().setUp()
        self.write("model.lua", MODEL)

    def volume(self, *arguments):
        outcome = self.run_csgrun("model.lua", "--stats=json", *arguments)
        self.expect(outcome, 0)
        return outcome.json()["parts"][0]["volume"]

    def refuse(self, message, *arguments):
        outcome = self.run_csgrun("model.lua", "--stats=json", *arguments)
        self.expect(outcome, 2, message)
        self.assertEqual(outcome.out, "")

    def test_names_and_values(self):
        self.write("p.json", json.dumps({"n": 2.5, "label": "b", "size": [1, 4, 1], "on": False}))
        self.assertEqual(self.volume("-p", "p.json"), 20)
        self.assertEqual(self.volume("-p", "p.json", "-D", "n=5"), 40)  # -D has the last word
        self.assertEqual(self.volume(), 8)

    def test_lists_are_as_long_as_their_defaults(self):
        for value, count in (("[1, 2]", 2), ("{1,2,3,4}", 4), ("[]", 0)):
            self.refuse(f"csgrun: -D size={value}: 'size' must be a list of 3 numbers, as its default is, got {count}",
                        "-D", f"size={value}")
        self.assertEqual(self.volume("-D", "size=[2, 3, 2]"), 12)
        outcome = self.run_script("local list = param('list', {}, {doc = 'any'}) return cube(#list + 1)", "-D", "list=[1, 2]", "--stats=json")
        self.assertEqual(outcome.json()["parts"][0]["volume"], 27)  # one of none may be of any length
        for asks in ('param("sizes", {})', 'param("sizes", {}, {doc = "edges"})', 'var("sizes", {})'):
            script = f"local sizes = {asks} local all = cube(2) for _, x in ipairs(sizes) do all = all + cube(x) end return all"
            self.assertEqual(self.run_script(script).json()["parts"][0]["volume"], 8, asks)
            outcome = self.run_script(script, "-D", "sizes={1,3}", "--stats=json")
            self.assertEqual(outcome.json()["parts"][0]["volume"], 27, asks)

    def test_sets_as_openscad_writes_them(self):
        self.write("p.json", json.dumps({"parameterSets": {
            "long": {"n": "10", "label": "b", "size": "[1, 2, 3]", "on": "true"}, "short": {"n": "1"}},
            "fileFormatVersion": "1"}))
        self.assertEqual(self.volume("-p", "p.json", "-P", "long"), 20)
        self.assertEqual(self.volume("-p", "p.json", "-P", "short"), 2)
        self.refuse("csgrun: -p p.json: choose a set with -P; there are long, short", "-p", "p.json")
        self.refuse("csgrun: -p p.json: there is no set 'shrt' (did you mean 'short'?); there are long, short",
                    "-p", "p.json", "-P", "shrt")
        self.write("p.json", json.dumps({"parameterSets": {"only": {"n": "3"}}}))
        self.assertEqual(self.volume("-p", "p.json"), 6)

    def test_mistakes(self):
        for values, message in (
                ({"n": 11}, "n=11: 'n' must be at most 10, got 11"),
                ({"n": 1.25}, "n=1.25: 'n' must be a whole number of steps of 0.5 from 1, got 1.25"),
                ({"n": "x"}, "n=x: 'n' must be a number"),
                ({"label": "c"}, "label=c: 'label' must be one of a, b"),
                ({"size": [1, 0, 1]}, "size=[1,0,1]: 'size' entry 2 must be at least 0.5, got 0"),
                ({"on": 1}, "on=1: 'on' must be true or false"),
                ({"m": 1}, "m: the model has no such parameter")):
            self.write("p.json", json.dumps(values))
            self.refuse("csgrun: -p p.json " + message, "-p", "p.json")
        self.write("p.json", '{"n": {"a": 1}}')
        self.refuse("csgrun: -p p.json: 'n' must be a number, true or false, a string or a list", "-p", "p.json")
        self.write("p.json", '{"n": 1')
        self.refuse("csgrun: -p p.json:1: malformed JSON: syntax error while parsing object - unexpected end of input", "-p", "p.json")
        self.write("p.json", "[1]")
        self.refuse("csgrun: -p p.json: must be a table of names and values", "-p", "p.json")
        self.write("p.json", "[" * 1000000)
        self.refuse("csgrun: -p p.json:1: malformed JSON: syntax error", "-p", "p.json")
        self.write("p.json", '{"parameterSets": 5}')
        self.refuse("csgrun: -p p.json: parameterSets has no sets", "-p", "p.json")
        self.write("p.json", '{"n": 1}')
        self.refuse("csgrun: -p p.json: has no sets, so -P x has no meaning", "-p", "p.json", "-P", "x")
        self.refuse("csgrun: -p none.json: cannot read it: No such file or directory", "-p", "none.json")
        self.refuse("csgrun: -P names a set in a file: give the file with -p", "-P", "x")
        self.write("a.off", "OFF\n0 0 0\n")
        self.expect(self.run_csgrun("a.off", "-p", "p.json", "--stats"), 2,
                    "csgrun: -p p.json n: only a script has parameters")


class Schema(Case):
    def test_all_kinds(self):
        self.write("model.lua", MODEL)
        outcome = self.run_csgrun("model.lua", "--list-params")
        self.expect(outcome, 0)
        schema = outcome.json()
        self.assertEqual(schema["type"], "object")
        self.assertFalse(schema["additionalProperties"])
        self.assertEqual(list(schema["properties"]), ["n", "label", "size", "on", "Radius of the hole"])
        self.assertEqual(schema["properties"], {
            "n": {"type": "number", "minimum": 1, "maximum": 10, "multipleOf": 0.5, "default": 4,
                  "description": "how long"},
            "label": {"type": "string", "default": "a", "enum": ["a", "b"]},
            "size": {"type": "array", "items": {"type": "number", "minimum": 0.5}, "minItems": 3, "maxItems": 3,
                     "default": [1, 2, 3]},
            "on": {"type": "boolean", "default": True},
            "Radius of the hole": {"type": "number", "default": 3, "description": "Radius of the hole"}})

    def test_steps_that_are_no_multiples(self):
        outcome = self.run_script("param('n', 1, {min = 1, step = 2}) return cube(1)", "--list-params")
        self.assertEqual(outcome.json()["properties"]["n"],
                         {"type": "number", "minimum": 1, "x-step": 2, "default": 1})

    def test_it_is_all_that_is_done(self):
        self.expect(self.run_script("return cube(1)", "--list-params", "-o", "a.stl"), 2,
                    "csgrun: --list-params writes no model")
        self.expect(self.run_script("\nerror('x')", "--list-params"), 1, "model.lua:2: x")
        self.assertEqual(self.run_script("return cube(1)", "--list-params").json()["properties"], {})


if __name__ == "__main__":
    main()
