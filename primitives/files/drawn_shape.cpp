#include "primitives/files/drawn_shape.h"

#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "primitives/shape2d/shape_factory.h"

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

/// Whether b is on the way from a to c, nowhere off by more than `noise`.
bool is_on_way(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, double noise) {
  const glm::dvec2 way = c - a, to = b - a;
  return glm::dot(to, c - b) > 0 &&
         std::fabs(way.x * to.y - way.y * to.x) <= noise * glm::length(way);
}

/// Without points on straight ways. The grid would put each of them beside the line.
Shape2D::Loop without_points_on_lines(const Shape2D::Loop& loop, double noise) {
  constexpr int kMostInARow = 64;  // or a curve of very many points would be cut short
  Shape2D::Loop kept;
  int dropped = 0;
  for (size_t i = 0; i < loop.size(); ++i) {
    const bool drop = !kept.empty() && dropped < kMostInARow &&
                      is_on_way(kept.back(), loop[i], loop[(i + 1) % loop.size()], noise);
    dropped = drop ? dropped + 1 : 0;
    if (!drop) kept.push_back(loop[i]);
  }
  return kept;
}

}  // namespace

Result<Shape2D> drawn_shape(const std::vector<Shape2D::Loop>& outlines, FillRule fill) {
  if (!all_finite(outlines)) return Shape2D::from_outlines(outlines, fill);  // says so
  const Result<Grid2D> grid = grid_for(extent_of(outlines));
  if (!grid) return grid.error();
  const double step = grid->unsnap({1, 0}).x, width = 2 * step, noise = step / 16;
  std::vector<Shape2D::Loop> lean;
  for (const Shape2D::Loop& loop : outlines) lean.push_back(without_points_on_lines(loop, noise));
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
  return Shape2DFactory::canonical(std::move(kept), outer_of);
}

}  // namespace csgrun
