-- A tree from one rule: a branch ends in two thinner ones that lean apart. Values that are functions of
-- themselves are what a language with solids as values is for.

local levels = param("levels", 7, {min = 1, max = 10, step = 1})
local length = param("length", 40, {min = 5, max = 200, doc = "of the trunk, mm"})
local lean   = param("lean", 28, {min = 5, max = 60, doc = "of a branch, degrees"})
local shrink = param("shrink", 0.74, {min = 0.5, max = 0.85})

local function branch(l, level)
  local r = l / 9
  local limb = cylinder{h = l, r1 = r, r2 = r * shrink, fn = 12} + sphere{r = r * shrink, fn = 12}:up(l)
  if level == 1 then return limb end
  local smaller = branch(l * shrink, level - 1)
  return limb + union{
    smaller:rotate(0, lean, 15):up(l),
    smaller:rotate(0, -lean * 0.8, 100):up(l),
    smaller:rotate(0, lean * 0.9, 240):up(l),
  }
end

local ground = cylinder{h = 3, r = length * 0.6, fn = 64}:down(3)
return {tree = branch(length, math.min(levels, 6)):color("sienna"), ground = ground:color("olivedrab")}
