#include "primitives/files/drawn_shape.h"

#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "primitives/shape2d/shape_factory.h"
#include "primitives/shape2d/straight_corners.h"

namespace csgrun {
namespace {

/// Whether a loop is on average narrower than so much.
bool is_narrow(const Shape2D::Loop& loop, double width) {
  double twice_area = 0, length = 0;
  for (size_t i = 0; i < loop.size(); ++i) {
    const glm::dvec2 a = loop[i] - loop[0], b = loop[(i + 1) % loop.size()] - loop[0];
    twice_area += a.x * b.y - a.y * b.x;
    length += glm::length(b - a);
  }
  return std::fabs(twice_area) <= width * length;
}

}  // namespace

Result<Shape2D> drawn_shape(const std::vector<Shape2D::Loop>& outlines, FillRule fill) {
  if (!all_finite(outlines)) return Shape2D::from_outlines(outlines, fill);  // says so
  const Result<Grid2D> grid = grid_for(extent_of(outlines));
  if (!grid) return grid.error();
  const double step = grid->unsnap({1, 0}).x, width = 2 * step, noise = step / 16;
  std::vector<Shape2D::Loop> lean;
  // The grid would put each corner on a straight way beside it.
  for (const Shape2D::Loop& loop : outlines) {
    lean.push_back(without_straight_corners(loop, [&](const glm::dvec2&) { return noise; }));
  }
  Result<Shape2D> shape = Shape2D::from_outlines(lean, fill);
  if (!shape || shape->empty()) return shape;
  std::vector<Shape2D::Loop> kept;
  std::vector<uint32_t> outer_of;
  for (const Shape2D::Region& region : shape->regions()) {
    if (is_narrow(shape->loops()[region.outer], width)) continue;
    const auto outer = static_cast<uint32_t>(kept.size());
    kept.push_back(shape->loops()[region.outer]);
    outer_of.push_back(outer);
    for (const uint32_t hole : region.holes) {
      if (is_narrow(shape->loops()[hole], width)) continue;
      kept.push_back(shape->loops()[hole]);
      outer_of.push_back(outer);
    }
  }
  if (kept.size() == shape->loops().size()) return shape;
  return Shape2DFactory::with_noise(Shape2DFactory::canonical(std::move(kept), outer_of),
                                    Shape2DFactory::noise_of(*shape));
}

}  // namespace csgrun
