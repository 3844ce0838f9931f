// Segments of several outlines, cut until they meet in end points only.
//
// Segments that cross are both cut at the grid point nearest to their crossing; a segment is cut at
// every end point that lies on it. Moving a crossing to the grid can make new crossings, so this is
// repeated until nothing crosses: the result is exact on the grid, with no epsilon.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "primitives/shape2d/grid2d.h"

namespace csgrun {

/// A segment with a < b (by x, then y). Crossing it from its right to its left side, seen from a to
/// b, adds `first` to the winding number of the first operand and `rest` to the sum of all others.
struct Segment2D {
  Point2D a, b;
  int32_t first = 0, rest = 0;
};

/// Appends the segment from one point to another, as part of a closed outline of the first operand
/// or of the others; nothing where they are equal.
void add_segment(const Point2D& from, const Point2D& to, bool is_first,
                 std::vector<Segment2D>& segments);
/// Appends the segments of a closed outline.
void add_outline(const GridLoop& loop, bool is_first, std::vector<Segment2D>& segments);

/// Cuts segments at the vertices of others that lie on them as far as can be told after rounding:
/// either was moved by half a step along each axis, so they are a step apart at most. Without it
/// what ends on an edge somewhere leaves a crack beside it. O(n log n) when few vertices share a
/// vertical line with a segment.
void cut_at_near_vertices(std::vector<Segment2D>& segments);

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
