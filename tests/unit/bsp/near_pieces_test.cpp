// The faces of a tool that are near boxes: all whose own box meets one of these, and none that is
// far from all.
#include "engine/bsp/near_pieces.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/bsp/near_faces.h"
#include "engine/bsp/piece_tree.h"
#include "engine/bsp/rounded_box.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"
#include "tests/support/seeded.h"

namespace csgrun::near_pieces_test {
namespace {

/// A hull of so many points about on a ball, all coordinates times a power of two.
std::shared_ptr<const LeafGeometry> ball(test::Random& random, double radius, int points,
                                         int64_t power) {
  std::vector<IVec3> on_it;
  for (int i = 0; i < points; ++i) {
    std::array<double, 3> at{};
    for (double& c : at) c = random.unit() - 0.5;
    const double scale = radius / std::hypot(at[0], at[1], at[2]);
    on_it.push_back(
        {std::llround(scale * at[0]), std::llround(scale * at[1]), std::llround(scale * at[2])});
  }
  auto leaf = std::make_shared<LeafGeometry>(*test::make_leaf(test::hull_loops(on_it)));
  for (IVec3& v : leaf->vertices) {
    for (int64_t& c : v) c *= power;
  }
  return leaf;
}

/// By how much boxes are apart along some axis at least.
int64_t distance(const PolygonBox& a, const PolygonBox& b) {
  int64_t apart = 0;
  for (size_t k = 0; k < 3; ++k) {
    apart = std::max({apart, int64_t{a.lo[k]} - b.hi[k], int64_t{b.lo[k]} - a.hi[k]});
  }
  return apart;
}

TEST(NearPieces, AreMetByAllFacesThatMayMeetThem) {
  test::Random random(1211);
  size_t near = 0, far = 0, none = 0, all = 0;
  double radius = 0;
  std::shared_ptr<const LeafGeometry> leaf;
  for (int i = 0; i < 400; ++i) {
    if (i % 20 == 0) {
      radius = std::ldexp(1 + random.unit(), static_cast<int>(random.integer(3, 12)));
      const int64_t power = int64_t{1} << random.integer(0, 13);
      leaf = ball(random, radius, static_cast<int>(random.integer(10, 70)), power);
      radius *= static_cast<double>(power);
    }
    IVec3 moved{};
    for (int64_t& m : moved) m = random.integer(-(1 << 28), 1 << 28);
    // Of points that are no whole numbers boxes are rounded outwards.
    const bool are_whole = random.integer(0, 2) != 0;
    std::vector<std::array<double, 3>> vertices;
    for (const IVec3& v : leaf->vertices) {
      for (size_t k = 0; k < 3; ++k) {
        const double beside = are_whole ? 0 : static_cast<double>(random.integer(-3, 3)) / 4;
        (k == 0 ? vertices.emplace_back() : vertices.back())[k] =
            static_cast<double>(v[k] + moved[k]) + beside;
      }
    }
    const auto around = are_whole ? box_of_leaf(*leaf, moved) : box_of_rounded(vertices);
    ASSERT_TRUE(around.has_value());
    std::vector<PolygonBox> boxes(static_cast<size_t>(random.integer(0, 6)));
    for (PolygonBox& box : boxes) {
      for (size_t k = 0; k < 3; ++k) {
        // Flat ones, long ones, those that only begin or end in the ball's, and those beside it.
        const auto place = [&] {
          return static_cast<int32_t>(
              std::llround(static_cast<double>(moved[k]) + 2.6 * radius * (random.unit() - 0.5)));
        };
        box.lo[k] = place();
        box.hi[k] = random.integer(0, 2) == 0 ? box.lo[k] : place();
        if (box.hi[k] < box.lo[k]) std::swap(box.lo[k], box.hi[k]);
      }
    }
    if (random.integer(0, 9) == 0) boxes.push_back(*around);
    const std::vector<uint32_t> faces = faces_near(*leaf, vertices, are_whole, *around, boxes);
    ASSERT_TRUE(std::is_sorted(faces.begin(), faces.end()));
    ASSERT_EQ(std::adjacent_find(faces.begin(), faces.end()), faces.end());
    // Cells are powers of two, at least 17 to the longest side of the box: or of one step.
    int64_t cell = 1;
    for (size_t k = 0; k < 3; ++k) {
      cell = std::max(cell, (int64_t{around->hi[k]} - around->lo[k]) / 16 + 1);
    }
    for (uint32_t f = 0; f < leaf->face_count(); ++f) {
      PieceBox exact;
      for (uint32_t c = leaf->face_starts[f]; c < leaf->face_starts[f + 1]; ++c) {
        exact.add(vertices[leaf->corners[c]]);
      }
      const PolygonBox own = are_whole ? box_of_face(*leaf, f, moved) : rounded_outwards(exact);
      const bool is_named = std::binary_search(faces.begin(), faces.end(), f);
      int64_t least = INT64_MAX;
      for (PolygonBox box : boxes) {
        box.clip(*around);
        if (!box.is_empty()) least = std::min(least, distance(own, box));
      }
      if (least == 0) {
        ASSERT_TRUE(is_named) << i << ": face " << f;
      }
      if (least > cell) {
        ASSERT_FALSE(is_named) << i << ": face " << f;
      }
      ++(is_named ? near : far);
    }
    none += faces.empty();
    all += faces.size() == leaf->face_count();
  }
  EXPECT_GT(near, 5000u);
  EXPECT_GT(far, 5000u);
  EXPECT_GT(none, 30u);
  EXPECT_GT(all, 10u);
}

}  // namespace
}  // namespace csgrun::near_pieces_test
