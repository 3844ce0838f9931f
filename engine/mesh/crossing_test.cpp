#include "engine/mesh/crossing_test.h"

#include <algorithm>
#include <cmath>

namespace csgrun {

CrossingTest::QuickPlane::QuickPlane(const TriangleCorners& t) : origin_(t[0]) {
  const auto is_tiny = [](double x) { return x != 0 && std::fabs(x) < 0x1p-400; };
  const glm::dvec3 u = t[1] - t[0], v = t[2] - t[0];
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double plus = u[i] * v[j], minus = u[j] * v[i];
    normal_[k] = plus - minus;
    size_[k] = std::fabs(plus) + std::fabs(minus);
    if (is_tiny(u[k]) || is_tiny(v[k])) size_[k] = HUGE_VAL;
  }
}

// With e = 2^-53: sides and the way to the point are off by e of them each, so products of the
// normal by less than 4 e of theirs, those with the way by 2 e more, and sums by 4 e: less than
// 16 e of all sizes. (Digits that tiny sides would lose are not looked at, those that products with
// the way lose are below the rest.)
int CrossingTest::QuickPlane::side(const glm::dvec3& p) const {
  const glm::dvec3 way = p - origin_;
  const double value = normal_.x * way.x + normal_.y * way.y + normal_.z * way.z;
  const double bound = 0x1p-49 * (size_.x * std::fabs(way.x) + size_.y * std::fabs(way.y) +
                                  size_.z * std::fabs(way.z)) +
                       0x1p-1000;
  return value > bound ? 1 : value < -bound ? -1 : 0;
}

CrossingTest::CrossingTest(const TriangleView& mesh) : p_(mesh.points), triangles_(mesh.triangles) {
  views_.reserve(triangles_.size());
  planes_.reserve(triangles_.size());
  for (uint32_t t = 0; t < triangles_.size(); ++t) {
    views_.push_back(aspect_of(corners_of(mesh, t)));
    planes_.emplace_back(corners_of(mesh, t));
  }
}

void CrossingTest::renew(const TriangleView& mesh, uint32_t triangle) {
  views_[triangle] = aspect_of(corners_of(mesh, triangle));
  planes_[triangle] = QuickPlane(corners_of(mesh, triangle));
}

CrossingTest::Meeting CrossingTest::crossing(uint32_t first, uint32_t second) const {
  const Triangle &s = triangles_[first], &t = triangles_[second];
  size_t shared = 0;
  std::array<bool, 3> in_s{}, in_t{};
  for (size_t i = 0; i < 3; ++i) {
    for (size_t k = 0; k < 3; ++k) {
      if (s[i] != t[k]) continue;
      in_s[i] = in_t[k] = true;
      ++shared;
    }
  }
  if (shared < 3 && (is_clear_of(s, in_s, second) || is_clear_of(t, in_t, first))) return {};
  switch (shared) {
    case 0:
      return without_common_corner(first, second);
    case 1:
      return beyond_corner(first, index_of(in_s, true), second, index_of(in_t, true));
    case 2:
      return beyond_edge(first, index_of(in_s, false), second, index_of(in_t, false));
    default:
      return middle(s);  // one upon the other
  }
}

size_t CrossingTest::index_of(const std::array<bool, 3>& flags, bool value) {
  return static_cast<size_t>(std::find(flags.begin(), flags.end(), value) - flags.begin());
}

glm::dvec3 CrossingTest::middle(const Triangle& t) const {
  return p_[t[0]] / 3.0 + p_[t[1]] / 3.0 + p_[t[2]] / 3.0;
}

bool CrossingTest::is_clear_of(const Triangle& t, const std::array<bool, 3>& is_shared,
                               uint32_t other) const {
  int all = 0;
  for (size_t i = 0; i < 3; ++i) {
    if (is_shared[i]) continue;
    const int side = planes_[other].side(p_[t[i]]);
    if (side == 0 || side == -all) return false;
    all = side;
  }
  return true;
}

int CrossingTest::side(const Triangle& t, uint32_t point) const {
  return orient(p_[t[0]], p_[t[1]], p_[t[2]], p_[point]);
}

bool CrossingTest::contains(uint32_t triangle, uint32_t point) const {
  const Triangle& t = triangles_[triangle];
  const TriangleAspect& view = views_[triangle];
  for (size_t i = 0; i < 3; ++i) {
    if (orient_along(view.axis, p_[t[i]], p_[t[(i + 1) % 3]], p_[point]) == -view.sign)
      return false;
  }
  return true;
}

CrossingTest::Meeting CrossingTest::segments_meet(int axis, uint32_t a, uint32_t b, uint32_t c,
                                                  uint32_t d) const {
  const auto turn = [&](uint32_t i, uint32_t j, uint32_t k) {
    return orient_along(axis, p_[i], p_[j], p_[k]);
  };
  const int abc = turn(a, b, c), abd = turn(a, b, d);
  if (abc == 0 && abd == 0) return collinear_meet(a, b, c, d);
  if (abc * abd > 0 || turn(c, d, a) * turn(c, d, b) > 0) return {};
  // Where d and c lie on different sides of the line a b, in proportion to their distances.
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto distance = [&](uint32_t k) {
    return (p_[b][u] - p_[a][u]) * (p_[k][v] - p_[a][v]) -
           (p_[b][v] - p_[a][v]) * (p_[k][u] - p_[a][u]);
  };
  return between(c, distance(c), d, distance(d));
}

CrossingTest::Meeting CrossingTest::collinear_meet(uint32_t a, uint32_t b, uint32_t c,
                                                   uint32_t d) const {
  const auto in_box = [&](uint32_t end, uint32_t from, uint32_t to) {
    bool inside = true;
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(p_[from][k], p_[to][k]);
      inside = inside && low <= p_[end][k] && p_[end][k] <= high;
    }
    return inside;
  };
  for (const uint32_t end : {a, b}) {
    if (in_box(end, c, d)) return p_[end];
  }
  for (const uint32_t end : {c, d}) {
    if (in_box(end, a, b)) return p_[end];
  }
  return {};
}

glm::dvec3 CrossingTest::between(uint32_t a, double at_a, uint32_t b, double at_b) const {
  const double sum = std::abs(at_a) + std::abs(at_b);
  const double part = sum > 0 ? std::abs(at_a) / sum : 0.5;
  return p_[a] * (1 - part) + p_[b] * part;
}

CrossingTest::Meeting CrossingTest::segment_meets(uint32_t a, uint32_t b, uint32_t triangle) const {
  const Triangle& t = triangles_[triangle];
  const int side_a = side(t, a), side_b = side(t, b);
  if (side_a * side_b > 0) return {};
  if (side_a == 0 && side_b == 0) return segment_meets_in_plane(a, b, triangle);
  if (side_a == 0 || side_b == 0) {
    const uint32_t end = side_a == 0 ? a : b;
    return contains(triangle, end) ? Meeting(p_[end]) : Meeting();
  }
  int least = 0, most = 0;
  for (size_t i = 0; i < 3; ++i) {
    const int turn = orient(p_[a], p_[b], p_[t[i]], p_[t[(i + 1) % 3]]);
    least = std::min(least, turn);
    most = std::max(most, turn);
  }
  if (least * most != 0) return {};
  const glm::dvec3 u = p_[t[1]] - p_[t[0]], v = p_[t[2]] - p_[t[0]];
  const auto distance = [&](uint32_t k) {
    const glm::dvec3 w = p_[k] - p_[t[0]];
    return u.x * (v.y * w.z - v.z * w.y) + u.y * (v.z * w.x - v.x * w.z) +
           u.z * (v.x * w.y - v.y * w.x);
  };
  return between(a, distance(a), b, distance(b));
}

CrossingTest::Meeting CrossingTest::segment_meets_in_plane(uint32_t a, uint32_t b,
                                                           uint32_t triangle) const {
  for (const uint32_t end : {a, b}) {
    if (contains(triangle, end)) return p_[end];
  }
  const Triangle& t = triangles_[triangle];
  for (size_t i = 0; i < 3; ++i) {
    if (const Meeting meeting = segments_meet(views_[triangle].axis, a, b, t[i], t[(i + 1) % 3])) {
      return meeting;
    }
  }
  return {};
}

CrossingTest::Meeting CrossingTest::without_common_corner(uint32_t first, uint32_t second) const {
  const Triangle &s = triangles_[first], &t = triangles_[second];
  if (is_apart(s, t) || is_apart(t, s)) return {};
  // What two triangles have in common ends on a side of one of them.
  for (size_t i = 0; i < 3; ++i) {
    if (const Meeting meeting = segment_meets(s[i], s[(i + 1) % 3], second)) return meeting;
    if (const Meeting meeting = segment_meets(t[i], t[(i + 1) % 3], first)) return meeting;
  }
  return {};
}

bool CrossingTest::is_apart(const Triangle& s, const Triangle& t) const {
  const int side_0 = side(t, s[0]);
  return side_0 != 0 && side(t, s[1]) == side_0 && side(t, s[2]) == side_0;
}

CrossingTest::Meeting CrossingTest::beyond_corner(uint32_t first, size_t s_at, uint32_t second,
                                                  size_t t_at) const {
  const Triangle &s = triangles_[first], &t = triangles_[second];
  const Meeting meeting = segment_meets(s[(s_at + 1) % 3], s[(s_at + 2) % 3], second);
  return meeting ? meeting : segment_meets(t[(t_at + 1) % 3], t[(t_at + 2) % 3], first);
}

CrossingTest::Meeting CrossingTest::beyond_edge(uint32_t first, size_t s_at, uint32_t second,
                                                size_t t_at) const {
  const Triangle &s = triangles_[first], &t = triangles_[second];
  if (side(s, t[t_at]) != 0) return {};
  const int axis = views_[first].axis;
  const uint32_t a = s[(s_at + 1) % 3], b = s[(s_at + 2) % 3];
  if (orient_along(axis, p_[a], p_[b], p_[s[s_at]]) !=
      orient_along(axis, p_[a], p_[b], p_[t[t_at]])) {
    return {};
  }
  return p_[a] / 2.0 + p_[b] / 2.0;
}

}  // namespace csgrun
