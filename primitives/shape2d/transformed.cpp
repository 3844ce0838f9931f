// Transforms of 2D shapes, and what they remember of them.
#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>

#include <csgrun/primitives/shape2d.h>

#include "primitives/base/text.h"
#include "primitives/shape2d/shape_factory.h"

namespace csgrun {
namespace {

/// The part of a map that moves shapes.
Affine flat_part(const Affine& map) {
  Affine flat;
  for (int i = 0; i < 2; ++i) {
    for (const int j : {0, 1, 3}) flat.m[i][j] = map.m[i][j];
  }
  return flat;
}

/// A map without a turn, with its noise taken off: scale, quarter turn, translation.
Affine without_noise(const Affine& map) {
  const std::optional<Split2D> split = split_2d(map);
  const auto turn = split ? quarter_turn(Frame2D(), split->frame) : std::nullopt;
  if (!turn) return map;
  Affine clean = map;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      clean.m[i][j] = turn->axis[i] == j ? turn->sign[i] * split->scale[j] : 0;
    }
  }
  return clean;
}

/// How much longer a map makes what it makes longest: its larger singular value.
double largest_stretch(const Affine& map) {
  const auto& m = map.m;
  double squares = 0;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) squares += m[i][j] * m[i][j];
  }
  const double det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  return std::sqrt((squares + std::sqrt(std::max(squares * squares - 4 * det * det, 0.0))) / 2);
}

/// The loops of a shape, mapped, which remember nothing but `turn`.
Result<Shape2D> mapped(const Shape2D& shape, const Affine& map,
                       std::shared_ptr<const Shape2DFactory::Turn> turn = nullptr) {
  const auto& m = map.m;
  std::vector<Shape2D::Loop> result = shape.loops();
  for (Shape2D::Loop& loop : result) {
    for (glm::dvec2& p : loop) {
      p = {m[0][0] * p.x + m[0][1] * p.y + m[0][3], m[1][0] * p.x + m[1][1] * p.y + m[1][3]};
    }
    if (m[0][0] * m[1][1] - m[0][1] * m[1][0] < 0) std::reverse(loop.begin(), loop.end());
  }
  if (!all_finite(result)) return invalid_argument("a coordinate of the shape would not be finite");
  return Shape2DFactory::with_noise(
      Shape2DFactory::canonical(std::move(result), Shape2DFactory::outer_of(shape),
                                std::move(turn)),
      Shape2DFactory::noise_of(shape) * largest_stretch(map));
}

/// Of edges along X or Y, but for the noise of a turn; `scale` stretches them.
double length_along_axes(const std::vector<Shape2D::Loop>& loops,
                         const std::array<double, 2>& scale = {1, 1}) {
  const double noise = 0x1p-44 * extent_of(loops);
  double sum = 0;
  for (const Shape2D::Loop& loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const glm::dvec2 edge = glm::abs(loop[(i + 1) % loop.size()] - loop[i]);
      if (edge.y <= noise) {
        sum += edge.x * scale[0];
      } else if (edge.x <= noise) {
        sum += edge.y * scale[1];
      }
    }
  }
  return sum;
}

}  // namespace

Result<Shape2D> Shape2DFactory::turned(const Shape2D& base, const Affine& map,
                                       const Split2D& split) {
  return mapped(base, map, std::make_shared<Turn>(Turn{base.data_, map, split}));
}

Result<Shape2D> Shape2D::transformed(const Affine& map) const {
  const auto& m = map.m;
  if (empty() || m[0][0] * m[1][1] - m[0][1] * m[1][0] == 0) return Shape2D();
  const Turn* before = Shape2DFactory::turn_of(*this);
  const Affine flat = flat_part(map);
  const Affine total = before == nullptr ? flat : Affine::compose(flat, before->map);
  const Shape2D base = before == nullptr ? *this : Shape2DFactory::base_of(*before);
  if (const auto split = find_turn(total)) return Shape2DFactory::turned(base, total, *split);
  return mapped(base, before == nullptr ? total : without_noise(total));
}

bool Shape2DFactory::are_upright(const std::vector<Shape2D>& shapes) {
  double world = 0, turned = 0;
  for (const Shape2D& shape : shapes) {
    world += length_along_axes(shape.loops());
    turned += length_along_axes(turn_of(shape)->base->loops, turn_of(shape)->split.scale);
  }
  // Equal sums may differ by noise: then the world is meant.
  return world > 0 && world >= turned * (1 - 0x1p-20);
}

std::optional<Shape2DFactory::BeforeTurn> Shape2DFactory::before_turn(const Shape2D& shape) {
  const Turn* turn = turn_of(shape);
  if (turn == nullptr || !turn->split.frame.is_rigid() || are_upright({shape})) return std::nullopt;
  Affine stretch;
  for (int i = 0; i < 2; ++i) stretch.m[i][i] = turn->split.scale[i];
  Result<Shape2D> before = mapped(base_of(*turn), stretch);
  if (!before) return std::nullopt;
  return BeforeTurn{*std::move(before),
                    turn->split.frame.map({turn->map.m[0][3], turn->map.m[1][3]})};
}

size_t Shape2D::bytes() const {
  size_t points = 0;
  for (const Loop& loop : loops()) points += loop.size();
  // The loops before a turn have as many points.
  return (data_ && data_->turn ? 2 : 1) * points * sizeof(glm::dvec2);
}

}  // namespace csgrun
