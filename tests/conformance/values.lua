-- Solids are values: immutable, shared, usable as keys, printed without addresses.
local a = cube(1)
local moved = a:translate(5, 0, 0)
assert(a:bbox().min[1] == 0 and moved:bbox().min[1] == 5)
assert(not pcall(function() a.x = 1 end))
assert(tostring(a) == "solid" and tostring(square(1)) == "shape" and tostring(rotate(1)) == "matrix")
assert(type(a) == "userdata" and getmetatable(a) == "solid")
local names = {[a] = "a", [moved] = "moved"}
assert(names[a] == "a" and names[moved] == "moved")

-- Settings reach what is made after them.
local before = cylinder(1, 1)
csg.fn = 4
assert(cylinder(1, 1):volume() == 2 and before:volume() > 2)
assert(cylinder{h = 1, r = 1, fn = 8}:volume() > 2.8)
csg.fn = 0

-- Every function stands in csg as well.
for _, name in ipairs{"cube", "sphere", "union", "translate", "sin", "import", "param", "emit"} do
  assert(csg[name] == _G[name], name)
end

-- Groups of parts, and their names.
emit({lid = a, box = moved}, {name = "case"})
emit(cube(2), {name = "foot"})
return {cube(3), spare = cube(4)}
