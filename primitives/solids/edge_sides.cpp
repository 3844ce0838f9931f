#include "primitives/solids/edge_sides.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include <csgrun/primitives/trig.h>

#include "primitives/base/none.h"

namespace csgrun {
namespace {

/// The sine between normals of one plane, of which what is known is good to 1e-15, and the cosine
/// between those of what is one side at once: no facets turn by so little.
constexpr double kSamePlane = 1e-14, kNearlyParallel = 1 - 1e-14;
/// So many grid steps apart are two planes between which the corners of one plane lie, at most:
/// rounding moves each by up to sqrt(3) / 2 steps to either side, and twice where what was made on
/// one grid is used on another, which is 3.5; what lies between corners is no farther off. The
/// plane that is laid through them is not that of the user's numbers, but about as near to them
/// (see Joiner::normal_of): sides of random cones, lofts and extrusions need 1.2.
///
/// Two facets of a circle of radius r that turn by t lie between planes that are r t^2 / 2 apart:
/// with 1000 to the turn 330 steps, where r is the largest coordinate, which has 2^24 at least.
constexpr double kRoughSteps = 4;
/// Faces that turn by more, in degrees, are two sides however narrow they are.
constexpr double kMostTurnOfSide = 10;

/// What lies between two planes.
struct Slab {
  glm::dvec3 normal{0};
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void add(const glm::dvec3& p) {
    const double height = glm::dot(normal, p);
    low = std::min(low, height), high = std::max(high, height);
  }
  [[nodiscard]] double thickness() const { return high - low; }
};

/// Joins neighbours, beginning with those that turn least, as long as all their corners together
/// lie between two planes that are no farther apart than the roughness: so facets of a fine curve
/// are not joined one after another.
class Joiner {
 public:
  Joiner(const Solid& solid, std::span<const uint32_t> twins, FlatSides& sides)
      : solid_(solid), twins_(twins), sides_(sides), joined_with_(sides.face.size()) {
    std::iota(joined_with_.begin(), joined_with_.end(), 0u);
  }

  /// `is_rough`: by side, whether it has several planes already.
  void join(std::vector<bool> is_rough) {
    is_rough_ = std::move(is_rough);
    find_areas();
    find_pairs();
    find_corners();
    // A narrow face may fit only when its neighbours are joined.
    for (bool is_any = true; is_any;) {
      is_any = false;
      std::erase_if(pairs_, [&](const Pair& pair) {
        const uint32_t a = root(pair.a), b = root(pair.b);
        const bool fits = a == b || try_to_join(a, b);
        is_any |= fits && a != b;
        return fits;
      });
    }
    renumber();
  }

 private:
  struct Pair {
    double cosine;
    uint32_t a, b;
  };

  [[nodiscard]] uint32_t root(uint32_t side) {
    while (joined_with_[side] != side) side = joined_with_[side] = joined_with_[joined_with_[side]];
    return side;
  }
  [[nodiscard]] const glm::dvec3& corner(uint32_t half) const {
    return solid_.positions[solid_.triangles[half / 3][half % 3]];
  }
  [[nodiscard]] glm::dvec3 area_of(uint32_t triangle) const {
    const glm::dvec3& p = corner(3 * triangle);
    return glm::cross(corner(3 * triangle + 1) - p, corner(3 * triangle + 2) - p);
  }

  /// The sum of the areas, as vectors, of what is joined depends on its rim alone: each corner
  /// tilts it by its own height and the distance between its neighbours there. So a rim of corners
  /// that are `h` off gives a plane within 4 h of them where it is convex.
  [[nodiscard]] glm::dvec3 normal_of(uint32_t a, uint32_t b) const {
    return glm::normalize(areas_[a] + areas_[b]);
  }

  void find_areas() {
    areas_.assign(sides_.face.size(), glm::dvec3(0));
    for (uint32_t t = 0; t < sides_.of.size(); ++t) areas_[sides_.of[t]] += area_of(t);
  }

  /// Neighbours that may be one: of each pair an edge and the corners across it lie in one plane.
  void find_pairs() {
    for (uint32_t h = 0; h < twins_.size(); ++h) {
      const uint32_t twin = twins_[h];
      const uint32_t a = sides_.of[h / 3], b = sides_.of[twin / 3];
      if (h > twin || a == b) continue;
      const double cosine = glm::dot(glm::normalize(areas_[a]), glm::normalize(areas_[b]));
      // What has no area, in doubles, has no direction either.
      if (!(cosine >= least_)) continue;
      Slab slab{normal_of(a, b)};
      for (const uint32_t c : {h, around(h), around(around(h)), around(around(twin))})
        slab.add(corner(c));
      if (slab.thickness() <= sides_.roughness) pairs_.push_back({cosine, a, b});
    }
    std::sort(pairs_.begin(), pairs_.end(), [](const Pair& p, const Pair& q) {
      return std::tie(q.cosine, p.a, p.b) < std::tie(p.cosine, q.a, q.b);
    });
  }

  /// Of the sides that are in pairs.
  void find_corners() {
    corners_.resize(sides_.face.size());
    std::vector<bool> is_in_pair(corners_.size(), false);
    for (const Pair& pair : pairs_) is_in_pair[pair.a] = is_in_pair[pair.b] = true;
    for (uint32_t t = 0; t < sides_.of.size(); ++t) {
      if (!is_in_pair[sides_.of[t]]) continue;
      const auto& corners = solid_.triangles[t];
      corners_[sides_.of[t]].insert(corners_[sides_.of[t]].end(), corners.begin(), corners.end());
    }
    slabs_.resize(corners_.size());
    for (uint32_t side = 0; side < corners_.size(); ++side) {
      auto& own = corners_[side];
      std::sort(own.begin(), own.end());
      own.erase(std::unique(own.begin(), own.end()), own.end());
      slabs_[side].normal = glm::normalize(areas_[side]);
      static_cast<void>(add_corners(side, slabs_[side]));
    }
  }

  /// Whether it is no thicker than it may be with them.
  [[nodiscard]] bool add_corners(uint32_t side, Slab& slab) const {
    for (const uint32_t v : corners_[side]) {
      slab.add(solid_.positions[v]);
      if (slab.thickness() > sides_.roughness) return false;
    }
    return true;
  }

  [[nodiscard]] bool try_to_join(uint32_t a, uint32_t b) {
    if (corners_[a].size() < corners_[b].size()) std::swap(a, b);
    if (!(glm::dot(glm::normalize(areas_[a]), glm::normalize(areas_[b])) >= least_)) return false;
    // Mostly the smaller one lies in the slab of the larger one, whose corners are many where
    // flat sides are of many faces.
    Slab slab = slabs_[a];
    if (!add_corners(b, slab)) {
      slab = {normal_of(a, b)};
      if (!add_corners(b, slab) || !add_corners(a, slab)) return false;
    }
    const uint32_t kept = std::min(a, b), gone = std::max(a, b);
    joined_with_[gone] = kept;
    areas_[kept] += areas_[gone];
    slabs_[kept] = slab;
    corners_[a].insert(corners_[a].end(), corners_[b].begin(), corners_[b].end());
    corners_[kept].swap(corners_[a]);
    return true;
  }

  void renumber() {
    std::vector<uint32_t> number(sides_.face.size(), kNone);
    FlatSides result;
    for (uint32_t side = 0; side < number.size(); ++side) {
      const uint32_t first = root(side);
      if (first == side) {
        number[side] = static_cast<uint32_t>(result.face.size());
        result.face.push_back(sides_.face[side]);
        result.normal.emplace_back();
      }
      number[side] = number[first];
      if (is_rough_[side] || first != side)
        result.normal[number[first]] = glm::normalize(areas_[first]);
    }
    for (uint32_t& side : sides_.of) side = number[side];
    sides_.face = std::move(result.face);
    sides_.normal = std::move(result.normal);
  }

  static uint32_t around(uint32_t half) { return half % 3 == 2 ? half - 2 : half + 1; }

  const Solid& solid_;
  const double least_ = cos_deg(kMostTurnOfSide);
  const std::span<const uint32_t> twins_;
  FlatSides& sides_;
  std::vector<uint32_t> joined_with_;           ///< by side: one before it, or itself
  std::vector<glm::dvec3> areas_;               ///< by side, twice: of what is joined with it
  std::vector<std::vector<uint32_t>> corners_;  ///< the same of those that are in pairs_
  std::vector<Slab> slabs_;                     ///< around these
  std::vector<Pair> pairs_;
  std::vector<bool> is_rough_;
};

}  // namespace

FlatSides flat_sides(const Solid& solid, std::span<const uint32_t> twins, double grid_step_mm) {
  std::vector<glm::dvec3> normals;
  for (const glm::dvec3& n : solid.face_normals) normals.push_back(glm::normalize(n));
  FlatSides result;
  result.roughness = kRoughSteps * grid_step_mm;
  result.of.assign(solid.triangles.size(), kNone);
  std::vector<bool> is_rough;
  std::vector<uint32_t> stack;
  for (uint32_t start = 0; start < result.of.size(); ++start) {
    if (result.of[start] != kNone) continue;
    const auto side = static_cast<uint32_t>(result.face.size());
    result.of[start] = side;
    result.face.push_back(solid.triangle_face[start]);
    is_rough.push_back(false);
    stack.assign(1, start);
    while (!stack.empty()) {
      const uint32_t t = stack.back();
      stack.pop_back();
      for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        const uint32_t other = twins[h] / 3;
        if (result.of[other] != kNone) continue;
        const glm::dvec3 &n = normals[solid.triangle_face[t]],
                         &m = normals[solid.triangle_face[other]];
        if (glm::dot(n, m) < kNearlyParallel) continue;
        if (glm::length(glm::cross(n, m)) > kSamePlane) is_rough.back() = true;
        result.of[other] = side;
        stack.push_back(other);
      }
    }
  }
  Joiner(solid, twins, result).join(is_rough);
  return result;
}

}  // namespace csgrun
