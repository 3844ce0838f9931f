local s = cube{1, 2, 3} - sphere(1, {fn = 8})
assert(s:volume() > 0)
local b = s:bbox() print(b, s:area(), s:centroid(), s:contains{0.9, 1.9, 2.9})
return s
