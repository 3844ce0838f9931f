-- A ring with a stone: a brilliant that is read from a mesh file, in a setting of four claws.
--
-- The stone is its own tool. What it would share with the claws is taken away from them, so it sits in
-- the setting facet on facet, with no gap and no overlap, however the claws are changed.

local finger = param("finger", 17, {min = 12, max = 24, doc = "inner diameter of the ring, mm"})
local band   = param("band", 1.8, {min = 1, max = 5, doc = "thickness of the ring"})
local width  = param("width", 2.4, {min = 1, max = 10, doc = "of the ring"})
local carat  = param("carat", 1, {min = 0.1, max = 5, doc = "weight of the stone"})
local claws  = param("claws", 4, {min = 3, max = 8, step = 1})

-- The mesh is a stone of one carat, 6.5 mm wide; weight goes with the third power of size.
local size = carat ^ (1 / 3)
local stone_r = 6.5 / 2 * size

local inner = finger / 2
local girdle = inner + band + 1.6 * size  -- how high the stone sits above the finger's axis
local stone = import("meshes/brilliant.off"):scale(size):up(girdle)

-- The band: flat inside and round outside, turned about the finger.
local profile = square{band, width}:translate(inner, -width / 2)
              * circle{r = width * 0.7, fn = 48}:right(inner + band - width * 0.7)
local ring = profile:rotate_extrude{fn = 144}:rotate(90, 0, 0)

-- A claw leans outwards from the band and ends in a ball over the edge of the stone. The ball is turned
-- by half a facet, so that its edges do not run into those of the claw.
local claw_r = 0.16 * stone_r
local root = inner + band / 2
local lean = atan2(stone_r, girdle - root)
local reach = math.sqrt(stone_r ^ 2 + (girdle - root) ^ 2) + claw_r
local ball = sphere{r = claw_r * 1.15, fn = 24}:rotate(180 / 24)
local claw = (cylinder{h = reach, r = claw_r, fn = 24} + ball:up(reach))
  :rotate(0, lean, 0)
  :up(root)

-- A hoop half way up ties the claws together.
local hoop_z = (root + girdle) / 2 + 0.3 * size
local hoop = circle{r = claw_r * 0.8, fn = 16}:right((hoop_z - root) * tan(lean))
  :rotate_extrude{fn = 60}
  :up(hoop_z)

local setting = ring + hoop
for i = 1, claws do
  setting = setting + claw:rotate(360 / claws * (i + 0.5))
end

-- The finger's hole last: nothing of the claws may stand in it.
local hole = cylinder{h = 2 * girdle, r = inner, center = true, fn = 144}:rotate(90, 0, 0)
setting = setting - hole - stone
assert((setting * stone):is_empty())

return {
  setting = setting:color("gold", {metallic = 1, roughness = 0.25, name = "gold"}),
  stone   = stone:color("#c8ecff", 0.6, {roughness = 0.05, name = "diamond"}),
}
