local s = cube(1)
for i = 1, 3 do s = s + s:translate(i, i, 0) end
return s
