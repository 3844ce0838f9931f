// Pairs of polygons of many corners, and with corners in common.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "engine/bsp/pair_test.h"
#include "tests/support/kernel_case.h"
#include "tests/support/pair_truth.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"

namespace csgrun::pair_corners_test {
namespace {

using namespace test;  // NOLINT: a test

/// A convex polygon of up to so many corners, in the plane through the origin that u and v span.
Loop polygon_of_many(Random& random, size_t corners, const IVec3& u, const IVec3& v) {
  // Sums of steps in all directions, by angle: each one and its reverse, so that they close.
  std::vector<std::array<int64_t, 2>> steps;
  const auto is_parallel = [&](const auto& step) {
    return std::any_of(steps.begin(), steps.end(),
                       [&](const auto& known) { return known[0] * step[1] == known[1] * step[0]; });
  };
  while (2 * steps.size() < corners) {
    const std::array<int64_t, 2> step{random.integer(-12, 12), random.integer(0, 12)};
    if ((step[0] == 0 && step[1] == 0) || is_parallel(step)) continue;
    steps.push_back(step[1] == 0 && step[0] < 0 ? std::array<int64_t, 2>{-step[0], 0} : step);
  }
  std::sort(steps.begin(), steps.end(),
            [](const auto& a, const auto& b) { return a[0] * b[1] > a[1] * b[0]; });
  Loop loop{{0, 0, 0}};
  for (const int64_t way : {1, -1}) {
    for (const auto& [s, t] : steps) {
      IVec3 next = loop.back();
      for (size_t k = 0; k < 3; ++k) next[k] += way * (s * u[k] + t * v[k]);
      loop.push_back(next);
    }
  }
  loop.pop_back();  // the first one again
  return loop;
}

// Eight at a time they are on one side of a plane, or are looked at one by one.
TEST(PairCorners, OfFacesOfManyCorners) {
  Random random(431);
  Seen seen;
  for (int i = 0; i < 120; ++i) {
    const int64_t scale = i % 3 == 0 ? 1 : int64_t{1} << random.integer(1, 14);
    IVec3 u{}, v{};
    while (cross_of(u, v) == IVec3{0, 0, 0}) {
      for (IVec3* axis : {&u, &v}) {
        for (int64_t& c : *axis) c = scale * random.integer(-2, 2);
      }
    }
    const auto many = static_cast<size_t>(random.integer(12, 70));
    const Loop loop = polygon_of_many(random, many, u, v);
    const auto corner = [&] {
      return loop[static_cast<size_t>(random.integer(0, static_cast<int64_t>(loop.size()) - 1))];
    };
    std::vector<Loop> others;
    while (others.size() < 16) {
      Loop triangle;
      for (int c = 0; c < 3; ++c) {
        triangle.push_back(corner());
        if (random.integer(0, 2) == 0) continue;
        for (int64_t& x : triangle.back()) x += random.integer(-9, 9) * scale;
      }
      if (cross_of(sub(triangle[1], triangle[0]), sub(triangle[2], triangle[0])) !=
          IVec3{0, 0, 0}) {
        others.push_back(triangle);
      }
    }
    Loop crossing = polygon_of_many(random, many, cross_of(u, v), v);
    for (IVec3& c : crossing) {
      for (size_t k = 0; k < 3; ++k) c[k] /= scale;
    }
    others.push_back(crossing);
    std::vector<Operand> operands{operand_of(make_leaf({loop})), operand_of(make_leaf(others))};
    const bool with_planes = i % 2 == 0;
    if (with_planes && i % 3 == 1) {
      operands[0].frame = operands[1].frame = random_frame(random);
      if (i % 4 == 0) operands[1].frame = random_frame(random);
    }
    check_pairs(operands, with_planes, seen);
    if (HasFatalFailure()) FAIL() << i;
  }
  EXPECT_GT(seen.apart, 100);
  EXPECT_GT(seen.plain, 100);
  EXPECT_GT(seen.touching, 100);
  EXPECT_GT(seen.coplanar, 20);
}

// Cones that are turned around a point which is the apex of all.
TEST(PairCorners, OfFacesWithCommonCornersInFrames) {
  std::vector<Loop> sides;
  const std::array<IVec3, 6> ring{{{900, 300, 0},
                                   {900, 150, 260},
                                   {900, -150, 260},
                                   {900, -300, 0},
                                   {900, -150, -260},
                                   {900, 150, -260}}};
  for (size_t i = 0; i < ring.size(); ++i) {
    sides.push_back({{0, 0, 0}, ring[i], ring[(i + 1) % ring.size()]});
  }
  std::vector<Operand> cones{operand_of(make_leaf(sides)), operand_of(make_leaf(sides))};
  cones[0].frame = frame_of(turn_about(2, 24));
  cones[1].frame = frame_of(turn_about(2, 72));
  Seen seen;
  check_pairs(cones, true, seen);
  EXPECT_EQ(seen.touching, 36);
  // The common corner tells all that doubles do not: no plane is asked.
  Job job(cones);
  for (uint32_t p = 0; p < job.polygons().size(); ++p) job.ensure_planes(p);
  for (const bool with_numbers : {false, true}) {
    CellGeometry geometry(job.planes(), &job), asked(job.planes(), &job);
    PairTest test(job);
    if (with_numbers) test.know_equal_vertices(numbers_of_vertices(job, geometry));
    Contact contact;
    for (uint32_t p = 0; p < 6; ++p) {
      for (uint32_t q = 6; q < 12; ++q)
        EXPECT_EQ(test.run(p, q, &asked, contact), Meeting::kContact);
    }
    EXPECT_EQ(asked.point_count() == 0, with_numbers);
  }
}

// A triangle through a polygon of 64 corners, whose plane passes through two of their eights.
TEST(PairCorners, AsksAboutEightCornersAtOnce) {
  Loop loop;
  for (int64_t i = 0; i < 64; ++i) {
    const double at = 3.14159265358979 * static_cast<double>(2 * i + 1) / 64;
    loop.push_back({std::llround(1e6 * std::cos(at)), std::llround(1e6 * std::sin(at)), 0});
  }
  const std::vector<Operand> operands{
      operand_of(make_leaf({loop})),
      operand_of(make_leaf({{{-1000, 3000, -5000}, {4000, -1000, 7000}, {5000, 2000, 6000}}}))};
  const Job job(operands);
  PairTest test(job);
  Contact contact;
  EXPECT_EQ(test.run(0, 1, nullptr, contact), Meeting::kContact);
  const uint64_t of_triangle = 3, eights = 6, of_two_eights = 16, of_ends = 4;
  EXPECT_EQ(test.signs().filtered, of_triangle + eights + of_two_eights + of_ends);
  EXPECT_EQ(test.signs().exact, 0u);
}

}  // namespace
}  // namespace csgrun::pair_corners_test
