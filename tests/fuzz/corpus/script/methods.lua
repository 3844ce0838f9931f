local s = square{4, 2, center = true} - circle(0.5, {fn = 5})
return s:linear_extrude(3, {twist = 30, slices = 2, scale = {0.5, 1}})
