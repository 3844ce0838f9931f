print(pcall(error, {}), pcall(error), xpcall(error, function(m) return m end, "x"))
local ok, m = pcall(cube, {size = {1, 2}, center = 3, nonsense = 4})
error(m, 2)
