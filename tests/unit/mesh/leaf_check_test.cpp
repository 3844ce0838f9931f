#include "engine/mesh/leaf_check.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include <gmpxx.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "engine/mesh/box_frame.h"

namespace csgrun::test::leaf_check_test {
namespace {

// The truth, in rationals: the intersection of two convex polygons by clipping, then a look at what
// it consists of.
using Rational = mpq_class;
using Point = std::array<Rational, 3>;
using Polygon = std::vector<IVec3>;

Point exact(const IVec3& p) {
  return {Rational(mpz_class(static_cast<signed long>(p[0]))),
          Rational(static_cast<signed long>(p[1])), Rational(static_cast<signed long>(p[2]))};
}
Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Rational dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
bool is_zero(const Point& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }

Point normal_of(const Polygon& polygon) {
  Point sum{0, 0, 0};
  for (size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Point n =
        cross(exact(polygon[i]) - exact(polygon[0]), exact(polygon[i + 1]) - exact(polygon[0]));
    for (int k = 0; k < 3; ++k) sum[k] += n[k];
  }
  return sum;
}

/// Keeps what has n . (p - o) >= 0.
std::vector<Point> clip(const std::vector<Point>& polygon, const Point& n, const Point& o) {
  std::vector<Point> kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Rational s = dot(n, p - o), t = dot(n, q - o);
    if (s >= 0) kept.push_back(p);
    if ((s < 0 && t > 0) || (s > 0 && t < 0)) {
      const Rational r = s / (s - t);
      Point x;
      for (int k = 0; k < 3; ++k) x[k] = p[k] + r * (q[k] - p[k]);
      kept.push_back(x);
    }
  }
  return kept;
}

bool adjacent(const Polygon& polygon, const IVec3& a, const IVec3& b) {
  for (size_t i = 0; i < polygon.size(); ++i) {
    const IVec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    if ((p == a && q == b) || (p == b && q == a)) return true;
  }
  return false;
}

bool boxes_apart(const Polygon& f, const Polygon& g) {
  for (int k = 0; k < 3; ++k) {
    const auto less = [k](const IVec3& a, const IVec3& b) { return a[k] < b[k]; };
    const auto [f_lo, f_hi] = std::minmax_element(f.begin(), f.end(), less);
    const auto [g_lo, g_hi] = std::minmax_element(g.begin(), g.end(), less);
    if ((*f_hi)[k] < (*g_lo)[k] || (*g_hi)[k] < (*f_lo)[k]) return true;
  }
  return false;
}

bool true_conflict(const Polygon& f, const Polygon& g) {
  if (boxes_apart(f, g)) return false;
  const Point n = normal_of(g), o = exact(g[0]);
  std::vector<Point> common;
  for (const IVec3& p : f) common.push_back(exact(p));
  common = clip(common, n, o);
  common = clip(common, {-n[0], -n[1], -n[2]}, o);
  for (size_t i = 0; i < g.size(); ++i) {
    const Point a = exact(g[i]), b = exact(g[(i + 1) % g.size()]);
    common = clip(common, cross(n, b - a), a);
  }
  std::sort(common.begin(), common.end());
  common.erase(std::unique(common.begin(), common.end()), common.end());
  if (common.empty()) return false;
  const Point &first = common.front(), &last = common.back();
  for (const Point& p : common) {
    if (!is_zero(cross(p - first, last - first))) return true;
  }
  // A point or a segment: the corners of both along it.
  const auto along = [&](const Polygon& polygon) {
    std::vector<IVec3> run;
    for (const IVec3& p : polygon) {
      const Point x = exact(p);
      if (is_zero(cross(x - first, last - first)) && first <= x && x <= last &&
          (common.size() > 1 || x == first)) {
        run.push_back(p);
      }
    }
    std::sort(run.begin(), run.end());
    return run;
  };
  const auto run = along(f);
  if (run.empty() || run != along(g) || exact(run.front()) != first || exact(run.back()) != last) {
    return true;
  }
  for (size_t i = 0; i + 1 < run.size(); ++i) {
    if (!adjacent(f, run[i], run[i + 1]) || !adjacent(g, run[i], run[i + 1])) return true;
  }
  return false;
}

LeafGeometry leaf_of(const std::vector<Polygon>& faces) {
  LeafGeometry leaf;
  std::map<IVec3, uint32_t> number;
  for (const Polygon& face : faces) {
    for (const IVec3& p : face) {
      const auto [at, is_new] = number.try_emplace(p, static_cast<uint32_t>(leaf.vertices.size()));
      if (is_new) leaf.vertices.push_back(p);
      leaf.corners.push_back(at->second);
    }
    leaf.face_starts.push_back(static_cast<uint32_t>(leaf.corners.size()));
  }
  return leaf;
}

SurfaceCheck check(const std::vector<Polygon>& faces) { return check_surface(leaf_of(faces)); }
std::vector<std::array<uint32_t, 2>> crossings(const std::vector<Polygon>& faces) {
  return find_self_intersections(leaf_of(faces));
}
bool found(const std::vector<Polygon>& faces) { return !crossings(faces).empty(); }

IVec3 map_point(const std::array<IVec3, 3>& m, const IVec3& t, const IVec3& p) {
  IVec3 q = t;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) q[r] += m[r][c] * p[c];
  }
  return q;
}

/// A random convex polygon of the plane z = 0 on the grid {0..size}^2, some edges with 180 degree
/// corners.
Polygon flat_polygon(int size, std::mt19937& random) {
  for (;;) {
    std::vector<IVec3> points;
    for (int i = 0; i < 6; ++i) {
      points.push_back({static_cast<int64_t>(random() % (size + 1)),
                        static_cast<int64_t>(random() % (size + 1)), 0});
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    const auto turn = [](const IVec3& a, const IVec3& b, const IVec3& c) {
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    };
    Polygon hull;
    for (int pass = 0; pass < 2; ++pass) {
      const size_t base = hull.size();
      for (const IVec3& p : points) {
        while (hull.size() >= base + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) {
          hull.pop_back();
        }
        hull.push_back(p);
      }
      hull.pop_back();
      std::reverse(points.begin(), points.end());
    }
    if (hull.size() < 3) continue;
    Polygon result;
    for (size_t i = 0; i < hull.size(); ++i) {
      const IVec3 &a = hull[i], &b = hull[(i + 1) % hull.size()];
      const int64_t steps = std::gcd(b[0] - a[0], b[1] - a[1]);
      result.push_back(a);
      for (int64_t k = 1; k < steps; ++k) {
        if (random() % 2) {
          result.push_back({a[0] + (b[0] - a[0]) / steps * k, a[1] + (b[1] - a[1]) / steps * k, 0});
        }
      }
    }
    std::rotate(result.begin(), result.begin() + static_cast<long>(random() % result.size()),
                result.end());
    return result;
  }
}

IVec3 random_vector(int size, std::mt19937& random) {
  IVec3 v;
  for (auto& x : v) x = static_cast<int64_t>(random() % (2 * size + 1)) - size;
  return v;
}

Polygon random_face(std::mt19937& random) {
  Polygon polygon = flat_polygon(4, random);
  for (;;) {
    const std::array<IVec3, 3> m{random_vector(1, random), random_vector(1, random),
                                 random_vector(1, random)};
    Polygon moved;
    for (const IVec3& p : polygon) moved.push_back(map_point(m, random_vector(0, random), p));
    if (!is_zero(normal_of(moved))) return moved;
  }
}

TEST(LeafCheck, RandomPairsAgreeWithRationals) {
  std::mt19937 random(3);
  size_t conflicts = 0, touching = 0, coplanar = 0;
  for (int round = 0; round < 8000; ++round) {
    Polygon f = random_face(random), g = random_face(random);
    // Move g so that a corner of it, often, meets one of f; sometimes let it lie in f's plane.
    if (round % 5 == 0) {
      f = flat_polygon(5, random), g = flat_polygon(5, random);
      if (random() % 2) std::reverse(g.begin(), g.end());
    }
    const IVec3 &a = f[random() % f.size()], &b = g[random() % g.size()];
    const bool meet = random() % 4 != 0;
    IVec3 by = meet ? IVec3{a[0] - b[0], a[1] - b[1], a[2] - b[2]} : random_vector(3, random);
    if (round % 5 == 0 && !meet) by[2] = 0;
    for (IVec3& p : g) {
      for (int k = 0; k < 3; ++k) p[k] += by[k];
    }
    const bool expected = true_conflict(f, g);
    conflicts += expected;
    touching += !expected && meet;
    coplanar += round % 5 == 0;
    ASSERT_EQ(true_conflict(g, f), expected);
    ASSERT_EQ(found({f, g}), expected) << "round " << round;
    ASSERT_EQ(found({g, f}), expected) << "round " << round;
    // The same far out, stretched to coordinates of 40 bits: exact integer maps change nothing.
    const int64_t s = int64_t{1} << 34;
    const std::array<IVec3, 3> m{{{s, 1, 0}, {0, s, 3}, {5, 0, s}}};
    for (Polygon* polygon : {&f, &g}) {
      for (IVec3& p : *polygon) p = map_point(m, {-7 * s, 3 * s, 11}, p);
    }
    ASSERT_EQ(found({f, g}), expected) << "far, round " << round;
  }
  EXPECT_GT(conflicts, 1000u);
  EXPECT_GT(touching, 1000u);
}

TEST(LeafCheck, NeighboursOfOneMesh) {
  std::mt19937 random(9);
  size_t conflicts = 0;
  for (int round = 0; round < 5000; ++round) {
    // Two triangles with 0 to 3 corners in common.
    std::vector<IVec3> p;
    while (p.size() < 6) {
      p.push_back(random_vector(2, random));
    }
    const size_t shared = random() % 4;
    Polygon f{p[0], p[1], p[2]}, g{p[3], p[4], p[5]};
    for (size_t i = 0; i < shared; ++i) g[i] = f[i];
    std::shuffle(g.begin(), g.end(), random);
    if (is_zero(normal_of(f)) || is_zero(normal_of(g))) continue;
    const bool expected = true_conflict(f, g);
    conflicts += expected;
    ASSERT_EQ(found({f, g}), expected) << "round " << round;
  }
  EXPECT_GT(conflicts, 1000u);
}

TEST(LeafCheck, FindsAllPairsOnAnyThreads) {
  std::mt19937 random(21);
  for (const size_t count : {60, 60, 60, 60, 60, 3000}) {
    std::vector<Polygon> faces;
    for (size_t i = 0; i < count; ++i) {
      Polygon f = random_face(random);
      const IVec3 by = random_vector(count > 1000 ? 60 : 12, random);
      for (IVec3& p : f) {
        for (int k = 0; k < 3; ++k) p[k] += by[k];
      }
      faces.push_back(f);
    }
    std::vector<std::array<uint32_t, 2>> expected;
    for (uint32_t i = 0; i < faces.size(); ++i) {
      for (uint32_t j = i + 1; j < faces.size(); ++j) {
        if (true_conflict(faces[i], faces[j])) expected.push_back({i, j});
      }
    }
    EXPECT_FALSE(expected.empty());
    for (const int threads : {1, 3}) {
      tbb::task_arena arena(threads);
      arena.execute([&] { EXPECT_EQ(crossings(faces), expected) << threads << " threads"; });
    }
    const auto [f, g] = expected[0];
    const auto place = intersection_place(leaf_of(faces), f, g);
    for (int k = 0; k < 3; ++k) {
      for (uint32_t face : {f, g}) {
        int64_t lo = INT64_MAX, hi = INT64_MIN;
        for (const IVec3& p : faces[face]) lo = std::min(lo, p[k]), hi = std::max(hi, p[k]);
        EXPECT_GE(place[k], static_cast<double>(lo) - 1e-6);
        EXPECT_LE(place[k], static_cast<double>(hi) + 1e-6);
      }
    }
  }
}

// Fans of long triangles, aslant and close to one another: nearly all their boxes overlap.
TEST(LeafCheck, LongTrianglesAgreeWithRationals) {
  size_t conflicts = 0, apart = 0;
  for (unsigned round = 0; round < 12; ++round) {
    std::mt19937 random(400 + round);
    const std::array<IVec3, 3> map{random_vector(3000, random), random_vector(3000, random),
                                   random_vector(3000, random)};
    const IVec3 move = random_vector(1 << 28, random);
    std::vector<Polygon> faces;
    for (int fan = 0; fan < 6; ++fan) {
      const int64_t length = 200 + static_cast<int64_t>(random() % 400), height = random() % 4;
      const IVec3 hub = random_vector(6, random);
      IVec3 last = hub;
      last[0] += length;
      for (int i = 0; i < 12; ++i) {
        // Sometimes the fan is bent, or a triangle is left out.
        IVec3 next = last;
        next[1] += 1 + static_cast<int64_t>(random() % 4);
        next[2] += height == 0 ? static_cast<int64_t>(random() % 3) - 1 : 0;
        if (random() % 8 != 0) faces.push_back({hub, last, next});
        last = next;
      }
    }
    for (Polygon& face : faces) {
      for (IVec3& p : face) p = map_point(map, move, p);
    }
    std::vector<std::array<uint32_t, 2>> expected;
    for (uint32_t i = 0; i < faces.size(); ++i) {
      for (uint32_t j = i + 1; j < faces.size(); ++j) {
        if (is_zero(normal_of(faces[i])) || is_zero(normal_of(faces[j]))) continue;
        if (true_conflict(faces[i], faces[j])) {
          expected.push_back({i, j});
        } else {
          ++apart;
        }
      }
    }
    const LeafGeometry leaf = leaf_of(faces);
    ASSERT_TRUE(has_long_triangles(leaf));
    EXPECT_EQ(find_self_intersections(leaf), expected) << round;
    conflicts += expected.size();
  }
  EXPECT_GT(conflicts, 300u);
  EXPECT_GT(apart, 10000u);
}

std::vector<Polygon> box(const IVec3& lo, const IVec3& hi) {
  const auto c = [&](int x, int y, int z) {
    return IVec3{x ? hi[0] : lo[0], y ? hi[1] : lo[1], z ? hi[2] : lo[2]};
  };
  return {{c(0, 0, 0), c(0, 1, 0), c(1, 1, 0), c(1, 0, 0)},
          {c(0, 0, 1), c(1, 0, 1), c(1, 1, 1), c(0, 1, 1)},
          {c(0, 0, 0), c(1, 0, 0), c(1, 0, 1), c(0, 0, 1)},
          {c(1, 0, 0), c(1, 1, 0), c(1, 1, 1), c(1, 0, 1)},
          {c(1, 1, 0), c(0, 1, 0), c(0, 1, 1), c(1, 1, 1)},
          {c(0, 1, 0), c(0, 0, 0), c(0, 0, 1), c(0, 1, 1)}};
}

bool boxes_meet(const IVec3& lo, const IVec3& hi, const IVec3& lo2, const IVec3& hi2) {
  auto faces = box(lo, hi);
  for (auto& face : box(lo2, hi2)) faces.push_back(face);
  return found(faces);
}

TEST(LeafCheck, Boxes) {
  EXPECT_FALSE(found(box({0, 0, 0}, {2, 3, 4})));
  EXPECT_FALSE(boxes_meet({0, 0, 0}, {2, 2, 2}, {2, 2, 0}, {4, 4, 2}));  // share an edge
  EXPECT_FALSE(boxes_meet({0, 0, 0}, {2, 2, 2}, {2, 2, 2}, {4, 4, 4}));  // share a corner
  EXPECT_FALSE(boxes_meet({0, 0, 0}, {9, 9, 9}, {2, 2, 2}, {4, 4, 4}));  // nested
  EXPECT_TRUE(boxes_meet({0, 0, 0}, {2, 2, 2}, {2, 2, 1}, {4, 4, 3}));   // edges overlap in part
  EXPECT_TRUE(boxes_meet({0, 0, 0}, {2, 2, 2}, {2, 0, 0}, {4, 2, 2}));   // share a face
  EXPECT_TRUE(boxes_meet({0, 0, 0}, {2, 2, 2}, {1, 1, 1}, {3, 3, 3}));
  EXPECT_TRUE(boxes_meet({0, 0, 0}, {9, 9, 9}, {2, 2, 0}, {4, 4, 4}));  // touches from inside
}

std::vector<Polygon> inverted(std::vector<Polygon> faces) {
  for (Polygon& face : faces) std::reverse(face.begin(), face.end());
  return faces;
}
std::vector<Polygon> joined(std::vector<Polygon> a, const std::vector<Polygon>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(LeafCheck, ShellsThatBoundASolid) {
  const auto outer = box({0, 0, 0}, {9, 9, 9}), inner = box({2, 2, 2}, {7, 7, 7}),
             core = box({3, 3, 3}, {4, 4, 4}), beside = box({20, 0, 0}, {21, 1, 1}),
             at_edge = box({9, 9, 0}, {12, 12, 9}), at_corner = box({9, 9, 9}, {11, 11, 11});
  const auto bounds = [](const std::vector<Polygon>& faces) {
    const SurfaceCheck result = check(faces);
    EXPECT_TRUE(result.crossings.empty());
    return result.bounds_solid;
  };
  EXPECT_TRUE(bounds(outer));
  EXPECT_TRUE(check(outer).connected);
  EXPECT_FALSE(bounds(inverted(outer)));
  EXPECT_TRUE(bounds(joined(outer, inverted(inner))));
  EXPECT_FALSE(check(joined(outer, inverted(inner))).connected);
  EXPECT_FALSE(bounds(joined(outer, inner)));
  EXPECT_TRUE(bounds(joined(joined(outer, inverted(inner)), core)));
  EXPECT_FALSE(bounds(joined(joined(outer, inverted(inner)), inverted(core))));
  EXPECT_TRUE(bounds(joined(outer, beside)));
  EXPECT_FALSE(bounds(joined(outer, inverted(beside))));
  for (const auto& touching : {at_edge, at_corner}) {
    EXPECT_TRUE(bounds(joined(outer, touching)));
    EXPECT_FALSE(bounds(joined(outer, inverted(touching))));
    EXPECT_FALSE(bounds(joined(inverted(outer), touching)));
  }
}

TEST(LeafCheck, NestedShellsFarOutAndTurned) {
  // The same in any axes and for coordinates of 40 bits; rays meet edges and vertices of other
  // shells.
  const auto outer = box({0, 0, 0}, {9, 9, 9}), inner = box({3, 3, 3}, {6, 6, 6});
  const int64_t s = int64_t{1} << 35;
  for (const auto& m : {std::array<IVec3, 3>{{{s, 1, 0}, {0, s, 3}, {5, 0, s}}},
                        std::array<IVec3, 3>{{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}},
                        std::array<IVec3, 3>{{{1, 1, 0}, {-1, 1, 0}, {0, 0, 1}}}}) {
    for (const bool good : {true, false}) {
      auto faces = joined(outer, good ? inverted(inner) : inner);
      for (Polygon& face : faces) {
        for (IVec3& p : face) p = map_point(m, {-4, 7, 0}, p);
      }
      EXPECT_EQ(check(faces).bounds_solid, good);
    }
  }
}

TEST(LeafCheck, FoldsAndDuplicates) {
  // Folded over a common edge into its own plane.
  EXPECT_TRUE(found({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 0, 0}, {4, 0, 0}, {1, 2, 0}}}));
  EXPECT_TRUE(found({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{4, 0, 0}, {0, 0, 0}, {1, 2, 0}}}));
  EXPECT_FALSE(found({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{4, 0, 0}, {0, 0, 0}, {1, -2, 0}}}));
  // The same face twice, and on its own back.
  EXPECT_TRUE(found({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{4, 0, 0}, {0, 4, 0}, {0, 0, 0}}}));
  EXPECT_TRUE(found({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 4, 0}, {4, 0, 0}, {0, 0, 0}}}));
}

TEST(LeafCheck, ManyCorners) {
  // A prism over a polygon of many corners: its lids have hundreds of edges each.
  std::vector<IVec3> ring;
  for (int64_t i = -200; i < 200; ++i) ring.push_back({i, i * i, 0});
  std::vector<Polygon> faces(2);
  for (size_t i = 0; i < ring.size(); ++i) {
    const IVec3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    faces.push_back({a, b, {b[0], b[1], 7}, {a[0], a[1], 7}});
    faces[1].push_back({a[0], a[1], 7});
    faces[0].push_back(ring[ring.size() - 1 - i]);
  }
  EXPECT_FALSE(found(faces));
  // A needle that stands on the lid: in its inside, on an edge, on a corner.
  const auto needle = [&](const IVec3& tip) {
    auto with = faces;
    with.push_back({tip, {tip[0] + 1, tip[1], 9}, {tip[0], tip[1] + 1, 9}});
    return found(with);
  };
  EXPECT_TRUE(needle({0, 20, 7}));
  EXPECT_TRUE(needle({-1, 199 * 200 / 2 * 2 + 1, 7}));
  EXPECT_FALSE(needle({3, 9, 7}));
  EXPECT_FALSE(needle({0, 20, 8}));
}

}  // namespace
}  // namespace csgrun::test::leaf_check_test
