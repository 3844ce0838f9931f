// Boxes found by a point: all that hold it, few others.
#include "engine/bsp/square_bins.h"

#include <gtest/gtest.h>

#include "tests/support/seeded.h"

namespace csgrun {
namespace {

using Box = SquareBins::Box;

bool holds(const Box& b, double x, double y) {
  return b.lo[0] <= x && x <= b.hi[0] && b.lo[1] <= y && y <= b.hi[1];
}

TEST(SquareBins, FindAllThatHoldAPoint) {
  test::Random random(961);
  for (const uint32_t per_side : {1u, 2u, 7u, 64u}) {
    for (const double away : {0.0, -1000.0, 1e9}) {
      std::vector<Box> boxes;
      for (int i = 0; i < 60; ++i) {
        Box& b = boxes.emplace_back();
        for (size_t k = 0; k < 2; ++k) {
          b.lo[k] = away + static_cast<double>(random.integer(0, 100));
          b.hi[k] = b.lo[k] + static_cast<double>(random.integer(1, i % 4 ? 5 : 90));
        }
        if (i % 10 == 3) std::swap(b.lo, b.hi);  // nowhere
      }
      const SquareBins bins(boxes, per_side);
      for (int i = 0; i < 300; ++i) {
        const double x = away + static_cast<double>(random.integer(-5, 400)) / 2,
                     y = away + static_cast<double>(random.integer(-5, 400)) / 2;
        const auto found = bins.at(x, y);
        ASSERT_TRUE(std::is_sorted(found.begin(), found.end()));
        for (uint32_t b = 0; b < boxes.size(); ++b) {
          const bool is_found = std::binary_search(found.begin(), found.end(), b);
          ASSERT_TRUE(is_found || !holds(boxes[b], x, y));
        }
      }
    }
  }
}

// Boxes that each fill a square: nobody else's are found in the midst of one.
TEST(SquareBins, FindNothingFarAway) {
  for (const double away : {0.0, -77.0, 900.0}) {
    std::vector<Box> boxes;
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        boxes.push_back(
            {{away + 10 * x + 1, away + 10 * y + 1}, {away + 10 * x + 9, away + 10 * y + 9}});
      }
    }
    const SquareBins bins(boxes, 8);
    for (uint32_t i = 0; i < boxes.size(); ++i) {
      const auto found = bins.at(boxes[i].lo[0] + 4, boxes[i].lo[1] + 4);
      ASSERT_EQ(std::vector<uint32_t>(found.begin(), found.end()), std::vector<uint32_t>{i});
    }
  }
}

// Boxes that all lie upon each other: 16 squares each, in four by four, and not one more.
TEST(SquareBins, AreFewWhereBoxesAreWide) {
  const std::vector<Box> wide(50, Box{{0, 0}, {100, 100}});
  EXPECT_EQ(SquareBins(wide, 64).size(), 16 * wide.size());
  EXPECT_EQ(SquareBins(wide, 4).size(), 16 * wide.size());
  EXPECT_EQ(SquareBins(wide, 3).size(), 9 * wide.size());
  // One of them alone is no reason for fewer squares.
  std::vector<Box> boxes{wide[0]};
  for (int i = 0; i < 99; ++i) boxes.push_back({{double(i), double(i)}, {i + 0.5, i + 0.5}});
  boxes.push_back({{50, 50}, {40, 60}});  // nowhere
  boxes.push_back({{50, 60}, {60, 50}});
  EXPECT_GT(SquareBins(boxes, 32).size(), 32u * 32);
}

TEST(SquareBins, OfNoBoxesHoldNothing) { EXPECT_TRUE(SquareBins({}, 1).at(3, -4).empty()); }

}  // namespace
}  // namespace csgrun
