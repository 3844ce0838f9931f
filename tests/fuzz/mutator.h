// Random changes of an input, for builds without libFuzzer: bytes, pieces, words of a dictionary,
// numbers. The same seed gives the same inputs everywhere.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/seeded.h"

namespace csgrun::fuzz {

class Mutator {
 public:
  /// `inputs` and `words` must outlive it; `inputs` must not be empty.
  Mutator(test::Random& random, const std::vector<std::string>& inputs,
          const std::vector<std::string>& words)
      : random_(random), inputs_(inputs), words_(words) {}

  std::string next() {
    std::string input = any(inputs_);
    for (uint64_t n = 1 + below(4); n > 0; --n) change(input);
    if (input.size() > kLongest) input.resize(kLongest);
    return input;
  }

 private:
  static constexpr size_t kLongest = 4096;

  uint64_t below(uint64_t bound) { return random_.bits() % std::max<uint64_t>(bound, 1); }
  const std::string& any(const std::vector<std::string>& list) { return list[below(list.size())]; }

  void change(std::string& input) {
    const size_t at = below(input.size() + 1);
    const size_t length = std::min<size_t>(1 + below(16), input.size() - at);
    switch (below(9)) {
      case 0:
        if (at < input.size()) input[at] = static_cast<char>(random_.bits());
        break;
      case 1:
        if (at < input.size()) input[at] = static_cast<char>(input[at] ^ (1 << below(8)));
        break;
      case 2:
        input.insert(at, 1, static_cast<char>(random_.bits()));
        break;
      case 3:
        input.erase(at, length);
        break;
      case 4:
        input.insert(below(input.size() + 1), input.substr(at, length));
        break;
      case 5: {  // a piece of another input
        const std::string& other = any(inputs_);
        const size_t from = below(other.size() + 1);
        input.insert(at, other.substr(from, below(64)));
        break;
      }
      case 6:
        if (!words_.empty()) input.insert(at, any(words_));
        break;
      case 7: {  // a number that is written out
        static const std::vector<std::string> numbers{
            "0",     "-1",  "1e9", "4294967295", "4294967296", "-9223372036854775808",
            "1e308", "nan", "inf", "0.1",        "1e-400",     "18446744073709551615",
            "255",   "3"};
        input.replace(at, std::min(length, below(3)), any(numbers));
        break;
      }
      default: {  // a number in bytes
        const uint64_t value = below(2) == 0 ? ~uint64_t{0} >> below(64) : below(8);
        for (size_t i = 0; i < 4 && at + i < input.size(); ++i)
          input[at + i] = static_cast<char>(value >> (8 * i));
      }
    }
  }

  test::Random& random_;
  const std::vector<std::string>& inputs_;
  const std::vector<std::string>& words_;
};

}  // namespace csgrun::fuzz
