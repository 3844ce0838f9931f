// Cells of an octree that is refined in binary steps: what meets them, and how they are divided.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "engine/bsp/job.h"

namespace csgrun {

/// The cell [lo + 1/p, hi + 1/p] in grid steps, p the job's prime, so that no leaf vertex lies in a
/// wall.
struct CellBox {
  IVec3 lo, hi;

  /// All grid points and more of the cell, walls included.
  [[nodiscard]] GridBox rounded_outwards() const { return {lo, {hi[0] + 1, hi[1] + 1, hi[2] + 1}}; }
};

/// Divisions that may pass without thinning out a cell before it is left as it is: two octree
/// levels. Many polygons through one point cannot be told apart by dividing.
constexpr int kDivisionPatience = 6;

/// The smallest cube with a power of two steps a side that contains the region, its lower corner
/// moved down by `shift`.
CellBox root_cell(const GridBox& region, const std::array<uint32_t, 3>& shift);

/// Whether the polygon may meet the cell: its box does and, for a polygon that reaches beyond the
/// cell, so do its plane and its outline. Conservative.
bool may_meet(const Job& job, uint32_t polygon, const CellBox& cell);

/// Along which axis to divide a cell: the longest, as an octree has it, unless dividing another
/// leaves clearly fewer polygons in the halves: faces that overlap in one plane thin out only
/// across their edges.
class AxisChoice {
 public:
  /// Up to this many polygons it pays to count them.
  static constexpr uint32_t kCountAtMost = 1024;

  explicit AxisChoice(const CellBox& box) : box_(box) {}

  void count(const PolygonBox& b) {
    for (int a = 0; a < 3; ++a) {
      const int64_t middle = box_.lo[a] + (box_.hi[a] - box_.lo[a]) / 2;
      sum_[a] += (b.lo[a] <= middle) + (b.hi[a] > middle);
    }
  }
  [[nodiscard]] int longest() const {
    int longest = 0;
    for (int k = 1; k < 3; ++k) {
      if (box_.hi[k] - box_.lo[k] > box_.hi[longest] - box_.lo[longest]) longest = k;
    }
    return longest;
  }
  /// By what was counted.
  [[nodiscard]] int best() const {
    int best = longest();
    for (int a = 0; a < 3; ++a) {
      if (box_.hi[a] - box_.lo[a] >= 2 && sum_[a] * 10 < sum_[best] * 9) best = a;
    }
    return best;
  }

 private:
  const CellBox& box_;
  std::array<uint32_t, 3> sum_{};
};

}  // namespace csgrun
