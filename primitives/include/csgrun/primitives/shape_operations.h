// What makes new outlines of 2D shapes: offset, hull, Minkowski sum, fill, resize.
//
// All of them are unions of pieces on the grid of 2D shapes, by the exact arrangement that Booleans
// use: nothing is rounded but the points where edges cross, and (of an offset) the ends of edges
// that were moved along their normals.
#pragma once

#include <array>
#include <vector>

#include <glm/vec2.hpp>

#include <csgrun/engine/error.h>
#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/solids.h>

namespace csgrun {

enum class OffsetJoin : uint8_t {
  kRound,    ///< OpenSCAD's `r`: an arc about the corner, in steps of 360 / fragments(|distance|);
             ///< a mitre where that is within a step, and within 1.5 degrees
  kMitre,    ///< OpenSCAD's `delta`: edges run on until they meet
  kChamfer,  ///< with `chamfer`: cut square, at the distance from the corner
  kBevel,    ///< cut straight between the moved edges (strokes of SVG)
};

struct OffsetOptions {
  double distance = 1;  ///< mm; negative: inwards
  OffsetJoin join = OffsetJoin::kRound;
  Facets facets;  ///< of round joins
};

/// Moves every edge outwards, or inwards. Corners that point the other way stay sharp. What is
/// thinner than twice an inward distance vanishes; mitres that would reach farther than 10^6 times
/// the distance are chamfered. Errors: kInvalidArgument (not finite), kOutOfRange, kLimit.
Result<Shape2D> offset_shape(const Shape2D& shape, const OffsetOptions& options);

enum class StrokeCap : uint8_t { kButt, kRound, kSquare };

struct StrokeOptions {
  double width = 1;  ///< mm
  StrokeCap cap = StrokeCap::kButt;
  OffsetJoin join = OffsetJoin::kMitre;
  double mitre_limit = 4;   ///< of half widths; beyond it a bevel
  bool cut_square = false;  ///< beyond it cut as with kChamfer, as OpenSCAD does
  Facets facets;            ///< of round joins and caps
};

/// The area that a pen of this width covers along an open line; empty for a line of no length.
/// Errors: kInvalidArgument (not finite, width not positive), kOutOfRange, kLimit.
Result<Shape2D> stroke_shape(const Shape2D::Loop& line, const StrokeOptions& options);

/// The smallest convex shape that contains all of them; empty ones count for nothing.
Result<Shape2D> hull_of_shapes(const std::vector<Shape2D>& shapes);
/// The convex hull of finite points, on the 2D grid; empty when they lie on one line.
Result<Shape2D> hull_of_points(const std::vector<glm::dvec2>& points);

/// All sums of a point of each. Empty shapes are left out, as in OpenSCAD, and a single one comes
/// back as it is. Exact on the grid also where nothing is convex. O((n + m) log) edges where one of
/// two is convex, O(n m) else. Errors: kOutOfRange, kLimit.
Result<Shape2D> minkowski_of_shapes(const std::vector<Shape2D>& shapes);

/// Without its holes.
Result<Shape2D> fill_shape(const Shape2D& shape);

/// The factors about the origin that give the bounding box `wanted` lengths. 0 keeps an axis; with
/// `automatic` it takes the factor of the axis whose wanted length is the largest.
template <size_t N>
std::array<double, N> resize_factors(const std::array<double, N>& size,
                                     const std::array<double, N>& wanted,
                                     const std::array<bool, N>& automatic) {
  size_t largest = 0;
  for (size_t i = 1; i < N; ++i) {
    if (wanted[i] > wanted[largest]) largest = i;
  }
  const double other = wanted[largest] > 0 ? wanted[largest] / size[largest] : 1;
  std::array<double, N> factors{};
  for (size_t i = 0; i < N; ++i) {
    factors[i] = wanted[i] > 0 ? wanted[i] / size[i] : automatic[i] ? other : 1;
  }
  return factors;
}

/// In mm, holes included.
double perimeter_of(const Shape2D& shape);

/// Its connected pieces, in the order of regions().
std::vector<Shape2D> pieces_of_shape(const Shape2D& shape);

}  // namespace csgrun
