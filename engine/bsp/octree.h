// Localisation: an octree refined, in binary steps, to where operands meet (Campen & Kobbelt 2010,
// section 4.1).
//
// A cell is [lo + 1/p, hi + 1/p] in grid steps, p the job's prime, so that no leaf vertex lies in a
// wall. An operand whose surface does not enter a cell is a constant there; the expression is
// folded with it. A cell whose expression is a constant is dropped, one that depends on a single
// operand copies it, and only a cell where several operands meet is divided, down to m polygons:
// what is left are the critical cells. Which constant an operand is, is known from the cell's
// lowest corner, moved by (e, e^2, e^3) for an infinitely small e: each division moves the corner
// along one axis and counts the polygons that it crosses, so nesting and components that do not
// touch cost no rays.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/bsp/cell_box.h"
#include "engine/bsp/job.h"
#include "engine/bsp/pruned_expression.h"

namespace csgrun {

/// A cell in which several operands meet.
struct CriticalCell {
  struct Presence {
    uint32_t operand;
    bool corner_inside;             ///< of the operand, at the lowest corner
    uint32_t first_polygon, count;  ///< into Octree::cell_polygons
  };
  CellBox box;
  uint32_t first_presence, presence_count;  ///< into Octree::presences; ascending operands
  PrunedExpression expression;
};

/// What happens to a polygon in the non-critical cells.
enum class Copy : uint8_t { kDrop = 1, kKeep = 2, kFlip = 4, kCritical = 8 };

struct Octree {
  /// If not null, per polygon whether its part of the result is asked for: others stand in cells as
  /// bounds only, and cells without any that is asked for are left out.
  const std::vector<uint8_t>* wanted = nullptr;
  [[nodiscard]] bool is_wanted(uint32_t polygon) const { return !wanted || (*wanted)[polygon]; }
  std::vector<CriticalCell> critical;
  std::vector<CriticalCell::Presence> presences;
  std::vector<uint32_t> cell_polygons;
  /// Per polygon: all that happens to it somewhere, as a bit set of Copy.
  std::vector<uint8_t> fate;
  /// Non-critical cells in which polygons are copied: (polygon, box), for those that are also cut.
  struct CopiedPiece {
    uint32_t polygon, cell;
    bool flip;
  };
  std::vector<CopiedPiece> copied;
  std::vector<CellBox> copied_cells;
  uint64_t cells = 0;
  /// Cells that hold surface. A cell that is copied is never divided, however many polygons it
  /// holds; it counts as the cells of m polygons that it would make.
  uint64_t surface_cells = 0;
};

/// Builds the octree over `region`; makes planes where corners are traced. `options.cell_limit` is
/// m. O((n + k) log) for n polygons, k of them near intersections.
/// `wanted`: see Octree.
Octree build_octree(Job& job, const Expression& expression, const GridBox& region,
                    const KernelOptions& options, const std::vector<uint8_t>* wanted = nullptr);

}  // namespace csgrun
