-- Fronts: surfaces that move along their normals, merge where they meet and tear where they thin out.
--
-- Two dented balls grow, and a plate with hollows on both sides is etched away. Each step moves the
-- vertices of a mesh, whatever that does to it; where it crosses itself then, the outer hull that minds
-- the surface's orientation says what is left: of what grew together, all that was swept, and nothing
-- of what was turned inside out. The stages lie behind one another, the first in front.

local stages = param("stages", 4, {min = 2, max = 8, step = 1, doc = "that are shown"})
local steps  = param("steps", 2, {min = 1, max = 10, step = 1, doc = "from one stage to the next"})
local growth = param("growth", 0.6, {min = 0.05, max = 1, doc = "of the balls, mm in a step"})
local etch   = param("etch", 0.24, {min = 0.05, max = 1, doc = "of the plate, mm in a step"})

-- The solid whose surface is that of `solid`, moved along its normals.
local function advance(solid, distance)
  local mesh = solid:mesh()
  local points, normals = mesh.points, {}
  for i = 1, #points do normals[i] = {0, 0, 0} end
  -- The normal of a corner of a triangle, weighted as on a sphere: u x v / (|u| |v|)^2 (N. Max, 1999).
  local function add(a, b, c)
    local p, q, r, n = points[a + 1], points[b + 1], points[c + 1], normals[a + 1]
    local ux, uy, uz = q[1] - p[1], q[2] - p[2], q[3] - p[3]
    local vx, vy, vz = r[1] - p[1], r[2] - p[2], r[3] - p[3]
    local weight = (ux * ux + uy * uy + uz * uz) * (vx * vx + vy * vy + vz * vz)
    if weight == 0 then return end
    n[1] = n[1] + (vy * uz - vz * uy) / weight  -- faces are clockwise: v x u points outwards
    n[2] = n[2] + (vz * ux - vx * uz) / weight
    n[3] = n[3] + (vx * uy - vy * ux) / weight
  end
  for _, f in ipairs(mesh.faces) do
    add(f[1], f[2], f[3])
    add(f[2], f[3], f[1])
    add(f[3], f[1], f[2])
  end
  for i, p in ipairs(points) do
    local n = normals[i]
    local length = math.sqrt(n[1] * n[1] + n[2] * n[2] + n[3] * n[3])
    if length > 0 then
      for k = 1, 3 do p[k] = p[k] + n[k] * distance / length end
    end
  end
  return outer_hull(polyhedron{points = points, faces = mesh.faces}, {orientation_sensitive = true})
end

-- A ball with dents.
local function dented_ball(radius)
  local mesh = sphere{r = radius, fn = 32}:mesh()
  for _, p in ipairs(mesh.points) do
    local dent = sin(24 * p[1] + 20) * sin(24 * p[2] + 50) * sin(24 * p[3] + 80)
    for k = 1, 3 do p[k] = p[k] * (1 - 0.3 * dent) end
  end
  return polyhedron(mesh)
end

-- A plate around the origin with five by three hollows above and below.
local hollow_size, across, along, pitch = 7.2, 30, 18, 1.2
local function half_thickness(x, y)
  local hollow = (1 + cos(360 / hollow_size * x)) * (1 + cos(360 / hollow_size * y)) / 4
  return 2.3 - 1.5 * hollow
end
local function hollow_plate()
  local points, faces = {}, {}
  local function face(a, b, c, d)
    faces[#faces + 1] = {a, b, c}
    faces[#faces + 1] = {a, c, d}
  end
  -- Top and bottom points in turn: those of column i and row j are at(i, j) and at(i, j) + 1.
  local function at(i, j) return 2 * (i * (along + 1) + j) end
  for i = 0, across do
    for j = 0, along do
      local x, y = (i - across / 2) * pitch, (j - along / 2) * pitch
      local z = half_thickness(x, y)
      points[#points + 1] = {x, y, z}
      points[#points + 1] = {x, y, -z}
    end
  end
  for i = 0, across - 1 do
    for j = 0, along - 1 do
      local a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
      face(a, d, c, b)
      face(a + 1, b + 1, c + 1, d + 1)
    end
    face(at(i, 0), at(i + 1, 0), at(i + 1, 0) + 1, at(i, 0) + 1)
    face(at(i + 1, along), at(i, along), at(i, along) + 1, at(i + 1, along) + 1)
  end
  for j = 0, along - 1 do
    face(at(0, j + 1), at(0, j), at(0, j) + 1, at(0, j + 1) + 1)
    face(at(across, j), at(across, j + 1), at(across, j + 1) + 1, at(across, j) + 1)
  end
  return polyhedron{points = points, faces = faces}
end

local balls = dented_ball(7):left(10) + dented_ball(7):right(10)
local plate = hollow_plate()
assert(balls:components() == 2 and plate:genus() == 0)

local colors = {"steelblue", "seagreen", "goldenrod", "orangered", "orchid", "slateblue", "teal", "sienna"}
local shown = {}
for stage = 1, stages do
  local back = (stage - 1) * 28
  shown[#shown + 1] = balls:translate(-24, back, 0):color(colors[stage])
  shown[#shown + 1] = plate:translate(24, back, 0):color(colors[stage])
  if stage < stages then
    for _ = 1, steps do
      balls = advance(balls, growth)
      plate = advance(plate, -etch)
    end
  end
end
print("in the end: balls " .. balls:components() .. ", holes " .. plate:genus())

return union(shown)
