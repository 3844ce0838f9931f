// Pairs of boxes found cell by cell, against all pairs.
#include "engine/bsp/near_pairs.h"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include "engine/base/parallel.h"
#include "tests/support/seeded.h"

namespace csgrun::near_pairs_test {
namespace {

using Pairs = std::vector<std::array<uint32_t, 2>>;

std::vector<PolygonBox> random_boxes(test::Random& random, size_t count, int32_t reach,
                                     int32_t size) {
  std::vector<PolygonBox> boxes(count);
  for (PolygonBox& box : boxes) {
    for (size_t k = 0; k < 3; ++k) {
      box.lo[k] = static_cast<int32_t>(random.integer(-reach, reach));
      box.hi[k] = box.lo[k] + static_cast<int32_t>(random.integer(0, size));
    }
  }
  return boxes;
}

/// A grid of cubes with sides of `side` from -reach on: those that boxes of both leaves meet.
PairCells shared_cells(const std::vector<PolygonBox>& boxes, uint32_t second, int32_t reach,
                       int32_t side) {
  PairCells cells;
  for (int32_t z = -reach; z <= reach; z += side) {
    for (int32_t y = -reach; y <= reach; y += side) {
      for (int32_t x = -reach; x <= reach; x += side) {
        const PolygonBox cell{{x, y, z}, {x + side - 1, y + side - 1, z + side - 1}};
        const auto first = static_cast<uint32_t>(cells.polygons.size());
        size_t of_second = 0;
        for (uint32_t b = 0; b < boxes.size(); ++b) {
          if (!cell.meets(boxes[b])) continue;
          cells.polygons.push_back(b);
          of_second += b >= second;
        }
        const auto count = static_cast<uint32_t>(cells.polygons.size() - first);
        if (of_second == 0 || of_second == count) {
          cells.polygons.resize(first);
        } else {
          cells.cells.push_back({cell.lo, cell.hi, first, count});
        }
      }
    }
  }
  cells.surface = 5;
  return cells;
}

TEST(NearPairs, AreAllThatOverlapEachOnce) {
  size_t pairs = 0, split = 0;
  for (int i = 0; i < 60; ++i) {
    test::Random random(6100 + i);
    const auto size = static_cast<int32_t>(random.integer(0, i % 4 == 0 ? 90 : 25));
    const auto boxes = random_boxes(random, static_cast<size_t>(random.integer(0, 400)), 60, size);
    const auto second =
        static_cast<uint32_t>(random.integer(0, static_cast<int64_t>(boxes.size())));
    const PairCells cells =
        shared_cells(boxes, second, 100, static_cast<int32_t>(random.integer(8, 70)));
    Pairs expected;
    for (uint32_t f = 0; f < second; ++f) {
      for (uint32_t g = second; g < boxes.size(); ++g) {
        if (boxes[f].meets(boxes[g])) expected.push_back({f, g});
      }
    }
    const auto found =
        with_threads(1 + i % 2, [&] { return find_near_pairs(cells, boxes, second); });
    if (expected.size() > 2 * boxes.size()) {
      ++split;
      EXPECT_FALSE(found) << i;
      continue;
    }
    ASSERT_TRUE(found) << i;
    ASSERT_EQ(found->starts.size(), cells.cells.size() + 1);
    EXPECT_EQ(found->starts.front(), 0u);
    EXPECT_EQ(found->starts.back(), found->pairs.size());
    // Those of a cell have the lowest corner of what they have in common in it.
    for (size_t c = 0; c < cells.cells.size(); ++c) {
      for (uint32_t p = found->starts[c]; p < found->starts[c + 1]; ++p) {
        const auto [f, g] = found->pairs[p];
        for (size_t k = 0; k < 3; ++k) {
          const int32_t lowest = std::max(boxes[f].lo[k], boxes[g].lo[k]);
          EXPECT_TRUE(cells.cells[c].lo[k] <= lowest && lowest <= cells.cells[c].hi[k]);
        }
      }
    }
    Pairs sorted = found->pairs;
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(sorted, expected) << i;
    EXPECT_EQ(found->visited, cells.cells.size());
    EXPECT_EQ(found->surface, 5 + cells.cells.size());
    pairs += expected.size();
  }
  EXPECT_GT(pairs, 1000u);
  EXPECT_GT(split, 2u);
}

TEST(NearPairs, AreAtMostTwiceAsManyAsFaces) {
  for (const uint32_t seconds : {4u, 5u}) {
    const std::vector<PolygonBox> boxes(4 + seconds, PolygonBox{{1, 1, 1}, {2, 2, 2}});
    PairCells cells;
    for (uint32_t f = 0; f < boxes.size(); ++f) cells.polygons.push_back(f);
    cells.cells.push_back({{0, 0, 0}, {9, 9, 9}, 0, static_cast<uint32_t>(boxes.size())});
    const auto found = find_near_pairs(cells, boxes, 4);
    ASSERT_EQ(found.has_value(), seconds == 4);
    if (found) {
      EXPECT_EQ(found->pairs.size(), 16u);
    }
  }
}

TEST(NearPairs, AreNotLookedForInCrowds) {
  for (const uint32_t crowd : {512u, 513u}) {
    // Side by side, so that none overlap.
    std::vector<PolygonBox> boxes;
    for (int32_t x = 0; x < static_cast<int32_t>(crowd); ++x) {
      boxes.push_back({{x, 0, 0}, {x, 9, 9}});
    }
    PairCells cells;
    for (uint32_t f = 0; f < crowd; ++f) cells.polygons.push_back(f);
    cells.cells.push_back({{0, 0, 0}, {600, 10, 10}, 0, crowd});
    const auto found = find_near_pairs(cells, boxes, 100);
    EXPECT_EQ(found.has_value(), crowd == 512);
    EXPECT_TRUE(!found || found->pairs.empty());
    // One crowd among many others that are none does no harm.
    boxes.resize(2 * crowd, {{1000, 0, 0}, {1000, 0, 0}});
    EXPECT_TRUE(find_near_pairs(cells, boxes, 100));
  }
}

}  // namespace
}  // namespace csgrun::near_pairs_test
