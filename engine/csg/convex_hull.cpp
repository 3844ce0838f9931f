#include "engine/csg/convex_hull.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

#include "engine/base/none.h"
#include "engine/csg/grid.h"
#include "engine/csg/wide_cross.h"
#include "engine/exact/fixed_int.h"
#include "engine/mesh/opposite_edges.h"

namespace csgrun {
namespace {

/// A triangle, counter-clockwise from outside. Neighbour i lies beyond the edge from corner i.
struct Triangle {
  std::array<uint32_t, 3> corner{};
  std::array<uint32_t, 3> neighbour{};
  Vec128 normal{};
  std::array<double, 3> rough_normal{};
  std::vector<uint32_t> outside;  ///< points in front of it that no other triangle has
  bool is_gone = false;
};

class Hull {
 public:
  explicit Hull(std::vector<IVec3> points) : points_(std::move(points)) {}

  /// False when the points lie in one plane.
  bool build();
  [[nodiscard]] LeafGeometry faces() const;

 private:
  struct HorizonEdge {
    uint32_t from, to, beyond;
  };

  /// Where a point is: its distance times the length of the normal, with the right sign.
  [[nodiscard]] double height(const Triangle& t, uint32_t p) const;
  uint32_t add(uint32_t a, uint32_t b, uint32_t c);
  bool find_simplex(std::array<uint32_t, 4>& simplex) const;
  void give(uint32_t triangle, uint32_t point);
  void distribute(const std::vector<uint32_t>& orphans, size_t first);
  void insert(uint32_t triangle);
  void find_horizon(uint32_t start, uint32_t p);

  std::vector<IVec3> points_;
  std::vector<Triangle> triangles_;
  std::vector<uint32_t> work_;     // triangles that may have points in front
  std::vector<uint32_t> visible_;  // of the point that is inserted
  std::vector<HorizonEdge> horizon_;
  std::vector<uint32_t> mark_;    // per triangle: the point that saw it last
  std::vector<uint32_t> leaves_;  // per point: the new triangle whose horizon edge leaves it
};

double Hull::height(const Triangle& t, uint32_t p) const {
  const IVec3& origin = points_[t.corner[0]];
  const IVec3& q = points_[p];
  double value = 0, bound = 0;
  for (int i = 0; i < 3; ++i) {
    // The difference is exact; the coefficient is rounded, and so is the product.
    const double term = t.rough_normal[i] * static_cast<double>(q[i] - origin[i]);
    value += term;
    bound += std::fabs(term);
  }
  if (std::fabs(value) > 0x1p-50 * bound) return value;
  Int128 exact = 0;
  for (int i = 0; i < 3; ++i) exact += t.normal[i] * (q[i] - origin[i]);
  return static_cast<double>(exact);
}

uint32_t Hull::add(uint32_t a, uint32_t b, uint32_t c) {
  Triangle t;
  t.corner = {a, b, c};
  t.normal = cross(points_[a], points_[b], points_[c]);
  for (int i = 0; i < 3; ++i) t.rough_normal[i] = static_cast<double>(t.normal[i]);
  triangles_.push_back(std::move(t));
  mark_.push_back(kNone);
  return static_cast<uint32_t>(triangles_.size() - 1);
}

/// Four points that do not lie in one plane: far from one another, so that few others stay outside.
bool Hull::find_simplex(std::array<uint32_t, 4>& simplex) const {
  if (points_.size() < 4) return false;
  const auto count = static_cast<uint32_t>(points_.size());
  // Points are sorted: the first and the last are extreme.
  simplex[0] = 0;
  simplex[1] = count - 1;
  double farthest = 0;
  bool found = false;
  for (uint32_t p = 1; p + 1 < count; ++p) {
    const Vec128 normal = cross(points_[simplex[0]], points_[simplex[1]], points_[p]);
    if (is_zero(normal)) continue;
    double size = 0;
    for (const Int128 x : normal) size += static_cast<double>(x) * static_cast<double>(x);
    if (found && !(size > farthest)) continue;
    found = true;
    farthest = size;
    simplex[2] = p;
  }
  if (!found) return false;
  Triangle base;
  base.corner = {simplex[0], simplex[1], simplex[2]};
  base.normal = cross(points_[simplex[0]], points_[simplex[1]], points_[simplex[2]]);
  for (int i = 0; i < 3; ++i) base.rough_normal[i] = static_cast<double>(base.normal[i]);
  farthest = 0;
  for (uint32_t p = 0; p < count; ++p) {
    const double h = height(base, p);
    if (std::fabs(h) <= std::fabs(farthest)) continue;
    farthest = h;
    simplex[3] = p;
  }
  if (farthest > 0) std::swap(simplex[1], simplex[2]);  // the fourth is behind the other three
  return farthest != 0;
}

void Hull::give(uint32_t triangle, uint32_t point) {
  std::vector<uint32_t>& outside = triangles_[triangle].outside;
  if (outside.empty()) work_.push_back(triangle);
  outside.push_back(point);
}

/// Gives each point to the first of the triangles from `first` on that sees it.
void Hull::distribute(const std::vector<uint32_t>& orphans, size_t first) {
  for (const uint32_t p : orphans) {
    for (size_t t = first; t < triangles_.size(); ++t) {
      if (height(triangles_[t], p) > 0) {
        give(static_cast<uint32_t>(t), p);
        break;
      }
    }
  }
}

bool Hull::build() {
  std::array<uint32_t, 4> s{};
  if (!find_simplex(s)) return false;
  leaves_.assign(points_.size(), kNone);
  const uint32_t base = add(s[0], s[1], s[2]);
  for (int i = 0; i < 3; ++i) {
    const uint32_t side = add(s[(i + 1) % 3], s[i], s[3]);
    triangles_[base].neighbour[i] = side;
    triangles_[side].neighbour = {base, 1 + static_cast<uint32_t>(i + 2) % 3,
                                  1 + static_cast<uint32_t>(i + 1) % 3};
  }
  std::vector<uint32_t> others;
  for (uint32_t p = 0; p < points_.size(); ++p) {
    if (std::find(s.begin(), s.end(), p) == s.end()) others.push_back(p);
  }
  distribute(others, 0);
  while (!work_.empty()) {
    const uint32_t triangle = work_.back();
    work_.pop_back();
    if (!triangles_[triangle].is_gone) insert(triangle);
  }
  return true;
}

/// The triangles that see a point, from one of them on, and the edges around them.
void Hull::find_horizon(uint32_t start, uint32_t p) {
  visible_.assign(1, start);
  horizon_.clear();
  mark_[start] = p;
  for (size_t i = 0; i < visible_.size(); ++i) {
    const Triangle& t = triangles_[visible_[i]];
    for (int k = 0; k < 3; ++k) {
      const uint32_t beyond = t.neighbour[k];
      if (mark_[beyond] == p) continue;
      if (height(triangles_[beyond], p) > 0) {
        mark_[beyond] = p;
        visible_.push_back(beyond);
      } else {
        horizon_.push_back({t.corner[k], t.corner[(k + 1) % 3], beyond});
      }
    }
  }
}

/// Adds the farthest of the points in front of a triangle.
void Hull::insert(uint32_t triangle) {
  uint32_t p = kNone;
  double farthest = 0;
  for (const uint32_t candidate : triangles_[triangle].outside) {
    const double h = height(triangles_[triangle], candidate);
    if (h > farthest) {
      farthest = h;
      p = candidate;
    }
  }
  find_horizon(triangle, p);
  const size_t first = triangles_.size();
  for (const HorizonEdge& edge : horizon_) {
    const uint32_t made = add(edge.from, edge.to, p);
    leaves_[edge.from] = made;
    triangles_[made].neighbour[0] = edge.beyond;
    Triangle& beyond = triangles_[edge.beyond];
    for (int k = 0; k < 3; ++k) {
      if (beyond.corner[k] == edge.to && beyond.corner[(k + 1) % 3] == edge.from) {
        beyond.neighbour[k] = made;
      }
    }
  }
  for (size_t t = first; t < triangles_.size(); ++t) {
    const uint32_t next = leaves_[triangles_[t].corner[1]];
    triangles_[t].neighbour[1] = next;
    triangles_[next].neighbour[2] = static_cast<uint32_t>(t);
  }
  std::vector<uint32_t> orphans;
  for (const uint32_t t : visible_) {
    for (const uint32_t q : triangles_[t].outside) {
      if (q != p) orphans.push_back(q);
    }
    triangles_[t].is_gone = true;
    std::vector<uint32_t>().swap(triangles_[t].outside);
  }
  distribute(orphans, first);
}

/// Triangles of one plane as one polygon each.
LeafGeometry Hull::faces() const {
  std::vector<uint32_t> face_of(triangles_.size(), kNone);
  std::vector<uint32_t> next(points_.size(), kNone);  // around the face at hand
  std::vector<uint32_t> number(points_.size(), kNone), loop, group;
  LeafGeometry leaf;
  for (uint32_t start = 0; start < triangles_.size(); ++start) {
    if (triangles_[start].is_gone || face_of[start] != kNone) continue;
    const auto face = static_cast<uint32_t>(leaf.face_count());
    group.assign(1, start);
    face_of[start] = face;
    uint32_t corner = kNone;
    for (size_t i = 0; i < group.size(); ++i) {
      const Triangle& t = triangles_[group[i]];
      for (int k = 0; k < 3; ++k) {
        const Triangle& other = triangles_[t.neighbour[k]];
        bool is_coplanar = true;
        for (const uint32_t c : other.corner) {
          is_coplanar = is_coplanar && height(triangles_[start], c) == 0;
        }
        if (!is_coplanar) {
          corner = t.corner[k];
          next[corner] = t.corner[(k + 1) % 3];
        } else if (face_of[t.neighbour[k]] == kNone) {
          face_of[t.neighbour[k]] = face;
          group.push_back(t.neighbour[k]);
        }
      }
    }
    loop.clear();
    for (uint32_t c = corner; loop.empty() || c != corner; c = next[c]) loop.push_back(c);
    const size_t n = loop.size();
    for (size_t i = 0; i < n; ++i) {
      const uint32_t c = loop[i];
      if (is_zero(cross(points_[loop[(i + n - 1) % n]], points_[c], points_[loop[(i + 1) % n]])))
        continue;
      if (number[c] == kNone) {
        number[c] = static_cast<uint32_t>(leaf.vertices.size());
        leaf.vertices.push_back(points_[c]);
      }
      leaf.corners.push_back(number[c]);
    }
    leaf.face_starts.push_back(static_cast<uint32_t>(leaf.corners.size()));
  }
  leaf.opposite = pair_edges(leaf).opposite;
  leaf.convex = leaf.has_single_fans = true;
  leaf.may_touch = false;
  return leaf;
}

}  // namespace

LeafGeometry convex_hull(std::span<const IVec3> points) {
  std::vector<IVec3> sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  assert(std::all_of(sorted.begin(), sorted.end(), [](const IVec3& p) {
    return std::all_of(p.begin(), p.end(), [](int64_t x) { return std::abs(x) < kFarLimit; });
  }));
  Hull hull(std::move(sorted));
  if (!hull.build()) return {};
  return hull.faces();
}

}  // namespace csgrun
