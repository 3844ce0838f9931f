// 2D shapes as values: outlines on an integer grid, their Booleans, and extrusion to solids.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/primitives/solids.h>

namespace csgrun {

/// A 2D region: loops in millimetres, outer ones counter-clockwise, holes clockwise, free of
/// crossings (loops may touch in points). Canonical order. Immutable; copies share the data.
class Shape2D {
 public:
  using Loop = std::vector<glm::dvec2>;
  Shape2D() = default;  ///< the empty region
  /// Any outlines, under the even-odd rule; snapped to the 2D grid, cleaned.
  static Result<Shape2D> from_outlines(const std::vector<Loop>& outlines);

  [[nodiscard]] const std::vector<Loop>& loops() const;
  [[nodiscard]] bool empty() const { return loops().empty(); }
  [[nodiscard]] double area() const;
  [[nodiscard]] std::array<glm::dvec2, 2> bounds() const;
  [[nodiscard]] bool contains(const glm::dvec2& p) const;

  static Result<Shape2D> boolean(BooleanOp op, const std::vector<Shape2D>& operands);
  /// Uses the entries (0,0) (0,1) (0,3) (1,0) (1,1) (1,3) of the map. A map of determinant 0 gives
  /// the empty shape.
  [[nodiscard]] Result<Shape2D> transformed(const Affine& map) const;

 private:
  std::shared_ptr<const std::vector<Loop>> loops_;
};

Result<Shape2D> make_square(const glm::dvec2& size, std::array<bool, 2> center = {false, false});
Result<Shape2D> make_circle(double r, const Facets& facets);
/// No paths: one outline of all points. With paths: all outlines together, even-odd.
Result<Shape2D> make_polygon(const std::vector<glm::dvec2>& points,
                             const std::vector<std::vector<uint32_t>>& paths);

struct LinearExtrudeOptions {
  double height = 100;
  std::optional<glm::dvec3> direction;  ///< OpenSCAD's `v`; normalised when `height_given`
  bool height_given = false;
  bool center = false;
  glm::dvec2 scale{1, 1};
  double twist = 0;
  std::optional<int> slices, segments;
  Facets facets;
};
MeshResult linear_extrude(const Shape2D& shape, const LinearExtrudeOptions& options);

struct RotateExtrudeOptions {
  double angle = 360;
  double start = 0;  ///< the caller decides OpenSCAD's 180 for a full turn without `angle`
  Facets facets;
};
/// The shape's Y becomes Z. Points on the axis collapse.
MeshResult rotate_extrude(const Shape2D& shape, const RotateExtrudeOptions& options);

}  // namespace csgrun
