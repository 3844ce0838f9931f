-- A Menger sponge, cut in half across its long diagonal.
--
-- The sponge is what three Sierpinski carpets have in common, each extruded along an axis. The cut
-- goes exactly through the middle of the sponge and shows stars with six points.

local level = param("level", 3, {min = 1, max = 4, step = 1, doc = "how often it is divided"})
local size  = param("size", 54, {min = 1, max = 1000, doc = "edge, mm"})
local halve = param("halve", true, {doc = "cut it, to show the stars"})

-- The holes of a carpet whose corner is the origin. All that are of one size are one shape, moved;
-- what is used many times is evaluated once.
local function carpet_holes(edge, depth)
  local third = edge / 3
  local holes = square(third):translate(third, third)
  if depth == 1 then return holes end
  local small = carpet_holes(third, depth - 1)
  local all = {holes}
  for i = 0, 2 do
    for j = 0, 2 do
      if i ~= 1 or j ~= 1 then all[#all + 1] = small:translate(i * third, j * third) end
    end
  end
  return union(all)
end

local prism = (square(size) - carpet_holes(size, level)):linear_extrude(size)

-- The other two directions: Z becomes X and then Y, by matrices of zeros and ones.
local along_x = prism:multmatrix{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}
local along_y = prism:multmatrix{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}
local sponge  = (prism * along_x * along_y):color("goldenrod")

if not halve then return sponge end

-- The corner of space where x + y + z is more than one and a half edges.
local reach = 1.5 * size
local corner = polyhedron{
  points = {{size, size, size}, {reach - 2 * size, size, size}, {size, reach - 2 * size, size},
            {size, size, reach - 2 * size}},
  faces = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}},
}
return sponge - corner:color("firebrick")
