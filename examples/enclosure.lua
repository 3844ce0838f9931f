-- A box for a small circuit board with a lid that is screwed on, as two parts.
--
--   csgrun examples/enclosure.lua -o enclosure.glb           both parts, the lid lifted
--   csgrun examples/enclosure.lua -D lift=0 -o closed.glb    the lid in its place
--   csgrun examples/enclosure.lua -o 'enclosure-%s.stl'      a file for each part

local board  = param("board", {65, 40}, {doc = "length and width of the board, mm"})
local height = param("height", 24, {min = 12, max = 100, doc = "inside"})
local wall   = param("wall", 2, {min = 1, max = 6, doc = "of the box and the lid"})
local screw  = param("screw", 3, {min = 2, max = 5, doc = "diameter of the screws"})
local play   = param("play", 0.2, {min = 0, max = 1, doc = "between the lid's rim and the box"})
local lift   = param("lift", 20, {min = 0, max = 200, doc = "how far to show the lid above the box"})

csg.fn = 48

-- The screws stand in posts in the corners; the board fits between the posts at its ends.
local post = 2 * screw
local length, width = board[1] + 2 * post, board[2] + 2
local rounding = post / 2

-- A rectangle about the origin with round corners: four discs and what lies between them.
local function rounded(x, y, radius)
  local shape = square{x, y - 2 * radius, center = true} + square{x - 2 * radius, y, center = true}
  for _, sx in ipairs{-1, 1} do
    for _, sy in ipairs{-1, 1} do
      shape = shape + circle(radius):translate(sx * (x / 2 - radius), sy * (y / 2 - radius))
    end
  end
  return shape
end

-- One of a solid in each corner of a rectangle about the origin.
local function in_corners(solid, x, y)
  return union{
    solid:translate(x / 2, y / 2),
    solid:mirror(1, 0):translate(-x / 2, y / 2),
    solid:mirror(0, 1):translate(x / 2, -y / 2),
    solid:mirror(1, 0):mirror(0, 1):translate(-x / 2, -y / 2),
  }
end

local outside = rounded(length + 2 * wall, width + 2 * wall, rounding + wall)
local inside  = rounded(length, width, rounding)

-- A post fills its corner: it ends in the walls' inner faces, and the corner's arc is its own.
local corner = circle{d = post} + square(post / 2):left(post / 2) + square(post / 2):forward(post / 2)
local posts = in_corners((corner * circle{r = post}):translate(-post / 2, -post / 2), length, width)
local pilots = in_corners(circle{d = screw * 0.85}:translate(-post / 2, -post / 2), length, width)

local box = outside:linear_extrude(wall)
          + (outside - inside + inside * posts - pilots):linear_extrude(height):up(wall)

-- Four feet hold the board; a slot for its plug at one end, vents along both sides.
local foot = cylinder{h = 4, d1 = 7, d2 = 5} + cylinder{h = 6, d = 2.4}
box = box + in_corners(foot:translate(-4, -4), board[1], board[2]):up(wall)

local plug = rounded(9, 4, 1.5):linear_extrude(wall):rotate(90, 0, 90)
box = box - plug:translate(length / 2, 0, wall + 8)

local vent = cube(2, width + 2 * wall, height * 0.4):translate(-1, -width / 2 - wall, 0)
for i = -3, 3 do
  box = box - vent:translate(6 * i, 0, wall + height * 0.45)
end

-- The lid: a rim below that fits into the box between the posts, countersunk holes.
local rim = rounded(length - 2 * play, width - 2 * play, rounding)
local free = in_corners(square(post + play, post + play):translate(-post - play, -post - play),
                        length, width)
local lid = outside:linear_extrude(wall)
          + (rim - rounded(length - 4, width - 4, rounding) - free):linear_extrude(3):down(3)

local hole = cylinder{h = wall, d = screw * 1.1}
           + cylinder{h = wall / 2, d1 = screw * 1.1, d2 = screw * 1.1 + wall}:up(wall / 2)
lid = lid - in_corners(hole:translate(-post / 2, -post / 2), length, width)

return {
  box = box:color("slategray"),
  lid = lid:up(height + wall + lift):color("darkorange"),
}
