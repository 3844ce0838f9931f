// Operations on shapes that are a few lines each.
#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include <csgrun/primitives/shape_operations.h>

#include "primitives/shape2d/shape_factory.h"

namespace csgrun {

Result<Shape2D> fill_shape(const Shape2D& shape) {
  if (shape.regions().size() == shape.loops().size()) return shape;
  if (const auto* turn = Shape2DFactory::turn_of(shape);
      turn != nullptr && !Shape2DFactory::are_upright({shape})) {
    const Result<Shape2D> filled = fill_shape(Shape2DFactory::base_of(*turn));
    return filled ? filled->transformed(turn->map) : filled;
  }
  const Result<Grid2D> grid = grid_for(extent_of(shape.loops()));
  if (!grid) return grid.error();
  std::vector<Segment2D> segments;
  for (const Shape2D::Region& region : shape.regions()) {
    add_outline(snap_loop(*grid, shape.loops()[region.outer]), kRestOfOperands, segments);
  }
  Result<Shape2D> filled = Shape2DFactory::arranged(*grid, std::move(segments),
                                                    [](int32_t, int32_t sum) { return sum > 0; });
  if (filled)
    filled = Shape2DFactory::with_noise(*std::move(filled), Shape2DFactory::noise_of(shape));
  return filled;
}

double perimeter_of(const Shape2D& shape) {
  double sum = 0;
  for (const Shape2D::Loop& loop : shape.loops()) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const glm::dvec2 edge = loop[(i + 1) % loop.size()] - loop[i];
      sum += std::sqrt(glm::dot(edge, edge));
    }
  }
  return sum;
}

std::vector<Shape2D> pieces_of_shape(const Shape2D& shape) {
  std::vector<Shape2D> pieces;
  if (const auto* turn = Shape2DFactory::turn_of(shape)) {
    for (const Shape2D& piece : pieces_of_shape(Shape2DFactory::base_of(*turn))) {
      pieces.push_back(*Shape2DFactory::turned(piece, turn->map, turn->split));
    }
    std::sort(pieces.begin(), pieces.end(), [](const Shape2D& a, const Shape2D& b) {
      return is_before(a.loops()[a.regions()[0].outer], b.loops()[b.regions()[0].outer]);
    });
    return pieces;
  }
  for (const Shape2D::Region& region : shape.regions()) {
    std::vector<Shape2D::Loop> loops{shape.loops()[region.outer]};
    for (const uint32_t hole : region.holes) loops.push_back(shape.loops()[hole]);
    pieces.push_back(Shape2DFactory::with_noise(
        Shape2DFactory::canonical(std::move(loops),
                                  std::vector<uint32_t>(region.holes.size() + 1, 0)),
        Shape2DFactory::noise_of(shape)));
  }
  return pieces;
}

}  // namespace csgrun
