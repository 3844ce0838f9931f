// What balls and planes in doubles say of points, against bodies in rational arithmetic.
#include "engine/bsp/operand_balls.h"

#include <gtest/gtest.h>

#include "engine/bsp/convex_sides.h"
#include "tests/support/convex_operand.h"
#include "tests/support/exact_solid.h"
#include "tests/support/kernel_case.h"
#include "tests/support/oracle.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"

namespace csgrun::operand_balls_test {
namespace {

using test::Query;
using Side = OperandBalls::Side;

/// A vertex in the world.
std::array<double, 3> corner_of(const Operand& operand, size_t vertex) {
  const IVec3 &v = operand.leaf->vertices[vertex], &t = operand.translation;
  return rounded(FrameMap(operand.frame).point({v[0] + t[0], v[1] + t[1], v[2] + t[2]}));
}

PolygonBox box_of(const Operand& operand) {
  PolygonBox box = PolygonBox::none();
  for (size_t v = 0; v < operand.leaf->vertices.size(); ++v) {
    const std::array<double, 3> corner = corner_of(operand, v);
    for (size_t k = 0; k < 3; ++k) {
      box.lo[k] = std::min(box.lo[k], static_cast<int32_t>(std::floor(corner[k])));
      box.hi[k] = std::max(box.hi[k], static_cast<int32_t>(std::ceil(corner[k])));
    }
  }
  return box;
}

/// A cube around the origin, whose sides are pressed in: its middle sees all faces from behind,
/// unless they are pressed in as far as that.
Operand dented_cube(int64_t half, int64_t depth) {
  std::vector<test::Loop> loops;
  for (const test::Loop& side : test::box_loops({-half, -half, -half}, {half, half, half})) {
    IVec3 middle{0, 0, 0};
    for (size_t k = 0; k < 3; ++k) {
      if (side[0][k] == side[2][k]) middle[k] = side[0][k] > 0 ? half - depth : depth - half;
    }
    for (size_t i = 0; i < 4; ++i) loops.push_back({side[i], side[(i + 1) % 4], middle});
  }
  return test::operand_of(test::make_leaf(loops));
}

Operand random_body(test::Random& random, int64_t reach) {
  const auto point = [&](int64_t most) {
    return IVec3{random.integer(-most, most), random.integer(-most, most),
                 random.integer(-most, most)};
  };
  std::vector<test::Loop> loops;
  if (random.integer(0, 2) == 0) {
    const int64_t size = random.integer(1, reach);
    loops = test::box_loops({-size, -size, -size}, {size, size, size});
    if (size > 4 && random.integer(0, 1) == 0) {
      Operand dented = dented_cube(size, random.integer(1, size - 1));
      dented.translation = point(2 * reach);
      return dented;
    }
  }
  while (loops.empty()) {
    std::vector<IVec3> points(static_cast<size_t>(random.integer(4, 14)));
    for (IVec3& p : points) p = point(reach);
    loops = test::hull_loops(points);
  }
  Operand operand = test::convex_operand(loops);
  operand.translation = point(2 * reach);
  return operand;
}

// Whatever they say holds of all points that are as near as points may be wrong: half a step along
// each axis for balls, one for planes. And they do say it of most points.
TEST(OperandBalls, TellOfPointsWhatIsSo) {
  test::Random random(971);
  size_t by_ball[3] = {}, by_planes[3] = {}, inside_of_dented = 0;
  for (int round = 0; round < 180; ++round) {
    const int64_t reach = round % 2 == 0 ? 12 : 3000;
    std::vector<Operand> operands{random_body(random, reach), random_body(random, reach)};
    if (round % 3 == 0) operands[1].frame = test::random_frame(random);
    const std::vector<PolygonBox> boxes{box_of(operands[0]), box_of(operands[1])};
    const OperandBalls balls(operands, boxes, {OperandBalls::kWithin, OperandBalls::kBeyond});
    ConvexSides sides;
    for (uint32_t o = 0; o < 2; ++o) {
      const test::Oracle oracle(test::exact_solid(operands[o]));
      for (int i = 0; i < 40; ++i) {
        const auto last = static_cast<int64_t>(operands[o].leaf->vertices.size()) - 1;
        const auto corner = corner_of(operands[o], static_cast<size_t>(random.integer(0, last)));
        Query at{}, near{}, next{};
        for (size_t k = 0; k < 3; ++k) {
          const int64_t lo = boxes[o].lo[k] - 4, hi = boxes[o].hi[k] + 4;
          at[k] = static_cast<double>(random.integer(8 * lo, 8 * hi)) / 8 + 0.0625;
          if (i % 2 == 0) {  // at a corner, where the outer ball is close
            at[k] =
                std::round(corner[k]) + static_cast<double>(random.integer(-8, 8)) / 16 + 0.0078125;
          }
          const double away = static_cast<double>(random.integer(-127, 127)) / 128;
          near[k] = at[k] + away / 2;
          next[k] = at[k] + away;
        }
        const auto near_winding = oracle.winding(near), next_winding = oracle.winding(next);
        if (!near_winding || !next_winding) continue;
        const Side ball = balls.side(o, at);
        if (ball != Side::kUnknown) {
          ASSERT_EQ(ball == Side::kInside, *near_winding == 1) << round;
        }
        ++by_ball[static_cast<size_t>(ball)];
        if (!operands[o].leaf->convex) {
          inside_of_dented += ball == Side::kInside ? 1 : 0;
          continue;
        }
        const Inside side = sides.side(operands, o, at);
        if (side != Inside::kUnknown) {
          ASSERT_EQ(side == Inside::kYes, *next_winding == 1) << round;
        }
        ++by_planes[static_cast<size_t>(side)];
      }
    }
  }
  for (const size_t n : {by_ball[static_cast<size_t>(Side::kInside)],
                         by_ball[static_cast<size_t>(Side::kOutside)]}) {
    EXPECT_GT(n, 100u);
  }
  EXPECT_GT(inside_of_dented, 10u);
  for (const Inside side : {Inside::kYes, Inside::kNo}) {
    EXPECT_GT(by_planes[static_cast<size_t>(side)], 700u);
  }
}

// Boxes that are said to be outside of a body are, with all points that are half a step beside
// them; some are in the body's box, too. Nothing is said by those of other use.
TEST(OperandBalls, LeaveOutBoxesThatAreBesideThem) {
  test::Random random(972);
  size_t left_out = 0, in_box = 0;
  for (int round = 0; round < 400; ++round) {
    const int64_t reach = round % 2 == 0 ? 12 : 3000;
    const Operand operand =
        round % 3 == 0 ? test::octahedron({7, reach, -9}, reach) : random_body(random, reach);
    const PolygonBox around = box_of(operand);
    const OperandBalls beyond({operand}, {around}, {OperandBalls::kBeyond});
    const OperandBalls within({operand}, {around}, {OperandBalls::kWithin});
    const test::Oracle oracle(test::exact_solid(operand));
    for (int i = 0; i < 40; ++i) {
      PolygonBox box{};
      for (size_t k = 0; k < 3; ++k) {
        const int32_t size = (around.hi[k] - around.lo[k]) / 8;
        // Near a corner of the body's box, where balls tell more than that.
        const int32_t end = random.integer(0, 1) == 0 ? around.lo[k] : around.hi[k] - size;
        box.lo[k] = end + static_cast<int32_t>(random.integer(-size / 2 - 1, size / 2 + 1));
        box.hi[k] = box.lo[k] + static_cast<int32_t>(random.integer(0, size));
      }
      ASSERT_FALSE(within.leave_out(box));
      const std::array<double, 3> corner{double(box.lo[0]), double(box.lo[1]), double(box.lo[2])};
      ASSERT_FALSE(beyond.hold(
          1, [&](uint32_t) -> const auto& { return corner; }));
      if (!beyond.leave_out(box)) continue;
      ++left_out;
      in_box += around.holds(box) ? 1 : 0;
      for (int n = 0; n < 8; ++n) {
        Query at{};
        for (size_t k = 0; k < 3; ++k) {
          at[k] = n < 4 ? static_cast<double>(random.integer(0, 1) == 0 ? box.lo[k] : box.hi[k])
                        : static_cast<double>(random.integer(box.lo[k], box.hi[k]));
          at[k] += static_cast<double>(random.integer(-63, 63)) / 128;
        }
        const auto winding = oracle.winding(at);
        if (!winding) continue;  // its ray meets an edge
        ASSERT_EQ(*winding, 0) << round << ' ' << i;
      }
    }
  }
  EXPECT_GT(left_out, 1000u);
  EXPECT_GT(in_box, 100u);
}

// Only leaves that were chosen have one, and not those of which too little is left, or
// that the middle of their box does not see from within.
TEST(OperandBalls, AreOfChosenOnes) {
  std::vector<Operand> operands{test::octahedron({0, 0, 0}, 50),
                                test::octahedron({9, 0, 0}, 50),
                                test::octahedron({0, 9, 0}, 50),
                                test::octahedron({0, 0, 9}, 1),
                                dented_cube(50, 49),
                                dented_cube(50, 51),
                                dented_cube(50, 30)};
  std::vector<PolygonBox> boxes;
  for (const Operand& operand : operands) boxes.push_back(box_of(operand));
  std::vector<uint8_t> chosen(operands.size(), OperandBalls::kWithin);
  chosen[1] = chosen[2] = 0;
  const OperandBalls balls(operands, boxes, chosen);
  const auto round = static_cast<uint32_t>(operands.size() - 1);
  for (uint32_t o = 0; o <= round; ++o) EXPECT_EQ(balls.has(o), o == 0 || o == round) << o;
  for (uint32_t o = 1; o < 4; ++o) EXPECT_EQ(balls.side(o, {0, 0, 0}), Side::kUnknown);
  EXPECT_FALSE(OperandBalls().has(0));
  EXPECT_TRUE(balls.hides(0) && balls.hides(round) && balls.hide_some());
  boxes[0].hi[0] = int32_t{1} << 30;  // as of one that reaches too far out
  EXPECT_FALSE(OperandBalls(operands, boxes, chosen).has(0));
}

/// A cube without its edges, so rounder than it.
Operand cut_cube(int64_t half) {
  std::vector<IVec3> points;
  for (const int64_t far : {half, -half}) {
    for (const int64_t a : {half / 2, -half / 2}) {
      for (const int64_t b : {half / 2, -half / 2}) {
        points.insert(points.end(), {{far, a, b}, {a, far, b}, {a, b, far}});
      }
    }
  }
  return test::convex_operand(test::hull_loops(points));
}

// Those in frames tell of points; polygons are hidden by round ones, and by none that points alone
// are asked about.
TEST(OperandBalls, InFramesHidePolygonsIfTheyAreRound) {
  std::vector<Operand> operands{cut_cube(100), cut_cube(100), cut_cube(100), cut_cube(100)};
  operands[2] = test::convex_operand(test::box_loops({-100, -100, -100}, {100, 100, 100}));
  operands[1].frame = operands[2].frame = test::frame_of(test::turn_about(2, 30));
  std::vector<PolygonBox> boxes;
  for (const Operand& operand : operands) boxes.push_back(box_of(operand));
  std::vector<uint8_t> uses(operands.size(), OperandBalls::kWithin | OperandBalls::kSide);
  uses[3] = OperandBalls::kSide;
  const std::array<double, 3> middle{1, 2, 3};
  const OperandBalls balls(operands, boxes, uses);
  for (uint32_t o = 0; o < operands.size(); ++o) {
    EXPECT_EQ(balls.side(o, middle), Side::kInside) << o;
    EXPECT_EQ(balls.hides(o), o < 2) << o;
    const OperandBalls own({operands[o]}, {boxes[o]}, {uses[o]});
    EXPECT_EQ(own.hide_some(), o < 2) << o;
    EXPECT_EQ(own.hold(
                  1, [&](uint32_t) -> const auto& { return middle; }),
              o < 2)
        << o;
  }
}

}  // namespace
}  // namespace csgrun::operand_balls_test
