local t = {} t[1] = t t.t = t
print(t, tostring(t))
print(pcall(union, t))
return union{cube(1), {cube(2), {cube(3)}}}
