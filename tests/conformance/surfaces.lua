-- Surfaces that cross themselves: fill rules, outer hulls, contacts.
local corners = {{0,0,0},{1,0,0},{0,1,0},{1,1,0},{0,0,1},{1,0,1},{0,1,1},{1,1,1}}
local sides = {{1,3,2,0},{6,7,5,4},{4,5,1,0},{3,7,6,2},{2,6,4,0},{5,7,3,1}} -- clockwise from outside

--- Boxes {x, y, z, size, inverted} in one polyhedron.
local function boxes(list, fill)
  local points, faces = {}, {}
  for _, b in ipairs(list) do
    local first = #points
    for _, c in ipairs(corners) do
      points[#points + 1] = {b[1] + c[1] * b[4], b[2] + c[2] * b[4], b[3] + c[3] * b[4]}
    end
    for _, side in ipairs(sides) do
      local face = {}
      for i = 1, 4 do face[i] = first + side[b[5] and 5 - i or i] end
      faces[#faces + 1] = face
    end
  end
  return polyhedron{points = points, faces = faces, fill = fill}
end

local a, b = cube(4), cube(4):translate(2, 2, 2)
local overlap, bite = {{0, 0, 0, 4}, {2, 2, 2, 4}}, {{0, 0, 0, 4}, {2, 2, 2, 3, true}}
assert(boxes(overlap) == a + b)
assert(boxes(overlap, "nonzero") == a + b)
assert(boxes(overlap, "positive") == a + b)
assert(boxes(overlap, "evenodd") == a ~ b)
assert(boxes(bite, "positive") == a - cube(3):translate(2, 2, 2))
assert(boxes(bite, "nonzero") == a ~ cube(3):translate(2, 2, 2))
assert(boxes(overlap):rotate(20, 30, 40) - b:up(1) == (a + b):rotate(20, 30, 40) - b:up(1))

-- Hulls: of results, of meshes as they are, as function and method.
local shell = cube(9) - cube(5):translate(2, 2, 2)
assert(outer_hull(shell) == cube(9))
assert(shell:outer_hull{keep_voids = true} == shell)
assert(outer_hull(shell, {orientation_sensitive = true, keep_voids = true}) == shell)
assert(boxes(overlap, "evenodd"):outer_hull() == a + b)
assert(boxes(bite, "evenodd"):outer_hull{orientation_sensitive = true} == a)
assert(boxes(bite):outer_hull{orientation_sensitive = true, keep_voids = true}
  == a - cube(3):translate(2, 2, 2))
assert(not pcall(outer_hull, shell, {keep_void = true}))
assert(not pcall(outer_hull, square(2)))

-- Contacts.
assert(csg.contacts == "separate")
assert((cube(1) + cube(1):translate(1, 1, 0)):components() == 2)
csg.contacts = "join"
assert((cube(1) + cube(1):translate(1, 1, 0)):components() == 1)
assert((cube(1) + cube(1):translate(1, 1, 1)):components() == 2)
assert(not pcall(function() csg.contacts = "joined" end) and csg.contacts == "join")
csg.contacts = "separate"
return boxes(overlap)
