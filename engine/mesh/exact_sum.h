// Exact sums of products of doubles.
//
// A product of three doubles is an integer of up to 159 bits times a power of two, so a fixed-point
// number that is wide enough for all exponents adds them without rounding.
#pragma once

#include <array>
#include <cstdint>

namespace csgrun {

class ExactSum {
 public:
  /// Adds x * y * z, or its negative. Finite numbers only.
  void add(double x, double y, double z, bool negative = false);
  /// -1, 0 or 1.
  [[nodiscard]] int sign();
  /// The sum divided by `divisor`, rounded once to the nearest double (ties to even).
  [[nodiscard]] double divided(uint32_t divisor);

 private:
  // Digit i stands for 2^(32 i - kBias). Three times the least exponent (-1074) to three times the
  // greatest (1024), and 64 bits for the number of terms.
  static constexpr int kBias = 3232;
  static constexpr int kDigits = (kBias + 3 * 1024 + 64) / 32 + 1;

  void use(int first, int last);
  void carry();

  // Only lowest_ to highest_ have values: most sums use a dozen digits.
  std::array<int64_t, kDigits> digits_;
  int lowest_ = kDigits, highest_ = -1;
  uint32_t pending_ = 0;  // terms since the last carry
};

}  // namespace csgrun
