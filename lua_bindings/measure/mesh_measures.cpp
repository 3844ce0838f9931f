#include "lua_bindings/measure/mesh_measures.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include <csgrun/engine/exact_triangles.h>
#include <csgrun/export/write.h>

namespace csgrun {
namespace {

using Real = long double;  // 64 bits: differences of floats and their products are mostly exact

struct RealVector {
  Real x, y, z;
};

RealVector difference(const glm::dvec3& a, const glm::dvec3& b) {
  return {Real(a.x) - b.x, Real(a.y) - b.y, Real(a.z) - b.z};
}

RealVector cross(const RealVector& a, const RealVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Real dot(const RealVector& a, const RealVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// A side of a triangle: corner `slot % 3` to the next, of triangle `slot / 3`.
struct Side {
  uint32_t low, high, slot;
  bool forward;  // from low to high
};

class UnionFind {
 public:
  explicit UnionFind(size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  uint32_t find(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(uint32_t a, uint32_t b) { parent_[find(a)] = find(b); }
  size_t count_roots() const {
    size_t roots = 0;
    for (uint32_t i = 0; i < parent_.size(); ++i) roots += parent_[i] == i ? 1 : 0;
    return roots;
  }

 private:
  std::vector<uint32_t> parent_;
};

class Topology {
 public:
  explicit Topology(const TriangleMesh& mesh)
      : mesh_(mesh), partner_(3 * mesh.triangles.size(), UINT32_MAX) {
    std::vector<Side> sides;
    for (uint32_t slot = 0; slot < partner_.size(); ++slot) {
      const uint32_t a = from(slot), b = to(slot);
      sides.push_back({std::min(a, b), std::max(a, b), slot, a < b});
    }
    std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) {
      return std::tie(s.low, s.high, s.slot) < std::tie(t.low, t.high, t.slot);
    });
    for (size_t first = 0; first < sides.size();) {
      size_t last = first;
      while (last < sides.size() && sides[last].low == sides[first].low &&
             sides[last].high == sides[first].high)
        ++last;
      pair({sides.begin() + static_cast<ptrdiff_t>(first),
            sides.begin() + static_cast<ptrdiff_t>(last)});
      first = last;
    }
  }

  [[nodiscard]] bool closed() const { return closed_; }

  [[nodiscard]] size_t components() const {
    UnionFind faces(mesh_.triangles.size());
    for (uint32_t slot = 0; slot < partner_.size(); ++slot) {
      if (partner_[slot] != UINT32_MAX) faces.join(slot / 3, partner_[slot] / 3);
    }
    return faces.count_roots();
  }

  /// Fans of triangles around vertices.
  [[nodiscard]] size_t fans() const {
    UnionFind corners(partner_.size());
    for (uint32_t slot = 0; slot < partner_.size(); ++slot) {
      const uint32_t other = partner_[slot];
      if (other == UINT32_MAX) continue;
      corners.join(slot, next(other));  // the corner where this side starts is where the other ends
      corners.join(next(slot), other);
    }
    return corners.count_roots();
  }

 private:
  static uint32_t next(uint32_t slot) { return slot / 3 * 3 + (slot + 1) % 3; }
  [[nodiscard]] uint32_t from(uint32_t slot) const { return mesh_.triangles[slot / 3][slot % 3]; }
  [[nodiscard]] uint32_t to(uint32_t slot) const { return from(next(slot)); }
  [[nodiscard]] uint32_t apex(uint32_t slot) const { return from(next(next(slot))); }

  void join(uint32_t a, uint32_t b) {
    partner_[a] = b;
    partner_[b] = a;
  }

  void pair(std::vector<Side> sides) {
    const auto forward = static_cast<size_t>(
        std::count_if(sides.begin(), sides.end(), [](const Side& s) { return s.forward; }));
    if (sides[0].low == sides[0].high || 2 * forward != sides.size()) {
      closed_ = false;
      return;
    }
    if (sides.size() == 2) {
      join(sides[0].slot, sides[1].slot);
      return;
    }
    sort_around(sides);
    // Counter-clockwise about the edge, a forward side has solid before it and a backward one
    // behind it: a backward side and the next forward one enclose a wedge of solid.
    for (size_t i = 0; i < sides.size(); ++i) {
      if (sides[i].forward) continue;
      size_t depth = 1, k = i;
      while (depth > 0) {
        k = (k + 1) % sides.size();
        depth += sides[k].forward ? size_t(-1) : size_t(1);
      }
      join(sides[i].slot, sides[k].slot);
    }
  }

  /// By angle about the edge from low to high, starting at the first side; of equal angles the
  /// forward sides come first, so that what lies face to face is not joined.
  void sort_around(std::vector<Side>& sides) const {
    const glm::dvec3 &low = mesh_.points[sides[0].low], &high = mesh_.points[sides[0].high];
    const RealVector axis = difference(high, low);
    const RealVector u0 = difference(mesh_.points[apex(sides[0].slot)], low);
    const RealVector v = cross(axis, u0), u = cross(v, axis);
    const Real scale = std::sqrt(dot(axis, axis));
    std::vector<std::pair<Real, Side>> angles;
    for (const Side& side : sides) {
      const RealVector p = difference(mesh_.points[apex(side.slot)], low);
      Real angle = std::atan2(dot(p, v) * scale, dot(p, u));
      if (angle < 0) angle += 2 * std::acos(Real(-1));
      angles.emplace_back(angle, side);
    }
    std::sort(angles.begin(), angles.end(), [](const auto& a, const auto& b) {
      if (a.first != b.first) return a.first < b.first;
      return a.second.forward != b.second.forward ? a.second.forward
                                                  : a.second.slot < b.second.slot;
    });
    for (size_t i = 0; i < sides.size(); ++i) sides[i] = angles[i].second;
  }

  const TriangleMesh& mesh_;
  std::vector<uint32_t> partner_;
  bool closed_ = true;
};

/// In 64 bits with a running compensation (Neumaier 1974).
double surface_area(const TriangleMesh& mesh) {
  Real sum = 0, lost = 0;
  for (const auto& t : mesh.triangles) {
    const RealVector n = cross(difference(mesh.points[t[1]], mesh.points[t[0]]),
                               difference(mesh.points[t[2]], mesh.points[t[0]]));
    const Real term = std::sqrt(dot(n, n)) / 2;
    const Real next = sum + term;
    lost += std::abs(sum) >= std::abs(term) ? (sum - next) + term : (term - next) + sum;
    sum = next;
  }
  return static_cast<double>(sum + lost);
}

}  // namespace

PartMeasures measure(const TriangleMesh& mesh) {
  PartMeasures result;
  result.name = mesh.name;
  result.triangles = mesh.triangles.size();
  if (mesh.triangles.empty()) return result;
  const Topology topology(mesh);
  result.closed = topology.closed();
  result.vertices = topology.fans();
  result.volume = exact_volume(mesh.view());
  result.area = surface_area(mesh);
  result.bbox = {mesh.points[mesh.triangles[0][0]], mesh.points[mesh.triangles[0][0]]};
  for (const auto& triangle : mesh.triangles) {
    for (const uint32_t corner : triangle) {
      for (int axis = 0; axis < 3; ++axis) {
        result.bbox[0][axis] = std::min(result.bbox[0][axis], mesh.points[corner][axis]);
        result.bbox[1][axis] = std::max(result.bbox[1][axis], mesh.points[corner][axis]);
      }
    }
  }
  if (result.closed) {
    result.components = static_cast<int64_t>(topology.components());
    // Euler: V - E + F = 2 (components - genus), and 2 E = 3 F.
    const auto f = static_cast<int64_t>(result.triangles),
               v = static_cast<int64_t>(result.vertices);
    result.genus = result.components - (v - f / 2) / 2;
  }
  return result;
}

uint64_t count_degenerate(const TriangleMesh& mesh) {
  uint64_t count = 0;
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
    count += is_degenerate(mesh.view(), t) ? 1 : 0;
  return count;
}

uint64_t count_crossings(const TriangleMesh& mesh) {
  return find_crossings(mesh.view(), kMostCrossings).size();
}

}  // namespace csgrun
