local s = cube(1)
for i = 1, 60 do s = s + s end
return s
