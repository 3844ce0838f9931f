-- Parts in groups, some of them the same solid elsewhere, with colours of every kind. They touch, and
-- stay apart where the format has parts.
local post = cylinder{h = 20, r = 2, fn = 24}:color{0.2, 0.4, 0.8}
local foot = cube{4, 4, 2, center = {true, true, false}}:color("#336699")
local leg = post + foot

emit(cube{40, 30, 2}:translate(-5, -5, 20):color("gold", 0.5), {name = "top"})

return {
  legs = {
    a = leg,
    b = leg:translate(30, 0, 0),
    c = leg:translate(0, 20, 0),
    d = leg:translate(30, 20, 0),
  },
  -- Two materials on one part: the pocket keeps the colour of its tool.
  tray = cube{20, 10, 4}:translate(5, 5, 22):color("firebrick")
    - sphere(4, {fn = 20}):translate(15, 10, 27):color("white"),
  turned = cube{3, 4, 5}:rotate(20, 30, 40):translate(0, 0, 60),
  mirrored = (post - cube(10):translate(0, 0, 15)):mirror(1, 1, 0):translate(0, 0, 80),
}
