// Where points and lines lie in a planar face.
#pragma once

#include <span>
#include <vector>

#include "engine/mesh/merge_faces.h"

namespace csgrun {

/// Answers for one plane. Exact; O(edges) a question.
class FaceLocator {
 public:
  FaceLocator(PlaneId support, PointView& points, const PlaneTable& planes);

  /// +1 when a point of the plane is inside loops that do not cross (by their parity), 0 on them,
  /// -1 outside.
  int locate(std::span<const std::vector<DirectedEdge>> loops, uint32_t p);
  /// Whether a line from a corner goes on inside the wedge between two edges of the face there.
  bool is_in_wedge(const DirectedEdge& arriving, const DirectedEdge& leaving,
                   const DirectedEdge& line);
  /// Whether a line, which leaves a point of the loops, goes on between them and to the left of
  /// them. `line.plane` is any plane that holds it but the support.
  bool starts_inside(std::span<const std::vector<DirectedEdge>> loops, const DirectedEdge& line);
  /// Order of points by the axes of the projection, the second one first; doubles decide unless
  /// equal.
  [[nodiscard]] bool before(uint32_t p, uint32_t q) const;
  /// The axes onto which the plane is projected.
  [[nodiscard]] std::array<int, 2> axes() const { return {u_, v_}; }

 private:
  int side_towards_u(const DirectedEdge& e, uint32_t p);

  PlaneId support_;
  PointView& points_;
  const PlaneTable& planes_;
  int u_, v_;
};

}  // namespace csgrun
