print(pcall(function() return cube(1).nothing end), pcall(function() cube(1).x = 1 end))
for k, v in pairs(csg) do print(k, v) end
return csg.cube(1)
