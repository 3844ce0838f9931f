// Where points and lines lie in a planar face.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "engine/mesh/merge_faces.h"

namespace csgrun {

/// Answers for one plane. Exact; O(edges) a question.
class FaceLocator {
 public:
  FaceLocator(PlaneId support, PointView& points, const PlaneTable& planes);

  /// +1 when a point of the plane is inside loops that do not cross (by their parity), 0 on them,
  /// -1 outside.
  template <class Loops>
  int locate(const Loops& loops, uint32_t p) {
    bool inside = false;
    for (const auto& loop : loops) {
      for (const DirectedEdge& e : loop) {
        const Met met = meet(e, p);
        if (met == Met::kOn) return 0;
        inside ^= met == Met::kCrossed;
      }
    }
    return inside ? 1 : -1;
  }
  /// Whether a line from a corner goes on inside the wedge between two edges of the face there.
  bool is_in_wedge(const DirectedEdge& arriving, const DirectedEdge& leaving,
                   const DirectedEdge& line);
  /// Whether a line, which leaves a point of the loops, goes on between them and to the left of
  /// them. `line.plane` is any plane that holds it but the support.
  template <class Loops>
  bool starts_inside(const Loops& loops, const DirectedEdge& line) {
    for (const auto& loop : loops) {
      for (size_t i = 0; i < loop.size(); ++i) {
        if (loop[i].from != line.from) continue;
        const DirectedEdge& arriving = loop[(i > 0 ? i : loop.size()) - 1];
        if (is_in_wedge(arriving, loop[i], line)) return true;
      }
    }
    return false;
  }
  /// Order of points by the axes of the projection, the second one first; doubles decide unless
  /// equal.
  [[nodiscard]] bool before(uint32_t p, uint32_t q) const;
  /// The axes onto which the plane is projected.
  [[nodiscard]] std::array<int, 2> axes() const { return {u_, v_}; }
  /// Has rays run along the other one of these.
  void swap_axes() { std::swap(u_, v_); }

 private:
  /// What a ray from a point towards -u does with an edge, or that the point is on it.
  enum class Met : uint8_t { kMissed, kCrossed, kOn };
  Met meet(const DirectedEdge& e, uint32_t p);
  int side_towards_u(const DirectedEdge& e, uint32_t p);

  PlaneId support_;
  PointView& points_;
  const PlaneTable& planes_;
  int u_, v_;
};

}  // namespace csgrun
