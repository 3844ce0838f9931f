// Random CSG trees against the reference, for as long as one likes.
//
//   treefuzz [--seed N] [--cases N] [--first N] [--minutes M] [--simple]
//   treefuzz --replay FILE
//
// Prints what it tried, and each difference as a case shrunk to the few nodes and corners that it
// needs; such a text can be replayed, and kept in tests/property/cases. Exits 1 on a difference.
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

#include "tests/support/fuzz/campaign.h"
#include "tests/support/fuzz/case.h"
#include "tests/support/fuzz/check.h"

namespace {

using namespace csgrun::test;  // NOLINT: a test

int replay(const char* file) {
  std::ifstream in(file);
  const std::string given((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const auto c = read_fuzz_case(given);
  if (!c) {
    std::fprintf(stderr, "%s is not a case\n", file);
    return 2;
  }
  const FuzzOutcome outcome = check_case(*c);
  std::printf("%s\n", outcome.failure.empty() ? "no difference" : outcome.failure.c_str());
  return outcome.failure.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Campaign campaign;
  bool counted = false;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--simple") {
      campaign.kinds = {false, false, false};
      continue;
    }
    if (i + 1 == argc) {
      std::fprintf(stderr, "treefuzz: %s needs a value, or is unknown\n", option.c_str());
      return 2;
    }
    const char* value = argv[++i];
    if (option == "--replay") {
      return replay(value);
    } else if (option == "--seed") {
      campaign.seed = std::strtoull(value, nullptr, 10);
    } else if (option == "--cases") {
      campaign.cases = std::strtoull(value, nullptr, 10);
      counted = true;
    } else if (option == "--first") {
      campaign.first = std::strtoull(value, nullptr, 10);
    } else if (option == "--minutes") {
      campaign.seconds = 60 * std::strtod(value, nullptr);
    } else {
      std::fprintf(stderr, "treefuzz: unknown option %s\n", option.c_str());
      return 2;
    }
  }
  if (campaign.seconds > 0 && !counted) campaign.cases = UINT64_MAX;
  const CampaignResult result = run(campaign);
  for (const std::string& failure : result.failures) std::printf("%s\n", failure.c_str());
  std::printf("seed %llu, from case %llu: %s\n", static_cast<unsigned long long>(campaign.seed),
              static_cast<unsigned long long>(campaign.first), result.summary().c_str());
  return result.failures.empty() ? 0 : 1;
}
