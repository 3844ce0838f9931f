local f = load("return cube(2) - ...", "chunk", "t", {cube = cube})
return f(cube(1))
