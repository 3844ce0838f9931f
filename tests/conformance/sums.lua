-- A Minkowski sum is one solid wherever it stands: no cavity or sliver opens between its pieces.
-- Counts of surfaces and handles are the truth here, and volumes of what has been moved or scaled.
local function near(a, b, relative)
  assert(math.abs(a - b) <= (relative or 1e-12) * math.max(1, math.abs(b)), a .. " for " .. b)
end
local function expect(solid, components, genus, what)
  assert(solid:components() == components and solid:genus() == genus,
         what .. ": " .. solid:components() .. " surfaces, " .. solid:genus() .. " handles")
end

-- Corners off every decimal grid, some of them in planes that are not along the axes.
local function pierced(sides)
  local plate = cube(20, 20, 5)
  for i, at in ipairs{{6.1, 6.3}, {13.7, 7.9}, {9.2, 14.1}} do
    plate = plate - cylinder{h = 20, r = 1.7 + i / 7, fn = sides, center = true}:translate(at[1], at[2], 0)
  end
  return plate
end
local plate = pierced(31)
local sum = minkowski(plate, sphere{r = 0.7, fn = 10})
expect(sum, 1, 3, "as it is")
local volume = sum:volume()

-- Moved by parts of a step, mirrored, turned: the very same solid.
local places = {
  moved = sum:translate(1 / 3, 1 / 7, math.sqrt(2)),
  mirrored = sum:mirror(1, 1, 0):translate(1 / 3, 0, 0),
  ["mirrored askew"] = sum:mirror(1, 2, 3):translate(0, 1 / 3, 0),
  turned = sum:rotate(10, 20, 30):translate(1 / 3, 1 / 7, 0),
  ["turned, then all moved"] = (sum:rotate(0, 0, 45) + cube(1):translate(90, 0, 0)):translate(1 / 9, 0, 0),
}
for what, solid in pairs(places) do
  local extra = what == "turned, then all moved" and 1 or 0
  expect(solid, 1 + extra, 3, what)
  near(solid:volume(), volume + extra, 1e-9)
end
-- Copies by whole steps are flush with one another.
local row = sum:translate(1 / 3, 0, 0) + sum:translate(1 / 3 + 21.4, 0, 0)
expect(row, 1, 6, "side by side")

-- Scaled: what is summed is scaled, then rounded.
for _, scaled in ipairs{sum:scale(1.1), sum:scale(1, 2, 3), sum:rotate(20):scale(1.3, 1, 1), sum:resize(50, 0, 0)} do
  expect(scaled, 1, 3, "scaled")
end
near(sum:scale(1.1):volume(), volume * 1.1 ^ 3, 1e-6)
near(sum:scale(1, 2, 3):rotate(1, 2, 3):translate(1 / 3, 0, 0):volume(), volume * 6, 1e-6)
local block = minkowski(cube(10) - cube(5), cube(1)):scale(1.1)
assert(block + cube(12.1) == cube(12.1)) -- flush with what is as large

-- Beside others that ask for a coarser grid, alone or below other constructions.
for _, far in ipairs{100, 1000, 1e6} do
  expect(sum + cube(far / 100):translate(far, 0, 0), 2, 3, "beside a cube at " .. far)
end
local small = minkowski(cube(5, 5, 2) - cylinder{h = 9, r = 1.3, fn = 7, center = true}:translate(2.4, 2.6, 0),
                        sphere{r = 0.3, fn = 6})
expect(minkowski(small + cube(10):translate(1000, 0, 0), cube(0.2)), 2, 1, "in a sum, beside a cube")
expect(hull(sum) - sum + cube(10):translate(1000, 0, 0), 4, 0, "what a hull fills, and a cube")
-- So long a sum that it asks for a coarser grid than its operands do.
local long = cube(134, 20, 4) - cylinder{h = 9, r = 3, fn = 31, center = true}:translate(10, 10, 0)
  - cylinder{h = 9, r = 3, fn = 31, center = true}:translate(120.3, 9.7, 0)
expect(minkowski(long, sphere{r = 1.1, fn = 12}), 1, 2, "longer than its operands")

-- Sums of sums, and of operands in frames of their own.
expect(minkowski(minkowski(plate, cube(0.3)), sphere{r = 0.4, fn = 8}):translate(1 / 3, 0, 0), 1, 3, "twice")
expect(minkowski(plate:rotate(20), sphere{r = 0.7, fn = 10}:rotate(20)):translate(1 / 3, 0, 0), 1, 3, "both turned")
expect(minkowski(plate:rotate(20), cube(1)):translate(1 / 3, 0, 0), 1, 3, "one turned")

-- Two that are not convex, one with corners where planes of two frames meet: rounded for all of the sum alike.
local cut = intersection(cube{40, 40, 40, center = true}, cube{45, 45, 45, center = true}:rotate(33, -21, 50))
  - cube(5, 5, 5):translate(0, 0, 15) - cube{3, 3, 90, center = true}
local notched = minkowski(cut, cube(2, 2, 2) - cube(1, 1, 1):translate(1, 1, 1))
expect(notched, 1, 1, "neither convex")
assert(outer_hull(notched):components() == 1)

-- An operand that is moved, within the sum, or the sum as a whole: the same by whole steps.
assert(minkowski(plate:translate(1, 2, 3), cube(1)) == minkowski(plate, cube(1)):translate(1, 2, 3))
assert(minkowski(plate):translate(1 / 3, 0, 0) == plate:translate(1 / 3, 0, 0))
return sum
