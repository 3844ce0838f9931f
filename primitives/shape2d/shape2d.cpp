// 2D shapes as values. Booleans, polygons and clean-up go through one exact arrangement of
// segments.
#include <algorithm>
#include <cmath>
#include <utility>

#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/trig.h>

#include "primitives/base/at_most.h"
#include "primitives/base/text.h"
#include "primitives/shape2d/shape_factory.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {
const std::vector<Shape2D::Loop>& Shape2D::loops() const {
  static const std::vector<Loop> kNone;
  return data_ ? data_->loops : kNone;
}

const std::vector<Shape2D::Region>& Shape2D::regions() const {
  static const std::vector<Region> kNone;
  return data_ ? data_->regions : kNone;
}

Result<Shape2D> Shape2D::from_outlines(const std::vector<Loop>& outlines, FillRule fill) {
  if (!all_finite(outlines)) return invalid_argument("2D shape: a coordinate is not finite");
  const Result<Grid2D> grid = grid_for(extent_of(outlines));
  if (!grid) return grid.error();
  std::vector<Segment2D> segments;
  for (const Loop& loop : outlines) add_outline(snap_loop(*grid, loop), kRestOfOperands, segments);
  return Shape2DFactory::arranged(*grid, std::move(segments), [fill](int32_t, int32_t rest) {
    return fill == FillRule::kEvenOdd   ? rest % 2 != 0
           : fill == FillRule::kNonZero ? rest != 0
                                        : rest > 0;
  });
}

double Shape2D::area() const {
  double sum = 0;
  for (const Loop& loop : loops()) {
    double twice = 0;
    for (size_t i = 1; i + 1 < loop.size(); ++i) {
      const glm::dvec2 a = loop[i] - loop[0], b = loop[i + 1] - loop[0];
      twice += a.x * b.y - a.y * b.x;
    }
    sum += twice / 2;
  }
  return sum;
}

std::array<glm::dvec2, 2> Shape2D::bounds() const {
  if (empty()) return {glm::dvec2(0), glm::dvec2(0)};
  std::array<glm::dvec2, 2> box{loops()[0][0], loops()[0][0]};
  for (const Loop& loop : loops()) {
    for (const glm::dvec2& p : loop) {
      box[0] = {std::min(box[0].x, p.x), std::min(box[0].y, p.y)};
      box[1] = {std::max(box[1].x, p.x), std::max(box[1].y, p.y)};
    }
  }
  return box;
}

bool Shape2D::contains(const glm::dvec2& p) const {
  const auto [low, high] = bounds();
  if (empty() || !(p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y)) return false;
  const auto grid = Grid2D::for_extent(extent_of(loops()));
  if (!grid) return false;
  const Point2D q = grid->snap(p);
  bool inside = false;
  for (const Loop& loop : loops()) {
    const GridLoop snapped = snap_loop(*grid, loop);
    for (size_t i = 0; i < snapped.size(); ++i) {
      Point2D a = snapped[i], b = snapped[(i + 1) % snapped.size()];
      if (b < a) std::swap(a, b);
      const int side = orient(a, b, q);
      if (side == 0 && a <= q && q <= b) return true;
      // Does the ray from q downwards cross the edge? Edges own their left end.
      if (a.x <= q.x && q.x < b.x && side > 0) inside = !inside;
    }
  }
  return inside;
}

Result<Shape2D> make_square(const glm::dvec2& size, std::array<bool, 2> center) {
  constexpr std::array<const char*, 2> kNames{"size.x", "size.y"};
  std::array<std::array<double, 2>, 2> range{};
  for (int i = 0; i < 2; ++i) {
    if (!std::isfinite(size[i])) return not_finite("square", kNames[i], size[i]);
    if (!(size[i] > 0)) return not_positive("square", kNames[i], size[i]);
    range[i] = center[i] ? std::array<double, 2>{-size[i] / 2, size[i] / 2}
                         : std::array<double, 2>{0, size[i]};
  }
  const auto& [x, y] = range;
  return Shape2DFactory::canonical({{{x[0], y[0]}, {x[1], y[0]}, {x[1], y[1]}, {x[0], y[1]}}}, {0});
}

Result<Shape2D> make_rounded_square(const glm::dvec2& size, double radius, const Facets& facets,
                                    std::array<bool, 2> center) {
  const double r = at_most(radius, std::min(size.x, size.y) / 2);
  const Result<Shape2D> sharp = make_square(size, center);
  if (!sharp) return sharp;
  if (!std::isfinite(r)) return not_finite("square", "r", r);
  if (!(r > 0)) return not_positive("square", "r", r);
  if (2 * r > std::min(size.x, size.y)) {
    return invalid_argument("square: r must be at most half of the shorter side, " +
                            number_text(std::min(size.x, size.y) / 2) + ", got " + number_text(r));
  }
  const int steps = (facets.fragments(r) + 3) / 4;
  if (steps > kMostPoints / 4) return too_many_points("square", steps, 4.0 * steps);
  const auto [low, high] = sharp->bounds();
  Shape2D::Loop loop;
  for (int corner = 0; corner < 4; ++corner) {
    const glm::dvec2 center_of_arc(corner == 1 || corner == 2 ? low.x + r : high.x - r,
                                   corner >= 2 ? low.y + r : high.y - r);
    for (int k = 0; k <= steps; ++k) {
      const double angle = 90 * corner + 90.0 * k / steps;
      const glm::dvec2 p = center_of_arc + r * glm::dvec2(cos_deg(angle), sin_deg(angle));
      if (loop.empty() || p != loop.back()) loop.push_back(p);
    }
  }
  while (loop.front() == loop.back()) loop.pop_back();
  return Shape2DFactory::canonical({std::move(loop)}, {0});
}

Result<Shape2D> make_circle(double r, const Facets& facets) {
  if (!std::isfinite(r)) return not_finite("circle", "r", r);
  if (!(r > 0)) return not_positive("circle", "r", r);
  if (!std::isfinite(facets.fn)) return not_finite("circle", "fn", facets.fn);
  if (!std::isfinite(facets.fa)) return not_finite("circle", "fa", facets.fa);
  if (!std::isfinite(facets.fs)) return not_finite("circle", "fs", facets.fs);
  const int n = facets.fragments(r);
  if (n > kMostPoints) return too_many_points("circle", n, n);
  Shape2D::Loop loop(n);
  for (int k = 0; k < n; ++k) {
    const double angle = 360.0 * k / n;
    loop[k] = {r * cos_deg(angle), r * sin_deg(angle)};
  }
  return Shape2DFactory::canonical({std::move(loop)}, {0});
}

Result<Shape2D> make_polygon(const std::vector<glm::dvec2>& points,
                             const std::vector<std::vector<uint32_t>>& paths) {
  for (size_t i = 0; i < points.size(); ++i) {
    for (const double c : {points[i].x, points[i].y}) {
      if (std::isfinite(c)) continue;
      return invalid_argument("polygon: point " + std::to_string(i) + " must be finite, got " +
                              number_text(c));
    }
  }
  std::vector<Shape2D::Loop> outlines;
  if (paths.empty()) {
    if (points.size() < 3) {
      return invalid_argument("polygon: needs at least 3 points, got " +
                              std::to_string(points.size()));
    }
    outlines.push_back(points);
  }
  for (size_t i = 0; i < paths.size(); ++i) {
    if (paths[i].size() < 3) {
      return invalid_argument("polygon: path " + std::to_string(i) +
                              " needs at least 3 points, got " + std::to_string(paths[i].size()));
    }
    Shape2D::Loop& outline = outlines.emplace_back();
    for (const uint32_t index : paths[i]) {
      if (index >= points.size()) {
        return invalid_argument("polygon: path " + std::to_string(i) + ": index " +
                                std::to_string(index) + " is out of range, there are " +
                                std::to_string(points.size()) + " points; indices count from 0");
      }
      outline.push_back(points[index]);
    }
  }
  Result<Shape2D> shape = Shape2D::from_outlines(outlines);
  if (shape && shape->empty()) return invalid_argument("polygon: encloses no area");
  return shape;
}

}  // namespace csgrun
