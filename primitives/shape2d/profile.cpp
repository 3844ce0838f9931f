#include "primitives/shape2d/profile.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <glm/geometric.hpp>

#include <csgrun/primitives/trig.h>

#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

bool less(const glm::dvec2& p, const glm::dvec2& q) {
  return std::tie(p.x, p.y) < std::tie(q.x, q.y);
}

double squared(const glm::dvec2& v) { return glm::dot(v, v); }

}  // namespace

Profile make_profile(const Shape2D& shape, const std::vector<Shape2D::Loop>& loops) {
  Profile profile;
  for (const Shape2D::Loop& loop : loops) {
    profile.points.insert(profile.points.end(), loop.begin(), loop.end());
  }
  std::sort(profile.points.begin(), profile.points.end(), less);
  profile.points.erase(std::unique(profile.points.begin(), profile.points.end()),
                       profile.points.end());
  for (const Shape2D::Loop& loop : loops) {
    std::vector<uint32_t>& indices = profile.loops.emplace_back();
    for (const glm::dvec2& p : loop) {
      const auto at = std::lower_bound(profile.points.begin(), profile.points.end(), p, less);
      indices.push_back(static_cast<uint32_t>(at - profile.points.begin()));
    }
  }
  profile.regions = shape.regions();
  profile.is_hole.assign(loops.size(), true);
  for (const Shape2D::Region& region : profile.regions) profile.is_hole[region.outer] = false;
  return profile;
}

std::vector<uint32_t> smooth_chains(const Shape2D::Loop& loop, uint32_t& chain_count) {
  const size_t n = loop.size();
  const double least_cosine = cos_deg(kSmoothTurnDegrees);
  // corner[i]: the edge before vertex i and the one after it do not run on smoothly.
  std::vector<bool> corner(n);
  size_t first_corner = n;
  for (size_t i = 0; i < n; ++i) {
    const glm::dvec2 in = loop[i] - loop[(i + n - 1) % n], out = loop[(i + 1) % n] - loop[i];
    corner[i] = !(glm::dot(in, out) > least_cosine * std::sqrt(squared(in) * squared(out)));
    if (corner[i] && first_corner == n) first_corner = i;
  }
  std::vector<uint32_t> chain(n, 0);
  chain_count = 1;
  if (first_corner == n) return chain;
  for (size_t k = 0; k < n; ++k) {
    const size_t i = (first_corner + k) % n;
    if (k > 0 && corner[i]) ++chain_count;
    chain[i] = chain_count - 1;
  }
  return chain;
}

}  // namespace csgrun
