// A convex polygon and all that meets it, in any position: the arrangement of the segments in which
// polygons of other operands meet it, with what lies on either side of each.
//
// Equal points have one number; those in which lines cross are compared by value. Segments are
// broken where they meet, equal parts become one arc with several sheets, and the arcs around a
// point are sorted by exact signs. What is inside an operand beside an arc follows from its sheets
// there: one that passes through, or the two that share an edge.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "engine/base/sort_by_key.h"
#include "engine/bsp/cut_polygon.h"
#include "engine/bsp/own_points.h"
#include "engine/bsp/point_index.h"

namespace csgrun {

/// A segment in which a polygon whose plane is another one meets the polygon. Points are unique.
struct SheetSegment {
  uint32_t from, to;  ///< what is behind `other` is on the left, seen from outside the polygon
  uint32_t other;
  bool front, back;  ///< where `other` goes from there
};

class FaceArrangement {
 public:
  /// `points`: of `geometry`, which is cleared for each polygon; they must be able to tell those of
  /// all vertices that are touched. `touched`: per vertex of the job, whether it may be on another
  /// operand's surface. `is_open`: see PlainlyCovered.
  FaceArrangement(const Job& job, CellGeometry& geometry, OwnPoints& points,
                  const std::vector<uint8_t>& touched, std::span<const uint8_t> is_open)
      : job_(job),
        geometry_(geometry),
        points_(points),
        index_(geometry),
        touched_(touched),
        is_open_(is_open) {}

  /// Appends the loops of a polygon that meets `segments` and polygons of its own plane; a convex
  /// operand that has one of these needs no segments. False,
  /// with nothing appended, where sheets are too many or too few to tell sides, as at edges of more
  /// than two faces. The planes of all polygons must have been made. O(n log n + pairs of segments
  /// whose boxes meet).
  bool build(uint32_t polygon, std::span<const SheetSegment> segments,
             std::span<const uint32_t> coplanar, CutLoops& out);

  /// Of all polygons so far, the regions times the operands with coplanar sheets among which they
  /// were found: where many overlap, that is most of the work.
  [[nodiscard]] uint64_t crowding() const { return crowding_; }
  /// How often edges of different operands meet, of polygons in the polygon's plane: about as often
  /// as they make regions. Planes as for build().
  uint64_t count_coplanar_crossings(uint32_t polygon, std::span<const uint32_t> coplanar);

 private:
  /// Of polygons with more edges it takes long to see that a line enters, which most do.
  static constexpr uint32_t kMaxEdges = 6;

  enum class Kind : uint8_t {
    kBoundary,  ///< an edge of the polygon itself
    kThrough,   ///< of a sheet that goes to the front and to the back
    kFront,     ///< an edge of a sheet in front
    kBack,
    kLeft,  ///< an edge of a coplanar sheet on the left
    kRight,
    kGone,  ///< one with another one
  };
  static bool is_coplanar(Kind kind) { return kind == Kind::kLeft || kind == Kind::kRight; }
  struct Line {
    uint32_t from, to;
    uint32_t plane;
    int left;  ///< the sign of the plane on the left
    Kind kind;
    uint32_t sheet;    ///< the other polygon, or kNone
    uint32_t operand;  ///< its operand, or kNone
  };
  struct Part {  ///< of a line, between neighbouring points
    uint32_t low, high;
    uint32_t line;
    bool backwards;  ///< the line runs from high to low
  };
  struct Arc {  ///< parts between the same two points
    uint32_t low, high;
    uint32_t first_part, part_count;
  };
  struct LoopFact {
    uint32_t loop;  ///< number within the polygon
    CutLoops::Fact fact;
    bool beside_coplanar = false;  ///< a coplanar sheet of the operand ends there
    bool operator==(const LoopFact&) const = default;
    auto operator<=>(const LoopFact&) const = default;
  };
  struct SheetBox {
    std::array<double, 3> lo{HUGE_VAL, HUGE_VAL, HUGE_VAL}, hi{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    void include(const std::array<double, 3>& p) {
      for (int k = 0; k < 3; ++k) lo[k] = std::min(lo[k], p[k]), hi[k] = std::max(hi[k], p[k]);
    }
    [[nodiscard]] bool holds(const SheetBox& o) const {
      bool all = true;
      for (int k = 0; k < 3; ++k) all &= lo[k] <= o.lo[k] && o.hi[k] <= hi[k];
      return all;
    }
  };
  struct EdgeSides {                         ///< of a point
    uint32_t build = 0;                      ///< of the polygon they are about
    uint32_t known = 0, beyond = 0, on = 0;  ///< a bit per edge
    uint32_t at = 0;  ///< its place in rim_, if it is between the ends of an edge
  };
  enum class RimPlace : uint8_t { kOff, kBefore, kBetween, kAfter };  ///< at an end is not between
  struct AlongRim {  ///< a line that is on the line of an edge, and where its ends are there
    uint32_t line, edge;
    RimPlace from, to;
  };
  struct SheetEdge {  ///< of a coplanar sheet
    uint32_t operand, low, high;
    uint32_t sheet, edge;
  };

  uint32_t vertex(uint32_t v);
  std::span<const int8_t> inner_signs(const JobPolygon& polygon);
  int inner_sign(const JobPolygon& polygon, uint32_t edge);
  [[nodiscard]] bool is_apart(uint32_t sheet);
  void add_boundary();
  void add_segments(std::span<const SheetSegment> segments);
  void add_coplanar(std::span<const uint32_t> coplanar);
  [[nodiscard]] bool is_far(uint32_t vertex, uint32_t other) const;
  bool take_equal(std::span<const SheetSegment> segments, std::span<const uint32_t> coplanar,
                  CutLoops& out);
  [[nodiscard]] bool has_own_corners(const JobPolygon& other);
  [[nodiscard]] bool has_own_corner(const JobPolygon& other);
  [[nodiscard]] bool is_own_corner(uint32_t vertex);
  /// False unless lines only meet the polygon in its edges. See face_rim.cpp.
  bool is_met_at_rim();
  /// Positive when a point is on the inner side of an edge. REQUIRES: is_met_at_rim began.
  int edge_side(uint32_t point, uint32_t edge);
  RimPlace place_on_edge(uint32_t edge, uint32_t point);
  void list_rim();
  [[nodiscard]] uint32_t rim_index(uint32_t edge, RimPlace place, uint32_t point) const;
  void list_along_rim();
  bool trace_rim(CutLoops& out);
  [[nodiscard]] bool may_pass_corner(const Line& line) const;
  void index_ends();
  void find_stops();
  void find_same_lines();
  [[nodiscard]] bool have_same_ends(size_t i, size_t j) const;
  void drop_gone_lines();
  void meet(uint32_t s, uint32_t t);
  int side(uint32_t line, uint32_t point);
  void add_collinear(const Line& on, uint32_t line, uint32_t point);
  void break_lines();
  void join_parts();
  [[nodiscard]] bool is_outside(const Part& part);
  [[nodiscard]] bool is_beyond(uint32_t point);
  void sort_around_points();
  bool trace(CutLoops& out);
  bool add_facts(uint32_t half, uint32_t loop, bool is_first_edge);
  bool find_covered(const CutLoops& out, uint32_t first_loop);
  bool find_covered_loop(const CutLoops::Loop& loop, uint32_t number,
                         std::span<const uint32_t> sheets, const CutLoops& out);
  [[nodiscard]] bool is_on_sheet_edge(uint32_t operand, uint32_t point);
  void mark_sheet_edges(uint32_t operand);
  bool write_facts(CutLoops& out, uint32_t first_loop);
  /// The first of the sheets that holds a point, or kNone.
  uint32_t sheet_at(std::span<const uint32_t> sheets, uint32_t point);
  bool is_convex_edge(uint32_t p, uint32_t q);
  [[nodiscard]] bool is_outer(uint32_t half) const;
  [[nodiscard]] uint32_t from(uint32_t half) const {
    return half % 2 ? arcs_[half / 2].high : arcs_[half / 2].low;
  }
  [[nodiscard]] uint32_t to(uint32_t half) const { return from(half ^ 1); }
  /// Positive when a point is on the left of a half-edge.
  int left_of(uint32_t half, uint32_t point);

  const Job& job_;
  CellGeometry& geometry_;
  OwnPoints& points_;
  PointIndex index_;  ///< of the ends of lines and the points in which these meet
  const std::vector<uint8_t>& touched_;
  const std::span<const uint8_t> is_open_;
  const JobPolygon* polygon_ = nullptr;
  static constexpr int8_t kUnknownSign = 2;
  std::vector<int8_t> inner_signs_;  ///< per edge of the job's polygons
  std::vector<Line> lines_;
  SegmentSweep sweep_;
  std::vector<std::array<uint32_t, 4>> line_ends_;  ///< lower, higher, operand, line
  SortByKey<std::array<uint32_t, 4>> sort_line_ends_;
  std::vector<uint32_t> numbers_;                     ///< of lines, once some are gone
  std::vector<uint8_t> is_swept_;                     ///< per line, whether it is in:
  std::vector<uint32_t> swept_;                       ///< lines, of those with equal ends one
  std::vector<uint32_t> next_same_;                   ///< per line: the next one of these, or kNone
  std::vector<std::pair<uint32_t, uint32_t>> stops_;  ///< (line, point)
  SortByKey<std::pair<uint32_t, uint32_t>> sort_pairs_;
  std::vector<Part> parts_;
  SortByKey<Part> sort_parts_;
  std::vector<Arc> arcs_;
  std::vector<std::pair<uint32_t, uint32_t>> around_;  ///< (point, half-edge that leaves it)
  std::vector<uint32_t> place_;                        ///< of a half-edge in around_
  std::vector<uint32_t> loop_of_;    ///< per half-edge: number within the polygon, or kNone
  std::vector<const Part*> at_arc_;  ///< of the arc at hand, by operands
  std::vector<LoopFact> facts_;
  SortByKey<LoopFact> sort_facts_;
  std::vector<uint32_t> sheets_;  ///< coplanar ones that are not clearly apart
  std::vector<SheetEdge> sheet_edges_;
  size_t first_coplanar_line_ = 0;
  uint64_t crowding_ = 0;
  bool is_sheet_marked_ = false;         ///< for the operand whose sheets are looked at
  uint64_t sheet_mark_ = 0;              ///< of the last one that was
  std::vector<uint64_t> on_sheet_edge_;  ///< per point: the mark of the last one that has it
  bool has_through_ = false;  ///< a segment of a sheet that goes to the front and to the back
  bool has_straight_angle_ = false;    ///< two edges of the polygon are on one line
  std::vector<EdgeSides> edge_sides_;  ///< per point
  bool is_at_rim_ = false;             ///< what is_met_at_rim found
  std::vector<AlongRim> along_rim_;    ///< by ascending lines
  std::vector<std::pair<uint32_t, uint32_t>> rim_points_;  ///< (edge, point between its ends)
  std::vector<uint32_t> rim_, rim_start_;  ///< points of the edges; where each begins
  /// (place in rim_ after which there is a part of it, of along_rim_)
  std::vector<std::pair<uint32_t, uint32_t>> rim_parts_;
  SheetBox box_;                  ///< of the polygon
  uint32_t build_ = 0;            ///< the number of the polygon at hand
  std::vector<uint32_t> beyond_;  ///< per point, of is_beyond: 2 x build_ when asked, + the answer
  std::vector<SheetBox> loop_boxes_;
  std::vector<LoopFact> covered_;  ///< not told by arcs
};

}  // namespace csgrun
