// Boxes found by a point: all that hold it, few others.
#include "engine/bsp/square_bins.h"

#include <gtest/gtest.h>

#include "tests/support/seeded.h"

namespace csgrun::square_bins_test {
namespace {

using Box = SquareBins::Box;
using Point = std::array<double, 3>;

bool holds(const Box& b, const Point& p) {
  bool is_in = true;
  for (size_t k = 0; k < 3; ++k) is_in &= b.lo[k] <= p[k] && p[k] <= b.hi[k];
  return is_in;
}

TEST(SquareBins, FindAllThatHoldAPoint) {
  test::Random random(961);
  for (const uint32_t most : {1u, 2u, 7u, 50u, 4096u}) {
    for (const double away : {0.0, -1000.0, 1e9}) {
      for (size_t flat = 0; flat < 4; ++flat) {  // the axis along which all are in one place
        std::vector<Box> boxes;
        for (int i = 0; i < 60; ++i) {
          Box& b = boxes.emplace_back();
          for (size_t k = 0; k < 3; ++k) {
            b.lo[k] = away + static_cast<double>(random.integer(0, k == flat ? 1 : 100));
            b.hi[k] = b.lo[k] + static_cast<double>(random.integer(1, i % 4 ? 5 : 90));
          }
          if (i % 10 == 3) std::swap(b.lo, b.hi);  // nowhere
        }
        const SquareBins bins(boxes, most);
        size_t inside = 0;
        for (int i = 0; i < 300; ++i) {
          Point p{};
          for (double& c : p) c = away + static_cast<double>(random.integer(-5, 200)) / 2;
          const auto found = bins.at(p);
          ASSERT_TRUE(std::is_sorted(found.begin(), found.end()));
          for (uint32_t b = 0; b < boxes.size(); ++b) {
            const bool is_found = std::binary_search(found.begin(), found.end(), b);
            ASSERT_TRUE(is_found || !holds(boxes[b], p));
            inside += holds(boxes[b], p);
          }
        }
        EXPECT_GT(inside, 10u);
      }
    }
  }
}

// Boxes that stand in a square across any two axes, or in a column: nobody else's are found in the
// midst of one.
TEST(SquareBins, FindNothingFarAway) {
  for (const double away : {0.0, -77.0, 900.0}) {
    for (size_t axis = 0; axis < 3; ++axis) {
      for (const bool is_column : {false, true}) {
        std::vector<Box> boxes;
        for (int i = 0; i < 64; ++i) {
          const size_t next = (axis + 1) % 3;
          Box& b = boxes.emplace_back();
          b.lo.fill(away + 1);
          b.lo[axis] += 10 * (is_column ? i : i / 8);
          b.lo[next] += is_column ? 0 : 10 * (i % 8);
          for (size_t k = 0; k < 3; ++k) b.hi[k] = b.lo[k] + 8;
        }
        const SquareBins bins(boxes, 256);
        for (uint32_t i = 0; i < boxes.size(); ++i) {
          const auto found = bins.at({boxes[i].lo[0] + 4, boxes[i].lo[1] + 4, boxes[i].lo[2] + 4});
          ASSERT_EQ(std::vector<uint32_t>(found.begin(), found.end()), std::vector<uint32_t>{i});
        }
      }
    }
  }
}

// Boxes that all lie upon each other: four squares each, in two by two, and not one more.
TEST(SquareBins, AreFewWhereBoxesAreWide) {
  const std::vector<Box> wide(50, Box{{0, 0, 0}, {100, 100, 100}});
  EXPECT_EQ(SquareBins(wide, 4096).size(), 4 * wide.size());
  EXPECT_EQ(SquareBins(wide, 4).size(), 4 * wide.size());
  EXPECT_EQ(SquareBins(wide, 1).size(), wide.size());
  // One of them alone is no reason for fewer squares.
  std::vector<Box> boxes{wide[0]};
  for (int i = 0; i < 99; ++i) {
    boxes.push_back({{double(i), double(i), 0}, {i + 0.5, i + 0.5, 100}});
  }
  boxes.push_back({{50, 50, 0}, {40, 60, 100}});  // nowhere
  boxes.push_back({{50, 60, 0}, {60, 50, 100}});
  EXPECT_GT(SquareBins(boxes, 1024).size(), 32u * 32);
  // Many of them are.
  boxes.insert(boxes.end(), 30, Box{{0, 0, 0}, {100, 100, 100}});
  EXPECT_LE(SquareBins(boxes, 1024).size(), 16 * boxes.size());
}

TEST(SquareBins, OfNoBoxesHoldNothing) { EXPECT_TRUE(SquareBins({}, 1).at({3, -4, 5}).empty()); }

}  // namespace
}  // namespace csgrun::square_bins_test
