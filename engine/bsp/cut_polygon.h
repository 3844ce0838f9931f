// A convex polygon cut along the segments in which it crosses polygons of other operands: an
// arrangement that is put together from names, as no three things meet in a point by chance.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/raw_vector.h"
#include "engine/bsp/cell_geometry.h"
#include "engine/bsp/segment_sweep.h"

namespace csgrun {

/// A segment on the polygon, between two points of the geometry. What is inside `other` is on its
/// left, seen from outside the polygon.
struct CutSegment {
  uint32_t from, to;
  uint32_t other;  ///< the polygon of another operand whose plane holds it
  /// The polygon's own edges that hold the ends, or kNone: an edge of `other` passes there.
  uint32_t from_edge, to_edge;
};

/// Loops with a region of the polygon on their left. Outer loops and holes are not told apart.
struct CutLoops {
  struct Loop {
    uint32_t first_corner, corner_count;
    uint32_t first_fact, fact_count;
    uint32_t vertex;        ///< a vertex of the polygon that it passes, or kNone
    bool is_loose = false;  ///< see FragmentSet::Piece
    bool is_rim = false;    ///< the polygon's own outline, perhaps with points on its edges
    bool is_bare = false;   ///< nothing of another operand is known to be along any of its edges
  };
  /// Whether what is in front of the region at the loop, and behind it, is inside an operand that
  /// bounds the region there. They differ where the operand has surface on the region.
  struct Fact {
    uint32_t operand;
    bool front, back;
    bool is_elsewhere = true;  ///< the first edge of the loop does not tell it

    [[nodiscard]] bool says_the_same(const Fact& o) const {
      return operand == o.operand && front == o.front && back == o.back;
    }
    bool operator==(const Fact&) const = default;
    auto operator<=>(const Fact&) const = default;
  };
  /// In `corner_plane`: this and the number of an edge of the polygon, whose plane may not have
  /// been made.
  static constexpr uint32_t kOwnEdge = 1u << 31;

  RawVector<Loop> loops;
  RawVector<uint32_t> corner_point;  ///< of the geometry
  RawVector<uint32_t> corner_plane;  ///< of the edge to the next corner
  RawVector<Fact> facts;             ///< of a loop: sorted, each once, from the first edge if so

  [[nodiscard]] std::span<const uint32_t> points(const Loop& loop) const {
    return {corner_point.data() + loop.first_corner, loop.corner_count};
  }
  [[nodiscard]] std::span<const uint32_t> planes(const Loop& loop) const {
    return {corner_plane.data() + loop.first_corner, loop.corner_count};
  }

  /// Sorts the facts of a loop, which are the last ones, and drops repetitions; false when they
  /// contradict one another, but for those of open operands: see may_contradict.
  bool finish_facts(Loop& loop, std::span<const uint8_t> is_open);

  /// Whether two different facts of an operand may be of one region: part of it is inside, and the
  /// surface that divides it is hidden (see PlainlyCovered).
  static bool may_contradict(const Fact& a, const Fact& b, std::span<const uint8_t> is_open) {
    return is_open[a.operand] && a.front == a.back && b.front == b.back;
  }
};

class PolygonCutter {
 public:
  /// `is_open`: see PlainlyCovered.
  PolygonCutter(const Job& job, CellGeometry& geometry, std::span<const uint8_t> is_open)
      : job_(job), geometry_(geometry), is_open_(is_open) {}

  /// Appends the loops of a polygon. One that comes to where the segments of an open operand end
  /// goes back on their other side. False, with nothing appended, when points coincide: then more
  /// than names is needed. The supports of all polygons must have been made. O(n log n) for n
  /// segments of one operand, and the pairs of segments of different ones whose boxes meet.
  bool cut(uint32_t polygon, std::span<const CutSegment> segments, CutLoops& out);

 private:
  /// Where two segments cross: the second runs to the left of the first, or to the right.
  struct Meet {
    uint32_t first, second, point;
    bool second_left;
  };
  struct Arc {
    uint32_t point[2];  ///< from, to
    uint32_t plane;
    uint32_t segment;  ///< kNone: a part of the polygon's boundary
    uint32_t next[2];  ///< half-edge after this one, run forwards and backwards
  };
  struct Stop {  ///< a point on an edge of the polygon or on a segment
    uint32_t point, index;
  };
  struct EndOnEdge {
    uint32_t edge, segment;
    bool at_to;
  };

  bool find_meets(std::span<const CutSegment> segments);
  bool add_segments(std::span<const CutSegment> segments);
  bool add_boundary(std::span<const CutSegment> segments);
  bool link_inner(std::span<const CutSegment> segments);
  void link_meets();
  bool order(std::vector<Stop>& stops, uint32_t from, uint32_t to);
  bool trace(std::span<const CutSegment> segments, CutLoops& out);

  const Job& job_;
  CellGeometry& geometry_;
  const std::span<const uint8_t> is_open_;
  const JobPolygon* polygon_ = nullptr;
  std::vector<Meet> meets_;
  std::vector<Arc> arcs_;
  /// Per segment: its first and last arc; arcs of a segment are numbered in a row.
  std::vector<uint32_t> first_arc_;
  /// Per meet: the arcs of its first and second segment that end there.
  std::vector<std::array<uint32_t, 2>> arc_to_meet_;
  std::vector<std::pair<uint32_t, uint32_t>> meets_of_segment_;  ///< (segment, meet)
  std::vector<EndOnEdge> ends_on_edge_;
  std::vector<std::array<uint32_t, 3>> inner_ends_;  ///< (point, segment, 1 for its end)
  std::vector<Stop> stops_;
  SegmentSweep sweep_;
  std::vector<uint8_t> seen_;
};

}  // namespace csgrun
