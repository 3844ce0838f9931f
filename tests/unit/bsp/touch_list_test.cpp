#include "engine/bsp/touch_list.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "engine/bsp/evaluate_job.h"

namespace csgrun {
namespace {

GridBox box_at(int64_t i) { return {{i, 2 * i, -i}, {i + 1, 2 * i + 1, 1 - i}}; }

bool same(const GridBox& a, const GridBox& b) { return a.lo == b.lo && a.hi == b.hi; }

TEST(TouchList, KeepsTheOrderAndEachVersion) {
  std::vector<TouchList> versions(1);
  std::vector<size_t> counts{0};
  size_t count = 0;
  for (size_t more = 0; more < 7; ++more) {
    std::vector<GridBox> boxes;
    for (size_t i = 0; i < more % 4; ++i) boxes.push_back(box_at(static_cast<int64_t>(count++)));
    versions.push_back(versions.back().with(boxes));
    counts.push_back(count);
  }
  for (size_t v = 0; v < versions.size(); ++v) {
    const std::vector<GridBox> boxes = versions[v].boxes();
    ASSERT_EQ(boxes.size(), counts[v]);
    for (size_t i = 0; i < boxes.size(); ++i) {
      EXPECT_TRUE(same(boxes[i], box_at(static_cast<int64_t>(i)))) << v << ' ' << i;
    }
  }
  // Two ways on from one version.
  const TouchList other = versions[3].with({box_at(99)});
  EXPECT_EQ(other.boxes().size(), counts[3] + 1);
  EXPECT_EQ(versions[4].boxes().size(), counts[4]);
}

TEST(TouchList, StaysShortAndHoldsAll) {
  TouchList list;
  constexpr int64_t kSteps = 30000;
  for (int64_t i = 0; i < kSteps; ++i) list = list.with({box_at(i)});
  // Nor do operations that touch nothing make it deep.
  for (int i = 0; i < 1000000; ++i) list = list.with({});
  const std::vector<GridBox> boxes = list.boxes();
  EXPECT_LE(boxes.size(), kMostTouches);
  EXPECT_GE(boxes.size(), kMostTouches / 2);
  for (int64_t i = 0; i < kSteps; i += 37) {
    const GridBox own = box_at(i);
    EXPECT_TRUE(std::any_of(boxes.begin(), boxes.end(), [&](const GridBox& b) {
      bool holds = true;
      for (size_t k = 0; k < 3; ++k) holds &= b.lo[k] <= own.lo[k] && own.hi[k] <= b.hi[k];
      return holds;
    })) << i;
  }
}

}  // namespace
}  // namespace csgrun
