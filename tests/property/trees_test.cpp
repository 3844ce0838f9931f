// Random CSG trees on a tiny grid, where zeros are dense, against the reference. CSGRUN_CASES and
// CSGRUN_SEED ask for more and others; treefuzz does the same for hours.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "tests/support/fuzz/campaign.h"
#include "tests/support/fuzz/case.h"
#include "tests/support/fuzz/check.h"
#include "tests/support/fuzz/shrink.h"
#include "tests/support/fuzz/truth.h"
#include "tests/support/kernel_checks.h"
#include "tests/support/reference/reference.h"

namespace csgrun::trees_test {
namespace {

using namespace test;  // NOLINT: a test

void agree(Campaign campaign, int ordinary) {
  campaign.cases = static_cast<uint64_t>(cases(ordinary));
  if (const char* given = std::getenv("CSGRUN_SEED")) {
    campaign.seed = std::strtoull(given, nullptr, 10);
  }
  const CampaignResult r = run(campaign);
  std::printf("seed %llu: %s\n", static_cast<unsigned long long>(campaign.seed),
              r.summary().c_str());
  for (const std::string& failure : r.failures) ADD_FAILURE() << failure;
  // The grid is there for the zeros.
  EXPECT_GE(10 * r.zeros, 3 * r.cases);
}

TEST(Trees, OfSimpleLeaves) {
  Campaign campaign;
  campaign.kinds = {false, false, false};
  agree(campaign, 2500);
}

TEST(Trees, OfAllKinds) {
  Campaign campaign;
  campaign.seed = 2;
  agree(campaign, 4000);
}

// A deliberate fault of the reference stands for one of the kernel: it is found, and what is left
// of the case shows the fault and nothing else.
TEST(Trees, WhatFailsShrinks) {
  const auto differs = [](const FuzzCase& c) {
    const auto result = FuzzEvaluator(c).run();
    if (!result) return true;
    const Truth truth = truth_of(c);
    return !reference::difference(truth.leaves, truth.tree, claim_of(**result),
                                  reference::Fault::kXorAsUnion)
                .empty();
  };
  Campaign campaign;
  int shrunk = 0;
  for (uint64_t i = 0; i < 40; ++i) {
    const FuzzCase c = fuzz_case(campaign, i);
    if (!differs(c)) continue;
    const FuzzCase small = Shrinker(c, differs).run();
    EXPECT_TRUE(differs(small));
    EXPECT_EQ(small.leaves.size(), 2u) << text(small);
    EXPECT_EQ(small.tree.node_count(), 3u) << text(small);
    EXPECT_LE(small.frames.size(), 2u) << text(small);  // the fault may need a frame
    ++shrunk;
  }
  EXPECT_GT(shrunk, 3);
}

// What failed once, shrunk.
TEST(Trees, KeptCases) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(CSGRUN_SOURCE_DIR "/tests/property/cases")) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  EXPECT_FALSE(files.empty());
  for (const auto& file : files) {
    std::ifstream in(file);
    const auto c = read_fuzz_case(
        std::string((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>()));
    ASSERT_TRUE(c) << file;
    EXPECT_EQ(check_case(*c).failure, "") << file;
  }
}

}  // namespace
}  // namespace csgrun::trees_test
