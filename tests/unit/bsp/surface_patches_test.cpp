// Patches, classes and junctions of a surface, against all pairs of its polygons.
#include "engine/bsp/surface_patches.h"

#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include "tests/support/exact_solid.h"
#include "tests/support/gmp_bridge.h"
#include "tests/support/half_space.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"
#include "tests/support/rational_polygons.h"

namespace csgrun::surface_patches_test {
namespace {

using test::Rational3;

/// Sets of numbers, joined by renaming.
struct Sets {
  explicit Sets(size_t n) : of(n) { std::iota(of.begin(), of.end(), 0u); }
  void join(uint32_t a, uint32_t b) {
    const uint32_t from = std::max(of[a], of[b]), to = std::min(of[a], of[b]);
    std::replace(of.begin(), of.end(), from, to);
  }
  std::vector<uint32_t> of;
};

struct Edge {
  Edge(const Rational3& a, const Rational3& b, uint32_t p) : from(a), to(b), polygon(p) {
    for (int k = 0; k < 3; ++k) start[k] = a[k].get_d(), way[k] = b[k].get_d() - start[k];
  }
  Rational3 from, to;
  uint32_t polygon;
  std::array<double, 3> start, way;  ///< nearly
};

/// Whether two edges have more than a point in common.
bool overlap(const Edge& e, const Edge& f) {
  // Plainly off the line, mostly: coordinates are small.
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const auto cross = [&](double vi, double vj) { return e.way[i] * vj - e.way[j] * vi; };
    if (std::fabs(cross(f.start[i] - e.start[i], f.start[j] - e.start[j])) > 1e-6) return false;
    if (std::fabs(cross(f.way[i], f.way[j])) > 1e-6) return false;
  }
  const Rational3 way = test::minus(e.to, e.from), zero{0, 0, 0};
  const Rational3 c = test::minus(f.from, e.from), d = test::minus(f.to, e.from);
  if (test::cross(way, c) != zero || test::cross(way, d) != zero) return false;
  const mpq_class s = test::dot(way, c), t = test::dot(way, d);
  return std::max(s, t) > 0 && std::min(s, t) < test::dot(way, way);
}

/// How many patches, junctions and so on were seen.
struct Seen {
  size_t patches = 0, classes = 0, junctions = 0, touching = 0, parted = 0;
};

void check(const Job& job, const std::vector<std::array<uint32_t, 2>>& crossings, Seen& seen) {
  const auto& polygons = job.polygons();
  std::vector<uint8_t> crosses(polygons.size(), 0);
  for (const auto& [f, g] : crossings) crosses[f] = crosses[g] = 1;
  const SurfacePatches found = find_patches(job, crossings, crosses);

  std::vector<std::vector<Rational3>> corners(polygons.size());
  std::map<Rational3, std::vector<uint32_t>> users;
  std::vector<Edge> edges;
  for (uint32_t p = 0; p < polygons.size(); ++p) {
    for (const uint32_t v : job.corners(polygons[p])) {
      const test::GmpPoint x = test::to_gmp(job.exact(v));
      corners[p].push_back({mpq_class(x.x) / x.w, mpq_class(x.y) / x.w, mpq_class(x.z) / x.w});
      users[corners[p].back()].push_back(p);
    }
    for (size_t i = 0; i < corners[p].size(); ++i) {
      edges.emplace_back(corners[p][i], corners[p][(i + 1) % corners[p].size()], p);
    }
  }
  Sets classes(polygons.size()), patches(polygons.size());
  for (const auto& [point, list] : users) {
    for (const uint32_t p : list) classes.join(list[0], p);
  }
  for (const auto& [f, g] : crossings) classes.join(f, g);
  for (const Edge& e : edges) {
    size_t sharing = 0;
    const Edge* other = nullptr;
    for (const Edge& f : edges) {
      if (&e == &f || !overlap(e, f)) continue;
      ++sharing;
      if (e.from == f.to && e.to == f.from) other = &f;
    }
    if (sharing == 1 && other && !crosses[e.polygon] && !crosses[other->polygon]) {
      patches.join(e.polygon, other->polygon);
    }
    seen.parted += sharing > 1;
  }
  // Numbered by first members.
  uint32_t class_count = 0, patch_count = 0;
  std::map<uint32_t, uint32_t> class_number, patch_number;
  std::map<Rational3, std::set<uint32_t>> patches_at;
  for (uint32_t p = 0; p < polygons.size(); ++p) {
    const auto [at, is_new] = class_number.emplace(classes.of[p], class_count);
    class_count += is_new;
    ASSERT_EQ(found.class_of[p], at->second);
    if (crosses[p]) {
      ASSERT_EQ(found.patch_of[p], kNone);
      continue;
    }
    const auto [patch, is_new_patch] = patch_number.emplace(patches.of[p], patch_count);
    patch_count += is_new_patch;
    ASSERT_EQ(found.patch_of[p], patch->second);
    for (const Rational3& c : corners[p]) patches_at[c].insert(patch->second);
  }
  ASSERT_EQ(found.class_count, class_count);
  ASSERT_EQ(found.patch_count, patch_count);
  seen.classes += class_count, seen.patches += patch_count;

  // Witnesses: of the patch, and beside a polygon that crosses if there is one.
  const auto exact = [&](uint32_t v) {
    const test::GmpPoint x = test::to_gmp(job.exact(v));
    return Rational3{mpq_class(x.x) / x.w, mpq_class(x.y) / x.w, mpq_class(x.z) / x.w};
  };
  ASSERT_EQ(found.witness.size(), patch_count);
  const auto touches = [&](const Rational3& p) {
    const auto& list = users[p];
    return std::any_of(list.begin(), list.end(), [&](uint32_t q) { return crosses[q] != 0; });
  };
  for (uint32_t patch = 0; patch < patch_count; ++patch) {
    const Rational3 at = exact(found.witness[patch]);
    ASSERT_TRUE(patches_at[at].count(patch));
    bool possible = false;
    for (const auto& [point, there] : patches_at) {
      possible = possible || (there.count(patch) && touches(point));
    }
    ASSERT_EQ(touches(at), possible);
    seen.touching += possible;
  }
  // Junctions: every point of several patches, in its class.
  ASSERT_EQ(found.junctions.size(), class_count);
  std::set<Rational3> junctions;
  for (uint32_t c = 0; c < class_count; ++c) {
    for (const uint32_t v : found.junctions[c]) {
      const Rational3 at = exact(v);
      ASSERT_EQ(found.class_of[users[at][0]], c);
      junctions.insert(at);
    }
  }
  for (const auto& [point, there] : patches_at) {
    ASSERT_EQ(junctions.count(point), there.size() > 1 ? 1u : 0u);
  }
  seen.junctions += junctions.size();
}

TEST(SurfacePatches, OfLeaves) {
  test::Random random(71);
  Seen seen;
  for (int i = 0; i < 20 && !HasFatalFailure(); ++i) {
    std::vector<test::Loop> loops;
    for (int64_t k = random.integer(1, 3); k > 0; --k) {
      auto own = test::random_loops(random, 4);
      if (random.integer(0, 2) == 0) test::turn_over(own);
      // Apart from the others, mostly.
      const int64_t move = 10 * random.integer(0, 2);
      for (auto& loop : own) {
        for (IVec3& p : loop) p[0] += move;
      }
      loops.insert(loops.end(), own.begin(), own.end());
    }
    const std::vector<Operand> operands{test::operand_of(test::make_leaf(loops))};
    const Job job(operands);
    // Edges that overlap in part are crossings of a leaf's faces, so say that all such faces cross.
    std::vector<std::array<uint32_t, 2>> crossings;
    const auto last = static_cast<int64_t>(loops.size()) - 1;
    std::vector<Edge> edges;
    for (uint32_t p = 0; p < loops.size(); ++p) {
      const auto at = [&](size_t c) {
        const IVec3& v = loops[p][c % loops[p].size()];
        return Rational3{mpq_class(mpz_class(v[0])), mpq_class(mpz_class(v[1])),
                         mpq_class(mpz_class(v[2]))};
      };
      for (size_t c = 0; c < loops[p].size(); ++c) edges.emplace_back(at(c), at(c + 1), p);
    }
    for (const Edge& e : edges) {
      for (const Edge& f : edges) {
        const bool equal = (e.from == f.from && e.to == f.to) || (e.from == f.to && e.to == f.from);
        if (e.polygon < f.polygon && overlap(e, f) && !equal) {
          crossings.push_back({e.polygon, f.polygon});
        }
      }
    }
    for (int64_t k = random.integer(0, 4); k > 0; --k) {
      crossings.push_back({static_cast<uint32_t>(random.integer(0, last)),
                           static_cast<uint32_t>(random.integer(0, last))});
    }
    check(job, crossings, seen);
  }
  EXPECT_GT(seen.patches, 60u);
  EXPECT_GT(seen.classes, 30u);
  EXPECT_GT(seen.junctions, 30u);
  EXPECT_GT(seen.touching, 30u);
  EXPECT_GT(seen.parted, 50u);
}

// Results of Booleans touch themselves, and edges overlap in part.
TEST(SurfacePatches, OfResults) {
  test::Random random(72);
  Seen seen;
  for (int i = 0; i < 12 && !HasFatalFailure(); ++i) {
    std::vector<Operand> leaves;
    for (int k = 0; k < 3; ++k) {
      leaves.push_back(test::operand_of(test::make_leaf(test::random_loops(random, 3))));
    }
    const auto built =
        test::evaluate(test::differ({test::leaf(0), test::leaf(1), test::leaf(2)}), leaves);
    ASSERT_TRUE(built) << test::text(built.error());
    std::vector<Operand> operands(1);
    operands[0].boundary = *built;
    check(Job(operands), {}, seen);
  }
  EXPECT_GT(seen.patches, 50u);
  EXPECT_GT(seen.junctions, 30u);
  EXPECT_GT(seen.parted, 50u);
}

// An edge is shorter than doubles tell, all of it on a long one of two other faces.
TEST(SurfacePatches, OfAnEdgeShorterThanRounding) {
  constexpr int64_t q = int64_t{1} << 23;  // heights 1000 - 1/q and 1000 - 1/(q + 1)
  const std::vector<Operand> leaves{test::operand_of(test::box_leaf({0, 0, 900}, {8, 8, 1100})),
                                    test::half_space(q, 1000, false),
                                    test::half_space(q + 1, 1000, true),
                                    test::operand_of(test::box_leaf({-8, -8, 900}, {0, 0, 1100}))};
  const auto built =
      test::evaluate(test::join({test::meet({test::leaf(0), test::leaf(1), test::leaf(2)}),
                                 test::meet({test::leaf(3), test::leaf(1)})}),
                     leaves);
  ASSERT_TRUE(built) << test::text(built.error());
  std::vector<Operand> operands(1);
  operands[0].boundary = *built;
  const Job job(operands);
  // The two faces at the short edge.
  std::vector<uint32_t> faces, others;
  for (uint32_t p = 0; p < job.polygons().size(); ++p) {
    const auto corners = job.corners(job.polygons()[p]);
    bool is_short = false;
    for (size_t i = 0; i < corners.size(); ++i) {
      const uint32_t a = corners[i], b = corners[(i + 1) % corners.size()];
      if (job.rounded(a) != job.rounded(b)) continue;
      ASSERT_NE(compare(job.exact(a), job.exact(b)), 0);
      is_short = true;
    }
    (is_short ? faces : others).push_back(p);
  }
  ASSERT_EQ(faces.size(), 2u);
  // They have nothing else in common, and all around them is said to cross.
  std::vector<std::array<uint32_t, 2>> crossings;
  for (size_t i = 1; i < others.size(); ++i) crossings.push_back({others[i - 1], others[i]});
  Seen seen;
  check(job, crossings, seen);
  EXPECT_EQ(seen.patches, 2u);
  EXPECT_GT(seen.parted, 0u);
}

}  // namespace
}  // namespace csgrun::surface_patches_test
