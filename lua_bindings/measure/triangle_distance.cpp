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
  void add(const Box& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  [[nodiscard]] double distance(const Box& other) const {
    return glm::length(glm::max(glm::max(low - other.high, other.low - high), glm::dvec3(0)));
  }
};

class Tree {
 public:
  explicit Tree(const TriangleView& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    boxes_.resize(order_.size());
    for (const uint32_t t : order_) boxes_[t].add(corners_of(t));
    nodes_.reserve(order_.size());
    build(0, order_.size());
  }

  struct Node {
    Box box;
    size_t begin = 0, end = 0;  ///< of the order of triangles
    size_t second = 0;          ///< the first child follows its parent; 0: a leaf
    [[nodiscard]] bool is_leaf() const { return second == 0; }
    [[nodiscard]] size_t size() const { return end - begin; }
  };

  [[nodiscard]] const Node& node(size_t place) const { return nodes_[place]; }
  [[nodiscard]] Corners triangle(size_t i) const { return corners_of(order_[i]); }

 private:
  [[nodiscard]] Corners corners_of(size_t t) const {
    const auto& corners = mesh_.triangles[t];
    return {mesh_.points[corners[0]], mesh_.points[corners[1]], mesh_.points[corners[2]]};
  }

  size_t build(size_t begin, size_t end) {
    const size_t place = nodes_.size();
    nodes_.emplace_back();
    Box box;
    for (size_t i = begin; i < end; ++i) box.add(boxes_[order_[i]]);
    nodes_[place].box = box;
    nodes_[place].begin = begin;
    nodes_[place].end = end;
    if (end - begin <= kLeafSize) return place;
    const glm::dvec3 size = box.high - box.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto key = [&](uint32_t t) {
      return std::pair(boxes_[t].low[axis] + boxes_[t].high[axis], t);
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
  std::vector<Box> boxes_;  ///< of triangles
  std::vector<Node> nodes_;
};

/// The nearest points of what lies below two nodes, where they are nearer than the best so far.
class Nearest {
 public:
  Nearest(const Tree& a, const Tree& b) : a_(a), b_(b) {
    best_.length = std::numeric_limits<double>::infinity();
    pending_.push_back(pair(0, 0));
  }

  Distance run() {
    while (!pending_.empty()) {
      const Pair top = pending_.back();
      pending_.pop_back();
      if (top.distance >= best_.length) continue;
      if (gap_along(a_.node(top.a).box, b_.node(top.b).box) >= best_.length) continue;
      const Tree::Node &a = a_.node(top.a), &b = b_.node(top.b);
      if (a.is_leaf() && b.is_leaf()) {
        compare(a, b);
      } else if (b.is_leaf() || (!a.is_leaf() && a.size() >= b.size())) {
        push_nearer_last(pair(top.a + 1, top.b), pair(a.second, top.b));
      } else {
        push_nearer_last(pair(top.a, top.b + 1), pair(top.a, b.second));
      }
    }
    return best_;
  }

 private:
  struct Pair {
    size_t a, b;
    double distance;  ///< of their boxes
  };

  [[nodiscard]] Pair pair(size_t a, size_t b) const {
    return {a, b, a_.node(a).box.distance(b_.node(b).box)};
  }
  void push_nearer_last(const Pair& p, const Pair& q) {
    const bool p_is_nearer = p.distance <= q.distance;
    pending_.push_back(p_is_nearer ? q : p);
    pending_.push_back(p_is_nearer ? p : q);
  }
  void compare(const Tree::Node& a, const Tree::Node& b) {
    for (size_t i = a.begin; i < a.end; ++i) {
      const Corners corners = a_.triangle(i);
      for (size_t j = b.begin; j < b.end; ++j) {
        const Corners others = b_.triangle(j);
        if (gap_along(corners, others) >= best_.length) continue;
        const Distance found = triangle_distance(corners, others);
        if (!(found.length < best_.length)) continue;
        best_ = found;
        if (found.length > 0) direction_ = (found.to - found.from) / found.length;
      }
    }
  }

  /// How far one thing is behind another one along the way between the nearest points so far: it is
  /// no nearer than that. Of rounded bodies that face each other hardly any triangles are left.
  [[nodiscard]] double gap_along(const Corners& a, const Corners& b) const {
    double end = glm::dot(direction_, a[0]), begin = glm::dot(direction_, b[0]);
    for (int i = 1; i < 3; ++i) {
      end = std::max(end, glm::dot(direction_, a[i]));
      begin = std::min(begin, glm::dot(direction_, b[i]));
    }
    return begin - end;
  }
  [[nodiscard]] double gap_along(const Box& a, const Box& b) const {
    const glm::dvec3 between = (b.low - a.high) + (b.high - a.low);
    const glm::dvec3 extent = (a.high - a.low) + (b.high - b.low);
    return (glm::dot(direction_, between) - glm::dot(glm::abs(direction_), extent)) / 2;
  }

  const Tree &a_, &b_;
  std::vector<Pair> pending_;
  Distance best_;
  glm::dvec3 direction_{};  ///< from the nearest point of the first to that of the second
};

}  // namespace

Distance surface_distance(const TriangleView& a, const TriangleView& b) {
  return Nearest(Tree(a), Tree(b)).run();
}

}  // namespace csgrun
