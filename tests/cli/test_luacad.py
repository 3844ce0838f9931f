"""A project as LuaCAD's users have them: twenty files, forty-three coloured parts, called by their names."""
import math

from support import Case, main

FN = 32


def module(index):
    """A file that makes two parts out of what the common file has; modelled beside the others."""
    return f"""
local u = require("parts.utils")
local palette = require("parts.palette")
local M = {{}}

local base = {{ {10 + index}, 6, 4 }}

function M.parts()
  local out = {{}}
  local function add(solid, look, name)
    out[#out + 1] = {{ solid = solid, color = palette.colors[look],
                     material = palette.materials[look], name = name }}
  end
  add(u.drilled(base, {1 + index % 3 * 0.25}):translate({20 * index}, 0, 0), "plate", "plate-{index}")
  local pin = (cylinder {{ h = 8, d = 3, center = true, fn = u.fn }}
      + sphere {{ r = 1.5, fn = u.fn }}:translate(0, 0, 4)):rotate(0, 90, {15 * index})
  add(pin:translate({20 * index}, 20, 0), "pin", "pin-{index}")
  return out
end

return M
"""


UTILS = """
local M = {}
M.fn = 32

local function cyl(h, r1, r2)
  return cylinder { h = h, r1 = r1, r2 = r2 or r1, center = true, fn = M.fn }
end
M.cyl = cyl

-- A plate with a hole, as every other file uses it.
function M.drilled(size, r)
  return cube { size, center = true } - cyl(2 * size[3], r)
end

function M.spiral(n)
  local shape, i = nil, 0
  while i < n do
    local bar = cube(4, 1, 1):rotate(0, 0, i * 360 / n)
    shape = shape and (shape + bar) or bar
    i = i + 1
  end
  return shape
end

return M
"""

PALETTE = """
local colors = { plate = "#2e3440", pin = "#d08770", ring = "gold", gem = "#88c0d0", wing = "#bf616a" }
local materials = { pin = "rubber", ring = { kind = "metal", roughness = 0.35 } }
return { colors = colors, materials = materials }
"""

MODEL = """
package.path = "./?.lua;" .. package.path

local u = require("parts.utils")
local palette = require("parts.palette")

local function finish(part)
  local solid = part.solid:color(part.color):name(part.name)
  return part.material and solid:material(part.material) or solid
end

for i = 1, 18 do
  for _, part in ipairs(require("parts.part" .. i).parts()) do
    render(finish(part):translate(0, 0, abs(-2) * floor(i / 2)))
  end
end

local extra = {
  { solid = torus { R = 6, r = 2, fn = u.fn }, color = palette.colors.ring, name = "ring",
    material = palette.materials.ring },
  { solid = octahedron(4):scale(1, 1, 2), color = palette.colors.gem, name = "gem" },
  { solid = pyramid(0, 0, 0, 6, 4), color = palette.colors.gem, name = "tip" },
  { solid = icosahedron { r = 3 }, color = palette.colors.gem, name = "ball" },
  { solid = polygon { points = { { 0, 0 }, { 10, 0 }, { 0, 5 } } }:linear_extrude(2), color = palette.colors.wing,
    name = "wing" },
  { solid = cube { 15, 15, 15, center = true }:intersect(sphere { r = 10, fn = u.fn }), color = "teal",
    name = "dice" },
  { solid = u.spiral(4), color = { 0.5, 0.25, 1 }, name = "spiral" },
}
for i, part in ipairs(extra) do
  render(finish(part):translate(20 * i, 60, 0))
end
render(t(cube(1000)))
"""


class Project(Case):
    def setUp(self):
        super().setUp()
        self.write("model.lua", MODEL)
        self.write("parts/utils.lua", UTILS)
        self.write("parts/palette.lua", PALETTE)
        for index in range(1, 19):
            self.write(f"parts/part{index}.lua", module(index))

    def test_runs_unchanged(self):
        outcome = self.run_csgrun("model.lua", "--fn", str(FN), "-o", "out.glb", "--stats=json")
        self.expect(outcome, 0)
        stats = outcome.json()
        self.assertEqual(stats["warnings"], [])
        parts = {part["name"]: part for part in stats["parts"]}
        self.assertEqual(len(stats["parts"]), 43)
        self.assertEqual(len(parts), 43)
        self.assertTrue(all(part["closed"] for part in parts.values()))
        self.assertEqual({name for name in parts if name.startswith("plate-")}, {f"plate-{i}" for i in range(1, 19)})
        gon = FN / 2 * math.sin(2 * math.pi / FN)  # of radius 1
        for i in range(1, 19):
            r = 1 + i % 3 * 0.25
            self.assertAlmostEqual(parts[f"plate-{i}"]["volume"], (10 + i) * 6 * 4 - gon * r * r * 4, delta=1e-3)
            self.assertAlmostEqual(parts[f"plate-{i}"]["bbox"][0][2], 2 * (i // 2) - 2, delta=1e-9)
        self.assertAlmostEqual(parts["gem"]["volume"], 4 / 3 * 64 * 2, delta=1e-6)
        self.assertAlmostEqual(parts["tip"]["volume"], 48, delta=1e-6)
        self.assertAlmostEqual(parts["wing"]["volume"], 50, delta=1e-9)

        gltf = self.read_glb("out.glb")
        nodes = {node["name"]: node for node in gltf["nodes"] if "mesh" in node}
        self.assertEqual(set(nodes), set(parts))

        def material(name):
            primitives = gltf["meshes"][nodes[name]["mesh"]]["primitives"]
            return gltf["materials"][primitives[0]["material"]]["pbrMetallicRoughness"]

        def linear(byte):
            c = byte / 255
            return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4
        for name, rgb, metallic, roughness in (("plate-7", (0x2e, 0x34, 0x40), 0, 0.6),
                                               ("pin-3", (0xd0, 0x87, 0x70), 0, 0.7),
                                               ("ring", (255, 215, 0), 1, 0.35), ("dice", (0, 128, 128), 0, 0.6)):
            look = material(name)
            for got, byte in zip(look["baseColorFactor"], rgb):
                self.assertAlmostEqual(got, linear(byte), delta=2e-6)
            self.assertAlmostEqual(look.get("metallicFactor", 1), metallic, delta=1e-6)
            self.assertAlmostEqual(look.get("roughnessFactor", 1), roughness, delta=1e-6)

    def test_the_same_bytes_again(self):
        files = []
        for threads in ("1", "2"):
            self.expect(self.run_csgrun("model.lua", "-o", "out.glb", "--threads", threads), 0)
            with open(self.path("out.glb"), "rb") as file:
                files.append(file.read())
        self.assertEqual(files[0], files[1])


if __name__ == "__main__":
    main()
