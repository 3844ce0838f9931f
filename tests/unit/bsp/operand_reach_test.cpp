// What an operand may meet: never nothing where it has a point, and nothing in the corners of the
// box of a round one.
#include "engine/bsp/operand_reach.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/seeded.h"

namespace csgrun::operand_reach_test {
namespace {

using Position = std::array<double, 3>;

TEST(OperandReach, HoldsAllPointsOfTheOperand) {
  test::Random random(811);
  int left_out = 0;
  for (int i = 0; i < 2000; ++i) {
    // Points of hulls lie between vertices.
    const double far = std::ldexp(random.unit() - 0.5, static_cast<int>(random.integer(1, 40)));
    // Some of them are round.
    std::vector<Position> vertices(static_cast<size_t>(random.integer(1, i % 2 ? 9 : 60)));
    for (Position& v : vertices) {
      for (double& c : v) c = random.unit() - 0.5;
      const double length = i % 2 ? 1 : 2 * std::hypot(v[0], v[1], v[2]);
      for (double& c : v) c = std::round(far + 1000 * c / length);
    }
    const OperandReach reach(vertices);
    const auto any = [&] {
      return vertices[static_cast<size_t>(
          random.integer(0, static_cast<int64_t>(vertices.size()) - 1))];
    };
    const Position p = any(), q = any();
    const double t = random.unit();
    PieceBox box, other;
    for (int k = 0; k < 8; ++k) {
      Position at{}, beside{};
      for (size_t c = 0; c < 3; ++c) {
        at[c] = p[c] + t * (q[c] - p[c]);
        if (k > 0) at[c] += (k & 1 << c ? 1 : -1) * 300 * random.unit();
        beside[c] = far + 1500 * (random.unit() - 0.5);
      }
      box.add(at);
      if (k < 1 + i % 2) other.add(beside);
    }
    ASSERT_TRUE(reach.may_meet(box)) << i;
    // Beside the box of the vertices there is nothing.
    if (!reach.box().meets(other)) {
      ASSERT_FALSE(reach.may_meet(other)) << i;
    }
    left_out += reach.box().meets(other) && !reach.may_meet(other);
  }
  EXPECT_GT(left_out, 20);
}

TEST(OperandReach, LeavesOutTheCornersOfABallsBox) {
  std::vector<Position> ball;
  for (int i = 0; i < 48; ++i) {
    for (int k = 0; k < 24; ++k) {
      const double a = i * M_PI / 24, b = (k + 0.5) * M_PI / 24;
      ball.push_back({std::round(5000 + 1000 * std::cos(a) * std::sin(b)),
                      std::round(1000 * std::sin(a) * std::sin(b)),
                      std::round(1000 * std::cos(b))});
    }
  }
  const OperandReach reach(ball);
  int met = 0, all = 0;
  for (double x = -990; x < 1000; x += 60) {
    for (double y = -990; y < 1000; y += 60) {
      for (double z = -990; z < 1000; z += 60) {
        PieceBox box;
        box.add(Position{5000 + x, y, z});
        const bool may_meet = reach.may_meet(box);
        const double distance = std::sqrt(x * x + y * y + z * z);
        if (distance < 1000 || distance > 1010) {
          EXPECT_EQ(may_meet, distance < 1005) << x << ' ' << y << ' ' << z;
        }
        met += may_meet, ++all;
      }
    }
  }
  EXPECT_NEAR(static_cast<double>(met) / all, M_PI / 6, 0.05);
}

TEST(OperandReach, OfNothingMeetsNothing) {
  const OperandReach reach({});
  PieceBox box;
  box.add(Position{-1e9, -1e9, -1e9});
  box.add(Position{1e9, 1e9, 1e9});
  EXPECT_FALSE(reach.may_meet(box));
}

}  // namespace
}  // namespace csgrun::operand_reach_test
