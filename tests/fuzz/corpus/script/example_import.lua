local part, a, b, plate, hole, slot, lid = cube(3), cube(1), cube(2), cube(4), cube(1), cube(2), cube(5)
import("part.stl")
return type(v) == "solid" and v or cube(1)
