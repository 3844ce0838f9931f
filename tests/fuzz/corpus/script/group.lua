return {base = cube(1), lid = {cube(2), top = sphere(1, {fn = 4})}}
