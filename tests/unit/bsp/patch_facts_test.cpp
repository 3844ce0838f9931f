#include "engine/bsp/patch_facts.h"

#include <vector>

#include <gtest/gtest.h>

namespace csgrun::patch_facts_test {
namespace {

std::vector<CutLoops::Fact> listed(const PatchFacts& facts, uint32_t patch) {
  const auto own = facts.of(patch);
  return {own.begin(), own.end()};
}

TEST(PatchFacts, AreThoseOfAPatchByOperandsAndOnceEach) {
  PatchFacts facts;
  facts.add(7, {3, true, true});
  facts.add(5, {2, false, true});
  facts.add(7, {1, false, false});
  facts.add(7, {3, true, true});
  facts.add(9, {3, false, false});
  const std::vector<uint8_t> none_is_open(4, 0);
  ASSERT_TRUE(facts.finish(none_is_open));
  using List = std::vector<CutLoops::Fact>;
  EXPECT_EQ(listed(facts, 7), (List{{1, false, false}, {3, true, true}}));
  EXPECT_EQ(listed(facts, 5), (List{{2, false, true}}));
  EXPECT_EQ(listed(facts, 9), (List{{3, false, false}}));
  for (const uint32_t none : {0u, 6u, 8u, 10u}) EXPECT_TRUE(facts.of(none).empty()) << none;
  EXPECT_TRUE(PatchFacts().of(0).empty());
}

// An open one may be here and there, but have no surface on either side of what it covers.
TEST(PatchFacts, ContradictOneAnotherOfOneOperandOnly) {
  for (const bool is_open : {false, true}) {
    for (const bool covers : {false, true}) {
      for (const bool contradicts : {false, true}) {
        PatchFacts facts;
        facts.add(4, {1, true, true});
        facts.add(4, {2, false, false});
        facts.add(5, {1, false, false});
        if (contradicts) facts.add(4, {2, !covers, true});
        const std::vector<uint8_t> open{0, 0, is_open};
        EXPECT_EQ(facts.finish(open), !contradicts || (is_open && !covers));
      }
    }
  }
}

}  // namespace
}  // namespace csgrun::patch_facts_test
