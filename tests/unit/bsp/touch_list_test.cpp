#include "engine/bsp/touch_list.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/kernel_case.h"

namespace csgrun::touch_list_test {
namespace {

GridBox box_at(int64_t i) { return {{i, 2 * i, -i}, {i + 1, 2 * i + 1, 1 - i}}; }

bool holds(const GridBox& outer, const GridBox& inner) {
  for (size_t k = 0; k < 3; ++k) {
    if (outer.lo[k] > inner.lo[k] || outer.hi[k] < inner.hi[k]) return false;
  }
  return true;
}

bool same(const GridBox& a, const GridBox& b) { return a.lo == b.lo && a.hi == b.hi; }

TEST(TouchList, ManyBoxesBecomeFewThatHoldThem) {
  test::Random random(701);
  for (const size_t count : {size_t{0}, size_t{1}, size_t{4096}, size_t{4097}, size_t{20001}}) {
    std::vector<GridBox> all;
    for (size_t i = 0; i < count; ++i) {
      GridBox& box = all.emplace_back();
      for (size_t k = 0; k < 3; ++k) {
        box.lo[k] = random.integer(-1000, 1000);
        box.hi[k] = box.lo[k] + random.integer(0, 9);
      }
    }
    std::vector<GridBox> few = all;
    keep_few(few);
    if (count <= 4096) {
      ASSERT_EQ(few.size(), count);
      continue;
    }
    ASSERT_LE(few.size(), 4096u);
    ASSERT_GT(few.size(), 2048u);
    // Neighbours stay together.
    size_t share = 1;
    while ((count + share - 1) / share > 4096) share *= 2;
    ASSERT_EQ(few.size(), (count + share - 1) / share);
    for (size_t i = 0; i < count; ++i) ASSERT_TRUE(holds(few[i / share], all[i])) << i;
    // And no box is larger than they ask for.
    for (size_t i = 0; i < few.size(); ++i) {
      GridBox hull = all[i * share];
      for (size_t j = i * share; j < std::min(count, (i + 1) * share); ++j) {
        for (size_t k = 0; k < 3; ++k) {
          hull.lo[k] = std::min(hull.lo[k], all[j].lo[k]);
          hull.hi[k] = std::max(hull.hi[k], all[j].hi[k]);
        }
      }
      ASSERT_EQ(few[i].lo, hull.lo);
      ASSERT_EQ(few[i].hi, hull.hi);
    }
  }
}

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
      return holds(b, own);
    })) << i;
  }
}

}  // namespace
}  // namespace csgrun::touch_list_test
