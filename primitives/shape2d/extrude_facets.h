// How finely linear_extrude cuts its height and its outlines: OpenSCAD's rules.
#pragma once

#include <csgrun/primitives/shape2d.h>

namespace csgrun {

/// The number of slices as a double, at least 1 and perhaps absurdly large. `height` is what
/// the top is above the bottom.
double slices_of(const Shape2D& shape, const LinearExtrudeOptions& options, double height);

/// The loops with vertices added on long edges, for twists and uneven scales.
std::vector<Shape2D::Loop> split_outlines(const Shape2D& shape, const LinearExtrudeOptions& options,
                                          int slices);

/// Whether the quadrilateral a b c d of a wall is cut from a to c: along the shorter diagonal, or,
/// of two that are equal but for rounding, as `of_equal` says.
bool is_cut_from_first(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                       const glm::dvec3& d, bool of_equal);

/// Where the points of slice i of n go: turned first, then scaled. The sines are those of the
/// slice, not of each of its points.
class Slice {
 public:
  Slice(const LinearExtrudeOptions& options, int i, int n);
  [[nodiscard]] glm::dvec2 point(const glm::dvec2& p) const;

 private:
  bool turned_;
  double cos_ = 1, sin_ = 0;
  glm::dvec2 scale_;
};

}  // namespace csgrun
