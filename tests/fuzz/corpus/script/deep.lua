local s = cube(1)
for i = 1, 300 do s = s:translate(0.01, 0, 0) end
return s
