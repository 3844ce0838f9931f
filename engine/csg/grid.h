// The integer grid: its step, and the rounding of millimetres to it.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include <csgrun/engine/evaluate.h>

#include "engine/exact/widths.h"

namespace csgrun {

static_assert(kGridBits == widths::kGrid);
/// Coordinates of what can reach a result, in steps, are below this.
constexpr int64_t kGridLimit = int64_t{1} << kGridBits;
/// Coordinates of leaves that reach far outside it are below this.
constexpr int64_t kFarLimit = int64_t{1} << widths::kFarGrid;
/// What the choice of a step leaves free at the limits, for bounds that are rounded outwards.
constexpr int64_t kGridMargin = 16;

/// Rounds millimetres to a grid.
class Quantiser {
 public:
  /// `step` must not be automatic.
  explicit Quantiser(const GridStep& step);

  /// floor(x / step + 1/2 + 2^-12), a function of the exact value of `x`: no rounding happens on
  /// the way. The 2^-12 makes ties (multiples of half a step) safe from the noise of the doubles
  /// that lead to `x`, and the rule is invariant under translation by whole steps. std::nullopt
  /// when |x / step| is 2^41 or more, or x is not finite.
  [[nodiscard]] std::optional<int64_t> operator()(double x) const {
    if (!(std::fabs(x) < limit_mm_)) return std::nullopt;
    // In doubles: three roundings lead to the quotient and one to the sum, each by 2^-53 of it,
    // which is at most 0.51 more than the quotient. Below 2^41 steps the bound is under 2^-8.
    const double quotient = x * steps_per_mm_, sum = quotient + (0.5 + 0x1p-12);
    const double bound = (std::fabs(quotient) + 1) * 0x1p-50;
    const int64_t low = floor_of(sum - bound), high = floor_of(sum + bound);
    return low == high ? low : round_exactly(x);
  }

  [[nodiscard]] const GridStep& step() const { return step_; }
  [[nodiscard]] double step_mm() const { return step_mm_; }

 private:
  static int64_t floor_of(double x) {
    const auto whole = static_cast<int64_t>(x);
    return whole - (static_cast<double>(whole) > x ? 1 : 0);
  }
  [[nodiscard]] int64_t round_exactly(double x) const;

  GridStep step_;
  double step_mm_, limit_mm_, steps_per_mm_;
};

/// The step 2^g nm, in lowest terms.
GridStep nanometre_step(int g);

/// The step 10^tens mm, -22 <= tens <= 22.
GridStep decimal_step(int tens);

/// The smallest step of 2^g nm, g in {..., -6, -3, 0, 3, 4, 5, 6}, 10^k mm, k in {-4, ..., 22}, and
/// again 2^g nm, g in {96, 99, ...}, on whose grid coordinates of `reach` mm stay below 2^27 and
/// those of `far` mm below 2^40 steps.
GridStep choose_step(double reach, double far);

/// Whether `choose_step`'s conditions hold for a given step.
bool step_fits(const GridStep& step, double reach, double far);

}  // namespace csgrun
