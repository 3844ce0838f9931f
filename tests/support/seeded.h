// Random numbers for tests: the same in every run, others with a CSGRUN_SEED other than 0.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace csgrun::test {

class Random {
 public:
  /// Sequences that have seeds of their own stay apart whatever CSGRUN_SEED is.
  explicit Random(uint64_t own_seed) : state_(own_seed) {
    if (const char* given = std::getenv("CSGRUN_SEED")) {
      const uint64_t seed = std::strtoull(given, nullptr, 10);
      state_ ^= seed * 0xd1342543de82ef95ull;
      std::printf("CSGRUN_SEED=%llu\n", static_cast<unsigned long long>(seed));
    }
  }

  /// A sequence of its own for one of many cases: nothing is printed, CSGRUN_SEED has no say.
  static Random of_case(uint64_t seed, uint64_t number) {
    Random r;
    r.state_ = seed ^ (number * 0xd1342543de82ef95ull);
    r.state_ = r.bits();
    return r;
  }

  uint64_t bits() {  // splitmix64
    uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  /// Uniform in [lo, hi].
  int64_t integer(int64_t lo, int64_t hi) {
    return lo + static_cast<int64_t>(bits() % static_cast<uint64_t>(hi - lo + 1));
  }
  /// Uniform in [0, 1).
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

 private:
  Random() = default;
  uint64_t state_ = 0;
};

}  // namespace csgrun::test
