// The working memory of one cell: points named by planes, convex polygons over them, and the
// splitting of a polygon by a plane (Bernstein & Fussell 2009; Campen & Kobbelt 2010, section 4.2).
//
// Points are constructed once and never rounded: a cut is the meeting point of the polygon's plane,
// an edge's plane and the cutting plane, and all decisions are signs of planes at points.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/chunked_vector.h"
#include "engine/base/none.h"
#include "engine/base/raw_vector.h"
#include "engine/bsp/job.h"
#include "engine/exact/predicates.h"

namespace csgrun {

/// A convex polygon: corners and edge planes in the arena of a CellGeometry. Edge i runs from
/// corner i to corner i + 1 and lies in edge plane i. Counter-clockwise seen from the side the
/// support's normal points to.
struct Fragment {
  PlaneId support;
  uint32_t polygon = kNone;  ///< the job's polygon that this is a piece of
  uint32_t first = 0, count = 0;
};

/// The direction of a line, as far as ordering points on it needs it.
struct LineAxis {
  int axis = 0;
  int sign = 1;
};

enum class Side : uint8_t { kFront, kBack, kOn, kSplit };

class CellGeometry {
 public:
  /// `job` may be null when only add_point is used.
  CellGeometry(const PlaneTable& planes, const Job* job);

  /// Forgets all points and fragments.
  void clear();

  [[nodiscard]] const PlaneTable& planes() const { return *planes_; }

  struct StoredPoint {
    std::array<double, 3> rounded;
    std::array<uint32_t, 3> planes;  ///< kNone thrice for a vertex of the job
    uint32_t vertex;                 ///< of the job, or kNone
    uint32_t exact;                  ///< index into exact_, or kNone until asked for
    bool is_on_grid;                 ///< known to be: then `rounded` is exact
    bool is_looked_at = false;       ///< whether it is on the grid, by find_on_grid

    /// REQUIRES: it is there.
    [[nodiscard]] IVec3 on_grid() const {
      return {static_cast<int64_t>(rounded[0]), static_cast<int64_t>(rounded[1]),
              static_cast<int64_t>(rounded[2])};
    }
  };

  /// The point of a vertex of the job.
  uint32_t vertex_point(uint32_t vertex);
  /// The same of a vertex that has a point. Several threads may ask.
  [[nodiscard]] uint32_t made_vertex_point(uint32_t vertex) const { return vertex_point_[vertex]; }
  /// The point where three planes meet.
  uint32_t add_point(const std::array<uint32_t, 3>& planes);
  uint32_t add_point(const std::array<uint32_t, 3>& planes, const std::array<double, 3>& rounded);
  /// A point that is known: where three planes meet, or, where these are kNone, a grid point.
  uint32_t add_point(const std::array<uint32_t, 3>& planes, const std::array<double, 3>& rounded,
                     bool is_on_grid);
  /// Makes room for so many points and returns the number of the first; each is to be set before it
  /// is looked at. Several threads may set different ones.
  uint32_t add_points(size_t count) {
    points_.resize(points_.size() + count);
    return static_cast<uint32_t>(points_.size() - count);
  }
  void set_point(uint32_t p, const std::array<uint32_t, 3>& planes,
                 const std::array<double, 3>& rounded) {
    points_[p] = {rounded, planes, kNone, kNone, false};
  }
  /// Makes the points of vertices that have none, on several threads; returns the first one's
  /// number: the others follow in the same order.
  uint32_t add_vertex_points(std::span<const uint32_t> vertices);
  /// REQUIRES: the vertex has no point.
  void set_vertex_point(uint32_t p, uint32_t vertex);
  [[nodiscard]] bool has_vertex_point(uint32_t vertex) const {
    return vertex_stamp_[vertex] == stamp_;
  }
  [[nodiscard]] const StoredPoint& point(uint32_t p) const { return points_[p]; }
  [[nodiscard]] size_t point_count() const { return points_.size(); }
  /// Valid until clear().
  const Point& exact(uint32_t p);
  /// The same, not kept for the next time: may be asked on several threads.
  [[nodiscard]] Point value(uint32_t p) const;
  /// Whether the point is found to be one of the grid: then its doubles are exact. Far ones and
  /// those of planes of very many bits are not found.
  [[nodiscard]] bool is_found_on_grid(uint32_t p) const {
    const StoredPoint& s = points_[p];
    return s.is_on_grid || (!s.is_looked_at && s.vertex == kNone && meets_on_grid(s));
  }
  /// The same, remembered. Different points may be asked for on several threads.
  bool find_on_grid(uint32_t p) {
    points_[p].is_on_grid = is_found_on_grid(p);
    points_[p].is_looked_at = true;
    return points_[p].is_on_grid;
  }

  /// The whole polygon of the job.
  Fragment load(uint32_t polygon);
  Fragment make_fragment(PlaneId support, const std::vector<uint32_t>& points,
                         const std::vector<uint32_t>& edges);
  /// The same of edges that follow each other: each has the point it comes `from`, and a `plane`.
  template <class Edge>
  Fragment make_fragment(PlaneId support, const std::vector<Edge>& edges) {
    const Fragment f{support, kNone, static_cast<uint32_t>(corners_.size()),
                     static_cast<uint32_t>(edges.size())};
    for (const Edge& e : edges) {
      corners_.push_back(e.from);
      edges_.push_back(e.plane);
    }
    return f;
  }
  [[nodiscard]] const uint32_t* corners(const Fragment& f) const {
    return corners_.data() + f.first;
  }
  [[nodiscard]] const uint32_t* edges(const Fragment& f) const { return edges_.data() + f.first; }

  /// Sign of the stored plane `plane` at a point: symbolic, by filter, else exact.
  int side(uint32_t plane, uint32_t p);
  /// The same at a vertex of the job, which does not become a point.
  int side_of_vertex(uint32_t plane, uint32_t vertex);

  /// Where a fragment lies relative to a plane; kSplit: `front` and `back` are the two pieces,
  /// which inherit support and polygon. Front is the positive side of the stored plane. kOn only
  /// when the plane is the support. REQUIRES: weakly convex fragment.
  Side split(const Fragment& f, uint32_t plane, Fragment& front, Fragment& back);
  /// As split, without constructing the pieces.
  Side classify(const Fragment& f, uint32_t plane);

  /// -1, 0, +1: the order of two points along an axis. Exact.
  int compare_along(uint32_t p, uint32_t q, int axis);
  /// An axis along which two points differ, the one on which their doubles do most if they do, and
  /// the sign of the way from p to q there; 0 if the points are equal.
  LineAxis axis_between(uint32_t p, uint32_t q);

  SignCounters counters;
  /// Set when split() meets a corner in the cutting plane; never cleared here.
  bool met_plane = false;

 private:
  [[nodiscard]] bool meets_on_grid(const StoredPoint& point) const;

  const PlaneTable* planes_;
  const Job* job_;
  RawVector<StoredPoint> points_;
  ChunkedVector<Point, 8> exact_;  ///< large, and references stay
  std::vector<uint32_t> corners_, edges_;
  std::vector<uint32_t> vertex_stamp_;
  RawVector<uint32_t> vertex_point_;  ///< where the stamp is this one
  uint32_t stamp_ = 1;
  std::vector<int8_t> signs_;
};

/// Sign of the stored plane `plane` at a point, by integers; `counters` note the integers' width.
int exact_side_of(const PlaneTable& planes, uint32_t plane, const IVec3& point,
                  SignCounters& counters);
int exact_side_of(const PlaneTable& planes, uint32_t plane, const Point& point,
                  SignCounters& counters);

/// Sign of the stored plane `plane` at a point: symbolic, by filter, else exact, for which
/// `exact()` gives the point if it is not known to be on the grid.
template <class Exact>
int side_of(const PlaneTable& planes, uint32_t plane, const CellGeometry::StoredPoint& s,
            SignCounters& counters, Exact&& exact) {
  if (s.planes[0] == plane || s.planes[1] == plane || s.planes[2] == plane) {
    ++counters.symbolic;
    return 0;
  }
  if (const int sign = filter_side(planes.approximate(plane), s.rounded)) {
    ++counters.filter;
    return sign;
  }
  return s.is_on_grid ? exact_side_of(planes, plane, s.on_grid(), counters)
                      : exact_side_of(planes, plane, exact(), counters);
}

/// The direction of the line where two planes meet, as far as ordering points needs it: the axis on
/// which the cross product of the normals is largest, and its sign there.
LineAxis line_axis(const Plane& a, const Plane& b);

}  // namespace csgrun
