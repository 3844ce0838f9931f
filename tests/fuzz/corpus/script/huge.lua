print(pcall(sphere, 1, {fn = 1e9}), pcall(cube, 1e308), pcall(cube, 0/0), pcall(circle, 1/0))
return cube(1e-300) + cube(1):translate(1e9, 0, 0)
