#include "lua_bindings/measure/triangle_distance.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace csgrun {
namespace {

using Corners = std::array<glm::dvec3, 3>;

constexpr size_t kLeafSize = 4;

Distance between(const glm::dvec3& p, const glm::dvec3& q) { return {glm::length(q - p), p, q}; }

void keep_nearer(Distance& best, const Distance& other) {
  if (other.length < best.length) best = other;
}

/// Of two segments. Ericson, Real-Time Collision Detection (2005), 5.1.9.
Distance segment_distance(const glm::dvec3& p, const glm::dvec3& p2, const glm::dvec3& q,
                          const glm::dvec3& q2) {
  const glm::dvec3 d = p2 - p, e = q2 - q, r = p - q;
  const double a = glm::dot(d, d), b = glm::dot(d, e), c = glm::dot(e, e);
  const double f = glm::dot(e, r), g = glm::dot(d, r), det = a * c - b * b;
  double s = det > 0 ? glm::clamp((b * f - g * c) / det, 0.0, 1.0) : 0;
  double t = c > 0 ? (b * s + f) / c : 0;
  if (t < 0) {
    t = 0;
    s = a > 0 ? glm::clamp(-g / a, 0.0, 1.0) : 0;
  } else if (t > 1) {
    t = 1;
    s = a > 0 ? glm::clamp((b - g) / a, 0.0, 1.0) : 0;
  }
  return between(p + s * d, q + t * e);
}

/// Of a point and the inside of a triangle: where the point is beside it, edges are nearer anyway.
Distance point_distance(const glm::dvec3& p, const Corners& t) {
  const glm::dvec3 n = glm::cross(t[1] - t[0], t[2] - t[0]);
  const double square = glm::dot(n, n);
  if (!(square > 0)) return between(p, t[0]);
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 &a = t[i], &b = t[(i + 1) % 3];
    if (glm::dot(glm::cross(b - a, p - a), n) < 0) return between(p, a);
  }
  return between(p, p - n * (glm::dot(p - t[0], n) / square));
}

Distance triangle_distance(const Corners& a, const Corners& b) {
  Distance best = between(a[0], b[0]);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      keep_nearer(best, segment_distance(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]));
    keep_nearer(best, point_distance(a[i], b));
    const Distance back = point_distance(b[i], a);
    keep_nearer(best, {back.length, back.to, back.from});
  }
  return best;
}

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};
  void add(const Corners& corners) {
    for (const glm::dvec3& p : corners) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  [[nodiscard]] double distance(const Box& other) const {
    return glm::length(glm::max(glm::max(low - other.high, other.low - high), glm::dvec3(0)));
  }
};

class Tree {
 public:
  explicit Tree(const TriangleView& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    build(0, order_.size());
  }

  void nearest(const Corners& corners, Distance& best) const {
    Box box;
    box.add(corners);
    std::vector<size_t> pending{0};
    while (!pending.empty()) {
      const Node& node = nodes_[pending.back()];
      pending.pop_back();
      if (node.box.distance(box) >= best.length) continue;
      if (node.second == 0) {
        for (size_t i = node.begin; i < node.end; ++i)
          keep_nearer(best, triangle_distance(corners, corners_of(mesh_, order_[i])));
        continue;
      }
      const size_t first = static_cast<size_t>(&node - nodes_.data()) + 1;
      const bool first_is_nearer =
          nodes_[first].box.distance(box) <= nodes_[node.second].box.distance(box);
      pending.push_back(first_is_nearer ? node.second : first);
      pending.push_back(first_is_nearer ? first : node.second);
    }
  }

  static Corners corners_of(const TriangleView& mesh, size_t t) {
    const auto& corners = mesh.triangles[t];
    return {mesh.points[corners[0]], mesh.points[corners[1]], mesh.points[corners[2]]};
  }

 private:
  struct Node {
    Box box;
    size_t begin = 0, end = 0;
    size_t second = 0;  ///< the first child follows its parent; 0: a leaf
  };

  size_t build(size_t begin, size_t end) {
    const size_t place = nodes_.size();
    nodes_.emplace_back();
    Box box;
    for (size_t i = begin; i < end; ++i) box.add(corners_of(mesh_, order_[i]));
    nodes_[place].box = box;
    nodes_[place].begin = begin;
    nodes_[place].end = end;
    if (end - begin <= kLeafSize) return place;
    const glm::dvec3 size = box.high - box.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto key = [&](uint32_t t) {
      const Corners c = corners_of(mesh_, t);
      return std::pair(c[0][axis] + c[1][axis] + c[2][axis], t);
    };
    const size_t middle = begin + (end - begin) / 2;
    const auto at = [&](size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end),
                     [&](uint32_t s, uint32_t t) { return key(s) < key(t); });
    build(begin, middle);
    const size_t second = build(middle, end);
    nodes_[place].second = second;
    return place;
  }

  const TriangleView& mesh_;
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace

Distance surface_distance(const TriangleView& a, const TriangleView& b) {
  const Tree tree(b);
  Distance best;
  best.length = std::numeric_limits<double>::infinity();
  for (size_t t = 0; t < a.triangles.size(); ++t) tree.nearest(Tree::corners_of(a, t), best);
  return best;
}

}  // namespace csgrun
