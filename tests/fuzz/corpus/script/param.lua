local n = param("n", 3, {min = 1, max = 10, step = 1, doc = "count"})
local name = param("name", "a", {choices = {"a", "b"}})
for i = 1, n do emit(cube(i):translate(2 * i * i), name .. i) end
