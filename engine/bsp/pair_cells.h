// Localisation of pairs: cells divided in binary steps to where polygons of different operands come
// near each other. A pair belongs to the cell that holds the lowest corner of the overlap of its
// two boxes, so each is looked at once, and polygons stay whole.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/bsp/job.h"
#include "engine/bsp/operand.h"

namespace csgrun {

/// Cells as spans of `polygons`, which ascend within a cell; [lo, hi] are grid coordinates.
struct PairCells {
  struct Cell {
    std::array<int32_t, 3> lo, hi;
    uint32_t first, count;
  };
  std::vector<Cell> cells;
  std::vector<uint32_t> polygons;
  uint64_t visited = 0;
  /// Cells that hold surface; where only one operand has some, as many as it would fill with
  /// `cell_limit` polygons each.
  uint64_t surface = 0;
};

/// Cells with polygons of at least two operands. O(n log n) for n polygons of bounded size.
PairCells find_pair_cells(const Job& job, const KernelOptions& options);

/// Calls visit(p, q), p < q, for each pair of different operands that belongs to the cell.
template <class Visit>
void for_each_pair(const Job& job, const PairCells& all, const PairCells::Cell& cell,
                   Visit&& visit) {
  const uint32_t* polygons = all.polygons.data() + cell.first;
  const auto& boxes = job.boxes();
  for (uint32_t j = 1; j < cell.count; ++j) {
    const PolygonBox& b = boxes[polygons[j]];
    const uint32_t operand = job.polygons()[polygons[j]].operand;
    for (uint32_t i = 0; i < j; ++i) {
      const PolygonBox& a = boxes[polygons[i]];
      bool meets = true;
      for (int k = 0; k < 3; ++k) {
        const int32_t lo = a.lo[k] > b.lo[k] ? a.lo[k] : b.lo[k];
        const int32_t hi = a.hi[k] < b.hi[k] ? a.hi[k] : b.hi[k];
        meets &= lo <= hi && lo >= cell.lo[k] && lo <= cell.hi[k];
      }
      if (meets && job.polygons()[polygons[i]].operand != operand) visit(polygons[i], polygons[j]);
    }
  }
}

}  // namespace csgrun
