#include "primitives/shape2d/edge_top.h"

#include <algorithm>
#include <cmath>

namespace csgrun {

EdgeTop::EdgeTop(const std::vector<Shape2D::Loop>& loops, const LinearExtrudeOptions& options,
                 int slices)
    : top_(options, slices, slices), axis_(options.scale.x == 0 ? 1 : 0) {
  // What a turn leaves a hair apart is one place.
  constexpr double kNoise = 0x1p-40;
  std::vector<double> values;
  for (const Shape2D::Loop& loop : loops) {
    for (const glm::dvec2& p : loop) values.push_back(along(p));
  }
  std::sort(values.begin(), values.end());
  const double noise = kNoise * std::max(std::fabs(values.front()), std::fabs(values.back()));
  for (const double u : values) {
    if (places_.empty() || u - places_.back() > noise) places_.push_back(u);
  }
}

glm::dvec2 EdgeTop::point(uint32_t place) const {
  glm::dvec2 p(0);
  p[axis_] = places_[place];
  return p;
}

double EdgeTop::along(const glm::dvec2& p) const { return top_.point(p)[axis_]; }

uint32_t EdgeTop::place_of(const glm::dvec2& p) const {
  const double u = along(p);
  const auto above = std::lower_bound(places_.begin(), places_.end(), u);
  const auto i = static_cast<uint32_t>(above - places_.begin());
  if (i == places_.size()) return i - 1;
  return i > 0 && u - places_[i - 1] < places_[i] - u ? i - 1 : i;
}

}  // namespace csgrun
