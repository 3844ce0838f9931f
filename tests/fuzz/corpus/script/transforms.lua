local M = rotation(90, {0, 0, 1}) * translation(1, 2, 3)
return M * cube(1) + cube(1):mirror(1, 0, 0):scale(2, 1, 1):color("red")
