local a, b = cube(2), sphere(1, {fn = 6}):translate(1, 1, 1)
return (a + b) - (a * b):scale(2), a ~ b, (a | b) & a
