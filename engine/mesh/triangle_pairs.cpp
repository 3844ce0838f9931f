#include "engine/mesh/triangle_pairs.h"

#include <algorithm>
#include <cmath>

#include "engine/mesh/leaf_shape.h"
#include "engine/mesh/spread_vertices.h"

namespace csgrun {
namespace {

/// No vertices, and not the same one.
constexpr uint32_t kNone = UINT32_MAX, kOther = UINT32_MAX - 1;

}  // namespace

bool TrianglePairs::covers(const LeafGeometry& leaf) {
  return consists_of_triangles(leaf) && is_compact(box_of_points(leaf.vertices));
}

TrianglePairs::TrianglePairs(const LeafGeometry& leaf, std::span<const uint32_t> order,
                             bool is_balanced)
    : leaf_(leaf), corners_((order.size() + 7) / 8), spread_(order.size()) {
  const std::vector<uint8_t> is_spread =
      is_balanced ? find_spread_vertices(leaf) : std::vector<uint8_t>(leaf.vertices.size(), 0);
  if (!corners_.empty()) {
    for (auto& lanes : corners_.back().corners) lanes.fill(kNone);
  }
  for (size_t place = 0; place < order.size(); ++place) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t v = leaf.corners[3 * size_t{order[place]} + i];
      corners_[place / 8].corners[i][place % 8] = v;
      spread_[place][i] = is_spread[v] != 0 ? v : kOther;
    }
  }
}

namespace {

using Point = std::array<double, 3>;
using Triangle = std::array<Point, 3>;

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point normal_of(const Triangle& t) { return cross(minus(t[1], t[0]), minus(t[2], t[0])); }

/// Whether the corners of `other` that are not marked lie strictly on one side of a plane.
bool is_beside(const Triangle& t, const Point& normal, const Triangle& other, uint32_t marked,
               double slack) {
  bool front = true, back = true;
  for (size_t i = 0; i < 3; ++i) {
    if ((marked >> i & 1) != 0) continue;
    const double distance = dot(normal, minus(other[i], t[0]));
    front = front & (distance > slack);
    back = back & (distance < -slack);
  }
  return front || back;
}

/// Whether, seen along an axis, `other` lies strictly beyond the line of a side of the triangle.
bool is_beyond_side(const Triangle& t, const Point& normal, size_t axis, const Triangle& other,
                    double slack) {
  if (std::fabs(normal[axis]) <= slack) return false;
  const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double sense = normal[axis] > 0 ? 1 : -1;
  for (size_t i = 0; i < 3; ++i) {
    const Point &a = t[i], &b = t[(i + 1) % 3];
    const double du = sense * (b[u] - a[u]), dv = sense * (b[v] - a[v]);
    bool beyond = true;
    for (const Point& p : other) {
      beyond = beyond & (du * (p[v] - a[v]) - dv * (p[u] - a[u]) < -slack);
    }
    if (beyond) return true;
  }
  return false;
}

size_t longest(const Point& v) {
  size_t axis = std::fabs(v[1]) > std::fabs(v[0]) ? 1 : 0;
  return std::fabs(v[2]) > std::fabs(v[axis]) ? 2 : axis;
}

}  // namespace

bool TrianglePairs::apart(uint32_t f, uint32_t g) const {
  const uint32_t* const p = &leaf_.corners[3 * size_t{f}];
  const uint32_t* const q = &leaf_.corners[3 * size_t{g}];
  uint32_t f_common = 0, g_common = 0;
  for (uint32_t i = 0; i < 3; ++i) {
    for (uint32_t k = 0; k < 3; ++k) {
      f_common |= static_cast<uint32_t>(p[i] == q[k]) << i;
      g_common |= static_cast<uint32_t>(p[i] == q[k]) << k;
    }
  }
  if (f_common == 7) return false;
  // Relative to one corner, all coordinates and their differences are exact.
  const IVec3& origin = leaf_.vertices[p[0]];
  Triangle s, t;
  double size = 0;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t k = 0; k < 3; ++k) {
      s[i][k] = static_cast<double>(leaf_.vertices[p[i]][k] - origin[k]);
      t[i][k] = static_cast<double>(leaf_.vertices[q[i]][k] - origin[k]);
      size = std::max({size, std::fabs(s[i][k]), std::fabs(t[i][k])});
    }
  }
  // Differences are at most d = 2 size. With u = 2^-53, a component of a normal is at most 2 d^2
  // and off by 4 u d^2 (two products, their difference); a distance by 28 u d^3: 12 for the normal,
  // 6 for the products, 10 for their sums. An area is computed like a component.
  const double d = 2 * size, area_slack = 0x1p-50 * d * d, slack = 0x1p-48 * d * d * d;
  // What triangles have in common lies in both planes: of neighbours the other corners decide.
  const Point s_normal = normal_of(s);
  if (is_beside(s, s_normal, t, g_common, slack)) return true;
  const Point t_normal = normal_of(t);
  if (is_beside(t, t_normal, s, f_common, slack)) return true;
  if (f_common != 0) return false;
  const size_t axis = longest(s_normal);
  return is_beyond_side(s, s_normal, axis, t, area_slack) ||
         is_beyond_side(t, t_normal, axis, s, area_slack);
}

}  // namespace csgrun
