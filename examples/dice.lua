-- A pair of dice: rounded cubes with pips; opposite faces add up to seven.
--
-- A cut face takes the colour of the tool that cut it, so white pips are white balls taken away.
-- Both dice are one solid, turned in two ways.

local size   = param("size", 16, {min = 5, max = 100, doc = "edge, mm"})
local pip    = param("pip", 3, {min = 0.5, max = 20, doc = "diameter of a pip"})
local colour = param("colour", "darkred", {doc = "of the dice"})

-- Places of the pips on a face, in thirds of its middle square.
local a = {-1, -1}; local b = {1, 1}; local c = {-1, 1}; local d = {1, -1}; local mid = {0, 0}
local faces = {
  {mid}, {a, b}, {a, mid, b}, {a, b, c, d}, {a, b, c, d, mid}, {a, b, c, d, {-1, 0}, {1, 0}},
}

-- How the top is turned to each face; 1, 2 and 3 run counter-clockwise around their corner.
local turns = {{0, 0, 0}, {-90, 0, 0}, {0, 90, 0}, {0, -90, 0}, {90, 0, 0}, {180, 0, 0}}

local ball = sphere{d = pip, fn = 24}:color("white")

local function pips(face)
  local balls = {}
  for i, place in ipairs(faces[face]) do
    balls[i] = ball:translate(place[1] * size / 4, place[2] * size / 4, size / 2)
  end
  return union(balls):rotate(turns[face])
end

-- A ball about the cube takes its corners off.
local die = (cube(size, {center = true}) * sphere{d = size * 1.42, fn = 96}):color(colour)
for face = 1, 6 do
  die = die - pips(face)
end
die = die:up(size / 2)

return {
  left  = die:rotate(25):left(size * 0.9),
  right = die:rotate(90, 0, 0):translate(0, size / 2, size / 2):rotate(-40):right(size * 0.9),
}
