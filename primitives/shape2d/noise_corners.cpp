#include "primitives/shape2d/noise_corners.h"

#include <algorithm>
#include <tuple>

#include "primitives/shape2d/shape_factory.h"
#include "primitives/shape2d/straight_corners.h"

namespace csgrun {
namespace {

bool has_noise(const Shape2D& shape, double noise) {
  for (const Shape2D::Loop& loop : shape.loops()) {
    const size_t n = loop.size();
    for (size_t i = 0; i < n; ++i) {
      if (is_on_way(loop[(i + n - 1) % n], loop[i], loop[(i + 1) % n], noise)) return true;
    }
  }
  return false;
}

}  // namespace

std::vector<Shape2D::Loop> loops_without_noise(const Shape2D& shape) {
  const double noise = Shape2DFactory::noise_of(shape);
  if (noise == 0 || !has_noise(shape, noise)) return shape.loops();
  const auto before = [](const glm::dvec2& a, const glm::dvec2& b) {
    return std::tie(a.x, a.y) < std::tie(b.x, b.y);
  };
  std::vector<glm::dvec2> all;
  for (const Shape2D::Loop& loop : shape.loops()) all.insert(all.end(), loop.begin(), loop.end());
  std::sort(all.begin(), all.end(), before);
  std::vector<Shape2D::Loop> lean;
  for (const Shape2D::Loop& loop : shape.loops()) {
    lean.push_back(without_straight_corners(loop, [&](const glm::dvec2& corner) {
      const auto [first, last] = std::equal_range(all.begin(), all.end(), corner, before);
      return last - first > 1 ? -1 : noise;
    }));
  }
  return lean;
}

Shape2D without_noise_corners(const Shape2D& shape) {
  if (Shape2DFactory::noise_of(shape) == 0) return shape;
  return Shape2DFactory::canonical(loops_without_noise(shape), Shape2DFactory::outer_of(shape));
}

}  // namespace csgrun
