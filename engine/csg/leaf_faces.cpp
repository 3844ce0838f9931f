#include "engine/csg/leaf_faces.h"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "engine/csg/wide_cross.h"
#include "engine/mesh/triangulate.h"

namespace csgrun {
namespace {

using Loop = std::vector<uint32_t>;
using Corners = std::span<const uint32_t>;

int sign(Int128 x) { return (x > 0) - (x < 0); }

/// Twice the vector area, by Newell's formula.
Vec128 loop_normal(const std::vector<IVec3>& vertices, Corners loop) {
  Vec128 sum{};
  for (size_t i = 1; i + 1 < loop.size(); ++i) {
    const Vec128 n = cross(vertices[loop[0]], vertices[loop[i]], vertices[loop[i + 1]]);
    for (int k = 0; k < 3; ++k) sum[k] += n[k];
  }
  return sum;
}

int dominant_axis(const Vec128& n) {
  const auto magnitude = [&](int i) { return n[i] < 0 ? -n[i] : n[i]; };
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (magnitude(i) > magnitude(axis)) axis = i;
  }
  return axis;
}

/// Points of a face as seen along an axis, from the side where its front is.
class ProjectedOracle final : public PlanarOracle {
 public:
  /// The sweep is the same for either front, so that faces that lie on one another are divided in
  /// the same way: flat ones, as those of stacked extrusions, lest every sliver of one meets every
  /// sliver of the other; bent ones, as those of a plug and its socket, lest there are gaps.
  ProjectedOracle(const std::vector<IVec3>& vertices, int axis, bool front_is_positive)
      : vertices_(vertices),
        u_((axis + 1) % 3),
        v_((axis + 2) % 3),
        front_(front_is_positive ? 1 : -1) {}
  int orient(uint32_t a, uint32_t b, uint32_t c) const override {
    const IVec3 &p = vertices_[a], &q = vertices_[b], &r = vertices_[c];
    return front_ * sign(static_cast<Int128>(q[u_] - p[u_]) * (r[v_] - p[v_]) -
                         static_cast<Int128>(q[v_] - p[v_]) * (r[u_] - p[u_]));
  }
  int compare(uint32_t a, uint32_t b) const override {
    const IVec3 &p = vertices_[a], &q = vertices_[b];
    if (p[u_] != q[u_]) return p[u_] < q[u_] ? -1 : 1;
    if (p[v_] != q[v_]) return p[v_] < q[v_] ? -1 : 1;
    return 0;
  }
  double along(uint32_t a) const override { return static_cast<double>(vertices_[a][u_]); }
  /// Whether a loop turns left (or goes straight) everywhere, and around once.
  [[nodiscard]] bool is_convex(Corners loop) const {
    const size_t n = loop.size();
    int changes = 0;
    for (size_t i = 0; i < n; ++i) {
      const uint32_t a = loop[i], b = loop[(i + 1) % n], c = loop[(i + 2) % n];
      const int turn = orient(a, b, c);
      // Forwards or backwards along the sweep; a convex loop changes twice.
      const int in = compare(a, b), out = compare(b, c);
      if (turn < 0 || (turn == 0 && in != out) || in == 0) return false;
      changes += in != out;
    }
    return changes == 2;
  }

 private:
  const std::vector<IVec3>& vertices_;
  int u_, v_;
  int front_;  ///< +1 when (u, v) is right-handed seen from the front
};

bool lies_in(const CornerPlane& plane, const std::vector<IVec3>& vertices, Corners loop) {
  return std::all_of(loop.begin(), loop.end(),
                     [&](uint32_t v) { return plane.side(vertices[v]) == 0; });
}

bool is_planar(const std::vector<IVec3>& vertices, const LoopFace& face) {
  CornerPlane plane;
  if (!corner_plane(vertices, face.loops[0].data(), face.loops[0].size(), plane)) return false;
  return std::all_of(face.loops.begin(), face.loops.end(),
                     [&](const Loop& loop) { return lies_in(plane, vertices, loop); });
}

/// Of a loop in one plane.
bool is_planar_convex(const std::vector<IVec3>& vertices, Corners loop) {
  const Vec128 normal = loop_normal(vertices, loop);
  const int axis = dominant_axis(normal);
  return normal[axis] != 0 && ProjectedOracle(vertices, axis, normal[axis] > 0).is_convex(loop);
}

bool is_collinear(const std::vector<IVec3>& vertices, const Loop& loop) {
  CornerPlane plane;
  return !corner_plane(vertices, loop.data(), loop.size(), plane);
}

bool drop_collinear_loops(const std::vector<IVec3>& vertices, std::vector<LoopFace>& faces) {
  return drop_collinear_loops(vertices, faces,
                              [&](const Loop& loop) { return is_collinear(vertices, loop); });
}

using LoopTriangle = std::array<uint32_t, 3>;

/// Whether the boundary of the triangles is the loops.
bool covers(const std::vector<LoopTriangle>& triangles, const std::vector<Loop>& loops) {
  std::vector<std::pair<uint32_t, uint32_t>> plus, minus;
  for (const LoopTriangle& t : triangles) {
    for (int i = 0; i < 3; ++i) plus.emplace_back(t[i], t[(i + 1) % 3]);
  }
  for (const Loop& loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) {
      plus.emplace_back(loop[(i + 1) % loop.size()], loop[i]);
    }
  }
  for (const auto& [a, b] : plus) minus.emplace_back(b, a);
  std::sort(plus.begin(), plus.end());
  std::sort(minus.begin(), minus.end());
  return plus == minus;
}

/// A quadrilateral that is bent over one diagonal: split at the other one, which lies outside.
/// Nothing if its first three corners are on a line.
std::optional<BulgingTriangles> bulging_triangles(const std::vector<IVec3>& vertices,
                                                  Corners quad) {
  CornerPlane plane;
  if (!corner_plane(vertices, quad.data(), 3, plane)) return std::nullopt;
  if (plane.side(vertices[quad[3]]) < 0) {
    return BulgingTriangles{{{quad[0], quad[1], quad[2]}, {quad[0], quad[2], quad[3]}}};
  }
  return BulgingTriangles{{{quad[1], quad[2], quad[3]}, {quad[1], quad[3], quad[0]}}};
}

/// `is_flat`: its corners are in one plane. Others may be divided so that they are convex.
std::vector<LoopTriangle> triangles_of(const std::vector<IVec3>& vertices, const LoopFace& face,
                                       bool is_flat, bool prefer_convex) {
  Vec128 normal{};
  for (const Loop& loop : face.loops) {
    const Vec128 n = loop_normal(vertices, loop);
    for (int k = 0; k < 3; ++k) normal[k] += n[k];
  }
  if (is_zero(normal)) return {};
  const int best = dominant_axis(normal);
  for (int turn = 0; turn < 3; ++turn) {
    const int axis = (best + turn) % 3;
    if (normal[axis] == 0) continue;
    const ProjectedOracle oracle(vertices, axis, normal[axis] > 0);
    if (prefer_convex && !is_flat && face.loops.size() == 1 && face.loops[0].size() == 4 &&
        oracle.is_convex(face.loops[0])) {
      const auto triangles = bulging_triangles(vertices, face.loops[0]);
      if (triangles) return {triangles->begin(), triangles->end()};
    }
    auto result = triangulate_face(face.loops, oracle);
    if (result && covers(*result, face.loops)) return std::move(*result);
  }
  return {};
}

/// They keep the surface closed, and the test for self-intersections tells whether it is still a
/// solid.
std::vector<LoopTriangle> fans_of(const LoopFace& face) {
  std::vector<LoopTriangle> fans;
  for (const Loop& loop : face.loops) {
    for (size_t i = 1; i + 1 < loop.size(); ++i) fans.push_back({loop[0], loop[i], loop[i + 1]});
  }
  return fans;
}

/// A loop's vertices from its lowest one on.
Loop from_lowest(Loop loop) {
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  return loop;
}

/// The faces whose corners another face may have, too: those with equal sums of hashes. Ascending.
std::vector<uint32_t> find_equal_corners(const std::vector<LoopFace>& faces) {
  std::vector<std::pair<uint64_t, uint32_t>> keys;
  keys.reserve(faces.size());
  for (uint32_t f = 0; f < faces.size(); ++f) {
    uint64_t key = 0;
    for (const uint64_t v : faces[f].loops[0]) {
      const uint64_t h = (v + 1) * 0x9e3779b97f4a7c15ull;
      key += (h ^ h >> 32) * 0xff51afd7ed558ccdull;
    }
    keys.emplace_back(key, f);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<uint32_t> found;
  for (size_t i = 0; i < keys.size(); ++i) {
    const bool is_equal = (i > 0 && keys[i].first == keys[i - 1].first) ||
                          (i + 1 < keys.size() && keys[i].first == keys[i + 1].first);
    if (is_equal) found.push_back(keys[i].second);
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Pairs of faces that are each other's reverse enclose nothing.
void cancel_opposite_faces(std::vector<LoopFace>& faces) {
  std::map<Loop, std::vector<size_t>> open;
  for (const uint32_t f : find_equal_corners(faces)) {
    Loop reverse = faces[f].loops[0];
    std::reverse(reverse.begin(), reverse.end());
    const auto found = open.find(from_lowest(std::move(reverse)));
    if (found != open.end() && !found->second.empty()) {
      faces[found->second.back()].loops.clear();
      found->second.pop_back();
      faces[f].loops.clear();
    } else {
      open[from_lowest(faces[f].loops[0])].push_back(f);
    }
  }
  drop_empty_loops(faces);
}

}  // namespace

int CornerPlane::side(const IVec3& p) const {
  Int128 sum = 0;
  for (int i = 0; i < 3; ++i) sum += normal[i] * (p[i] - point[i]);
  return sign(sum);
}

bool corner_plane(const std::vector<IVec3>& vertices, const uint32_t* corners, size_t count,
                  CornerPlane& plane) {
  for (size_t i = 2; i < count; ++i) {
    plane.normal = cross(vertices[corners[0]], vertices[corners[1]], vertices[corners[i]]);
    if (is_zero(plane.normal)) continue;
    plane.point = vertices[corners[0]];
    return true;
  }
  return false;
}

bool is_convex_polygon(const std::vector<IVec3>& vertices, Corners loop) {
  CornerPlane plane;
  return corner_plane(vertices, loop.data(), loop.size(), plane) &&
         lies_in(plane, vertices, loop) && is_planar_convex(vertices, loop);
}

std::optional<BulgingTriangles> split_bent_quad(const std::vector<IVec3>& vertices, Corners quad) {
  const Vec128 normal = loop_normal(vertices, quad);
  const int axis = dominant_axis(normal);
  if (normal[axis] == 0) return std::nullopt;
  if (!ProjectedOracle(vertices, axis, normal[axis] > 0).is_convex(quad)) return std::nullopt;
  return bulging_triangles(vertices, quad);
}

std::vector<LoopTriangle> triangulate(const std::vector<IVec3>& vertices, const LoopFace& face) {
  return triangles_of(vertices, face, is_planar(vertices, face), false);
}

bool make_convex_faces(const std::vector<IVec3>& vertices, bool prefer_convex, bool merged,
                       std::vector<LoopFace>& faces) {
  // `flat`: a loop that touches itself may leave triangles without area, in a plane too.
  bool collapsed = false, bent = false, flat = false, simple = true;
  for (LoopFace& face : faces) {
    for (Loop& loop : face.loops) {
      const size_t before = loop.size();
      clean_loop(loop);
      collapsed |= loop.size() != before;
    }
  }
  drop_empty_loops(faces);
  collapsed |= drop_collinear_loops(vertices, faces);

  std::vector<LoopFace> result;
  result.reserve(faces.size());
  for (LoopFace& face : faces) {
    if (face.loops.size() == 1 && face.loops[0].size() == 3) {  // not collinear, by now
      result.push_back(std::move(face));
      continue;
    }
    const bool planar = is_planar(vertices, face);
    if (planar && face.loops.size() == 1 && is_planar_convex(vertices, face.loops[0])) {
      result.push_back(std::move(face));
      continue;
    }
    bent |= !planar;
    auto triangles = triangles_of(vertices, face, planar, prefer_convex);
    if (triangles.empty()) {
      simple = false;
      triangles = fans_of(face);
    }
    for (const LoopTriangle& t : triangles) {
      LoopFace piece{{{t[0], t[1], t[2]}}, face.facet, face.surface, face.appearance};
      flat |= is_collinear(vertices, piece.loops[0]);
      result.push_back(std::move(piece));
    }
  }
  faces = std::move(result);
  if (collapsed || bent || flat) {
    for (LoopFace& face : faces) clean_loop(face.loops[0]);
    drop_empty_loops(faces);
    collapsed |= drop_collinear_loops(vertices, faces);
  }
  if (merged || collapsed) cancel_opposite_faces(faces);
  return simple;
}

}  // namespace csgrun
