#include "engine/base/chance_list.h"

#include <vector>

#include <gtest/gtest.h>

#include "tests/support/seeded.h"

namespace csgrun::chance_list_test {
namespace {

TEST(ChanceList, HasWhatWasAdded) {
  test::Random random(77);
  for (int i = 0; i < 200; ++i) {
    const auto calls = static_cast<size_t>(random.integer(0, 300));
    const bool has_room = random.integer(0, 1) == 0;
    ChanceList<uint32_t> list(has_room ? calls : 0);
    std::vector<uint32_t> truth;
    for (uint32_t k = 0; k < calls; ++k) {
      const bool is_added = random.integer(0, 2) == 0;
      if (!has_room) list.make_room(1);
      list.add_if(is_added, k);
      if (is_added) truth.push_back(k);
      ASSERT_EQ(list.size(), truth.size());
      if (is_added) {
        ASSERT_EQ(list[truth.size() - 1], k);
      }
    }
    ASSERT_EQ(std::vector<uint32_t>(list.view().begin(), list.view().end()), truth);
    const RawVector<uint32_t> taken = list.take();
    ASSERT_EQ(std::vector<uint32_t>(taken.begin(), taken.end()), truth);
    ASSERT_EQ(list.size(), 0u);
  }
}

}  // namespace
}  // namespace csgrun::chance_list_test
