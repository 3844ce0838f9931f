-- A mesh from a file beside the script, cut, and beside its own turned copy.
local octahedron = import("octahedron.off"):scale(10)
return {
  cut = octahedron - cube(20):translate(1, 2, 3),
  pair = (octahedron ~ octahedron:rotate(45)):translate(40, 0, 0),
}
