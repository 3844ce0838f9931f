// Boxes inside of the largest operands that are added or taken away: what polygons have in common
// in one is boundary of nothing. (What comes of it: hidden_polygons_test.)
#include "engine/bsp/inner_boxes.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "engine/bsp/covered_polygons.h"
#include "engine/bsp/grid_planes.h"
#include "tests/support/convex_operand.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun::inner_boxes_test {
namespace {

/// The hull of points up to so far from a point near the origin.
Operand convex_body(test::Random& random, int64_t reach) {
  for (;;) {
    std::vector<IVec3> points(static_cast<size_t>(random.integer(4, 12)));
    const IVec3 middle{random.integer(-20, 20), random.integer(-20, 20), random.integer(-20, 20)};
    for (IVec3& p : points) {
      for (size_t k = 0; k < 3; ++k) p[k] = middle[k] + random.integer(-reach, reach);
    }
    const auto loops = test::hull_loops(points);
    if (!loops.empty()) return test::convex_operand(loops);
  }
}

/// Whether all of a box is behind the planes of all faces of a leaf on the grid, exactly.
bool is_behind_faces(const Operand& operand, const PolygonBox& box) {
  const LeafGeometry& leaf = *operand.leaf;
  const auto corner = [&](uint32_t c) -> const IVec3& { return leaf.vertices[leaf.corners[c]]; };
  for (uint32_t f = 0; f < leaf.face_count(); ++f) {
    const uint32_t first = leaf.face_starts[f];
    const Plane plane = support_of_loop(leaf.face_starts[f + 1] - first, [&](uint32_t i) {
      return corner(first + i % (leaf.face_starts[f + 1] - first));
    });
    Int128 value = plane.d;
    for (size_t k = 0; k < 3; ++k) {
      const Int128 normal = k == 0 ? plane.a : k == 1 ? plane.b : plane.c;
      value += normal * ((normal > 0 ? box.hi[k] : box.lo[k]) - operand.translation[k]);
    }
    if (value >= 0) return false;
  }
  return true;
}

/// An L of that height, to which the middle of its box does not belong.
Operand angle(int64_t height) {
  const auto at = [](int64_t x, int64_t y, int64_t z) { return IVec3{x, y, z}; };
  std::vector<test::Loop> loops;
  for (const int64_t z : {-height, height}) {
    test::Loop foot{at(-90, -90, z), at(90, -90, z), at(90, -60, z), at(-60, -60, z),
                    at(-90, -60, z)},
        arm{at(-90, -60, z), at(-60, -60, z), at(-60, 90, z), at(-90, 90, z)};
    for (test::Loop* loop : {&foot, &arm}) {
      if (z < 0) std::reverse(loop->begin(), loop->end());
      loops.push_back(*loop);
    }
  }
  const std::vector<std::array<int64_t, 2>> rim{{-90, -90}, {90, -90}, {90, -60}, {-60, -60},
                                                {-60, 90},  {-90, 90}, {-90, -60}};
  for (size_t i = 0; i < rim.size(); ++i) {
    const auto [x, y] = rim[i];
    const auto [u, v] = rim[(i + 1) % rim.size()];
    loops.push_back({at(x, y, -height), at(u, v, -height), at(u, v, height), at(x, y, height)});
  }
  return test::operand_of(test::make_leaf(loops));
}

/// What two polygons have in common is passed over where a remover holds all of it.
TEST(InnerBoxes, HoldWhatIsInsideOfARemover) {
  test::Random random(954);
  size_t within = 0, beyond = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<Operand> operands;
    const auto count = static_cast<uint32_t>(random.integer(3, 7));
    for (uint32_t o = 0; o < count; ++o) {
      operands.push_back(convex_body(random, o == 1 ? 90 : 30));
      if (o != 1) continue;
      const int64_t kind = random.integer(0, 3);
      if (kind == 0) operands.back() = test::octahedron({3, 2, 1}, 90);
      if (kind == 1) operands.back() = angle(random.integer(20, 90));
    }
    const bool is_difference = round % 2 == 1;
    const Expression expression =
        test::flat_expression(is_difference ? BooleanOp::kDifference : BooleanOp::kUnion, count);
    const Job job(operands);
    const PlainlyCovered plainly = find_plainly_covered(job, expression);
    for (uint32_t p = 0; p < job.polygons().size(); ++p) {
      for (uint32_t q = 0; q < p; ++q) {
        PolygonBox common = job.boxes()[p];
        common.clip(job.boxes()[q]);
        const uint32_t o = job.polygons()[p].operand, other = job.polygons()[q].operand;
        if (o == other || common.is_empty()) continue;
        // If it is one of theirs, its polygon is not in there.
        const bool is_held =
            std::any_of(operands.begin() + (is_difference ? 1 : 0), operands.end(),
                        [&](const Operand& remover) { return is_behind_faces(remover, common); });
        if (plainly.meet_within(job, p, q)) {
          ASSERT_TRUE(is_held) << "round " << round << ", polygons " << q << " and " << p;
          ASSERT_TRUE(plainly.is_open[o] != 0 && plainly.is_open[other] != 0);
          ++within;
        } else {
          beyond += is_held;
        }
      }
    }
  }
  EXPECT_GT(within, 2000u);
  EXPECT_GT(within, beyond / 4) << "boxes inside of removers leave most of them out";
}

}  // namespace
}  // namespace csgrun::inner_boxes_test
