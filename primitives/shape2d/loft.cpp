// loft: outlines at different heights, and strips of triangles between them.
//
// A strip walks along both of its outlines at once: the next triangle takes a step on the one that
// has come less far, measured in parts of the whole length. That closes whatever the outlines are;
// where the walls cross, the solid is what they wind around.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

#include <csgrun/primitives/sweep.h>

#include "primitives/base/text.h"
#include "primitives/shape2d/noise_corners.h"
#include "primitives/shape2d/profile.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

constexpr const char* kLoft = "loft";

glm::dvec2 middle_of(const Shape2D::Loop& loop) {
  glm::dvec2 low = loop[0], high = loop[0];
  for (const glm::dvec2& p : loop) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return (low + high) * 0.5;
}

double square_of(const glm::dvec2& v) { return glm::dot(v, v); }

/// A loop with the way to each of its corners from the first, as parts of its length.
struct Outline {
  explicit Outline(const Shape2D::Loop& loop) : points(loop) {
    double total = 0;
    for (size_t i = 0; i <= loop.size(); ++i) {
      part.push_back(total);
      total += std::sqrt(square_of(loop[(i + 1) % loop.size()] - loop[i % loop.size()]));
    }
    total = part.back();
    for (double& p : part) p /= total;
  }

  /// How far corner `steps` after `first` is from it: from 0 to 1.
  [[nodiscard]] double way(size_t first, size_t steps) const {
    const size_t n = points.size();
    if (steps == n) return 1;
    const double at = part[(first + steps) % n] - part[first];
    return at < 0 ? at + 1 : at;
  }

  const Shape2D::Loop& points;
  std::vector<double> part;  ///< one more than points: the last is 1
};

/// Calls step(on_first, i, j) for each triangle between two outlines that start in corners i0, j0:
/// corner i of the first and j of the second have been reached, and the step is on the one or the
/// other. It ends when `step` says so, by false.
template <class Step>
void walk_strip(const Outline& a, size_t i0, const Outline& b, size_t j0, Step step) {
  const size_t n = a.points.size(), m = b.points.size();
  size_t i = 0, j = 0;
  while (i < n || j < m) {
    const bool on_first =
        j == m || (i < n && a.way(i0, i + 1) + a.way(i0, i) <= b.way(j0, j + 1) + b.way(j0, j));
    if (!step(on_first, i, j)) return;
    (on_first ? i : j) += 1;
  }
}

/// The corners where the strip between two outlines begins: those that give the shortest walls,
/// the outlines laid on each other by their middles.
std::pair<size_t, size_t> best_start(const Outline& a, const Outline& b) {
  const glm::dvec2 shift = middle_of(b.points) - middle_of(a.points);
  const size_t n = a.points.size(), m = b.points.size();
  // Every corner of the one with the fewer is tried against all of the other, as long as that is
  // no more than some millions of steps; beyond it, every k-th.
  constexpr size_t kMostSteps = 4'000'000;
  const size_t work = n * m * (n + m);
  const size_t stride = 1 + static_cast<size_t>(std::sqrt(static_cast<double>(work / kMostSteps)));
  double best = std::numeric_limits<double>::infinity();
  std::pair<size_t, size_t> start{0, 0};
  for (size_t i0 = 0; i0 < n; i0 += stride) {
    for (size_t j0 = 0; j0 < m; j0 += stride) {
      double sum = 0;
      // A hair's difference is rounding, and must not decide.
      const double limit = best * (1 - 1e-9);
      walk_strip(a, i0, b, j0, [&](bool on_first, size_t i, size_t j) {
        const glm::dvec2 p = a.points[(i0 + i + (on_first ? 1 : 0)) % n];
        const glm::dvec2 q = b.points[(j0 + j + (on_first ? 0 : 1)) % m];
        sum += square_of(q - p - shift);
        return sum < limit;
      });
      if (sum < limit) {
        best = sum;
        start = {i0, j0};
      }
    }
  }
  return start;
}

/// For each of `from` the one of `to` whose middle is nearest, each taken once.
std::vector<uint32_t> pair_by_middles(const std::vector<glm::dvec2>& from,
                                      const std::vector<glm::dvec2>& to) {
  std::vector<uint32_t> partner(from.size());
  std::vector<bool> taken(to.size(), false);
  for (size_t i = 0; i < from.size(); ++i) {
    double best = std::numeric_limits<double>::infinity();
    for (uint32_t j = 0; j < to.size(); ++j) {
      if (taken[j] || !(square_of(to[j] - from[i]) < best)) continue;
      best = square_of(to[j] - from[i]);
      partner[i] = j;
    }
    taken[partner[i]] = true;
  }
  return partner;
}

/// For each loop of a shape its partner in the next one. Empty when they do not fit.
std::vector<uint32_t> pair_loops(const Shape2D& a, const Shape2D& b) {
  const auto middles = [](const Shape2D& shape, const std::vector<uint32_t>& loops) {
    std::vector<glm::dvec2> result;
    for (const uint32_t l : loops) result.push_back(middle_of(shape.loops()[l]));
    return result;
  };
  const auto outers = [](const Shape2D& shape) {
    std::vector<uint32_t> result;
    for (const Shape2D::Region& region : shape.regions()) result.push_back(region.outer);
    return result;
  };
  if (a.regions().size() != b.regions().size()) return {};
  std::vector<uint32_t> partner(a.loops().size());
  const auto regions = pair_by_middles(middles(a, outers(a)), middles(b, outers(b)));
  for (size_t r = 0; r < regions.size(); ++r) {
    const Shape2D::Region &p = a.regions()[r], &q = b.regions()[regions[r]];
    if (p.holes.size() != q.holes.size()) return {};
    partner[p.outer] = q.outer;
    const auto holes = pair_by_middles(middles(a, p.holes), middles(b, q.holes));
    for (size_t h = 0; h < holes.size(); ++h) partner[p.holes[h]] = q.holes[holes[h]];
  }
  return partner;
}

class Lofter {
 public:
  Lofter(const std::vector<LoftOutline>& outlines, const std::vector<double>& heights)
      : outlines_(outlines), heights_(heights) {}

  MeshResult build() {
    mesh_.kind = kLoft;
    for (size_t i = 0; i < outlines_.size(); ++i) add_level(i);
    for (size_t i = 0; i + 1 < outlines_.size(); ++i) {
      if (outlines_[i].point || outlines_[i + 1].point) {
        add_cone(i);
        continue;
      }
      const std::vector<uint32_t> partner = pair_loops(shape(i), shape(i + 1));
      if (partner.empty()) {
        return invalid_argument("loft: outlines " + std::to_string(i + 1) + " and " +
                                std::to_string(i + 2) +
                                " have not the same numbers of pieces and of holes");
      }
      for (uint32_t l = 0; l < partner.size(); ++l) add_strip(i, l, partner[l]);
    }
    add_cap(0, true);
    add_cap(outlines_.size() - 1, false);
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] const Shape2D& shape(size_t level) const { return outlines_[level].shape; }

  struct Level {
    Profile profile;
    std::vector<uint32_t> points;  ///< of the mesh, per point of the profile
  };

  void add_level(size_t i) {
    Level& level = levels_.emplace_back();
    if (const auto& apex = outlines_[i].point) {
      level.points.push_back(static_cast<uint32_t>(mesh_.points.size()));
      mesh_.points.emplace_back(apex->x, apex->y, heights_[i]);
      return;
    }
    level.profile = make_profile(shape(i), shape(i).loops());
    for (const glm::dvec2& p : level.profile.points) {
      level.points.push_back(static_cast<uint32_t>(mesh_.points.size()));
      mesh_.points.emplace_back(p.x, p.y, heights_[i]);
    }
  }

  [[nodiscard]] uint32_t corner(size_t level, uint32_t loop, size_t k) const {
    const std::vector<uint32_t>& indices = levels_[level].profile.loops[loop];
    return levels_[level].points[indices[k % indices.size()]];
  }

  /// From a level to the next, one of which is a point: pieces have it in common, and nothing else.
  void add_cone(size_t level) {
    const bool is_upwards = !outlines_[level].point;
    const size_t base = is_upwards ? level : level + 1;
    const uint32_t apex = levels_[is_upwards ? level + 1 : level].points[0];
    for (uint32_t l = 0; l < shape(base).loops().size(); ++l) {
      for (size_t k = 0; k < shape(base).loops()[l].size(); ++k) {
        const uint32_t p = corner(base, l, k), q = corner(base, l, k + 1);
        mesh_.add_face(std::array<uint32_t, 3>{is_upwards ? p : q, is_upwards ? q : p, apex}, 0);
      }
    }
  }

  void add_strip(size_t level, uint32_t lower, uint32_t upper) {
    const Outline a(shape(level).loops()[lower]), b(shape(level + 1).loops()[upper]);
    const auto [i0, j0] = best_start(a, b);
    const size_t first = i0, second = j0;
    walk_strip(a, first, b, second, [&](bool on_first, size_t i, size_t j) {
      const uint32_t p = corner(level, lower, first + i), q = corner(level + 1, upper, second + j);
      const uint32_t r =
          on_first ? corner(level, lower, first + i + 1) : corner(level + 1, upper, second + j + 1);
      mesh_.add_face(std::array<uint32_t, 3>{p, r, q}, 0);
      return true;
    });
  }

  void add_cap(size_t at, bool backwards) {
    for (const Shape2D::Region& region : shape(at).regions()) {
      std::vector<std::vector<uint32_t>> loops;
      auto add = [&](uint32_t l) {
        std::vector<uint32_t>& loop = loops.emplace_back();
        for (size_t k = 0; k < shape(at).loops()[l].size(); ++k) loop.push_back(corner(at, l, k));
        if (backwards) std::reverse(loop.begin(), loop.end());
      };
      add(region.outer);
      for (const uint32_t hole : region.holes) add(hole);
      add_face_with_holes(mesh_, loops);
    }
  }

  const std::vector<LoftOutline>& outlines_;
  const std::vector<double>& heights_;
  std::vector<Level> levels_;
  PolygonMesh mesh_;
};

}  // namespace

MeshResult loft_shapes(const std::vector<LoftOutline>& outlines,
                       const std::vector<double>& heights) {
  if (outlines.size() < 2) return invalid_argument("loft: needs at least two outlines");
  if (heights.size() != outlines.size()) {
    return invalid_argument("loft: " + std::to_string(outlines.size()) +
                            " outlines need as many heights, got " +
                            std::to_string(heights.size()));
  }
  double points = 0;
  for (size_t i = 0; i < outlines.size(); ++i) {
    const Shape2D& shape = outlines[i].shape;
    if (const auto& apex = outlines[i].point) {
      if (i > 0 && i + 1 < outlines.size()) {
        return invalid_argument(
            "loft: only the first or the last outline may be a point, not number " +
            std::to_string(i + 1));
      }
      if (i > 0 && outlines[i - 1].point)
        return invalid_argument("loft: needs an outline between two points");
      for (int k = 0; k < 2; ++k) {
        if (!std::isfinite((*apex)[k])) return not_finite(kLoft, "a point", (*apex)[k]);
      }
      points += 1;
    } else if (shape.empty()) {
      return invalid_argument("loft: outline " + std::to_string(i + 1) + " is empty");
    }
    if (!std::isfinite(heights[i])) return not_finite(kLoft, "a height", heights[i]);
    if (i > 0 && !(heights[i] > heights[i - 1])) {
      return invalid_argument("loft: heights must increase, got " + number_text(heights[i]) +
                              " after " + number_text(heights[i - 1]));
    }
    for (const Shape2D::Loop& loop : shape.loops()) points += static_cast<double>(loop.size());
  }
  if (points > kMostPoints) return too_many_points(kLoft, points, points);
  // Strips go by the parts of the way that corners are at, and begin at corners.
  std::vector<LoftOutline> lean = outlines;
  for (LoftOutline& outline : lean) outline.shape = without_noise_corners(outline.shape);
  return Lofter(lean, heights).build();
}

}  // namespace csgrun
