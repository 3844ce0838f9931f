// Boxes around points in doubles, and what maps make of them.
#pragma once

#include <glm/vec3.hpp>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/polygon_mesh.h>

namespace csgrun {

/// A box in millimetres, closed; one that holds nothing is inside out.
struct PointBox {
  glm::dvec3 lo, hi;

  static PointBox nothing();
  static PointBox everything();
  void include(const glm::dvec3& p);
  void include(const PointBox& other);
  [[nodiscard]] bool is_nothing() const;
  [[nodiscard]] bool meets(const PointBox& other) const;
  [[nodiscard]] bool holds(const PointBox& other) const;
  /// The longest edge; 0 when it holds nothing.
  [[nodiscard]] double size() const;
  bool operator==(const PointBox&) const = default;
};

/// The box of the points of a mesh.
PointBox box_of(const PolygonMesh& mesh);

/// What both have in common.
PointBox common(const PointBox& a, const PointBox& b);

/// Widened for the rounding of doubles; if it reaches to infinity, or further, everything.
PointBox widened(PointBox box);

/// The box of a box under a map, but for the rounding of doubles. What reaches to infinity, or
/// further, is everything.
PointBox image(const Affine& map, const PointBox& box);

/// What a map takes into a box, or more; everything if the map is nearly singular.
PointBox original(const Affine& map, const PointBox& box);

}  // namespace csgrun
