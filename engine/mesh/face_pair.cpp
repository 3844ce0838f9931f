// Two convex faces meet in a convex set: nothing, a point, a segment or a polygon. A polygon is a
// conflict; a point or a segment is one unless it consists of corners and edges of both faces.
//
// Faces of two planes meet on the line of the planes, where each has an interval; the order of the
// ends along the line is the sign of one determinant of four corners (Devillers & Guigue 2002).
#include "engine/mesh/face_pair.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace csgrun {
namespace {

constexpr uint32_t kNone = UINT32_MAX;
constexpr size_t kManyCorners = 12;
constexpr double kUlp = 0x1p-53;

int sign(__int128 x) { return (x > 0) - (x < 0); }

/// A difference of points as integers: both are exact in double.
IVec3 difference(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {static_cast<int64_t>(a[0] - b[0]), static_cast<int64_t>(a[1] - b[1]),
          static_cast<int64_t>(a[2] - b[2])};
}

}  // namespace

FacePairs::FacePairs(const LeafGeometry& leaf) : corners_(leaf.corners), starts_(leaf.face_starts) {
  points_.reserve(leaf.vertices.size());
  for (const IVec3& v : leaf.vertices) {
    points_.push_back(
        {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])});
  }

  const size_t faces = leaf.face_count();
  planes_.resize(faces);
  boxes_.resize(faces);
  sorted_starts_.assign(faces + 1, 0);
  for (uint32_t f = 0; f < faces; ++f) {
    const Corners loop = corners(f);
    Box& box = boxes_[f];
    for (int k = 0; k < 3; ++k) box.lo[k] = INFINITY, box.hi[k] = -INFINITY;
    for (uint32_t v : loop) {
      for (int k = 0; k < 3; ++k) {
        box.lo[k] = std::min(box.lo[k], points_[v][k]);
        box.hi[k] = std::max(box.hi[k], points_[v][k]);
      }
    }
    // Corners a third of the way round give a normal of good relative accuracy. A long run of 180
    // degree corners may hold all three: then the first edge and a corner off its line.
    const size_t n = loop.size();
    planes_[f].base = {loop[0], loop[n / 3], loop[2 * n / 3]};
    Normal normal = exact_normal(planes_[f].base);
    for (size_t i = 2; i < n && normal == Normal{}; ++i) {
      planes_[f].base = {loop[0], loop[1], loop[i]};
      normal = exact_normal(planes_[f].base);
    }
    for (int k = 0; k < 3; ++k) planes_[f].normal[k] = static_cast<double>(normal[k]);
    planes_[f].origin = points_[planes_[f].base[0]];

    if (n > kManyCorners) {
      const auto first = static_cast<std::ptrdiff_t>(sorted_.size());
      for (uint32_t i = 0; i < n; ++i) sorted_.push_back({loop[i], i});
      std::sort(sorted_.begin() + first, sorted_.end());
    }
    sorted_starts_[f + 1] = static_cast<uint32_t>(sorted_.size());
  }
}

FacePairs::Normal FacePairs::exact_normal(const std::array<uint32_t, 3>& base) const {
  const IVec3 u = difference(points_[base[1]], points_[base[0]]),
              v = difference(points_[base[2]], points_[base[0]]);
  const auto minor = [&](int i, int j) {
    return static_cast<__int128>(u[i]) * v[j] - static_cast<__int128>(u[j]) * v[i];
  };
  return {minor(1, 2), minor(2, 0), minor(0, 1)};
}

/// The sign of a point against a face's plane: +1 in front.
int FacePairs::side(uint32_t f, uint32_t point) const {
  const Plane& plane = planes_[f];
  const Point& p = points_[point];
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
  const IVec3 d = difference(p, plane.origin);
  return sign(n[0] * d[0] + n[1] * d[1] + n[2] * d[2]);
}

/// The sign of det(b - a, c - a, d - a).
int FacePairs::orient(uint32_t a, uint32_t b, uint32_t c, uint32_t d) const {
  const IVec3 u = difference(points_[b], points_[a]), v = difference(points_[c], points_[a]),
              w = difference(points_[d], points_[a]);
  double sum = 0, magnitude = 0;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double p = static_cast<double>(v[i]) * static_cast<double>(w[j]);
    const double q = static_cast<double>(v[j]) * static_cast<double>(w[i]);
    sum += static_cast<double>(u[k]) * (p - q);
    magnitude += std::fabs(static_cast<double>(u[k])) * (std::fabs(p) + std::fabs(q));
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

bool FacePairs::has_corner(uint32_t f, uint32_t point) const {
  const auto begin = sorted_.begin() + sorted_starts_[f],
             end = sorted_.begin() + sorted_starts_[f + 1];
  if (begin != end) {
    const auto at = std::lower_bound(begin, end, std::pair(point, 0u));
    return at != end && at->first == point;
  }
  const Corners loop = corners(f);
  return std::find(loop.begin(), loop.end(), point) != loop.end();
}

bool FacePairs::has_edge(uint32_t f, uint32_t a, uint32_t b) const {
  const Corners loop = corners(f);
  const auto begin = sorted_.begin() + sorted_starts_[f],
             end = sorted_.begin() + sorted_starts_[f + 1];
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
void FacePairs::signs_against(uint32_t f, uint32_t g, std::vector<int>& signs) const {
  const Corners loop = corners(f);
  signs.resize(loop.size());
  for (size_t i = 0; i < loop.size(); ++i) {
    signs[i] = has_corner(g, loop[i]) ? 0 : side(g, loop[i]);
  }
}

/// Whether two triangles certainly meet in common corners and edges only: nearly all pairs do.
bool FacePairs::triangles_apart(const uint32_t* f, const uint32_t* g, uint32_t plane_of_f) const {
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
  if (corners(f).size() == 3 && corners(g).size() == 3) {
    const uint32_t *p = corners(f).data(), *q = corners(g).data();
    if (triangles_apart(p, q, f) || triangles_apart(q, p, g)) return false;
  }
  // The face with fewer corners is held against the plane of the other: mostly that decides.
  if (corners(f).size() < corners(g).size()) std::swap(f, g);
  const Corners loop = corners(g);
  signs_against(g, f, scratch.signs_g);
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
  signs_against(f, g, scratch.signs_f);
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
  const std::array<double, 3>& normal = planes_[f].normal;
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::fabs(normal[k]) > std::fabs(normal[axis])) axis = k;
  }
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  const auto turn = [&](uint32_t a, uint32_t b, uint32_t c) {
    const IVec3 u = difference(points_[b], points_[a]), v = difference(points_[c], points_[a]);
    return sign(static_cast<__int128>(u[x]) * v[y] - static_cast<__int128>(u[y]) * v[x]);
  };
  // Convex polygons with disjoint insides are separated by the line of an edge of one of them, and
  // then meet on that line only.
  const auto separated = [&](uint32_t one, uint32_t other) {
    const int front = planes_[one].normal[axis] > 0 ? 1 : -1;
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
  const auto before = [&](uint32_t a, uint32_t b) { return points_[a] < points_[b]; };
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
  const auto at = [&](uint32_t v) { return points_[v]; };
  const auto dot = [](const Point& a, const Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  const Point& normal = planes_[g].normal;
  std::vector<Point> polygon;
  for (uint32_t v : corners(f)) polygon.push_back(at(v));
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
                                    [&](uint32_t v) { return side(g, v) == 0; });
  if (!coplanar) clip(normal, dot(normal, at(planes_[g].base[0])), true);
  const Corners loop = corners(g);
  for (size_t i = 0; i < loop.size(); ++i) {
    const Point a = at(loop[i]), b = at(loop[(i + 1) % loop.size()]);
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
