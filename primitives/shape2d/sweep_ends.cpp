#include "primitives/shape2d/sweep_ends.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace csgrun {
namespace {

bool is_across_axis(const glm::dvec3& direction) {
  constexpr double kNoise = 1e-12;
  int across = 0;
  for (int k = 0; k < 3; ++k) across += std::fabs(direction[k]) < kNoise ? 1 : 0;
  return across == 2;
}

/// Axes across a direction that depend on it alone, also on which way it goes: ends that meet there
/// are in the same frame, whatever the sweeps do elsewhere.
struct Axes {
  glm::dvec3 x, y, z;
  double outwards;  ///< along z: 1 or -1

  explicit Axes(const glm::dvec3& direction) {
    int most = 0, least = 0;
    for (int k = 1; k < 3; ++k) {
      if (std::fabs(direction[k]) > std::fabs(direction[most])) most = k;
      if (std::fabs(direction[k]) < std::fabs(direction[least])) least = k;
    }
    outwards = direction[most] > 0 ? 1 : -1;
    z = direction * outwards;
    y = -z * z[least];
    y[least] += 1;
    y /= glm::length(y);
    x = glm::cross(y, z);
  }

  /// Along x and y, and outwards.
  [[nodiscard]] glm::dvec3 local(const glm::dvec3& v) const {
    return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z) * outwards};
  }
};

struct Box {
  glm::dvec3 lo{std::numeric_limits<double>::infinity()}, hi{-lo};

  void add(const glm::dvec3& p) {
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  }
  [[nodiscard]] bool meets(const Box& o) const {
    bool meets = true;
    for (int k = 0; k < 3; ++k) meets = meets && lo[k] <= o.hi[k] && o.lo[k] <= hi[k];
    return meets;
  }
};

/// Twice how far a corner of a ring lies from the middle of all.
double size_of(const SweepRings& sweep, const std::vector<uint32_t>& ring) {
  glm::dvec3 middle(0);
  for (const uint32_t corner : ring) middle += sweep.points[corner];
  middle /= static_cast<double>(ring.size());
  double square = 0;
  for (const uint32_t corner : ring) {
    const glm::dvec3 way = sweep.points[corner] - middle;
    square = std::max(square, glm::dot(way, way));
  }
  return 2 * std::sqrt(square);
}

/// By how much of their length walls go on where there is room. The wider, the farther from its
/// corners is where the seam of a wall's two triangles meets the end; walls that are not flat have
/// a corner there that is off the line. No matter of the outline: walls that two sweeps have in
/// common stay so.
double most_beyond(bool has_flat_walls) { return has_flat_walls ? 1.0 / 8 : 1.0 / 256; }

class SweepEndCutter {
 public:
  SweepEndCutter(const SweepRings& sweep, const SweepEnd& end)
      : sweep_(sweep),
        end_(end),
        axes_(end.outwards),
        pieces_(sweep.rings.size() - 1),
        own_(sweep.rings[end.is_last ? pieces_ : 0]),
        before_(sweep.rings[end.is_last ? pieces_ - 1 : 1]) {}

  std::optional<CutEnd> run() {
    const bool is_before_behind = std::all_of(before_.begin(), before_.end(),
                                              [&](uint32_t corner) { return local(corner).z < 0; });
    if (!is_before_behind) return std::nullopt;
    const std::vector<uint32_t>&other = sweep_.rings[end_.is_last ? 0 : pieces_],
          &inside = sweep_.rings[end_.is_last ? 1 : pieces_ - 1];
    double beyond = most_beyond(end_.has_flat_walls);
    constexpr int kTries = 3;
    for (int i = 0; i < kTries; ++i, beyond /= 8) {
      const Box cut = box_beyond(beyond);
      // What goes on at the other end is taken off there, but is not to cross this.
      if (is_free(cut) && !comes_into(cut, inside, other, 1, 1 + beyond))
        return cut_with(beyond, cut);
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] glm::dvec3 local(uint32_t corner) const {
    return axes_.local(sweep_.points[corner] - end_.at);
  }

  /// From the end on, around the walls that go on.
  [[nodiscard]] Box box_beyond(double beyond) const {
    Box box;
    for (size_t k = 0; k < own_.size(); ++k) {
      const glm::dvec3 p = local(own_[k]);
      box.add(p);
      box.add(beyond_end(p, local(before_[k]), beyond));
    }
    const double margin = size_of(sweep_, own_) / 64;
    box.lo -= margin;
    box.hi += margin;
    box.lo.z = 0;
    return box;
  }

  /// Whether no other piece of the sweep comes into a box.
  [[nodiscard]] bool is_free(const Box& box) const {
    for (size_t i = 0; i < pieces_; ++i) {
      if (i == (end_.is_last ? pieces_ - 1 : 0)) continue;
      if (comes_into(box, sweep_.rings[i], sweep_.rings[i + 1], 0, 1)) return false;
    }
    return true;
  }

  /// Whether walls between two rings do, from one part of the way to another.
  [[nodiscard]] bool comes_into(const Box& box, const std::vector<uint32_t>& from,
                                const std::vector<uint32_t>& to, double begin, double end) const {
    Box all;
    for (size_t k = 0; k < from.size(); ++k) {
      const glm::dvec3 p = local(from[k]), way = local(to[k]) - p;
      all.add(p + way * begin);
      all.add(p + way * end);
    }
    if (!all.meets(box)) return false;
    // A long piece aslant is in few places of its box.
    constexpr int kParts = 16;
    const double step = (end - begin) / kParts;
    for (int part = 0; part < kParts; ++part) {
      Box own;
      for (size_t k = 0; k < from.size(); ++k) {
        const glm::dvec3 p = local(from[k]), way = local(to[k]) - p;
        own.add(p + way * (begin + part * step));
        own.add(p + way * (begin + (part + 1) * step));
      }
      if (own.meets(box)) return true;
    }
    return false;
  }

  [[nodiscard]] CutEnd cut_with(double beyond, const Box& box) const {
    CutEnd result{beyond, {}, {}};
    PolygonMesh& tool = result.tool;
    for (const double z : {0.0, box.hi.z * axes_.outwards}) {
      for (const double y : {box.lo.y, box.hi.y}) {
        for (const double x : {box.lo.x, box.hi.x}) tool.points.emplace_back(x, y, z);
      }
    }
    tool.hull_of_points = true;
    for (int k = 0; k < 3; ++k) {
      result.map.m[k] = {axes_.x[k], axes_.y[k], axes_.z[k], end_.at[k]};
    }
    return result;
  }

  const SweepRings& sweep_;
  const SweepEnd& end_;
  const Axes axes_;
  const size_t pieces_;
  const std::vector<uint32_t>&own_, &before_;
};

}  // namespace

std::optional<CutEnd> cut_end(const SweepRings& sweep, const SweepEnd& end) {
  if (is_across_axis(end.outwards)) return std::nullopt;
  return SweepEndCutter(sweep, end).run();
}

}  // namespace csgrun
