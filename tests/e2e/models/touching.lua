-- Shared edges and corners, hollows within hollows, a wedge that touches with its edge: all that is
-- closed only when edges with four faces are taken apart.
local touching = {}
for x = 0, 2 do
  for y = 0, 2 do
    for z = 0, 2 do
      if (x + y + z) % 2 == 0 then touching[#touching + 1] = cube(1):translate(x, y, z) end
    end
  end
end

local function ball(r) return sphere(r, {fn = 16}):translate(10, 0, 0) end
local hollow = ball(4) - ball(3) + ball(2) - ball(1)

-- A roof of two wedges whose edges meet in one line, on a plate with a hole that meets its rim.
local wedge = polygon{{0, 0}, {3, 0}, {3, 3}}:linear_extrude(4)
local roof = wedge:translate(-10, 0, 0) + wedge:mirror(1, 0, 0):translate(-10, 0, 0)
local plate = cube(6, 6, 1):translate(-14, -8, 0) - cylinder{h = 1, r = 3, fn = 36}:translate(-11, -5, 0)

return union(touching) + hollow + roof + plate
