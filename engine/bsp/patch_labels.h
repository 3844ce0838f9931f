// Which operands a patch of one operand's surface is inside of, and what becomes of it.
//
// A patch is a part of the surface that no other operand's surface meets, so that all of it is
// inside the same operands. What bounds it says so for those that cut it there; for the others one
// point of it is looked at.
//
// But for open operands (see PlainlyCovered), whose hidden surface may pass through it: of these
// the same point tells, unless what bounds it decides that all of it is boundary of nothing.
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "engine/bsp/convex_sides.h"
#include "engine/bsp/covered_polygons.h"
#include "engine/bsp/cut_polygon.h"
#include "engine/bsp/ray_boxes.h"
#include "engine/bsp/sparse_boundary.h"
#include "engine/bsp/square_bins.h"
#include "engine/bsp/vertex_signs.h"

namespace csgrun {

enum class PatchFate : uint8_t { kDrop, kKeep, kFlip, kUnknown };

class PatchLabels {
 public:
  /// `plainly` is kept by reference.
  PatchLabels(const Job& job, const Expression& expression, const PlainlyCovered& plainly);

  /// What becomes of a patch of operand `own`, of which `point` is a point (each coordinate as
  /// wrong as `error` at most) on no operand but its own and those of the facts. `is_at_first`:
  /// it is on the first edge of the loop that the facts are of. kUnknown when doubles do not tell.
  /// O(operands), and O(n) for each of them whose box holds the point.
  PatchFate fate(uint32_t own, const std::array<double, 3>& point, double error,
                 std::span<const CutLoops::Fact> facts, bool is_at_first);

  [[nodiscard]] double error(uint32_t operand) const { return signs_.error(operand); }

 private:
  /// What an operand is at the patch: twice its number, and one more for what is behind the patch;
  /// those that stand here are inside.
  using Sides = std::vector<uint64_t>;
  PatchFate evaluate(uint32_t own, const Sides& inside);
  [[nodiscard]] bool are_decisive(std::span<const CutLoops::Fact> facts) const;
  bool note(uint32_t operand, bool is_inside);

  const Job& job_;
  const PlainlyCovered& plainly_;
  SparseBoundary boundary_;
  VertexSigns signs_;
  RayBoxes boxes_;
  const SquareBins bins_;  ///< of the operands
  /// Operands that balls do not tell of: rays are sent only if none of these decides.
  std::vector<uint32_t> asked_;
  ConvexSides convex_sides_;
  /// By the operand and those that it is inside of: few differ.
  using Patch = std::pair<uint32_t, Sides>;
  std::map<Patch, PatchFate> known_;
  Patch patch_;  ///< at hand: as a member it keeps its memory
  std::vector<SparseBoundary::Sides> sides_;
};

}  // namespace csgrun
