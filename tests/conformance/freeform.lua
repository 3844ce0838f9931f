-- Free forms: refined, smoothed, bent, sampled; tables of heights; round edges.
local function near(a, b, relative)
  assert(math.abs(a - b) <= (relative or 1e-12) * math.max(1, math.abs(b)), a .. " for " .. b)
end

assert(#cube(8):refine(3):mesh().faces > 100 and cube(8):refine(3):volume() == 512)
local egg = cube(10):refine(6):smooth(2)
assert(egg:volume() < 1000 and egg:genus() == 0 and egg:bbox().min[1] >= 0)
assert(smooth(cube(10), 1):volume() > cube(10):smooth{rounds = 3}:volume())

local bent = cube{40, 4, 4}:refine(2):warp(function(x, y, z) return x, y, z + 5 * sin(9 * x) end)
near(bent:volume(), 640, 1e-2)
assert(cube(2):warp(function(x, y, z) return {-x, y, 3 * z} end) == cube(2, 2, 6):left(2))
-- Two lobes, one of them turned over: each is a wedge of 50 x 5 / 2 x 10.
assert(cube(10):warp(function(x, y, z) return x * (z - 5), y, z end):volume() == 2500)

local function ball(x, y, z) return norm{x, y, z} - 8 end
local all = levelset(ball, {min = {-9, -9, -9}, max = {9, 9, 9}}, 0.5)
near(all:volume(), 4 / 3 * math.pi * 512, 1e-2)
local half = levelset{ball, bounds = {{-9, -9, 0}, {9, 9, 9}}, step = 0.5} -- cut with the bounds
near(half:volume(), 2 / 3 * math.pi * 512, 1e-2)
assert(half:bbox().min[3] == 0)
near(levelset(ball, {{-9, -9, -9}, {9, 9, 9}}, {step = 0.5, level = -2}):volume(),
     4 / 3 * math.pi * 216, 2e-2)
assert(levelset(function() return 1 end, {{0, 0, 0}, {1, 1, 1}}):is_empty())

assert(surface{heights = {{0, 1}, {2, 3}}}:volume() == 2.5)
assert(surface{heights = {{0, 1}, {2, 3}}, center = true}:bbox().min[1] == -0.5)

local brick = cube{20, 10, 5, r = 2, fn = 32, center = true}
assert(brick:bbox().max[1] == 10 and brick:volume() < 1000 and brick:volume() > 850)
near(cylinder{h = 10, r = 3, round = 3, fn = 64}:volume(), math.pi * (9 * 4 + 36), 1e-2)

-- offset of solids: by a ball, by a box, inwards.
assert(cube(10):offset{delta = 2} == cube(14):translate(-2, -2, -2))
assert(cube(10):offset{delta = -2} == cube(6):translate(2, 2, 2))
near(cube(10):offset(1, {fn = 64}):volume(), 1000 + 600 + 30 * math.pi + 4 / 3 * math.pi, 1e-3)
assert(cube(10):offset(-1) == cube(8):translate(1, 1, 1))
local frame = cube(10, 10, 2) - cube(4, 4, 4):translate(3, 3, -1)
assert(frame:offset{delta = -0.5} == cube(9, 9, 1):translate(0.5, 0.5, 0.5)
       - cube(5, 5, 4):translate(2.5, 2.5, -1))
return bent
