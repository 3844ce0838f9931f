// Localisation of pairs: cells divided in binary steps to where polygons of different operands come
// near each other. A pair belongs to the cell that holds the lowest corner of the overlap of its
// two boxes, so each is looked at once, and polygons stay whole.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/raw_vector.h"
#include "engine/bsp/cell_boxes.h"
#include "engine/bsp/job.h"
#include "engine/bsp/job_triangles.h"
#include "engine/bsp/operand.h"
#include "engine/bsp/packed_boxes.h"
#include "engine/bsp/slabs.h"

namespace csgrun {

/// Cells as spans of `polygons`, which ascend within a cell; [lo, hi] are grid coordinates.
struct PairCells {
  struct Cell {
    std::array<int32_t, 3> lo, hi;
    uint32_t first, count;
  };
  RawVector<Cell> cells;
  RawVector<uint32_t> polygons;
  uint64_t visited = 0;
  /// Cells that hold surface; where only one operand has some, as many as it would fill with
  /// `cell_limit` polygons each.
  uint64_t surface = 0;
  /// The slabs of triangles in crowds, each made once, and per polygon its place there, or
  /// kNoSlabs; both empty if there is no crowd.
  static constexpr uint32_t kNoSlabs = ~0u;
  std::vector<Slabs> slabs;
  std::vector<uint32_t> slabs_at;
};

/// So many polygons of a cell are a crowd: worth the time to pack their corners. Among many
/// operands more of the pairs meet, as those of balls that overlap do.
constexpr uint32_t kCrowd = 128, kCrowdOfTwo = 64;
inline uint32_t crowd_of(const Job& job) { return job.operand_count() == 2 ? kCrowdOfTwo : kCrowd; }

/// Cells with polygons of at least two operands, not all of which are in `covered` (per polygon;
/// empty: none is), and none in `left_out`; with slabs. O(n log n) for n polygons of bounded size.
/// REQUIRES: the job was not given pairs (NearFaces::pairs).
PairCells find_pair_cells(const Job& job, std::span<const uint8_t> covered,
                          const KernelOptions& options, std::span<const uint8_t> left_out = {});

/// Makes the slabs of the triangles in crowds.
void add_slabs(const Job& job, PairCells& cells);

/// The pairs of a cell. Keeps its working memory from one cell to the next.
class CellPairs {
 public:
  /// `covered`: per polygon; empty: none is.
  explicit CellPairs(std::span<const uint8_t> covered) : covered_(covered) {}

  /// Calls visit(p, q), p < q, for each pair of different operands that belongs to the cell, but
  /// for those of two covered polygons, and in a crowd for triangles of different planes that are
  /// seen to be apart at a glance.
  template <class Visit>
  void visit(const Job& job, const PairCells& all, const PairCells::Cell& cell, Visit&& visit) {
    load(job, all, cell);
    uint32_t own_start = 0;  // the first of the polygons that are of the same operand
    for (uint32_t j = 1; j < cell.count; ++j) {
      if (operands_[j] != operands_[j - 1]) own_start = j;
      for (uint32_t first = 0; first < own_start; first += CellBoxes::kAtOnce) {
        const uint32_t count = std::min(CellBoxes::kAtOnce, own_start - first);
        uint32_t meets = boxes_.compare(first, count, j);
        if (!triangles_.empty()) meets = sift(all, first, j, meets);
        PackedBoxes::for_each_bit(meets, [&](uint32_t lane) {
          const uint32_t i = first + lane;
          if (!are_covered(polygons_[i], polygons_[j])) visit(polygons_[i], polygons_[j]);
        });
      }
    }
  }

 private:
  [[nodiscard]] bool are_covered(uint32_t p, uint32_t q) const {
    return !covered_.empty() && covered_[p] && covered_[q];
  }

  void load(const Job& job, const PairCells& all, const PairCells::Cell& cell);
  /// Of polygons from `first` on, a bit each, those that are not triangles plainly apart from
  /// polygon j.
  [[nodiscard]] uint32_t sift(const PairCells& all, uint32_t first, uint32_t j,
                              uint32_t meets) const;

  std::span<const uint8_t> covered_;
  const uint32_t* polygons_ = nullptr;
  CellBoxes boxes_;  ///< by the place in the cell
  std::vector<uint32_t> operands_;
  std::vector<JobTriangles> triangles_;  ///< in a crowd all of them, eight by eight
};

}  // namespace csgrun
