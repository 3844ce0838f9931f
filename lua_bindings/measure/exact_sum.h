// Exact sums of products of doubles, and what follows from their signs.
//
// A product of three doubles is an integer of up to 159 bits times a power of two, so a fixed-point
// number that is wide enough for all exponents adds them without rounding.
#pragma once

#include <array>
#include <cstdint>

#include <glm/vec3.hpp>

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

/// The sign of the determinant of b - a, c - a, d - a: positive when d lies on the side from which
/// a, b, c run counter-clockwise. Exact; a filter in doubles answers first.
int orient(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

/// The sign of the area of a, b, c seen along `axis` (0, 1, 2), the other two axes in cyclic order.
int orient_along(int axis, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

}  // namespace csgrun
