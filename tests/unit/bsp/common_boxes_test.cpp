// Boxes around what polygons have in common hold all of it, as rationals tell, and are small.
#include "engine/bsp/common_boxes.h"

#include <gtest/gtest.h>

#include "tests/support/conformity.h"
#include "tests/support/exact_solid.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"
#include "tests/support/seeded.h"

namespace csgrun::common_boxes_test {
namespace {

/// Three points at random, or a sliver along a line that others are along, too.
std::array<IVec3, 3> triangle(test::Random& random, const IVec3& way, int64_t size,
                              bool is_sliver) {
  std::array<IVec3, 3> points{};
  for (IVec3& p : points) {
    const int64_t along = random.integer(-size, size);
    for (size_t k = 0; k < 3; ++k) {
      p[k] = is_sliver ? way[k] * along + random.integer(-3, 3) : random.integer(-size, size);
    }
  }
  return points;
}

/// A triangle with both of its sides.
Operand sheet(const std::array<IVec3, 3>& t) {
  auto leaf = std::make_shared<LeafGeometry>();
  leaf->vertices.assign(t.begin(), t.end());
  leaf->corners = {0, 1, 2, 0, 2, 1};
  leaf->face_starts = {0, 3, 6};
  leaf->facet = leaf->surface = leaf->appearance = FaceNumbers::all(0);
  return test::operand_of(std::move(leaf));
}

test::RationalTriangle rational(const std::array<IVec3, 3>& t) {
  test::RationalTriangle result;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t k = 0; k < 3; ++k) result[i][k] = mpq_class(static_cast<long>(t[i][k]));
  }
  return result;
}

TEST(CommonBoxes, HoldAllThatIsInBoth) {
  test::Random random(4711);
  size_t meeting = 0, coplanar = 0;
  double volume = 0, of_overlaps = 0;
  for (int i = 0; i < 20'000; ++i) {
    const int64_t size = int64_t{1} << random.integer(2, 20);
    const IVec3 way{random.integer(-5, 5), random.integer(-5, 5), random.integer(-5, 5)};
    const bool are_slivers = i % 2 == 0;
    std::array<IVec3, 3> s = triangle(random, way, size, are_slivers),
                         t = triangle(random, way, size, are_slivers && i % 4 != 0);
    if (i % 5 == 0) t[0] = s[1];
    if (i % 10 == 0) t[1] = s[2];
    if (i % 7 == 0) {
      for (auto* const each : {&s, &t}) {
        for (IVec3& p : *each) p[2] = 3;
      }
    }
    const auto has_area = [](const std::array<IVec3, 3>& p) {
      const test::RationalTriangle r = rational(p);
      return test::cross(test::minus(r[1], r[0]), test::minus(r[2], r[0])) != test::Rational3{};
    };
    if (!has_area(s) || !has_area(t)) continue;
    const std::vector<Operand> operands{sheet(s), sheet(t)};
    const Job job(operands);
    const auto common = test::common_points(rational(s), rational(t));
    if (common.empty()) continue;
    ++meeting;
    coplanar += common.size() > 2;
    for (const uint32_t slices : {1u, 16u}) {
      std::vector<GridBox> boxes;
      add_common_boxes(job, 0, job.polygon_start(1), slices, boxes);
      const auto is_held = [&](const test::Rational3& p) {
        return std::any_of(boxes.begin(), boxes.end(), [&](const GridBox& box) {
          bool all = true;
          for (size_t k = 0; k < 3; ++k) {
            all =
                all && p[k] >= static_cast<long>(box.lo[k]) && p[k] <= static_cast<long>(box.hi[k]);
          }
          return all;
        });
      };
      // Its corners, and points between any two of them.
      for (const test::Rational3& p : common) {
        for (const test::Rational3& q : common) {
          for (long n = 0; n <= 8; ++n) {
            test::Rational3 at;
            for (size_t k = 0; k < 3; ++k) at[k] = p[k] + (q[k] - p[k]) * n / 8;
            ASSERT_TRUE(is_held(at)) << i << ": of " << slices << " slices";
          }
        }
      }
      if (slices == 1 || !are_slivers || size < 1 << 12 || common.size() > 2) continue;
      const auto size_of = [](const GridBox& box) {
        double product = 1;
        for (size_t k = 0; k < 3; ++k) product *= static_cast<double>(box.hi[k] - box.lo[k] + 1);
        return product;
      };
      for (const GridBox& box : boxes) volume += size_of(box);
      PolygonBox overlap = job.boxes()[0];
      overlap.clip(job.boxes()[job.polygon_start(1)]);
      of_overlaps += size_of({{overlap.lo[0], overlap.lo[1], overlap.lo[2]},
                              {overlap.hi[0], overlap.hi[1], overlap.hi[2]}});
    }
  }
  EXPECT_GT(meeting, 1500u);
  EXPECT_GT(coplanar, 300u);
  EXPECT_LT(volume, of_overlaps / 20);
}

}  // namespace
}  // namespace csgrun::common_boxes_test
