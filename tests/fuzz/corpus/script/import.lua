print(pcall(import, "part.stl"), pcall(import, "../../etc/passwd"), pcall(require, "os"), pcall(require, "a.b"))
return cube(1)
