"""What every function says of wrong arguments, tried for all of them from the table that `--help-api=json` prints.

A message has the place, the function, the argument and what was expected. Whatever is new in the table is
tried here without being named; only what a function cannot do without stands in NEEDS.
"""
import json
import os
import re
import subprocess

from support import CSGRUN, SOURCE, Case, main

# What must be given, besides the subject.
NEEDS = {
    "anchor": {}, "attach": {"to": "cube(3)"}, "chamfer": {"distance": "0.1"}, "fillet": {"r": "0.1"}, "color": {"c": '"red"'}, "setcolor": {"c": '"red"'},
    "contains": {"p": "{1, 1, 1}"}, "cross": {"a": "{1, 0, 0}", "b": "{0, 1, 0}"},
    "gap": {"other": "cube(1):right(9)"}, "grid_array": {"n": "{2, 2}", "step": "{9, 9}"},
    "import": {"file": '"a.off"'}, "levelset": {"f": "ball", "bounds": "{{-3, -3, -3}, {3, 3, 3}}"},
    "linear_array": {"n": "2", "v": "{9, 0, 0}"}, "load_csg": {"file": '"a.csg"'},
    "loft": {"outlines": "{square(4, true), circle(1)}", "heights": "{0, 3}"},
    "lookup": {"key": "1", "table": "{{0, 0}, {2, 4}}"}, "multmatrix": {"m": "{{1, 0, 0, 5}}"},
    "name": {"name": '"x"'}, "norm": {"v": "{1, 2, 3}"}, "param": {"name": '"p"', "default": "3"},
    "polar_array": {"n": "3"}, "polygon": {"points": "{{0, 0}, {4, 0}, {0, 4}}"},
    "polyhedron": {"points": "corners", "faces": "faces_of_corners"}, "pow": {"x": "2", "y": "3"},
    "rands": {"min": "0", "max": "1", "n": "2"}, "ray": {"from": "{-5, 1, 1}", "direction": "{1, 0, 0}"},
    "read_csv": {"file": '"a.csv"'}, "read_json": {"file": '"a.json"'}, "read_text": {"file": '"a.csv"'},
    "refine": {"length": "1"}, "regular_polygon": {"n": "5"}, "require": {"name": '"csg.gears"'},
    "resize": {"newsize": "{3, 3, 3}"}, "rotate": {"a": "30"}, "scale": {"v": "2"},
    "sweep": {"path": "{{0, 0, 0}, {0, 0, 9}}"}, "text": {"text": '"a"'}, "text3d": {"text": '"a"'},
    "text_metrics": {"text": '"a"'}, "textmetrics": {"text": '"a"'}, "translate": {"v": "{1, 2, 3}"},
    "move": {"v": "{1, 2, 3}"}, "var": {"doc": '"p"', "default": "3"}, "vec": {"v": "{1, 2, 3}"},
    "vector": {"v": "{1, 2, 3}"}, "warp": {"f": "same"}, "atan2": {"y": "1", "x": "1"},
    "atan2d": {"y": "1", "x": "1"},
    **{name: {"d": "1"} for name in ("up", "down", "left", "right", "forward", "front", "back", "tx", "ty", "tz")},
    **{name: {"a": "30"} for name in ("rx", "ry", "rz", "sin", "cos", "tan", "sind", "cosd", "tand")},
    **{name: {"x": "0.5"} for name in ("asin", "acos", "atan", "asind", "acosd", "atand", "abs", "sign", "floor", "ceil",
                                       "round", "sqrt", "exp", "ln")},
}
# What is given instead of another option, and cannot stand beside it.
INSTEAD = {("split", "point"): "offset", ("trim", "point"): "offset", ("translate", "x"): "v", ("move", "x"): "v",
           ("rotate", "x"): "a", ("scale", "x"): "v", ("surface", "file"): "heights"}
# Their arguments are solids, shapes or numbers in any number, not options.
OPEN = {"union", "difference", "intersection", "symmetric_difference", "add", "sub", "subtract", "intersect", "hull",
        "minkowski", "min", "max"}
# What is wrong with a value of a kind: none of these may pass.
WRONG = {
    "a number": ['"x"', "true", "{}", "{1, 2}", "cube(1)"],
    "a whole number": ['"x"', "true", "{}", "2.5"],
    "true or false": ["1", '"true"', "{}"],
    "true, false or a list of two of them": ["1", '"x"', "{true}", "{true, 1}", "{true, true, true}"],
    "true, false or a list of three of them": ["1", '"x"', "{true}", "{true, true, 1}", "{true, true}"],
    "true, false or a list of two or three of them": ["1", '"x"', "{true}", "{true, 1}"],
    "a string": ["5", "true", "{}"],
    "a list of two numbers": ["5", '"x"', "{1}", "{1, 2, 3}", '{1, "x"}', "{x = 1, y = 2}"],
    "a list of three numbers": ["5", '"x"', "{1}", "{1, 2}", '{1, 2, "x"}', "{1, 2, 3, 4}"],
    "a list of two or three numbers": ["5", '"x"', "{1}", '{1, "x"}', "{1, 2, 3, 4}"],
    "a number or a list of two numbers": ['"x"', "true", "{1}", '{1, "x"}', "{1, 2, 3}"],
    "a number or a list of three numbers": ['"x"', "true", "{1}", '{1, 2, "x"}', "{1, 2}"],
    "a number or a list of two or three numbers": ['"x"', "true", "{1}", '{1, 2, "x"}', "{1, 2, 3, 4}"],
    "a number or a list of up to three numbers": ['"x"', "true", '{1, "x"}', "{1, 2, 3, 4}"],
    "a list of points {x, y}": ["5", '"x"', "{5}", "{{1}, {2, 3}}", '{{1, "x"}, {2, 3}}', "{{1, 2, 3}, {2, 3, 4}}"],
    "a list of points {x, y, z}": ["5", '"x"', "{5}", "{{1, 2}}", '{{1, 2, "x"}, {2, 3, 4}}'],
    "a list of lists of indices (from 0)": ["5", '"x"', "{5}", '{{"x"}}', "{{-1, 0, 1}}", "{{0, 1, 2.5}}", "{{0, 1, 99}}"],
    "a matrix or a list of rows of numbers": ["5", '"x"', "{5}", '{{1, "x"}}', "{{1, 2, 3, 4, 5}}"],
    "a colour's name, '#rrggbb' or a list of three or four numbers from 0 to 1":
        ["5", "true", '"nonesuch"', '"#12"', "{1, 2}", "{2, 0, 0}", '{1, 0, "x"}'],
}
WRONG_VALUES = {  # of what a function looks at itself
    "outlines": ["5", "{}", "{square(1)}", "{cube(1), cube(2)}"], "heights": ['"x"', "{}", '{"a", "b"}', "{1}"],
    "f": ["5", '"x"'], "bounds": ["5", "{}", "{{1, 2, 3}}", "{{0, 0}, {1, 1}}"], "to": ["5", '"x"', "{}", "{1}"],
    "other": ["5", "square(1)", "{}"], "choices": ["5", "{}", '{"a"}'], "default": ["cube(1)", "print", '{"a"}'],
    "edges": ["5", '"up"', "true", '{"x", 5}', "{{}}"], "on": ["5", '"x"', "{1, 2}", "{1, 2, true}"],
    "along": ["5", '"top"', "{1, 2}", "{0, 0, 1/0}"],
    "repair": ["5", '"x"', "{weeld = 1}", "{weld = -1}", '{orient = "yes"}'],
    "file": ["5", "true", "{}", "{1, 2}"],
}
NUMBERS = ("a number", "a whole number")
VECTORS = re.compile(r"list of (two|three|two or three|up to three) numbers$")
STRANGE = {"nan": "0/0", "inf": "1/0", "-inf": "-1/0"}


def functions():
    text = subprocess.run([CSGRUN, "--help-api=json"], check=True, stdout=subprocess.PIPE).stdout
    return json.loads(text)["functions"]


class Messages(Case):
    PRELUDE = """local ball = function(x, y, z) return norm{x, y, z} - 2 end
        local same = function(x, y, z) return x, y, z end
        local corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}
        local faces_of_corners = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}
        local function try(f)
          local good, message = pcall(f)
          print("TRIED", good, ((tostring(message):gsub("\\n", " | "))))
        end """.replace("\n", " ")

    def setUp(self):
        super().setUp()
        self.functions = functions()
        self.write("a.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")
        self.write("a.csv", "1,2\n")
        self.write("a.json", "{}")
        self.write("a.csg", "cube(size = [1, 1, 1], center = false);\n")
        self.write("a.svg", "<svg><rect width='1' height='1'/></svg>")
        self.write("a.dxf", "0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n10\n0\n20\n0\n40\n2\n0\nENDSEC\n0\nEOF\n")
        self.cases = []

    def try_call(self, what, expression, *expected):
        """`expected`: None where either is good, "good", or what the message must have, in order."""
        self.cases.append((what, expression, expected))

    def run_cases(self):
        lines = [f"try(function() return {expression} end)" for _, expression, _ in self.cases]
        outcome = self.run_script(self.PRELUDE + "\n" + "\n".join(lines) + "\nreturn cube(1)")
        self.assertEqual(outcome.code, 0, outcome.err[-2000:])
        tried = [line.split("\t") for line in outcome.err.split("\n") if line.startswith("TRIED")]
        self.assertEqual(len(tried), len(self.cases))
        failures = []
        for number, ((what, expression, expected), (_, good, message)) in enumerate(zip(self.cases, tried)):
            place = f"model.lua:{number + 2}: "
            if good == "true":
                if expected not in ((None,), ("good",)):
                    failures.append(f"{what}: {expression} is taken")
                continue
            said = message[len(place):] if message.startswith(place) else ""
            wanted = ("",) if expected == (None,) else expected
            if not said or wanted == ("good",) or not all(re.search(part, said) for part in wanted):
                failures.append(f"{what}: {expression}: {message}")
        self.assertEqual(len(failures), 0, "\n".join([""] + failures))

    def subject(self, function):
        if function["name"] == "inverse":
            return "rotate(30)"
        if "solid" in function["methods"] or function["subject"] in ("part", "solid"):
            return "cube(2)"
        return "square(4)" if "shape" in function["methods"] or function["subject"] else ""

    def call(self, function, **options):
        """The function with these options, and with what it needs besides."""
        name = function["name"]
        given = {key: value for key, value in NEEDS.get(name, {}).items() if key not in options}
        for key in options:
            given.pop(INSTEAD.get((name, key), ""), None)
        if name == "surface" and "file" not in options and "heights" not in options:
            given["heights"] = "{{0, 1}, {1, 0}}"
        if name == "import" and options.keys() & {"layer", "id", "dpi", "center", "fn", "fa", "fs"}:
            given["file"] = '"a.svg"'
        if name == "import" and options.keys() & {"origin", "scale"}:
            given["file"] = '"a.dxf"'
        given.update({key: value for key, value in options.items() if value is not None})
        table = "{" + ", ".join(f"{key} = {value}" for key, value in given.items()) + "}"
        subject = self.subject(function)
        if not function["function"]:
            return f"{subject}:{name}({table})"
        return f"{name}({subject + ', ' if subject else ''}{table})"

    def each(self):
        return [f for f in self.functions if f["name"] not in OPEN]

    def test_every_option_is_shown_by_what_it_changes(self):
        outcome = self.run_csgrun(os.path.join(SOURCE, "tests/conformance/options.lua"), "-q", "--stats")
        self.expect(outcome, 0)
        shown = {line[6:] for line in outcome.err.split("\n") if line.startswith("SHOWN ")}
        options = {f"{function['name']}.{option['name']}" for function in self.functions for option in function["options"]}
        self.assertEqual(shown, options)

    def test_what_is_needed_is_enough(self):
        for function in self.each():
            if function["options"]:
                self.try_call("good", self.call(function), "good")
        self.run_cases()

    def test_misspelt_options(self):
        for function in self.each():
            names = [option["name"] for option in function["options"]]
            for name in names:
                wrong = name + "x" if name[-1] == name[:1] else name + name[-1]
                if wrong in names:
                    continue
                hint = r"\((did you mean|there (are|is)) " if len(name) < 3 else rf"\(did you mean '{name}'\?\)"
                self.try_call("misspelt", self.call(function, **{wrong: "1"}), rf"^{function['name']}: ",
                              rf"unknown option '{wrong}' {hint}")
        self.run_cases()

    def test_wrong_types(self):
        for function in self.each():
            for option in function["options"]:
                name, takes = option["name"], option["takes"]
                wrong = WRONG_VALUES[name] if takes == "a value" else WRONG[takes]
                if name == "points" or name == "path" or name == "table":
                    said = rf"'{name}'|point \d+|pair \d+"
                elif name in ("faces", "paths"):
                    said = rf"'{name}'|{name[:-1]} \d+"
                else:
                    said = rf"'{name}'|(outline|height|row|choice) \d+|as many heights|default of '|option 'repair'|no colour|no edge"
                for value in wrong:
                    if (function["name"], name, value) in (("resize", "newsize", "{1, 2}"),):
                        continue
                    self.try_call("wrong type", self.call(function, **{name: value}), rf"^{function['name']}: ", said,
                                  r"must |needs? |no edge of it is meant|there is no colour|unknown option|there are \d+ points")
        self.run_cases()

    def test_numbers_that_are_none(self):
        for function in self.each():
            for option in function["options"]:
                values = []
                if option["takes"] in NUMBERS or option["takes"].startswith("a number or "):
                    values += STRANGE.values()
                if VECTORS.search(option["takes"]):
                    size = 2 if option["takes"].endswith("two numbers") else 3
                    for place in range(size):
                        for strange in STRANGE.values():
                            values.append("{" + ", ".join(strange if i == place else "1" for i in range(size)) + "}")
                for value in values:
                    self.try_call("not finite", self.call(function, **{option["name"]: value}),
                                  rf"^{function['name']}: ", rf"option '{option['name']}' must be (finite|a whole number)",
                                  r"got (the number )?-?(nan|inf)")
        self.run_cases()

    def test_zero_and_less(self):
        for function in self.each():
            for option in function["options"]:
                if option["takes"] not in NUMBERS and not option["takes"].startswith("a number or "):
                    continue
                for value in ("0", "-1"):
                    call = self.call(function, **{option["name"]: value})
                    said = {"positive": "must be positive", "not negative": "must not be negative"}.get(option["range"])
                    if said is None or value == "0" and option["range"] == "not negative":
                        self.try_call("degenerate", call, None)
                    else:
                        self.try_call("degenerate", call, rf"^{function['name']}: ", rf"option '{option['name']}' {said}")
        self.run_cases()

    def test_vectors_of_nothing_and_less(self):
        refused = {("polar_array", "axis"), ("mirror_copy", "v"), ("linear_array", "v"), ("split", "normal"),
                   ("trim", "normal"), ("slice", "normal"), ("project", "direction"), ("faces", "normal"), ("ray", "direction"), ("linear_extrude", "v"), ("scale", "v"),
                   ("grid_array", "step"), ("grid_array", "n"), ("sweep", "up"), ("edges", "normal")}
        for function in self.each():
            for option in function["options"]:
                if not VECTORS.search(option["takes"]):
                    continue
                zero = "{0, 0}" if option["takes"].endswith("two numbers") else "{0, 0, 0}"
                call = self.call(function, **{option["name"]: zero})
                if option["range"] == "positive" or (function["name"], option["name"]) in refused:
                    self.try_call("zero", call, rf"^{function['name']}: ", "not be 0|be positive|and not 0|point upwards|from 1 on")
                else:
                    self.try_call("zero", call, "good")
                if option["range"] != "any":
                    call = self.call(function, **{option["name"]: zero.replace("0", "-1")})
                    self.try_call("negative", call, rf"^{function['name']}: ", "must (not be negative|be positive), got -1")
        self.run_cases()

    def test_words(self):
        """Strings that are names of something: each says what there is."""
        for function in self.each():
            for option in function["options"]:
                key = option["name"]
                if key in ("halign", "valign", "direction", "script", "fill", "kind") or function["name"] in ("anchor", "align") \
                        or (function["name"] == "attach" and key in ("at", "own")):
                    if option["takes"] == "a string":
                        self.try_call("word", self.call(function, **{key: '"nonsense"'}), rf"^{function['name']}: ",
                                      "must be|there is no", "nonsense")
        for call, said in (("text('\\xff')", "text: it is not in UTF-8: byte 1"),
                           ("rect{4, 3, r = 5}", "^rect: r must be at most half of the shorter side"),
                           ("torus{segments_minor = 2^60}", "^torus: option 'segments_minor': fn must be from 0 to 100000"),
                           ("cube{1, 1, 1, fn = 2^60}", "^cube: fn must be from 0 to 100000"),
                           ("cube(1):faces{angle = 200}", "^faces: option 'angle' must be at most 180, got 200"),
                           ("cube(1):grid_array({2, 1}, {0, 5})", "^grid_array: option 'step' must not be 0 along X"),
                           ("cube(1):polar_array(2, 0)", "^polar_array: option 'angle' must not be 0")):
            self.try_call("call", call, said)
        self.run_cases()

    def test_what_is_missing(self):
        for function in self.each():
            for name in NEEDS.get(function["name"], {}):
                self.try_call("missing", self.call(function, **{name: None}), rf"^{function['name']}: ", "needs ")
        self.run_cases()

    def test_subjects(self):
        for function in self.functions:
            name = function["name"]
            if function["methods"] and function["function"] and not function["subject"]:
                continue  # of transforms: without a subject they give a matrix
            if function["function"] and function["subject"]:
                for value in ("", "5", '"x"', "nil", "print"):
                    self.try_call("subject", f"{name}({value})", rf"^{name}: ", "solid|shape|matrix|part", "got |needs ")
            for kind, value in (("solid", "cube(1)"), ("shape", "square(1)")):
                if kind not in function["methods"] and function["methods"]:
                    self.try_call("no method", f"{value}:{name}()", rf"^a {kind} has no method '{name}'|^{name}: ")
        self.run_cases()

    def test_too_many_and_twice(self):
        for function in self.each():
            if not function["options"]:
                continue
            needs = NEEDS.get(function["name"], {})
            for option in function["options"]:
                if option["alias"] and option["name"] != "fn":
                    value = needs.get(option["name"], "{0, 0, 1}" if option["takes"] == "a list of three numbers" else "1")
                    both = {option["name"]: value, option["alias"]: value}
                    self.try_call("twice", self.call(function, **both), rf"^{function['name']}: ", "is given twice")
                    self.try_call("alias", self.call(function, **{option["name"]: None, option["alias"]: value}), "good")
        for call, said in (("cube(1, true, 3)", "cube: too many arguments: after 'center' only"),
                           ("cube(1, {size = 2})", "cube: option 'size' is given twice"),
                           ("sphere(1, 2)", "sphere: too many arguments: after 'r' only"),
                           ("circle(1, 2)", "circle: too many arguments"), ("cube(1, 2, 3, 4)", "got 4 numbers"),
                           ("square(1, 2, 3)", "got 3 numbers"), ("cube(nil)", "cube: option 'size' must be .* got nil"),
                           ("cube(1):up(1, 2)", "up: too many arguments"), ("sin(1, 2)", "sin: too many arguments"),
                           ("cube(1):volume(2)", "volume: takes no arguments"),
                           ("cube{[7] = 1}", "cube: option 'size' must be .* got a list whose entry 1 is nil"),
                           ("union(5)", "union: an operand must be a solid or a shape, got 5"),
                           ("union(cube(1), square(1))", "union: a solid and a 2D shape cannot be combined"),
                           ("hull()", "hull: needs a solid or a shape"), ("min()", "min: needs a number"),
                           ("max('x')", "max: takes numbers or a list of numbers, got the string \"x\""),
                           ("difference{cube(1), cutt = 'body'}", r"unknown option 'cutt' \(did you mean 'cut'\?\)"),
                           ("difference(cube(1), {cut = 'wood'})", "option 'cut' must be \"tool\" or \"body\", got \"wood\"")):
            self.try_call("call", call, said)
        self.run_cases()


if __name__ == "__main__":
    main()
