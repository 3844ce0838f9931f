// Many random cases against the reference: counts what they were, shrinks what fails.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/fuzz/maker.h"

namespace csgrun::test {

struct Campaign {
  uint64_t seed = 1;
  uint64_t first = 0, cases = 1000;
  double seconds = 0;  ///< stop after so much time; 0: when all cases are done
  FuzzKinds kinds;
  uint64_t forms_every =
      4;  ///< forms and arrays are looked at in so many cases only: they cost more
  uint64_t most_failures = 5;  ///< stop when there are so many
};

struct CampaignResult {
  uint64_t cases = 0, zeros = 0, empty = 0, framed = 0, crossing = 0, hulls = 0, nested = 0,
           named = 0, in_pieces = 0, literal = 0, leaves = 0, most_leaves = 0;
  std::vector<std::string> failures;  ///< what differed, and the shrunk case as text

  [[nodiscard]] std::string summary() const;
};

FuzzCase fuzz_case(const Campaign& campaign, uint64_t number);

CampaignResult run(const Campaign& campaign);

}  // namespace csgrun::test
