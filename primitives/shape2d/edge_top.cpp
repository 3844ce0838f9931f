#include "primitives/shape2d/edge_top.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

bool less(const glm::dvec2& p, const glm::dvec2& q) {
  return std::tie(p.x, p.y) < std::tie(q.x, q.y);
}

/// The points that occur more than once, sorted.
std::vector<glm::dvec2> repeated_points(const std::vector<Shape2D::Loop>& loops) {
  std::vector<glm::dvec2> all, repeated;
  for (const Shape2D::Loop& loop : loops) all.insert(all.end(), loop.begin(), loop.end());
  std::sort(all.begin(), all.end(), less);
  for (size_t i = 0; i + 1 < all.size(); ++i) {
    if (all[i] == all[i + 1]) repeated.push_back(all[i]);
  }
  return repeated;
}

}  // namespace

EdgeTop::EdgeTop(std::vector<Shape2D::Loop>& loops, const LinearExtrudeOptions& options, int slices)
    : top_(options, slices, slices), axis_(options.scale.x == 0 ? 1 : 0) {
  find_places(loops);
  split_loops(loops);
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

bool EdgeTop::cut_at_from(uint32_t from, uint32_t to) const {
  const bool from_high = from_high_[std::min(from, to)];
  return from < to ? !from_high : from_high;
}

void EdgeTop::find_places(const std::vector<Shape2D::Loop>& loops) {
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
  // Places where walls meet in a point: ends of the outline, and points where loops touch.
  std::vector<bool> meeting(places_.size(), false);
  for (const Shape2D::Loop& loop : loops) {
    const size_t n = loop.size();
    for (size_t i = 0; i < n; ++i) {
      const uint32_t before = place_of(loop[(i + n - 1) % n]), here = place_of(loop[i]),
                     after = place_of(loop[(i + 1) % n]);
      if ((before < here && after < here) || (before > here && after > here)) meeting[here] = true;
    }
  }
  for (const glm::dvec2& p : repeated_points(loops)) meeting[place_of(p)] = true;

  std::vector<double> finer;
  for (size_t i = 0; i < places_.size(); ++i) {
    finer.push_back(places_[i]);
    if (i + 1 == places_.size()) break;
    from_high_.push_back(meeting[i]);
    const double middle = (places_[i] + places_[i + 1]) / 2;
    if (meeting[i] && meeting[i + 1] && places_[i + 1] - places_[i] > 4 * noise) {
      finer.push_back(middle);
      from_high_.push_back(false);
    }
  }
  places_ = std::move(finer);
}

void EdgeTop::split_loops(std::vector<Shape2D::Loop>& loops) const {
  double total = 0;
  for (Shape2D::Loop& loop : loops) {
    Shape2D::Loop fine;
    for (size_t i = 0; i < loop.size(); ++i) {
      const glm::dvec2 a = loop[i], b = loop[(i + 1) % loop.size()];
      const auto from = static_cast<int64_t>(place_of(a)), to = static_cast<int64_t>(place_of(b));
      const double u = along(a), length = along(b) - u;
      fine.push_back(a);
      for (int64_t k = from < to ? from + 1 : from - 1; from < to ? k < to : k > to;
           k += from < to ? 1 : -1) {
        fine.push_back(a + (b - a) * ((places_[k] - u) / length));
      }
    }
    loop = std::move(fine);
    total += static_cast<double>(loop.size());
    if (total > kMostPoints) return;  // far too many for a mesh: the caller counts them and says so
  }
}

}  // namespace csgrun
