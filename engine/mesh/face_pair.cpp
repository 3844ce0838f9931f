// Two convex faces meet in a convex set: nothing, a point, a segment or a polygon. A polygon is a
// conflict; a point or a segment is one unless it consists of corners and edges of both faces.
//
// Faces of two planes meet on the line of the planes, where each has an interval; the order of the
// ends along the line is the sign of one determinant of four corners (Devillers & Guigue 2002).
#include "engine/mesh/face_pair.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/none.h"
#include "engine/mesh/face_normal.h"

namespace csgrun {
namespace {

constexpr size_t kManyCorners = 12;
constexpr double kUlp = 0x1p-53;

int sign(__int128 x) { return (x > 0) - (x < 0); }

}  // namespace

FacePairs::FacePairs(const LeafGeometry& leaf) : leaf_(leaf) {
  const size_t faces = leaf.face_count();
  for (uint32_t f = 0; f < faces; ++f) {
    const Corners loop = corners(f);
    if (loop.size() > kManyCorners) {
      if (sorted_starts_.empty()) sorted_starts_.assign(faces + 1, 0);
      const auto first = static_cast<std::ptrdiff_t>(sorted_.size());
      for (uint32_t i = 0; i < loop.size(); ++i) sorted_.push_back({loop[i], i});
      std::sort(sorted_.begin() + first, sorted_.end());
    }
    if (!sorted_starts_.empty()) sorted_starts_[f + 1] = static_cast<uint32_t>(sorted_.size());
  }
}

FacePairs::Point FacePairs::point(uint32_t v) const {
  const IVec3& p = leaf_.vertices[v];
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

FacePairs::Plane FacePairs::plane_of(uint32_t f) const {
  // Corners a third of the way round give a normal of good relative accuracy. A long run of 180
  // degree corners may hold all three: then the first edge and a corner off its line.
  const Corners loop = corners(f);
  const size_t n = loop.size();
  Plane plane;
  plane.base = {loop[0], loop[n / 3], loop[2 * n / 3]};
  Normal normal = exact_normal(plane.base);
  for (size_t i = 2; i < n && normal == Normal{}; ++i) {
    plane.base = {loop[0], loop[1], loop[i]};
    normal = exact_normal(plane.base);
  }
  for (int k = 0; k < 3; ++k) plane.normal[k] = static_cast<double>(normal[k]);
  plane.origin = point(plane.base[0]);
  return plane;
}

FacePairs::Normal FacePairs::exact_normal(const std::array<uint32_t, 3>& base) const {
  const IVec3 u = difference(leaf_.vertices[base[1]], leaf_.vertices[base[0]]),
              v = difference(leaf_.vertices[base[2]], leaf_.vertices[base[0]]);
  const auto minor = [&](int i, int j) {
    return static_cast<__int128>(u[i]) * v[j] - static_cast<__int128>(u[j]) * v[i];
  };
  return {minor(1, 2), minor(2, 0), minor(0, 1)};
}

/// The sign of a point against a plane: +1 in front.
int FacePairs::side(const Plane& plane, uint32_t v) const {
  const Point p = point(v);
  double sum = 0, magnitude = 0;
  for (int k = 0; k < 3; ++k) {
    const double term = plane.normal[k] * (p[k] - plane.origin[k]);
    sum += term;
    magnitude += std::fabs(term);
  }
  // One rounding in the normal, one in the product, two in the sum; the differences are exact.
  const double bound = 6 * kUlp * magnitude;
  if (sum > bound) return 1;
  if (sum < -bound) return -1;
  const Normal n = exact_normal(plane.base);
  const IVec3 d = difference(leaf_.vertices[v], leaf_.vertices[plane.base[0]]);
  return sign(n[0] * d[0] + n[1] * d[1] + n[2] * d[2]);
}

/// The sign of det(b - a, c - a, d - a).
int FacePairs::orient(uint32_t a, uint32_t b, uint32_t c, uint32_t d) const {
  const auto& p = leaf_.vertices;
  const IVec3 u = difference(p[b], p[a]), v = difference(p[c], p[a]), w = difference(p[d], p[a]);
  double sum = 0, magnitude = 0;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double plus = static_cast<double>(v[i]) * static_cast<double>(w[j]);
    const double minus = static_cast<double>(v[j]) * static_cast<double>(w[i]);
    sum += static_cast<double>(u[k]) * (plus - minus);
    magnitude += std::fabs(static_cast<double>(u[k])) * (std::fabs(plus) + std::fabs(minus));
  }
  const double bound = 8 * kUlp * magnitude;
  if (sum > bound) return 1;
  if (sum < -bound) return -1;
  __int128 exact = 0;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    exact += u[k] * (static_cast<__int128>(v[i]) * w[j] - static_cast<__int128>(v[j]) * w[i]);
  }
  return sign(exact);
}

std::span<const std::pair<uint32_t, uint32_t>> FacePairs::sorted_corners(uint32_t f) const {
  if (sorted_starts_.empty()) return {};
  return {sorted_.data() + sorted_starts_[f], sorted_.data() + sorted_starts_[f + 1]};
}

bool FacePairs::has_corner(uint32_t f, uint32_t point) const {
  const auto sorted = sorted_corners(f);
  const auto begin = sorted.begin(), end = sorted.end();
  if (begin != end) {
    const auto at = std::lower_bound(begin, end, std::pair(point, 0u));
    return at != end && at->first == point;
  }
  const Corners loop = corners(f);
  return std::find(loop.begin(), loop.end(), point) != loop.end();
}

bool FacePairs::has_edge(uint32_t f, uint32_t a, uint32_t b) const {
  const Corners loop = corners(f);
  const auto sorted = sorted_corners(f);
  const auto begin = sorted.begin(), end = sorted.end();
  size_t at;
  if (begin != end) {
    const auto found = std::lower_bound(begin, end, std::pair(a, 0u));
    if (found == end || found->first != a) return false;
    at = found->second;
  } else {
    at = static_cast<size_t>(std::find(loop.begin(), loop.end(), a) - loop.begin());
    if (at == loop.size()) return false;
  }
  return loop[(at + 1) % loop.size()] == b || loop[(at + loop.size() - 1) % loop.size()] == b;
}

/// The signs of f's corners against g's plane; shared corners need no arithmetic.
void FacePairs::signs_against(uint32_t f, uint32_t g, const Plane& plane_of_g,
                              std::vector<int>& signs) const {
  const Corners loop = corners(f);
  signs.resize(loop.size());
  for (size_t i = 0; i < loop.size(); ++i) {
    signs[i] = has_corner(g, loop[i]) ? 0 : side(plane_of_g, loop[i]);
  }
}

/// Whether two triangles certainly meet in common corners and edges only: nearly all pairs do.
bool FacePairs::triangles_apart(const uint32_t* f, const uint32_t* g,
                                const Plane& plane_of_f) const {
  std::array<uint32_t, 3> own{};  // corners of g that f does not have
  size_t count = 0;
  for (int i = 0; i < 3; ++i) {
    if (g[i] != f[0] && g[i] != f[1] && g[i] != f[2]) own[count++] = g[i];
  }
  if (count == 0) return false;
  const int first = side(plane_of_f, own[0]);
  // With an edge in common all that is left is one plane, folded.
  if (first == 0) return false;
  for (size_t i = 1; i < count; ++i) {
    if (side(plane_of_f, own[i]) != first) return false;
  }
  return true;
}

bool FacePairs::conflict(uint32_t f, uint32_t g, Scratch& scratch) const {
  // The face with fewer corners is held against the plane of the other: mostly that decides.
  if (corners(f).size() < corners(g).size()) std::swap(f, g);
  const Plane plane_of_f = plane_of(f);
  const Corners loop = corners(g);
  const bool are_triangles = corners(f).size() == 3 && loop.size() == 3;
  if (are_triangles && triangles_apart(corners(f).data(), loop.data(), plane_of_f)) return false;
  signs_against(g, f, plane_of_f, scratch.signs_g);
  const auto count = [](const std::vector<int>& signs, int s) {
    return std::count(signs.begin(), signs.end(), s);
  };
  const auto zeros = count(scratch.signs_g, 0);
  const bool g_crosses = count(scratch.signs_g, 1) > 0 && count(scratch.signs_g, -1) > 0;
  if (zeros == 0 && !g_crosses) return false;
  if (static_cast<size_t>(zeros) == loop.size()) return coplanar_conflict(f, g, scratch);
  if (!g_crosses) {
    // g stands on f's plane on a corner or on a run of edges.
    bool shared = true;
    for (size_t i = 0; i < loop.size() && shared; ++i) {
      const size_t j = (i + 1) % loop.size();
      if (scratch.signs_g[i] != 0) continue;
      shared = scratch.signs_g[j] == 0 ? has_edge(f, loop[i], loop[j]) : has_corner(f, loop[i]);
    }
    if (shared) return false;
  }
  const Plane plane_of_g = plane_of(g);
  if (are_triangles && triangles_apart(loop.data(), corners(f).data(), plane_of_g)) return false;
  signs_against(f, g, plane_of_g, scratch.signs_f);
  const bool f_crosses = count(scratch.signs_f, 1) > 0 && count(scratch.signs_f, -1) > 0;
  if (!f_crosses) {
    if (count(scratch.signs_f, 0) == 0) return false;
    if (!g_crosses) {
      scratch.run_f.clear(), scratch.run_g.clear();
      for (size_t i = 0; i < scratch.signs_f.size(); ++i) {
        if (scratch.signs_f[i] == 0) scratch.run_f.push_back(corners(f)[i]);
      }
      for (size_t i = 0; i < scratch.signs_g.size(); ++i) {
        if (scratch.signs_g[i] == 0) scratch.run_g.push_back(loop[i]);
      }
      return runs_conflict(scratch);
    }
  }
  return crossing_conflict(f, g, scratch);
}

/// The last (or first) point of f on the line of two planes, along the direction normal(f) x
/// normal(other). Seen from f's front the line has the other's front on its right, so the boundary
/// leaves that side in the last point.
FacePairs::LineEnd FacePairs::line_end(uint32_t f, const std::vector<int>& signs, bool last) const {
  const Corners loop = corners(f);
  const size_t n = loop.size();
  const bool any_front = std::find(signs.begin(), signs.end(), 1) != signs.end();
  const auto on_plane = [&](size_t i) -> LineEnd {
    size_t off = 0;
    while (signs[off] == 0) ++off;
    if (signs[off] > 0) return {loop[off], loop[i], loop[i]};
    return {loop[i], loop[off], loop[i]};
  };
  for (size_t i = 0; i < n; ++i) {
    const size_t j = (i + 1) % n;
    if (any_front && last && signs[i] > 0 && signs[j] <= 0) {
      return signs[j] == 0 ? on_plane(j) : LineEnd{loop[i], loop[j], kNone};
    }
    if (any_front && !last && signs[i] <= 0 && signs[j] > 0) {
      return signs[i] == 0 ? on_plane(i) : LineEnd{loop[j], loop[i], kNone};
    }
    if (!any_front && last && signs[i] == 0 && signs[j] < 0) return on_plane(i);
    if (!any_front && !last && signs[i] < 0 && signs[j] == 0) return on_plane(j);
  }
  return {kNone, kNone, kNone};  // not reached: the face meets the plane and does not lie in it
}

/// For faces of different planes that both meet the line of the planes, at least one of them in its
/// inside: a segment in common is a conflict then, a point is one unless it is a corner of both.
bool FacePairs::crossing_conflict(uint32_t f, uint32_t g, const Scratch& scratch) const {
  // Along normal(f) x normal(g); for g the direction is the opposite one, so are its ends.
  const LineEnd f_first = line_end(f, scratch.signs_f, false),
                f_last = line_end(f, scratch.signs_f, true);
  const LineEnd g_first = line_end(g, scratch.signs_g, true),
                g_last = line_end(g, scratch.signs_g, false);
  // +1 when y comes after x. Both span lines run from the front of the other plane to its back, and
  // the volume between them has the sign of the way from x to y.
  const auto order = [&](const LineEnd& x, const LineEnd& y) {
    if (x.vertex != kNone && x.vertex == y.vertex) return 0;
    return orient(x.above, x.below, y.above, y.below);
  };
  const auto touch_conflicts = [](const LineEnd& x, const LineEnd& y) {
    return x.vertex == kNone || x.vertex != y.vertex;
  };
  const int gap = order(f_last, g_first);
  if (gap > 0) return false;
  const int other_gap = order(f_first, g_last);
  if (other_gap < 0) return false;
  if (gap == 0) return touch_conflicts(f_last, g_first);
  if (other_gap == 0) return touch_conflicts(f_first, g_last);
  return true;
}

bool FacePairs::coplanar_conflict(uint32_t f, uint32_t g, Scratch& scratch) const {
  const Point normal = plane_of(f).normal;
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::fabs(normal[k]) > std::fabs(normal[axis])) axis = k;
  }
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  const auto turn = [&](uint32_t a, uint32_t b, uint32_t c) {
    const auto& p = leaf_.vertices;
    const IVec3 u = difference(p[b], p[a]), v = difference(p[c], p[a]);
    return sign(static_cast<__int128>(u[x]) * v[y] - static_cast<__int128>(u[y]) * v[x]);
  };
  // Convex polygons with disjoint insides are separated by the line of an edge of one of them, and
  // then meet on that line only.
  const auto separated = [&](uint32_t one, uint32_t other) {
    const double facing = one == f ? normal[axis] : plane_of(one).normal[axis];
    const int front = facing > 0 ? 1 : -1;
    const Corners loop = corners(one), points = corners(other);
    for (size_t i = 0; i < loop.size(); ++i) {
      const uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      const bool outside = std::all_of(points.begin(), points.end(),
                                       [&](uint32_t p) { return turn(a, b, p) * front <= 0; });
      if (!outside) continue;
      scratch.run_f.clear(), scratch.run_g.clear();
      for (uint32_t p : loop) {
        if (turn(a, b, p) == 0) scratch.run_f.push_back(p);
      }
      for (uint32_t p : points) {
        if (turn(a, b, p) == 0) scratch.run_g.push_back(p);
      }
      return true;
    }
    return false;
  };
  if (!separated(f, g) && !separated(g, f)) return true;
  return !scratch.run_g.empty() && runs_conflict(scratch);
}

/// For corners of two faces along a common line, each a run of edges or one corner: what the runs
/// have in common must consist of the same corners.
bool FacePairs::runs_conflict(Scratch& scratch) const {
  // On a line the lexicographic order is the order along it.
  const auto before = [&](uint32_t a, uint32_t b) { return leaf_.vertices[a] < leaf_.vertices[b]; };
  std::vector<uint32_t>&f = scratch.run_f, &g = scratch.run_g;
  std::sort(f.begin(), f.end(), before);
  std::sort(g.begin(), g.end(), before);
  const uint32_t first = before(f.front(), g.front()) ? g.front() : f.front();
  const uint32_t last = before(f.back(), g.back()) ? f.back() : g.back();
  if (before(last, first)) return false;
  const auto common = [&](const std::vector<uint32_t>& run) {
    return std::span(std::lower_bound(run.begin(), run.end(), first, before),
                     std::upper_bound(run.begin(), run.end(), last, before));
  };
  const auto a = common(f), b = common(g);
  return !std::equal(a.begin(), a.end(), b.begin(), b.end());
}

/// Clips f by the sides of g (planes through g's edges along its normal), and, if the planes
/// differ, takes the part nearest to g's plane.
std::array<double, 3> FacePairs::place(uint32_t f, uint32_t g) const {
  const auto dot = [](const Point& a, const Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  const Plane plane_of_g = plane_of(g);
  const Point& normal = plane_of_g.normal;
  std::vector<Point> polygon;
  for (uint32_t v : corners(f)) polygon.push_back(point(v));
  const auto clip = [&](const Point& n, double offset, bool keep_line_only) {
    std::vector<Point> kept;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const double s = dot(n, p) - offset, t = dot(n, q) - offset;
      if (s == 0 || (s > 0 && !keep_line_only)) kept.push_back(p);
      if ((s < 0 && t > 0) || (s > 0 && t < 0)) {
        const double r = s / (s - t);
        kept.push_back(
            {p[0] + r * (q[0] - p[0]), p[1] + r * (q[1] - p[1]), p[2] + r * (q[2] - p[2])});
      }
    }
    // Rounding may clip everything away where faces only touch.
    if (!kept.empty()) polygon = std::move(kept);
  };
  const bool coplanar = std::all_of(corners(f).begin(), corners(f).end(),
                                    [&](uint32_t v) { return side(plane_of_g, v) == 0; });
  if (!coplanar) clip(normal, dot(normal, plane_of_g.origin), true);
  const Corners loop = corners(g);
  for (size_t i = 0; i < loop.size(); ++i) {
    const Point a = point(loop[i]), b = point(loop[(i + 1) % loop.size()]);
    const Point e{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const Point inward{normal[1] * e[2] - normal[2] * e[1], normal[2] * e[0] - normal[0] * e[2],
                       normal[0] * e[1] - normal[1] * e[0]};
    clip(inward, dot(inward, a), false);
  }
  Point sum{0, 0, 0};
  for (const Point& p : polygon) {
    for (int k = 0; k < 3; ++k) sum[k] += p[k] / static_cast<double>(polygon.size());
  }
  return sum;
}

}  // namespace csgrun
