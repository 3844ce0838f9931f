local t = {3, 1, 2} table.sort(t, function(a, b) return a > b end)
print(table.concat(t, ","), table.unpack(t), select("#", table.unpack(t, 1, 50)), next({}), rawlen(t))
return cube(t[1])
