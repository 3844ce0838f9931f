// What the result's boundary is inside one cell.
#pragma once

#include <vector>

#include "engine/bsp/cell_walls.h"
#include "engine/bsp/fragment_set.h"
#include "engine/bsp/local_bsp.h"
#include "engine/bsp/octree.h"

namespace csgrun {

/// Solves critical cells one after another: each operand's polygons are clipped to the cell and
/// made into a labelled BSP; each polygon is pushed down the BSPs of all other operands, which cuts
/// it into pieces with known labels in front and behind for every operand; pieces where the
/// expression's value changes are boundary. No merge of trees is needed for that (algorithm by
/// Thibault; the literal merge of the paper is in literal_cell.h). One solver per thread.
class CellSolver {
 public:
  explicit CellSolver(const Job& job);

  void solve(const Octree& tree, const CriticalCell& cell, const CellWalls& walls,
             FragmentSet& out);
  /// The part of a polygon inside a cell, copied as it is or turned over.
  void copy(uint32_t polygon, const CellBox& box, const CellWalls& walls, bool flip,
            FragmentSet& out);

  [[nodiscard]] const SignCounters& counters() const { return geometry_.counters; }
  /// In how many of the solved cells surfaces of different operands were found to meet.
  [[nodiscard]] uint64_t cells_with_contact() const { return cells_with_contact_; }
  /// Whether in the cell solved last surfaces of different operands may touch: a corner of one lies
  /// in a plane of another.
  [[nodiscard]] bool may_touch() const { return may_touch_; }
  /// The solver's working memory, for others that solve a cell in its place.
  CellGeometry& geometry() { return geometry_; }

 private:
  struct Operand {
    uint32_t id;
    std::vector<Fragment> polygons;
    LocalBsp bsp;
  };
  struct Labelled {
    Fragment fragment;
    std::vector<Inside> front, back;  ///< by presence in the cell
  };

  void solve_polygon(const PrunedExpression& expression, uint32_t own, const Fragment& f,
                     FragmentSet& out);

  const Job& job_;
  CellGeometry geometry_;
  std::vector<Operand> operands_;
  uint32_t operand_count_ = 0;
  uint64_t cells_with_contact_ = 0;
  bool contact_ = false;
  bool may_touch_ = false;
  std::vector<uint32_t> slot_of_operand_;
  std::vector<uint32_t> numbers_;
  std::vector<Inside> scratch_;
  std::vector<PrunedExpression::Boundary> boundary_scratch_;
  std::vector<Labelled> current_, next_;
  std::vector<LocalBsp::Piece> pieces_;
};

}  // namespace csgrun
