// Parts of surfaces against a search over all pairs of faces.
#include "engine/mesh/surface_parts.h"

#include <map>
#include <numeric>

#include <gtest/gtest.h>

#include "engine/mesh/opposite_edges.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"
#include "tests/support/seeded.h"

namespace csgrun::surface_parts_test {
namespace {

/// The lowest face of each part: labels spread over edges that have two faces until none changes.
std::vector<uint32_t> slowly(const LeafGeometry& leaf) {
  std::map<std::array<uint32_t, 2>, std::vector<uint32_t>> by_ends;
  for (uint32_t f = 0; f < leaf.face_count(); ++f) {
    const uint32_t begin = leaf.face_starts[f], end = leaf.face_starts[f + 1];
    for (uint32_t c = begin; c < end; ++c) {
      by_ends[{leaf.corners[c], leaf.corners[c + 1 < end ? c + 1 : begin]}].push_back(f);
    }
  }
  std::vector<uint32_t> label(leaf.face_count());
  std::iota(label.begin(), label.end(), 0u);
  for (bool any = true; any;) {
    any = false;
    for (const auto& [ends, faces] : by_ends) {
      const auto reverse = by_ends.find({ends[1], ends[0]});
      if (faces.size() != 1 || reverse == by_ends.end() || reverse->second.size() != 1) continue;
      uint32_t &a = label[faces[0]], &b = label[reverse->second[0]];
      if (a == b) continue;
      a = b = std::min(a, b);
      any = true;
    }
  }
  std::vector<uint32_t> lowest;
  for (uint32_t f = 0; f < label.size(); ++f) {
    if (label[f] == f) lowest.push_back(f);
  }
  return lowest;
}

TEST(SurfaceParts, AreConnectedByEdgesOfTwoFaces) {
  test::Random random(345);
  size_t with_opposites = 0, without = 0, several = 0;
  for (int i = 0; i < 150; ++i) {
    // Boxes, which may have corners and edges in common, and hulls.
    std::vector<test::Loop> loops;
    for (int64_t n = random.integer(1, 6); n > 0; --n) {
      IVec3 lo{}, hi{};
      for (size_t k = 0; k < 3; ++k) {
        lo[k] = random.integer(-1, 1);
        hi[k] = lo[k] + 1;
      }
      std::vector<IVec3> points;
      for (int p = 0; p < 12; ++p) {
        points.push_back(
            {50 * n + random.integer(0, 9), random.integer(0, 9), random.integer(0, 9)});
      }
      const auto more = random.integer(0, 1) ? test::box_loops(lo, hi) : test::hull_loops(points);
      loops.insert(loops.end(), more.begin(), more.end());
    }
    for (size_t k = loops.size(); k > 1; --k) {
      std::swap(loops[k - 1],
                loops[static_cast<size_t>(random.integer(0, static_cast<int64_t>(k) - 1))]);
    }
    LeafGeometry leaf = *test::make_leaf(loops);
    leaf.opposite = pair_edges(leaf).opposite;
    const std::vector<uint32_t> truth = slowly(leaf);
    ASSERT_EQ(one_face_of_each_part(leaf), truth) << i;
    ++(leaf.opposite.empty() ? without : with_opposites);
    several += truth.size() > 1;
  }
  EXPECT_GT(with_opposites, 30u);
  EXPECT_GT(without, 15u);
  EXPECT_GT(several, 60u);
}

}  // namespace
}  // namespace csgrun::surface_parts_test
