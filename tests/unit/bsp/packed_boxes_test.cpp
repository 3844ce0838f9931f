// Trees of boxes against a look at all boxes.
#include "engine/bsp/packed_boxes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "engine/mesh/box_tree.h"

namespace csgrun::packed_boxes_test {
namespace {

/// Boxes strewn at random; `crowded`: most of them within a millionth of the space.
std::vector<Box> random_boxes(size_t count, bool crowded, std::mt19937& random) {
  const auto at_random = [&](double size) {
    return static_cast<double>(random()) * 0x1p-32 * size;
  };
  std::vector<Box> boxes;
  for (size_t i = 0; i < count; ++i) {
    const double scale = crowded && i % 16 != 0 ? 1e-6 : 1;
    Box box;
    for (size_t k = 0; k < 3; ++k) {
      box.lo[k] = 1000 + at_random(100 * scale);
      // Some are flat, some points.
      box.hi[k] = box.lo[k] + (random() % 4 == 0 ? 0 : at_random(20 * scale));
    }
    boxes.push_back(box);
  }
  return boxes;
}

std::vector<FloatBox> rounded(const std::vector<Box>& boxes) {
  std::vector<FloatBox> result;
  for (const Box& box : boxes) {
    FloatBox f;
    for (size_t k = 0; k < 3; ++k) {
      f.lo[k] = static_cast<float>(box.lo[k]);
      f.hi[k] = static_cast<float>(box.hi[k]);
    }
    result.push_back(f);
  }
  return result;
}

bool overlap(const FloatBox& a, const FloatBox& b) {
  bool all = true;
  for (size_t k = 0; k < 3; ++k) all = all && a.lo[k] <= b.hi[k] && b.lo[k] <= a.hi[k];
  return all;
}

using Pairs = std::vector<std::pair<uint32_t, uint32_t>>;

TEST(PackedBoxes, FindsEachPairOnceHoweverItIsDivided) {
  std::mt19937 random(2);
  for (const size_t count : {0, 1, 7, 8, 9, 32, 33, 64, 65, 500, 1200}) {
    for (const bool crowded : {false, true}) {
      const std::vector<FloatBox> boxes = rounded(random_boxes(count, crowded, random));
      Pairs expected;
      for (uint32_t i = 0; i < count; ++i) {
        for (uint32_t j = i + 1; j < count; ++j) {
          if (overlap(boxes[i], boxes[j])) expected.emplace_back(i, j);
        }
      }
      const PackedBoxes tree(boxes);
      for (const size_t wanted : {1, 10, 300}) {
        Pairs found;
        for (const auto& task : tree.pair_tasks(wanted)) {
          tree.visit_rows(task, [&](uint32_t place, uint32_t group, uint32_t hits) {
            PackedBoxes::for_each_bit(hits, [&](uint32_t bit) {
              EXPECT_LT(place, 8 * group + bit);
              found.push_back(std::minmax({tree.order()[place], tree.order()[8 * group + bit]}));
            });
          });
        }
        std::sort(found.begin(), found.end());
        ASSERT_EQ(found, expected) << count << (crowded ? " crowded" : "");
      }
    }
  }
}

TEST(PackedBoxes, PairsOverlapAlongMoreAxesToo) {
  std::mt19937 random(9);
  for (const size_t count : {3, 20, 33, 200, 1500}) {
    const std::vector<FloatBox> boxes = rounded(random_boxes(count, true, random));
    const std::array more{rounded(random_boxes(count, false, random)),
                          rounded(random_boxes(count, true, random))};
    Pairs expected, found;
    for (uint32_t i = 0; i < count; ++i) {
      for (uint32_t j = i + 1; j < count; ++j) {
        if (overlap(boxes[i], boxes[j]) && overlap(more[0][i], more[0][j]) &&
            overlap(more[1][i], more[1][j])) {
          expected.emplace_back(i, j);
        }
      }
    }
    const PackedBoxes tree(boxes, more);
    for (const auto& task : tree.pair_tasks(5)) {
      tree.visit_rows(task, [&](uint32_t place, uint32_t group, uint32_t hits) {
        PackedBoxes::for_each_bit(hits, [&](uint32_t bit) {
          found.push_back(std::minmax({tree.order()[place], tree.order()[8 * group + bit]}));
        });
      });
    }
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, expected) << count;
  }
}

TEST(PackedBoxes, OrderHoldsEachBoxOnce) {
  std::mt19937 random(3);
  for (const size_t count : {5, 40, 3000}) {
    const PackedBoxes tree(rounded(random_boxes(count, true, random)));
    std::vector<uint32_t> sorted = tree.order();
    std::sort(sorted.begin(), sorted.end());
    for (uint32_t i = 0; i < count; ++i) ASSERT_EQ(sorted[i], i);
  }
}

TEST(BoxTree, FindsWhatOverlapsInDoubles) {
  std::mt19937 random(4);
  for (const size_t count : {1, 30, 700}) {
    for (const bool crowded : {false, true}) {
      const std::vector<Box> boxes = random_boxes(count, crowded, random);
      const BoxTree tree(boxes);
      for (uint32_t i = 0; i < count; ++i) {
        std::vector<uint32_t> all, later, expected_all, expected_later;
        tree.visit_all(boxes[i], [&](uint32_t j) { all.push_back(j); });
        tree.visit_later(i, [&](uint32_t j) { later.push_back(j); });
        for (uint32_t j = 0; j < count; ++j) {
          if (!boxes[i].overlaps(boxes[j])) continue;
          expected_all.push_back(j);
          if (j > i) expected_later.push_back(j);
        }
        std::sort(all.begin(), all.end());
        std::sort(later.begin(), later.end());
        ASSERT_EQ(all, expected_all);
        ASSERT_EQ(later, expected_later);
      }
    }
  }
}

TEST(BoxTree, TheEndsOfTheRangeOfDoubles) {
  constexpr double kMost = std::numeric_limits<double>::max();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<Box> boxes;
  for (const double x : {-kMost, -1e300, -1.0, 0.0, 5e-324, 1.0, 1e300, kMost}) {
    boxes.push_back({{x, x, x}, {x, x, x}});
  }
  const BoxTree tree(boxes);
  for (uint32_t i = 0; i < boxes.size(); ++i) {
    std::vector<uint32_t> found;
    tree.visit_all(boxes[i], [&](uint32_t j) { found.push_back(j); });
    EXPECT_EQ(found, std::vector<uint32_t>{i});
  }
  size_t count = 0;
  tree.visit_all({{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}},
                 [&](uint32_t) { ++count; });
  EXPECT_EQ(count, boxes.size());
}

}  // namespace
}  // namespace csgrun::packed_boxes_test
