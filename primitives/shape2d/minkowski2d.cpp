// Minkowski sums and hulls of shapes, in integers of the grid.
//
// The sum of a shape A and a convex polygon B is A united with a parallelogram along each edge (the
// edge swept to B's farthest vertex in the direction of its normal) and a fan at each convex corner
// (B's boundary between the two farthest vertices). As with an offset, all of this is one closed
// curve for each loop whose winding number is positive exactly in the union.
//
// Where neither is convex, their convolution is such a curve, with few edges: of regions without
// holes, to which those with holes are cut open along slits.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include <csgrun/primitives/shape_operations.h>

#include "primitives/base/text.h"
#include "primitives/shape2d/convolution.h"
#include "primitives/shape2d/noise_corners.h"
#include "primitives/shape2d/shape_factory.h"
#include "primitives/shape2d/slits.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

Point2D sum(const Point2D& a, const Point2D& b) { return {a.x + b.x, a.y + b.y}; }

/// A shape as loops on a grid that is known to hold the result.
std::vector<GridLoop> snapped_loops(const Grid2D& grid, const Shape2D& shape) {
  std::vector<GridLoop> loops;
  for (const Shape2D::Loop& loop : shape.loops()) {
    GridLoop snapped = snap_loop(grid, loop);
    snapped.erase(std::unique(snapped.begin(), snapped.end()), snapped.end());
    while (snapped.size() > 1 && snapped.front() == snapped.back()) snapped.pop_back();
    loops.push_back(std::move(snapped));
  }
  return loops;
}

/// The corners of the convex hull, counter-clockwise from the smallest, none straight (Andrew's
/// monotone chain). One or two points when all lie on a line.
GridLoop convex_hull(GridLoop points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  GridLoop hull;
  for (int side = 0; side < 2; ++side) {
    const size_t start = hull.size();
    for (const Point2D& p : points) {
      while (hull.size() > start + 1 && orient(hull[hull.size() - 2], hull.back(), p) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();  // the other side starts with it
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// The corners of a shape that is one convex polygon, without straight ones; else nothing.
GridLoop convex_corners(const std::vector<GridLoop>& loops) {
  if (loops.size() != 1) return {};
  const GridLoop& loop = loops[0];
  const size_t n = loop.size();
  for (size_t i = 0; i < n; ++i) {
    if (orient(loop[i], loop[(i + 1) % n], loop[(i + 2) % n]) < 0) return {};
  }
  const GridLoop corners = convex_hull(loop);
  return corners.size() >= 3 ? corners : GridLoop();
}

/// A convex polygon with its first vertex as the origin.
class ConvexTool {
 public:
  explicit ConvexTool(GridLoop corners) : corners_(std::move(corners)) {
    const Point2D origin = corners_[0];
    for (Point2D& p : corners_) p = p - origin;
  }

  /// The curve around a loop that has the shape on its left.
  void sweep(const GridLoop& loop, const Point2D& shift, std::vector<Segment2D>& segments) const {
    const size_t n = loop.size();
    if (n < 2) return;
    std::vector<size_t> farthest(n);
    for (size_t i = 0; i < n; ++i) farthest[i] = farthest_from(loop[(i + 1) % n] - loop[i]);
    GridLoop curve;
    for (size_t i = 0; i < n; ++i) {
      const Point2D before = loop[i] - loop[(i + n - 1) % n], after = loop[(i + 1) % n] - loop[i];
      const Point2D at = sum(loop[i], shift);
      size_t k = farthest[(i + n - 1) % n];
      curve.push_back(sum(at, corners_[k]));
      if (sign(cross(before, after)) > 0) {
        while (k != farthest[i]) curve.push_back(sum(at, corners_[k = next(k)]));
      } else {
        curve.push_back(at);
        curve.push_back(sum(at, corners_[farthest[i]]));
      }
    }
    add_outline(curve, kRestOfOperands, segments);
  }

 private:
  [[nodiscard]] size_t next(size_t k) const { return k + 1 == corners_.size() ? 0 : k + 1; }

  /// The vertex farthest to the right of a direction; of two the one that comes first, so that a
  /// fan at the end of the edge goes over both.
  [[nodiscard]] size_t farthest_from(const Point2D& direction) const {
    size_t best = 0;
    for (size_t k = 1; k < corners_.size(); ++k) {
      const int side = sign(cross(corners_[k] - corners_[best], direction));
      if (side > 0 || (side == 0 && sign(dot(corners_[k] - corners_[best], direction)) < 0))
        best = k;
    }
    return best;
  }

  GridLoop corners_;
};

double edge_count(const std::vector<GridLoop>& loops) {
  double count = 0;
  for (const GridLoop& loop : loops) count += static_cast<double>(loop.size());
  return count;
}

/// A shape as it is on a grid that may be coarser than its own.
Result<Shape2D> cleaned_on(const Grid2D& grid, const Shape2D& shape) {
  std::vector<Segment2D> segments;
  for (const GridLoop& loop : snapped_loops(grid, shape))
    add_outline(loop, kRestOfOperands, segments);
  return Shape2DFactory::arranged(grid, std::move(segments),
                                  [](int32_t, int32_t winding) { return winding > 0; });
}

/// Loops of which each has a region without holes on its left; all together have the shape.
Result<std::vector<GridLoop>> loops_without_holes(const Grid2D& grid, const Shape2D& shape) {
  const std::vector<GridLoop> all = snapped_loops(grid, shape);
  std::vector<GridLoop> open;
  for (const Shape2D::Region& region : shape.regions()) {
    std::vector<GridLoop> loops{all[region.outer]};
    for (const uint32_t hole : region.holes) loops.push_back(all[hole]);
    std::optional<GridLoop> loop = cut_open(loops);
    if (!loop) return Error{ErrorCode::kInternal, "a hole of a shape sees no corner of it", {}};
    open.push_back(*std::move(loop));
  }
  return open;
}

Status convolve(const Grid2D& grid, const Shape2D& first, const Shape2D& second,
                std::vector<Segment2D>& segments) {
  std::array<std::vector<GridLoop>, 2> loops;
  for (size_t i = 0; i < 2; ++i) {
    const Result<Shape2D> clean = cleaned_on(grid, i == 0 ? first : second);
    if (!clean) return clean.error();
    auto open = loops_without_holes(grid, *clean);
    if (!open) return open.error();
    loops[i] = *std::move(open);
  }
  for (const GridLoop& p : loops[0]) {
    for (const GridLoop& q : loops[1]) add_convolution(p, q, segments);
  }
  return std::monostate{};
}

Result<Shape2D> sum_of_two(const Shape2D& first, const Shape2D& second) {
  const Result<Grid2D> grid = grid_for(extent_of(first.loops()) + extent_of(second.loops()));
  if (!grid) return grid.error();
  std::vector<GridLoop> a = snapped_loops(*grid, first), b = snapped_loops(*grid, second);
  GridLoop corners = convex_corners(b);
  if (corners.empty()) {  // a convex first operand is the tool as well
    corners = convex_corners(a);
    if (!corners.empty()) std::swap(a, b);
  }
  const bool convex = !corners.empty();
  const double pieces = convex ? edge_count(a) * 3 + edge_count(b) : edge_count(a) * edge_count(b);
  if (pieces > kMostPoints) return too_many_points("minkowski", pieces, pieces);
  std::vector<Segment2D> segments;
  if (convex) {
    const ConvexTool tool(corners);
    for (const GridLoop& loop : a) tool.sweep(loop, corners[0], segments);
  } else {
    if (auto status = convolve(*grid, first, second, segments); !status) return status.error();
  }
  return Shape2DFactory::arranged(*grid, std::move(segments),
                                  [](int32_t, int32_t winding) { return winding > 0; });
}

}  // namespace

Result<Shape2D> minkowski_of_shapes(const std::vector<Shape2D>& shapes) {
  Shape2D result;
  for (const Shape2D& shape : shapes) {
    if (shape.empty()) continue;
    if (result.empty()) {
      result = shape;
      continue;
    }
    Result<Shape2D> next = sum_of_two(without_noise_corners(result), without_noise_corners(shape));
    if (!next) return next;
    result = *std::move(next);
  }
  return result;
}

Result<Shape2D> hull_of_points(const std::vector<glm::dvec2>& points) {
  const Result<Grid2D> grid = grid_for(extent_of({points}));
  if (!grid) return grid.error();
  GridLoop snapped;
  for (const glm::dvec2& p : points) snapped.push_back(grid->snap(p));
  GridRegions regions;
  regions.loops.push_back(convex_hull(std::move(snapped)));
  if (regions.loops[0].size() < 3) return Shape2D();
  regions.outer_of = {0};
  return Shape2DFactory::from_grid(*grid, regions);
}

Result<Shape2D> hull_of_shapes(const std::vector<Shape2D>& shapes) {
  std::vector<glm::dvec2> points;
  for (const Shape2D& shape : shapes) {
    for (const Shape2D::Loop& loop : shape.loops())
      points.insert(points.end(), loop.begin(), loop.end());
  }
  return hull_of_points(points);
}

}  // namespace csgrun
