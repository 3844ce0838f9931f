#include "tests/support/fuzz/campaign.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "tests/support/fuzz/check.h"
#include "tests/support/fuzz/shrink.h"

namespace csgrun::test {

std::string CampaignResult::summary() const {
  const auto share = [&](uint64_t n) {
    char out[32];
    std::snprintf(out, sizeof out, "%.1f %%", cases ? 100.0 * n / cases : 0.0);
    return std::string(out);
  };
  return std::to_string(cases) + " trees, " + std::to_string(failures.size()) +
         " differences; zero signs in " + share(zeros) + ", frames in " + share(framed) +
         ", leaves that cross themselves in " + share(crossing) + ", hulls in " + share(hulls) +
         ", subtrees materialised in " + share(nested) + ", in pieces " + share(in_pieces) +
         ", with named faces " + share(named) + ", the paper's cells in " + share(literal) +
         ", empty results " + share(empty) + "; " + std::to_string(leaves) + " leaves, at most " +
         std::to_string(most_leaves) + " a tree";
}

namespace {

bool has_hull(const FuzzNode& n) {
  if (n.hull) return true;
  return std::any_of(n.children.begin(), n.children.end(), has_hull);
}

}  // namespace

FuzzCase fuzz_case(const Campaign& campaign, uint64_t number) {
  Random random = Random::of_case(campaign.seed, number);
  return FuzzMaker(random, campaign.kinds).make();
}

CampaignResult run(const Campaign& campaign) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  CampaignResult r;
  for (uint64_t i = 0; i < campaign.cases && r.failures.size() < campaign.most_failures; ++i) {
    if (campaign.seconds > 0 &&
        std::chrono::duration<double>(Clock::now() - start).count() > campaign.seconds) {
      break;
    }
    const uint64_t number = campaign.first + i;
    const FuzzCase c = fuzz_case(campaign, number);
    const FuzzOutcome outcome = check_case(c, number % campaign.forms_every == 0);
    ++r.cases;
    r.zeros += outcome.meets_zero;
    r.empty += outcome.empty;
    r.framed += c.frames.size() > 1;
    r.crossing += std::any_of(c.leaves.begin(), c.leaves.end(),
                              [](const FuzzLeaf& l) { return l.may_cross; });
    r.hulls += has_hull(c.tree);
    r.named += outcome.named > 0;
    r.nested += c.nest != 0;
    r.in_pieces += (c.nest & kInPieces) != 0;
    r.literal += c.options.literal_cells;
    r.leaves += c.leaves.size();
    r.most_leaves = std::max<uint64_t>(r.most_leaves, c.leaves.size());
    if (outcome.failure.empty()) continue;
    // Should a smaller case bring the program down, this one is known.
    std::fprintf(stderr, "case %llu: %s; shrinking\n%s\n", static_cast<unsigned long long>(number),
                 outcome.failure.c_str(), text(c).c_str());
    const FuzzCase small =
        Shrinker(c, [](const FuzzCase& s) { return !check_case(s).failure.empty(); }).run();
    r.failures.push_back("seed " + std::to_string(campaign.seed) + ", case " +
                         std::to_string(number) + ": " + outcome.failure +
                         "\nshrunk: " + check_case(small).failure + "\n" + text(small));
  }
  return r;
}

}  // namespace csgrun::test
