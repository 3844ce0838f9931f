// Edges of solids whose sides are flat by the user's numbers, but not on the grid: what is cut off
// is what elementary geometry says.
#include "lua_support.h"

namespace csgrun::testing::edge_sides_test {
namespace {

/// ring(n, r, z): a regular polygon's corners. removed(T, B, d): what a chamfer by d takes from the
/// rim T of a side, from whose corners T[i] edges go towards B[i]: a wedge beside each edge, which
/// ends where the lines on the sides meet, and where they meet those edges. The rim is around
/// material, or around a hole. fillet_removed(n, {a, z}, {b, y}, r, fn): the same of a regular
/// prismatoid, of apothem a at height z, and b at y below it. chance(low, high): the same numbers
/// each time.
const std::string kTruth = R"(
  local function sub(a, b) return {a[1] - b[1], a[2] - b[2], a[3] - b[3]} end
  local function add(a, b, s) return {a[1] + b[1] * s, a[2] + b[2] * s, a[3] + b[3] * s} end
  local function dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end
  local function cross(a, b)
    return {a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1]}
  end
  local function unit(a) return add({0, 0, 0}, a, 1 / math.sqrt(dot(a, a))) end
  local function tetrahedron(a, b, c, d)
    return math.abs(dot(sub(b, a), cross(sub(c, a), sub(d, a)))) / 6
  end
  local function ring(n, r, z)
    local t = {}
    for i = 1, n do t[i] = {r * cos(i * 360 / n), r * sin(i * 360 / n), z} end
    return t
  end
  local function removed(T, B, d, is_hole)
    local n, normal, along, inwards = #T, {0, 0, 0}, {}, {}
    for i = 1, n do normal = add(normal, cross(T[i], T[i % n + 1]), 1) end
    for i = 1, n do
      along[i] = unit(sub(T[i % n + 1], T[i]))
      inwards[i] = add({0, 0, 0}, cross(unit(normal), along[i]), is_hole and -1 or 1)
    end
    local on_top, first, last, volume = {}, {}, {}, 0
    for i = 1, n do
      local before = (i - 2) % n + 1
      local u = unit(sub(B[i], T[i]))
      local function down(e) local c = cross(u, e) return add(T[i], u, d / math.sqrt(dot(c, c))) end
      on_top[i] = add(T[i], add(inwards[before], inwards[i], 1),
                      d / (1 + dot(inwards[before], inwards[i])))
      first[i], last[i] = down(along[i]), down(along[before])
    end
    for i = 1, n do
      local k = i % n + 1
      volume = volume + tetrahedron(T[i], on_top[i], first[i], T[k]) +
        tetrahedron(on_top[i], first[i], T[k], on_top[k]) +
        tetrahedron(first[i], T[k], on_top[k], last[k])
    end
    return volume
  end
  local function fillet_removed(n, top, below, r, fn, is_hole)
    local into = is_hole and 1 or -1
    local da, dz = below[1] - top[1], below[2] - top[2]
    local length = math.sqrt(da * da + dz * dz)
    da, dz = da / length, dz / length
    local turn = math.deg(math.acos(-da * into))
    local middle = {top[1] + into * r * tan(turn / 2), top[2] - r}
    local normal = {into * dz, -into * da}
    local parts = math.max(1, math.ceil(fn * turn / 360 - 1e-3))
    local profile = {top}
    for k = 0, parts do
      local p, q = sin(turn * (1 - k / parts)) / sin(turn), sin(turn * k / parts) / sin(turn)
      profile[k + 2] = {middle[1] + r * q * normal[1], middle[2] + r * (p + q * normal[2])}
    end
    local sum = 0
    for i, p in ipairs(profile) do
      local q = profile[i % #profile + 1]
      sum = sum + (p[1] ^ 2 + p[1] * q[1] + q[1] ^ 2) / 3 * (q[2] - p[2])
    end
    return math.abs(sum) * n * tan(180 / n)
  end
  local state = 1
  local function chance(low, high)
    state = (state * 1103515245 + 12345) % 2147483648
    return low + (high - low) * state / 2147483648
  end
  -- Up to the reach of bodies and the lift of arcs: some grid steps all around.
  local function near(found, wanted, what)
    assert(math.abs(found - wanted) < 1e-4, what .. ": " .. found .. " for " .. wanted)
  end
  local function is_convex(solid, what)
    -- Corners of hulls are rounded to the grid, on a surface of 1000 mm^2.
    assert(math.abs(hull(solid):volume() - solid:volume()) < 1e-3, what .. " is not convex")
  end
  -- Somewhere else, with the direction that was up.
  local function placed(solid)
    local angle, axis = chance(0, 180), {chance(-1, 1), chance(-1, 1), chance(-1, 1)}
    local up = cube(1, 1, 1, {center = true}):translate(0, 0, 1000):rotate(angle, axis):centroid()
    return solid:rotate(angle, axis):translate(chance(-9, 9), chance(-9, 9), chance(-9, 9)), up
  end
)";

TEST(EdgeSides, ChamferedConesAreConvex) {
  expect_good(kTruth + R"(
    local c = cylinder{h = 10, r1 = 6, r2 = 3, fn = 32}
    assert(#c:edges() == 64 and #c:edges{turn = 0} == 64)
    assert(#c:chamfer(.4, "top"):slice(9.9):points() == 32)
    for _, r in ipairs{{6, 3}, {10, 9}, {3, 6}} do
      for _, n in ipairs{3, 16, 30, 32, 60} do
        local cone, what = cylinder{h = 10, r1 = r[1], r2 = r[2], fn = n}, r[1] .. " " .. n
        local T, B = ring(n, r[2], 10), ring(n, r[1], 0)
        for _, solid in ipairs{{cone, "top"}, {placed(cone)}} do
          local which = solid[2]
          local how = type(which) == "string" and which or {on = which}
          local cut = solid[1]:chamfer(.1, {edges = how})
          near(solid[1]:volume() - cut:volume(), removed(T, B, .1), what)
          is_convex(cut, what)
        end
        is_convex(cone:chamfer(.05), what .. " both")
        local a = cos(180 / n)
        near(cone:volume() - cone:fillet(.1, {edges = "top", fn = 24}):volume(),
             fillet_removed(n, {r[2] * a, 10}, {r[1] * a, 0}, .1, 24), what .. " round")
      end
    end)");
}

TEST(EdgeSides, RimsOfWhatIsLoftedTurnedAndTrimmed) {
  expect_good(kTruth + R"(
    local function check(solid, T, B, size, what, is_hole)
      local n, r = #T, math.sqrt(T[1][1] ^ 2 + T[1][2] ^ 2)
      local a, b = r * cos(180 / n), math.sqrt(B[1][1] ^ 2 + B[1][2] ^ 2) * cos(180 / n)
      local turned, up = placed(solid)
      for _, s in ipairs{{solid, {0, 0, 1}}, {turned, up}} do
        local which = {on = s[2]}
        local volume = s[1]:volume()
        local all = s[1]:edges(which)
        if is_hole then  -- without the plate's own rim
          which = {}
          for _, e in ipairs(all) do if e.length < 10 then which[#which + 1] = e end end
          all = which
        end
        assert(#all == n, what .. ": " .. #all .. " edges")
        near(volume - s[1]:chamfer(size, {edges = which}):volume(), removed(T, B, size, is_hole),
             what)
        near(volume - s[1]:fillet(size, {edges = which, fn = 16}):volume(),
             fillet_removed(n, {a, T[1][3]}, {b, B[1][3]}, size, 16, is_hole), what .. " round")
      end
    end
    for _, n in ipairs{9, 24, 61} do
      check(loft({circle(6, {fn = n}), circle(4, {fn = n})}, 7), ring(n, 4, 7), ring(n, 6, 0), .1,
            "loft " .. n)
      check(circle(6, {fn = n}):linear_extrude(10, {scale = .8}), ring(n, 4.8, 10), ring(n, 6, 0),
            .3, "taper " .. n)
      check(polygon{{0, 0}, {6, 0}, {5, 3}, {3, 8}, {0, 8}}:rotate_extrude{fn = n}, ring(n, 3, 8),
            ring(n, 5, 3), .2, "turned " .. n)
      check(cube(20, 20, 5):translate(-10, -10, 0) -
              cylinder{h = 4, r1 = 3, r2 = 7, fn = n}:translate(0, 0, 3),
            ring(n, 5, 5), ring(n, 3, 3), .2, "countersunk " .. n, true)
    end
    -- A ball of 16 rings: z = 4 is between the sixth and the seventh.
    local function parallel(k)
      local angle = 180 * (k - .5) / 16
      return ring(32, 10 * sin(angle), 10 * cos(angle))
    end
    local lower, upper = parallel(7), parallel(6)
    local cut = {}
    for i, p in ipairs(lower) do
      local u = sub(upper[i], p)
      cut[i] = add(p, u, (4 - p[3]) / u[3])
    end
    check(sphere(10, {fn = 32}):trim({0, 0, -1}, -4), cut, lower, .2, "ball"))");
}

TEST(EdgeSides, RimsOfIrregularSides) {
  expect_good(kTruth + R"(
    for case = 1, 30 do
      local n, r, h, scale = math.floor(chance(3, 40)), chance(4, 8), chance(3, 10), chance(.5, 1.6)
      local corners, T, B = {}, {}, {}
      for i = 1, n do
        local angle = (i + chance(0, .7)) * 360 / n
        local x, y = r * cos(angle), r * sin(angle)
        corners[i], B[i], T[i] = {x, y}, {x, y, 0}, {scale * x, scale * y, h}
      end
      local solid, up = polygon(corners):linear_extrude(h, {scale = scale}), {0, 0, 1}
      if case % 2 == 0 then solid, up = placed(solid) end
      local size = chance(.02, .5) / n
      near(solid:volume() - solid:chamfer(size, {edges = {on = up}}):volume(), removed(T, B, size),
           "taper of " .. n)
      -- A cone whose top is aslant.
      local tilt, way = chance(5, 30), chance(0, 360)
      up = {sin(tilt) * cos(way), sin(tilt) * sin(way), cos(tilt)}
      local at = chance(7, 12) * up[3]
      T, B = ring(n, chance(3, 8), 20), ring(n, 6, 0)
      local cone = cylinder{h = 20, r1 = 6, r2 = math.sqrt(T[1][1] ^ 2 + T[1][2] ^ 2), fn = n}
      for i = 1, n do
        local u = sub(T[i], B[i])
        T[i] = add(B[i], u, (at - dot(B[i], up)) / dot(u, up))
      end
      solid = cone:trim({-up[1], -up[2], -up[3]}, -at)
      near(solid:volume() - solid:chamfer(size, {edges = {on = up}}):volume(), removed(T, B, size),
           "aslant, of " .. n)
    end)");
}

TEST(EdgeSides, TopsOfTwistedSolids) {
  // Their rims have corners on straight lines, where triangles of the sides end. What is left of
  // the top is its outline less the chamfer.
  expect_good(R"(
    for _, n in ipairs{4, 6, 12, 30} do
      for _, twist in ipairs{10, 45} do
        for _, scale in ipairs{1, .7} do
          local solid = circle(6, {fn = n}):linear_extrude(10, {twist = twist, scale = scale})
          local wanted = n * tan(180 / n) * (6 * scale * cos(180 / n) - .3) ^ 2
          for _, how in ipairs{"chamfer", "fillet"} do
            local cut = solid[how](solid, .3, {edges = "top", fn = how == "fillet" and 8 or nil})
            local what = how .. " " .. n .. " " .. twist .. " " .. scale
            assert(cut:components() == 1, what)
            if how == "chamfer" then
              local found = cut:slice(10 - 1e-5):area()
              assert(math.abs(found - wanted) < 2e-3, what .. ": " .. found .. " for " .. wanted)
            end
          end
        end
      end
    end)");
}

TEST(EdgeSides, FacetsOfAFineCurveAreSides) {
  expect_good(R"(
    for _, r in ipairs{1, 10, 100} do
      assert(#cylinder{h = r, r1 = r, r2 = r / 2, fn = 1000}:edges{turn = 0} == 2000)
      assert(#cylinder{h = r, r = r, fn = 1000}:edges() == 2000)
    end
    local cut = cylinder{h = 5, r1 = 10, r2 = 5, fn = 1000}:chamfer(.01, "top")
    assert(#cut:slice(4.995):points() == 1000))");
}

TEST(EdgeSides, AreOfManyFaces) {
  // A block whose top is aslant and of 800 triangles, all of them off its plane: with 12 edges. At
  // its upright edges the chamfer takes wedges as long as these.
  expect_good(R"(
    local n, points, faces = 20, {}, {}
    local function height(x, y) return 5 + .1234567 * x + .07654321 * y end
    for i = 0, n do
      for k = 0, n do points[#points + 1] = {i / 2, k / 2, height(i / 2, k / 2)} end
    end
    local below = #points
    for i = 1, below do points[#points + 1] = {points[i][1], points[i][2], 0} end
    local function at(i, k) return i * (n + 1) + k end
    local function face(a, b, c)
      faces[#faces + 1] = {a, b, c}
      faces[#faces + 1] = {a + below, c + below, b + below}
    end
    for i = 0, n - 1 do
      for k = 0, n - 1 do
        face(at(i, k), at(i + 1, k), at(i + 1, k + 1))
        face(at(i, k), at(i + 1, k + 1), at(i, k + 1))
      end
      local function wall(a, b) faces[#faces + 1] = {a, a + below, b + below, b} end
      wall(at(i, 0), at(i + 1, 0))
      wall(at(i + 1, n), at(i, n))
      wall(at(0, i + 1), at(0, i))
      wall(at(n, i), at(n, i + 1))
    end
    local block = polyhedron(points, faces)
    assert(#block:edges{turn = 0} == 12)
    local upright = block:volume() - block:chamfer(.5, "z"):volume()
    -- Over triangles of an area of 1/8, the height at their centroids.
    local wanted = 0
    for _, x in ipairs{1 / 6, 10 - 1 / 6} do
      for _, y in ipairs{1 / 6, 10 - 1 / 6} do wanted = wanted + height(x, y) / 8 end
    end
    assert(math.abs(upright - wanted) < 1e-5, upright .. " for " .. wanted)
    -- Six sides, twelve chamfers and eight tips have 48 edges.
    local cut = block:chamfer(.5)
    assert(#cut:edges() == 48 and math.abs(hull(cut):volume() - cut:volume()) < 1e-4))");
}

TEST(EdgeSides, AreOfTheGridOfTheirSolid) {
  // Another solid's, evaluated later, is coarser.
  expect_good(R"(
    local function turned() return cube(10):rotate(10, 20, 30) end
    local wanted = turned():chamfer(.01, "all"):volume()
    local solid = turned()
    assert(solid == cube(10):rotate(10, 20, 30) and #solid:edges() == 12)
    assert(#cube(1e6):rotate(1, 2, 3):faces() == 6)
    assert(solid:chamfer(.01):volume() == wanted))");
}

}  // namespace
}  // namespace csgrun::testing::edge_sides_test
