"""OpenSCAD's .csg trees, written as scripts of csgrun.

Each node becomes one call of the function that is its equal in the language. What a tree may hold and a
script may not (sizes that make nothing, flat things among solid ones) is settled here or by the few
functions that stand at the head of each script: OpenSCAD's rules, said in Lua.
"""
import math
import re

PRELUDE = """
local function is_flat(x) return tostring(x) == "shape" end
-- The children that count, and the first of all being one of them: of flat and solid things the kind of
-- the first that is not empty counts, and the others are as good as empty.
local function settled(children, count)
  local flat
  for i = 1, count do
    local x = children[i]
    if x and is_flat(x) and x:is_empty() then children[i] = false end
    if children[i] and flat == nil then flat = is_flat(x) end
  end
  local kept, missing = {}, flat == nil
  for i = 1, count do
    local x = children[i]
    if x and is_flat(x) == flat then kept[#kept + 1] = x else missing = true end
  end
  return kept, missing, children[1] and is_flat(children[1]) == flat
end
local function of(operation, children, count)
  local kept = settled(children, count)
  return #kept > 0 and operation(kept)
end
local function united(children, count) return of(union, children, count) end
local function reduced(children, count)
  local kept, _, first = settled(children, count)
  return first and difference(kept)
end
local function common(children, count)
  local kept, missing = settled(children, count)
  return not missing and intersection(kept)
end
local function kind_of(flat, children, count)
  for i = 1, count do
    if children[i] and is_flat(children[i]) ~= flat then children[i] = false end
  end
  return united(children, count)
end
local function mapped(change, x) return x and change(x) end
"""

TOKEN = re.compile(r'\s*(?:([A-Za-z_$][\w$]*|[-+]?(?:\d[\w.+-]*|\.\d[\w.+-]*|inf|nan))|(.))', re.S)
RAW_TEXT = re.compile(r'\s*text\s*=\s*"(.*?)", size = ', re.S)
STRING = re.compile(r'"((?:[^"\\]|\\.)*)"', re.S)
ESCAPES = {"n": "\n", "r": "\r", "t": "\t"}


class Word(str):
    """A number or a bare word, as it stands in the file."""


class Node:
    def __init__(self, name, hidden, arguments, children):
        self.name, self.hidden, self.arguments, self.children = name, hidden, arguments, children

    def get(self, key, otherwise=None):
        value = self.arguments.get(key)
        return otherwise if value is None or value == "undef" else value


class Reader:
    def __init__(self, text):
        self.text, self.at = text, 0

    def peek(self):
        while self.at < len(self.text) and self.text[self.at].isspace():
            self.at += 1
        return self.text[self.at:self.at + 1]

    def take(self, wanted):
        if self.peek() != wanted:
            raise ValueError(f"{wanted!r} expected before {self.text[self.at:self.at + 30]!r}")
        self.at += 1

    def word(self):
        found = TOKEN.match(self.text, self.at)
        if found is None or found[1] is None:
            raise ValueError(f"a word expected before {self.text[self.at:self.at + 30]!r}")
        self.at = found.end()
        return Word(found[1])

    def nodes(self):
        nodes = []
        while self.peek() not in ("", "}"):
            nodes.append(self.node())
        return nodes

    def node(self):
        hidden = False
        while self.peek() in "%#":
            hidden |= self.peek() == "%"
            self.at += 1
        name = self.word()
        self.take("(")
        arguments = self.arguments(name)
        children = []
        if self.peek() == "{":
            self.take("{")
            children = self.nodes()
            self.take("}")
        else:
            self.take(";")
        return Node(name, hidden, arguments, children)

    def arguments(self, name):
        arguments = {}
        raw = RAW_TEXT.match(self.text, self.at) if name == "text" else None
        if raw:  # its string is not escaped
            arguments["text"] = raw[1]
            self.at = raw.end() - len("size = ")
        while self.peek() != ")":
            start = self.at
            key = None
            if self.peek() not in '["':
                key = self.word()
                if self.peek() == "=":
                    self.take("=")
                else:
                    key, self.at = None, start
            arguments[key] = self.value()
            if self.peek() == ",":
                self.take(",")
        self.take(")")
        return arguments

    def value(self):
        if self.peek() == '"':
            found = STRING.match(self.text, self.at)
            self.at = found.end()
            return re.sub(r"\\(.)", lambda e: ESCAPES.get(e[1], e[1]), found[1])
        if self.peek() != "[":
            return self.word()
        self.take("[")
        values = []
        while self.peek() != "]":
            values.append(self.value())
            if self.peek() == ",":
                self.take(",")
        self.take("]")
        return values


def quoted(text):
    return '"' + "".join(f"\\{ord(c)}" if c in '"\\\n\r\t' else c for c in text) + '"'


def lua(value):
    """A value as Lua writes it; numbers stay as they stand in the file."""
    if isinstance(value, list):
        return "{" + ", ".join(lua(v) for v in value) + "}"
    return str(value) if isinstance(value, (Word, int, float)) else quoted(value)


def options(**given):
    return "{" + ", ".join(f"{key} = {lua(value)}" for key, value in given.items() if value is not None) + "}"


def facets(node):
    fn = node.get("$fn", Word("0"))
    if not math.isfinite(float(fn)):
        fn = Word("3")
    return {"fn": fn, "fa": node.get("$fa"), "fs": node.get("$fs")}


def good(*sizes, zero=False):
    """Whether such sizes make anything."""
    return all(math.isfinite(float(s)) and (float(s) > 0 or zero and float(s) == 0) for s in sizes)


def cube(node):
    size = node.get("size")
    return good(*size) and f"cube{options(size=size, center=node.get('center'))}"


def sphere(node):
    return good(node.get("r")) and f"sphere{options(r=node.get('r'), **facets(node))}"


def cylinder(node):
    h, r1, r2 = node.get("h"), node.get("r1"), node.get("r2")
    if not good(h) or not good(r1, r2, zero=True) or float(r1) == float(r2) == 0:
        return False
    return f"cylinder{options(h=h, r1=r1, r2=r2, center=node.get('center'), **facets(node))}"


def polyhedron(node):
    points = node.get("points")
    faces = []
    for face in node.get("faces"):
        known = [i for i in face if 0 <= float(i) < len(points)]
        if len({tuple(map(float, points[int(i)])) for i in known}) >= 3:
            faces.append(known)
    return bool(faces) and f"polyhedron{options(points=points, faces=faces)}"


def square(node):
    size = node.get("size")
    return good(*size) and f"square{options(size=size, center=node.get('center'))}"


def circle(node):
    return good(node.get("r")) and f"circle{options(r=node.get('r'), **facets(node))}"


def is_straight(points):
    """Whether an outline is one of no width."""
    (ax, ay), *rest = [[float(c) for c in point] for point in points]
    bx, by = next(((x, y) for x, y in rest if (x, y) != (ax, ay)), (ax, ay))
    return all((bx - ax) * (y - ay) == (by - ay) * (x - ax) for x, y in rest)


def polygon(node):
    points = node.get("points")
    paths = node.get("paths")
    if paths is not None:
        paths = [path for path in paths if len(path) >= 3]
    outlines = [points] if paths is None else [[points[int(i)] for i in path] for path in paths]
    if all(is_straight(outline) for outline in outlines):
        return False
    return f"polygon{options(points=node.get('points'), paths=paths)}"


def text(node):
    if node.get("text") == "" or not good(node.get("size")):
        return False
    names = ("text", "size", "font", "halign", "valign", "spacing", "direction", "language", "script")
    given = {name: node.get(name) for name in names}
    given = {name: value for name, value in given.items() if value not in ("", "default")}
    return f"text{options(as_openscad=Word('true'), **given, **facets(node))}"


def file_node(node):
    names = {".svg": ("id", "layer", "dpi", "center"), ".dxf": ("layer", "origin", "scale", "center")}
    given = {name: node.get(name) for name in names.get(node.get("file")[-4:].lower(), ())}
    more = facets(node) if given else {}
    given = {name: value for name, value in given.items() if value not in ("", "false")}
    if node.get("file")[-4:].lower() == ".svg":
        more["as_openscad"] = Word("true")
    return f"import({lua(node.get('file'))}, {options(**given, **more)})"


def surface(node):
    return f"surface{options(file=node.get('file'), center=node.get('center'), invert=node.get('invert'))}"


PRIMITIVES = {"cube": cube, "sphere": sphere, "cylinder": cylinder, "polyhedron": polyhedron, "square": square,
              "circle": circle, "polygon": polygon, "text": text, "import": file_node, "surface": surface}


def multmatrix(node):
    rows = node.arguments[None]
    numbers = [[float(x) for x in row] for row in rows]
    if not all(math.isfinite(x) for row in numbers for x in row):
        return False
    (a, b, c, _), (d, e, f, _), (g, h, i, _), (_, _, _, w) = numbers
    solid = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) != 0
    flat = a * e - b * d != 0
    if w != 1:
        rows = [[Word(x / w) for x in row] for row in numbers]
    move = f"x:multmatrix({lua(rows[:3])})"
    if solid and flat:
        return move
    return f"is_flat(x) == {lua(Word('true' if flat else 'false'))} and {solid or flat} and {move}".replace(
        "True", "true").replace("False", "false")


def color(node):
    rgba = node.arguments[None]
    if float(rgba[0]) < 0:
        return "x"
    clamped = [Word(min(max(float(c), 0), 1)) for c in rgba[:3]] + [Word(min(float(rgba[3]), 1))]
    if float(rgba[3]) < 0:
        clamped[3] = Word("1")
    return f"x:color({lua(clamped)})"


def offset(node):
    if node.get("r") is not None:
        return f"x:offset{options(r=node.get('r'), **facets(node))}"
    return f"x:offset{options(delta=node.get('delta'), chamfer=node.get('chamfer'), **facets(node))}"


def resize(node):
    size = [Word(max(float(s), 0)) for s in node.get("newsize")]
    auto = [Word("false" if float(a) == 0 else "true") for a in node.get("auto")]
    return f"x:resize(is_flat(x) and {lua(size[:2])} or {lua(size)}, {options(auto=auto)})"


def linear_extrude(node):
    v = node.get("v")
    if not good(node.get("height")) or v is not None and not good(v[2]):
        return False
    scale = node.get("scale")
    if isinstance(scale, list):
        scale = [Word(max(float(s), 0)) for s in scale]
    elif scale is not None:
        scale = Word(max(float(scale), 0))
    names = ("height", "v", "center", "twist", "slices", "segments")
    return f"x:linear_extrude{options(**{n: node.get(n) for n in names}, scale=scale, **facets(node))}"


def rotate_extrude(node):
    if float(node.get("angle", "360")) == 0:
        return False
    return f"x:rotate_extrude{options(angle=node.get('angle'), start=node.get('start'), **facets(node))}"


def projection(node):
    return f"x:projection{options(cut=node.get('cut'))}"


# What is done with the union of the children: any, flat ones only, or solid ones only.
CHANGES = {"multmatrix": ("united", multmatrix), "color": ("united", color), "resize": ("united", resize),
           "fill": ("united", lambda node: "is_flat(x) and x:fill() or x"),
           "offset": ("kind_of(true", offset), "linear_extrude": ("kind_of(true", linear_extrude),
           "rotate_extrude": ("kind_of(true", rotate_extrude), "projection": ("kind_of(false", projection)}
COMBINATIONS = {"union": "united", "group": "united", "render": "united", "difference": "reduced",
                "intersection": "common", "hull": "of(hull", "minkowski": "of(minkowski"}


def call(function, nodes, indent):
    """`function` of the list of what these nodes are; its count is told as well, for the gaps in it."""
    shown = [node for node in nodes if not node.hidden]
    if not shown:
        return "false"
    function += ", " if "(" in function else "("
    inside = ",\n".join("  " * (indent + 1) + expression(node, indent + 1) for node in shown)
    return f"{function}{{\n{inside},\n{'  ' * indent}}}, {len(shown)})"


def expression(node, indent=0):
    if node.name in PRIMITIVES:
        return PRIMITIVES[node.name](node) or "false"
    if node.name in COMBINATIONS:
        return call(COMBINATIONS[node.name], node.children, indent)
    united, change = CHANGES[node.name]
    changed = change(node)
    child = call(united, node.children, indent)
    if not changed or child == "false":
        return "false"
    return f"mapped(function(x) return {changed} end, {child})"


def translate(tree):
    """The script of a tree's text."""
    reader = Reader(tree)
    nodes = reader.nodes()
    if reader.peek():
        raise ValueError("more braces are closed than opened")
    return f"{PRELUDE}\nreturn {call('united', nodes, 0)}\n"
