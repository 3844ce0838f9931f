// Where a triangle mesh over doubles crosses itself: a tree of boxes finds the pairs that may, and
// signs of determinants decide.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>

#include <csgrun/engine/exact_triangles.h>

#include "engine/base/parallel.h"
#include "engine/mesh/box_frame.h"
#include "engine/mesh/box_tree.h"
#include "engine/mesh/triangle_shape.h"

namespace csgrun {
namespace {

using Triangle = std::array<uint32_t, 3>;

/// The plane of a triangle, that tells quickly on which side of it most points are.
class QuickPlane {
 public:
  explicit QuickPlane(const std::array<glm::dvec3, 3>& t) : origin_(t[0]) {
    const glm::dvec3 u = t[1] - t[0], v = t[2] - t[0];
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const double plus = u[i] * v[j], minus = u[j] * v[i];
      normal_[k] = plus - minus;
      size_[k] = std::fabs(plus) + std::fabs(minus);
      if (is_tiny(u[k]) || is_tiny(v[k])) size_[k] = HUGE_VAL;
    }
  }

  /// +1 or -1, or 0 where doubles do not tell. With e = 2^-53: sides and the way to the point are
  /// off by e of them each, so products of the normal by less than 4 e of theirs, those with the
  /// way by 2 e more, and sums by 4 e: less than 16 e of all sizes. (Digits that tiny sides
  /// would lose are not looked at, those that products with the way lose are below the rest.)
  [[nodiscard]] int side(const glm::dvec3& p) const {
    const glm::dvec3 way = p - origin_;
    const double value = normal_.x * way.x + normal_.y * way.y + normal_.z * way.z;
    const double bound = 0x1p-49 * (size_.x * std::fabs(way.x) + size_.y * std::fabs(way.y) +
                                    size_.z * std::fabs(way.z)) +
                         0x1p-1000;
    return value > bound ? 1 : value < -bound ? -1 : 0;
  }

 private:
  static bool is_tiny(double x) { return x != 0 && std::fabs(x) < 0x1p-400; }

  glm::dvec3 origin_, normal_, size_;
};

/// A point that two triangles have, as doubles tell it; none when they do not meet.
using Meeting = std::optional<glm::dvec3>;

class CrossingTest {
 public:
  explicit CrossingTest(const TriangleView& mesh) : p_(mesh.points), triangles_(mesh.triangles) {
    views_.reserve(triangles_.size());
    planes_.reserve(triangles_.size());
    for (uint32_t t = 0; t < triangles_.size(); ++t) {
      views_.push_back(aspect_of(corners_of(mesh, t)));
      planes_.emplace_back(corners_of(mesh, t));
    }
  }

  [[nodiscard]] bool has_area(uint32_t triangle) const { return views_[triangle].sign != 0; }

  /// A point of both triangles beyond the corners and edges which both have.
  [[nodiscard]] Meeting crossing(uint32_t first, uint32_t second) const {
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

 private:
  static size_t index_of(const std::array<bool, 3>& flags, bool value) {
    return static_cast<size_t>(std::find(flags.begin(), flags.end(), value) - flags.begin());
  }

  [[nodiscard]] glm::dvec3 middle(const Triangle& t) const {
    return p_[t[0]] / 3.0 + p_[t[1]] / 3.0 + p_[t[2]] / 3.0;
  }

  /// Whether the corners of a triangle that another one has not are plainly on one side of that
  /// one's plane: then it has nothing of the plane but the others.
  [[nodiscard]] bool is_clear_of(const Triangle& t, const std::array<bool, 3>& is_shared,
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

  [[nodiscard]] int side(const Triangle& t, uint32_t point) const {
    return orient(p_[t[0]], p_[t[1]], p_[t[2]], p_[point]);
  }

  /// Whether a point of the triangle's plane lies in it, boundary included.
  [[nodiscard]] bool contains(uint32_t triangle, uint32_t point) const {
    const Triangle& t = triangles_[triangle];
    const TriangleAspect& view = views_[triangle];
    for (size_t i = 0; i < 3; ++i) {
      if (orient_along(view.axis, p_[t[i]], p_[t[(i + 1) % 3]], p_[point]) == -view.sign)
        return false;
    }
    return true;
  }

  /// Where two segments of one plane, seen along `axis`, meet.
  [[nodiscard]] Meeting segments_meet(int axis, uint32_t a, uint32_t b, uint32_t c,
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

  /// Segments of one line meet when an end of one lies in the other, which is in its box.
  [[nodiscard]] Meeting collinear_meet(uint32_t a, uint32_t b, uint32_t c, uint32_t d) const {
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

  /// The point of the segment whose distances at its ends are these, of different signs or zero.
  [[nodiscard]] glm::dvec3 between(uint32_t a, double at_a, uint32_t b, double at_b) const {
    const double sum = std::abs(at_a) + std::abs(at_b);
    const double part = sum > 0 ? std::abs(at_a) / sum : 0.5;
    return p_[a] * (1 - part) + p_[b] * part;
  }

  /// Where the segment a b meets the triangle, boundaries included.
  [[nodiscard]] Meeting segment_meets(uint32_t a, uint32_t b, uint32_t triangle) const {
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

  [[nodiscard]] Meeting segment_meets_in_plane(uint32_t a, uint32_t b, uint32_t triangle) const {
    for (const uint32_t end : {a, b}) {
      if (contains(triangle, end)) return p_[end];
    }
    const Triangle& t = triangles_[triangle];
    for (size_t i = 0; i < 3; ++i) {
      if (const Meeting meeting =
              segments_meet(views_[triangle].axis, a, b, t[i], t[(i + 1) % 3])) {
        return meeting;
      }
    }
    return {};
  }

  [[nodiscard]] Meeting without_common_corner(uint32_t first, uint32_t second) const {
    const Triangle &s = triangles_[first], &t = triangles_[second];
    if (is_apart(s, t) || is_apart(t, s)) return {};
    // What two triangles have in common ends on a side of one of them.
    for (size_t i = 0; i < 3; ++i) {
      if (const Meeting meeting = segment_meets(s[i], s[(i + 1) % 3], second)) return meeting;
      if (const Meeting meeting = segment_meets(t[i], t[(i + 1) % 3], first)) return meeting;
    }
    return {};
  }

  /// Whether all corners of s lie strictly on one side of t's plane.
  [[nodiscard]] bool is_apart(const Triangle& s, const Triangle& t) const {
    const int side_0 = side(t, s[0]);
    return side_0 != 0 && side(t, s[1]) == side_0 && side(t, s[2]) == side_0;
  }

  /// What they have in common beyond one corner ends on a side opposite to it.
  [[nodiscard]] Meeting beyond_corner(uint32_t first, size_t s_at, uint32_t second,
                                      size_t t_at) const {
    const Triangle &s = triangles_[first], &t = triangles_[second];
    const Meeting meeting = segment_meets(s[(s_at + 1) % 3], s[(s_at + 2) % 3], second);
    return meeting ? meeting : segment_meets(t[(t_at + 1) % 3], t[(t_at + 2) % 3], first);
  }

  /// Two that share an edge overlap when they lie in one plane and on one side of the edge.
  [[nodiscard]] Meeting beyond_edge(uint32_t first, size_t s_at, uint32_t second,
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

  std::span<const glm::dvec3> p_;
  std::span<const Triangle> triangles_;
  std::vector<TriangleAspect> views_;
  std::vector<QuickPlane> planes_;
};

/// A box for each of the triangles, so that the boxes of those that meet overlap.
std::vector<Box> boxes_of(const TriangleView& mesh, std::span<const uint32_t> triangles) {
  const auto corners = [&](uint32_t t) {
    std::array<Vec3d, 3> result{};
    for (size_t i = 0; i < 3; ++i) {
      const glm::dvec3& p = mesh.points[mesh.triangles[t][i]];
      result[i] = {p.x, p.y, p.z};
    }
    return result;
  };
  std::vector<std::array<Vec3d, 3>> sample;
  for (size_t i = 0, step = triangles.size() / kFrameSample + 1; i < triangles.size(); i += step) {
    sample.push_back(corners(triangles[i]));
  }
  const std::optional<BoxFrame> frame = find_box_frame(sample);
  double reach = 0;
  for (const glm::dvec3& p : mesh.points) {
    reach = std::max({reach, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  }
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (const uint32_t t : triangles) {
    boxes.push_back(frame ? box_along(*frame, corners(t), reach) : box_of(corners_of(mesh, t)));
  }
  return boxes;
}

}  // namespace

std::vector<TriangleCrossing> find_crossings(const TriangleView& mesh, uint64_t most) {
  const CrossingTest test(mesh);
  std::vector<uint32_t> with_area;
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (test.has_area(t)) with_area.push_back(t);
  }
  const std::vector<Box> boxes = boxes_of(mesh, with_area);
  const BoxTree tree(boxes);
  constexpr size_t kEach = 256;
  std::vector<std::vector<TriangleCrossing>> parts(part_count(boxes.size(), kEach));
  std::atomic<size_t> enough = parts.size();  // a part with as many: what comes after is not needed
  for_each_part(boxes.size(), kEach, [&](size_t part, size_t begin, size_t end) {
    std::vector<TriangleCrossing>& found = parts[part];
    for (auto i = static_cast<uint32_t>(begin); i < end && part <= enough; ++i) {
      const size_t before = found.size();
      tree.visit_later(i, [&](uint32_t j) {
        if (const Meeting meeting = test.crossing(with_area[i], with_area[j])) {
          found.push_back({{with_area[i], with_area[j]}, *meeting});
        }
      });
      std::sort(found.begin() + static_cast<std::ptrdiff_t>(before), found.end(),
                [](const auto& a, const auto& b) { return a.triangles < b.triangles; });
      if (found.size() < most) continue;
      for (size_t at = enough; part < at && !enough.compare_exchange_weak(at, part);) {
      }
      break;
    }
  });
  std::vector<TriangleCrossing> all;
  for (const auto& part : parts) {
    const size_t wanted = std::min<size_t>(part.size(), most - all.size());
    all.insert(all.end(), part.begin(), part.begin() + static_cast<std::ptrdiff_t>(wanted));
  }
  return all;
}

}  // namespace csgrun
