#include "engine/mesh/triangle_pairs.h"

#include <algorithm>
#include <cmath>

#include "engine/base/none.h"
#include "engine/base/parallel.h"
#include "engine/base/vec3d.h"
#include "engine/mesh/leaf_shape.h"

namespace csgrun {
namespace {

/// No vertices, and not those that have none (kNone).
constexpr uint32_t kOther = UINT32_MAX - 1;

}  // namespace

bool TrianglePairs::covers(const LeafGeometry& leaf) {
  return is_compact(box_of_points(leaf.vertices));
}

TrianglePairs::TrianglePairs(const LeafGeometry& leaf, std::span<const uint32_t> order,
                             std::span<const uint8_t> is_spread, bool are_long)
    : leaf_(leaf), corners_((order.size() + 7) / 8), spread_(8 * corners_.size()) {
  for (size_t place = 0; place < spread_.size(); ++place) {
    const bool has_corners = place < order.size() && is_triangle(order[place]);
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t corner =
          has_corners ? leaf.corners[leaf.face_starts[order[place]] + i] : kNone;
      corners_[place / 8].corners[i][place % 8] = corner;
      const bool has_spread = has_corners && !is_spread.empty() && is_spread[corner] != 0;
      spread_[place][i] = has_spread ? corner : kOther;
    }
  }
  if (are_long) make_slabs();
}

void TrianglePairs::make_slabs() {
  const GridBox box = box_of_points(leaf_.vertices);
  IVec3 middle{};
  double reach = 0;
  for (size_t k = 0; k < 3; ++k) {
    middle[k] = (box.lo[k] + box.hi[k]) / 2;
    reach = std::max(reach, static_cast<double>(box.hi[k] - box.lo[k]) / 2 + 1);
  }
  slabs_.resize(corners_.size());
  for_each_part(corners_.size(), kFewForThreads / 8, [&](size_t, size_t begin, size_t end) {
    for (size_t group = begin; group < end; ++group) {
      EightSlabs::Corners corners{};
      uint32_t lanes = 0;
      for (uint32_t lane = 0; lane < 8; ++lane) {
        if (corners_[group].corners[0][lane] == kNone) continue;
        lanes |= 1u << lane;
        for (size_t i = 0; i < 3; ++i) {
          const IVec3& p = leaf_.vertices[corners_[group].corners[i][lane]];
          for (size_t k = 0; k < 3; ++k) {
            corners[i][k][lane] = static_cast<float>(p[k] - middle[k]);
          }
        }
      }
      slabs_[group] = EightSlabs(corners, lanes, reach);
    }
  });
}

namespace {

using Triangle = std::array<Vec3d, 3>;

Vec3d normal_of(const Triangle& t) { return cross(minus(t[1], t[0]), minus(t[2], t[0])); }

/// Where the corners of a triangle are that are not common, against a plane; as bits. (Common ones
/// are on it: their distances are below any slack.)
struct PairSides {
  uint32_t front = 0, back = 0, on = 0;
  uint32_t open = 0;  ///< not decided in doubles

  [[nodiscard]] bool one() const { return front == 0 || back == 0; }
};

PairSides sides_of(const Triangle& t, const Vec3d& normal, const Triangle& other, uint32_t common,
                   double slack) {
  PairSides sides;
  for (uint32_t i = 0; i < 3; ++i) {
    const double distance = dot(normal, minus(other[i], t[0]));
    sides.front |= static_cast<uint32_t>(distance > slack) << i;
    sides.back |= static_cast<uint32_t>(distance < -slack) << i;
  }
  sides.open = 7 & ~(sides.front | sides.back | common);
  return sides;
}

/// Decides what is open by whole numbers: all coordinates are.
void decide_open(const Triangle& t, const Triangle& other, PairSides& sides) {
  const auto whole = [&](const Vec3d& p) {
    const Vec3d d = minus(p, t[0]);
    return IVec3{static_cast<int64_t>(d[0]), static_cast<int64_t>(d[1]),
                 static_cast<int64_t>(d[2])};
  };
  const IVec3 u = whole(t[1]), v = whole(t[2]);
  for (uint32_t i = 0; i < 3; ++i) {
    if ((sides.open >> i & 1) == 0) continue;
    const IVec3 w = whole(other[i]);
    __int128 sum = 0;
    for (size_t k = 0; k < 3; ++k) {
      const size_t x = (k + 1) % 3, y = (k + 2) % 3;
      sum += static_cast<__int128>(u[x] * v[y] - u[y] * v[x]) * w[k];
    }
    sides.front |= static_cast<uint32_t>(sum > 0) << i;
    sides.back |= static_cast<uint32_t>(sum < 0) << i;
    sides.on |= static_cast<uint32_t>(sum == 0) << i;
  }
  sides.open = 0;
}

size_t longest(const Vec3d& v) {
  const size_t axis = std::fabs(v[1]) > std::fabs(v[0]) ? 1 : 0;
  return std::fabs(v[2]) > std::fabs(v[axis]) ? 2 : axis;
}

/// Whether, seen along the axis that the triangle faces most, the corners of `other` lie strictly
/// beyond the line of one of its sides, but for the common ones, which are on that side, and for
/// those that are off its plane, with the whole of `other` on one side of it. Then the two meet in
/// the common corners and the edge between them only. Corners are given as bits.
bool is_beyond_side(const Triangle& t, uint32_t t_common, const Vec3d& normal,
                    const Triangle& other, uint32_t common, uint32_t aside, double slack) {
  const size_t axis = longest(normal), u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (std::fabs(normal[axis]) <= slack) return false;
  const double sense = normal[axis] > 0 ? 1 : -1;
  for (size_t i = 0; i < 3; ++i) {
    const size_t next = (i + 1) % 3;
    if ((t_common & ~(1u << i | 1u << next)) != 0) continue;
    const Vec3d &a = t[i], &b = t[next];
    const double du = sense * (b[u] - a[u]), dv = sense * (b[v] - a[v]);
    bool beyond = true;
    for (size_t k = 0; k < 3; ++k) {
      const Vec3d& p = other[k];
      beyond = beyond & (((common | aside) >> k & 1) != 0 ||
                         du * (p[v] - a[v]) - dv * (p[u] - a[u]) < -slack);
    }
    if (beyond) return true;
  }
  return false;
}

}  // namespace

bool TrianglePairs::apart(uint32_t f, uint32_t g) const {
  if (!is_triangle(f) || !is_triangle(g)) return false;
  const uint32_t* const p = &leaf_.corners[leaf_.face_starts[f]];
  const uint32_t* const q = &leaf_.corners[leaf_.face_starts[g]];
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
  // What triangles have in common lies in both planes: of one that is on one side of the other's
  // plane, in the corners that it has there; if these are common, that is all.
  const Vec3d s_normal = normal_of(s);
  PairSides of_t = sides_of(s, s_normal, t, g_common, slack);
  if (of_t.open == 0 && of_t.one()) return true;
  const Vec3d t_normal = normal_of(t);
  PairSides of_s = sides_of(t, t_normal, s, f_common, slack);
  if (of_s.open == 0 && of_s.one()) return true;
  if (is_beyond_side(s, f_common, s_normal, t, g_common, 0, area_slack) ||
      is_beyond_side(t, g_common, t_normal, s, f_common, 0, area_slack)) {
    return true;
  }
  // One may rest on the plane of the other with a corner or an edge that is beside it.
  const auto rests_beside = [&](const Triangle& one, uint32_t one_common, const Vec3d& normal,
                                const Triangle& other, uint32_t common, PairSides& sides) {
    decide_open(one, other, sides);
    if (!sides.one()) return false;
    return sides.on == 0 || is_beyond_side(one, one_common, normal, other, common,
                                           sides.front | sides.back, area_slack);
  };
  return rests_beside(s, f_common, s_normal, t, g_common, of_t) ||
         rests_beside(t, g_common, t_normal, s, f_common, of_s);
}

}  // namespace csgrun
