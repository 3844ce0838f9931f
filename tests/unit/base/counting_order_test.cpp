// Sorting by small whole numbers, against the standard library's; on one thread and on several.
#include "engine/base/counting_order.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/support/seeded.h"

namespace csgrun::counting_order_test {
namespace {

TEST(CountingOrder, IsAStableSort) {
  test::Random random(1201);
  for (const size_t count : {size_t{0}, size_t{50}, 4 * kFewForThreads - 1, 4 * kFewForThreads,
                             4 * kFewForThreads + 12345}) {
    for (const size_t keys : {size_t{1}, size_t{3}, size_t{4}, size_t{1000}, count + 7}) {
      std::vector<uint32_t> key(count);
      // The last key is left out, and so are some between.
      const auto most = std::max<int64_t>(0, static_cast<int64_t>(keys) - 2);
      for (uint32_t& k : key) k = static_cast<uint32_t>(random.integer(0, most));
      std::vector<uint32_t> order(count);
      std::iota(order.begin(), order.end(), 0u);
      std::stable_sort(order.begin(), order.end(),
                       [&](uint32_t i, uint32_t j) { return key[i] < key[j]; });
      std::vector<uint32_t> starts(keys + 1, 0);
      for (const uint32_t k : key) ++starts[k + 1];
      for (size_t k = 0; k < keys; ++k) starts[k + 1] += starts[k];
      for (const unsigned threads : {1u, 4u}) {
        CountingOrder sorted;
        with_threads(threads, [&] { sorted.sort(count, keys, [&](size_t i) { return key[i]; }); });
        EXPECT_EQ(sorted.order, order) << count << " " << keys;
        EXPECT_EQ(sorted.starts, starts) << count << " " << keys;
      }
    }
  }
}

}  // namespace
}  // namespace csgrun::counting_order_test
