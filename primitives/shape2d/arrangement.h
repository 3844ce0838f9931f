// Segments of several outlines, cut until they meet in end points only.
//
// Segments that cross are both cut at the grid point nearest to their crossing; a segment is cut at
// every end point that lies on it. Moving a crossing to the grid can make new crossings, so this is
// repeated until nothing crosses: the result is exact on the grid, with no epsilon.
//
// Segments are cut, too, at end points of other operands that may have been on them before either
// was rounded: where an outline ended on the edge of another one, there must be no crack. What one
// operand has is apart as that operand says.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "primitives/shape2d/grid2d.h"

namespace csgrun {

/// The operands that have a segment, by their numbers.
class OperandSet {
 public:
  OperandSet() : OperandSet(0) {}
  explicit OperandSet(uint32_t operand) : only_(operand), bits_(uint64_t{1} << operand % 64) {}
  void add(const OperandSet& others) {
    if (only_ != others.only_) only_ = kSeveral;
    bits_ |= others.bits_;
  }
  /// Whether some operand is in both. May be true where none is, if a set has several.
  [[nodiscard]] bool meets(const OperandSet& o) const {
    if (only_ != kSeveral && o.only_ != kSeveral) return only_ == o.only_;
    return (bits_ & o.bits_) != 0;
  }

 private:
  static constexpr uint32_t kSeveral = UINT32_MAX;
  uint32_t only_;
  uint64_t bits_;  ///< of the numbers modulo 64
};

/// A segment with a < b (by x, then y). Crossing it from its right to its left side, seen from a to
/// b, adds `first` to the winding number of the first operand and `rest` to the sum of all others.
struct Segment2D {
  Point2D a, b;
  int32_t first = 0, rest = 0;
  OperandSet operands{};
};

/// Windings of the first operand count for `first`, those of all others for `rest`. Where all
/// outlines are of one shape, its number is that of the rest.
constexpr uint32_t kFirstOperand = 0, kRestOfOperands = 1;

/// Appends the segment from one point to another, as part of a closed outline of an operand;
/// nothing where they are equal.
void add_segment(const Point2D& from, const Point2D& to, uint32_t operand,
                 std::vector<Segment2D>& segments);
/// Appends the segments of a closed outline.
void add_outline(const GridLoop& loop, uint32_t operand, std::vector<Segment2D>& segments);

/// After so many rounds, each of which moves what it cuts by less than a step, segments are also
/// pulled to vertices near them.
constexpr int kRoundsBeforeSnapping = 8;

/// Cuts segments as described above and merges equal ones; those that cancel are dropped. The
/// result is sorted by (a, b). Nothing if it does not settle (no such input is known).
/// O(n log n) when few segments share a vertical line.
std::optional<std::vector<Segment2D>> arrange(std::vector<Segment2D> segments);
/// The same, or nothing when segments that cross nothing would be pulled to vertices near them.
std::optional<std::vector<Segment2D>> arrange_without_snapping(std::vector<Segment2D> segments);

}  // namespace csgrun
