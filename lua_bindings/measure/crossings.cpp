// Where a triangle mesh crosses itself, exactly: a sweep along its longest axis finds the pairs
// whose boxes overlap, and signs of determinants decide.
#include <algorithm>
#include <numeric>

#include "lua_bindings/measure/exact_sum.h"
#include "lua_bindings/measure/mesh_measures.h"

namespace csgrun {
namespace {

/// More than this is "a lot" to everybody who reads it.
constexpr uint64_t kMostCrossings = 1000000;

using Points = std::vector<glm::dvec3>;
using Triangle = std::array<uint32_t, 3>;

bool is_degenerate(const Points& p, const Triangle& t) {
  for (int axis = 0; axis < 3; ++axis) {
    if (orient_along(axis, p[t[0]], p[t[1]], p[t[2]]) != 0) return false;
  }
  return true;
}

/// An axis along which the triangle has area.
int view_axis(const Points& p, const Triangle& t) {
  int axis = 0;
  while (axis < 2 && orient_along(axis, p[t[0]], p[t[1]], p[t[2]]) == 0) ++axis;
  return axis;
}

/// Whether a point of the triangle's plane lies in it, boundary included.
bool contains(const Points& p, const Triangle& t, uint32_t point) {
  const int axis = view_axis(p, t);
  const int whole = orient_along(axis, p[t[0]], p[t[1]], p[t[2]]);
  for (size_t i = 0; i < 3; ++i) {
    if (orient_along(axis, p[t[i]], p[t[(i + 1) % 3]], p[point]) == -whole) return false;
  }
  return true;
}

/// Whether two segments of one plane, seen along `axis`, have a point in common.
bool segments_meet(const Points& p, int axis, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  const auto turn = [&](uint32_t i, uint32_t j, uint32_t k) {
    return orient_along(axis, p[i], p[j], p[k]);
  };
  const int abc = turn(a, b, c), abd = turn(a, b, d), cda = turn(c, d, a), cdb = turn(c, d, b);
  if (abc == 0 && abd == 0) {  // on one line: their boxes overlap
    for (int i = 0; i < 3; ++i) {
      if (std::max(p[a][i], p[b][i]) < std::min(p[c][i], p[d][i]) ||
          std::max(p[c][i], p[d][i]) < std::min(p[a][i], p[b][i])) {
        return false;
      }
    }
    return true;
  }
  return abc * abd <= 0 && cda * cdb <= 0;
}

/// Whether the segment a b meets the triangle, boundaries included.
bool segment_meets(const Points& p, uint32_t a, uint32_t b, const Triangle& t) {
  const int side_a = orient(p[t[0]], p[t[1]], p[t[2]], p[a]),
            side_b = orient(p[t[0]], p[t[1]], p[t[2]], p[b]);
  if (side_a * side_b > 0) return false;
  if (side_a == 0 && side_b == 0) {
    if (contains(p, t, a) || contains(p, t, b)) return true;
    const int axis = view_axis(p, t);
    for (size_t i = 0; i < 3; ++i) {
      if (segments_meet(p, axis, a, b, t[i], t[(i + 1) % 3])) return true;
    }
    return false;
  }
  if (side_a == 0) return contains(p, t, a);
  if (side_b == 0) return contains(p, t, b);
  int least = 0, most = 0;
  for (size_t i = 0; i < 3; ++i) {
    const int side = orient(p[a], p[b], p[t[i]], p[t[(i + 1) % 3]]);
    least = std::min(least, side);
    most = std::max(most, side);
  }
  return least * most == 0;
}

/// Where the corners of s lie as seen from t's plane: all on one side, all in it, or otherwise.
enum class Position : uint8_t { kApart, kInPlane, kAcross };

Position position(const Points& p, const Triangle& s, const Triangle& t) {
  std::array<int, 3> sides{};
  for (size_t i = 0; i < 3; ++i) sides[i] = orient(p[t[0]], p[t[1]], p[t[2]], p[s[i]]);
  if (sides[0] != sides[1] || sides[1] != sides[2]) return Position::kAcross;
  return sides[0] == 0 ? Position::kInPlane : Position::kApart;
}

/// Whether a line along a side of t separates s from it, strictly, in their common plane.
bool separated(const Points& p, const Triangle& s, const Triangle& t) {
  const int axis = view_axis(p, t);
  const int inside = orient_along(axis, p[t[0]], p[t[1]], p[t[2]]);
  for (size_t i = 0; i < 3; ++i) {
    const auto beyond = [&](uint32_t corner) {
      return orient_along(axis, p[t[i]], p[t[(i + 1) % 3]], p[corner]) == -inside;
    };
    if (beyond(s[0]) && beyond(s[1]) && beyond(s[2])) return true;
  }
  return false;
}

bool crosses(const Points& p, const Triangle& s, const Triangle& t) {
  size_t shared = 0, s_at = 0, t_at = 0;  // s_at, t_at: the shared corner, or the ones not shared
  std::array<bool, 3> in_s{}, in_t{};
  for (size_t i = 0; i < 3; ++i) {
    for (size_t k = 0; k < 3; ++k) {
      if (s[i] != t[k]) continue;
      in_s[i] = in_t[k] = true;
      ++shared;
    }
  }
  if (shared == 3) return true;  // one upon the other
  const auto find = [](const std::array<bool, 3>& flags, bool value) {
    return static_cast<size_t>(std::find(flags.begin(), flags.end(), value) - flags.begin());
  };
  if (shared == 2) {
    s_at = find(in_s, false);
    t_at = find(in_t, false);
    if (orient(p[s[0]], p[s[1]], p[s[2]], p[t[t_at]]) != 0) return false;
    // In one plane: they overlap when both apexes lie on the same side of the edge.
    const int axis = view_axis(p, s);
    const uint32_t a = s[(s_at + 1) % 3], b = s[(s_at + 2) % 3];
    return orient_along(axis, p[a], p[b], p[s[s_at]]) == orient_along(axis, p[a], p[b], p[t[t_at]]);
  }
  if (shared == 1) {
    // What they have in common beyond the corner ends on a side opposite to it.
    s_at = find(in_s, true);
    t_at = find(in_t, true);
    return segment_meets(p, s[(s_at + 1) % 3], s[(s_at + 2) % 3], t) ||
           segment_meets(p, t[(t_at + 1) % 3], t[(t_at + 2) % 3], s);
  }
  const Position of_s = position(p, s, t);
  if (of_s == Position::kInPlane) return !separated(p, s, t) && !separated(p, t, s);
  if (of_s == Position::kApart || position(p, t, s) == Position::kApart) return false;
  for (size_t i = 0; i < 3; ++i) {
    if (segment_meets(p, s[i], s[(i + 1) % 3], t) || segment_meets(p, t[i], t[(i + 1) % 3], s))
      return true;
  }
  return false;
}

}  // namespace

uint64_t count_degenerate(const TriangleMesh& mesh) {
  return static_cast<uint64_t>(
      std::count_if(mesh.triangles.begin(), mesh.triangles.end(),
                    [&](const Triangle& t) { return is_degenerate(mesh.points, t); }));
}

uint64_t count_crossings(const TriangleMesh& mesh) {
  struct Box {
    std::array<double, 3> low, high;
    uint32_t triangle;
  };
  const Points& p = mesh.points;
  std::vector<Box> boxes;
  std::array<double, 3> all_low{1e308, 1e308, 1e308}, all_high{-1e308, -1e308, -1e308};
  for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    if (is_degenerate(p, t)) continue;
    Box box{{}, {}, i};
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto c = static_cast<int>(axis);
      box.low[axis] = std::min({p[t[0]][c], p[t[1]][c], p[t[2]][c]});
      box.high[axis] = std::max({p[t[0]][c], p[t[1]][c], p[t[2]][c]});
      all_low[axis] = std::min(all_low[axis], box.low[axis]);
      all_high[axis] = std::max(all_high[axis], box.high[axis]);
    }
    boxes.push_back(box);
  }
  size_t axis = 0;
  for (size_t i = 1; i < 3; ++i) {
    if (all_high[i] - all_low[i] > all_high[axis] - all_low[axis]) axis = i;
  }
  const size_t second = (axis + 1) % 3, third = (axis + 2) % 3;
  std::sort(boxes.begin(), boxes.end(), [axis](const Box& a, const Box& b) {
    return std::pair(a.low[axis], a.triangle) < std::pair(b.low[axis], b.triangle);
  });
  uint64_t count = 0;
  for (size_t i = 0; i < boxes.size(); ++i) {
    const Box& a = boxes[i];
    for (size_t k = i + 1; k < boxes.size() && boxes[k].low[axis] <= a.high[axis]; ++k) {
      const Box& b = boxes[k];
      if (b.low[second] > a.high[second] || a.low[second] > b.high[second] ||
          b.low[third] > a.high[third] || a.low[third] > b.high[third]) {
        continue;
      }
      if (crosses(p, mesh.triangles[a.triangle], mesh.triangles[b.triangle]) &&
          ++count == kMostCrossings)
        return count;
    }
  }
  return count;
}

}  // namespace csgrun
