// OpenSCAD gives faces to libtess2, in single precision. What that comes to for four corners, found
// by running it on thousands of quadrilaterals with and without ties:
// (1) The normal is that of the largest triangle with two corners that are farthest apart along an
//     axis; the face is seen along the normal's longest component.
// (2) Of two neighbours that are one there, the one that is lost is cut off; so is one from which
// the
//     outline runs straight back. A corner that is not convex has the diagonal. Else the second
//     corner has it, in the order of the first coordinate there, then of the other.
// (3) The other diagonal is taken if the angles opposite to the first one are more than 180 degrees
//     and a hundredth of a radian: Delaunay's rule, with a tolerance that decides ties.
#include "primitives/solids/bent_quads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <csgrun/primitives/trig.h>

namespace csgrun {
namespace {

/// The coordinates as they are compared there; -ffp-contract=off makes each operation a rounding.
using QuadCorner = std::array<float, 3>;
using Quad = std::array<QuadCorner, 4>;

/// The axis that it is seen along, by OpenSCAD; -1 when all corners lie on a line.
int view_axis(const Quad& quad) {
  constexpr int kOrder[] = {1, 2, 3, 0};  // in which corners are compared: the first of equals wins
  std::array<const QuadCorner*, 3> low{}, high{};
  low.fill(&quad[1]);
  high.fill(&quad[1]);
  for (const int k : kOrder) {
    for (size_t i = 0; i < 3; ++i) {
      if (quad[k][i] < (*low[i])[i]) low[i] = &quad[k];
      if (quad[k][i] > (*high[i])[i]) high[i] = &quad[k];
    }
  }
  const auto extent = [&](size_t i) { return (*high[i])[i] - (*low[i])[i]; };
  size_t widest = extent(1) > extent(0) ? 1 : 0;
  if (extent(2) > extent(widest)) widest = 2;
  const QuadCorner &from = *low[widest], &to = *high[widest];
  const auto less = [&](const QuadCorner& p) {
    return QuadCorner{p[0] - to[0], p[1] - to[1], p[2] - to[2]};
  };
  const QuadCorner d = less(from);
  QuadCorner normal{};
  float largest = 0;
  for (const int k : kOrder) {
    const QuadCorner r = less(quad[k]);
    const QuadCorner n{d[1] * r[2] - d[2] * r[1], d[2] * r[0] - d[0] * r[2],
                       d[0] * r[1] - d[1] * r[0]};
    const float length = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    if (length <= largest) continue;
    largest = length;
    normal = n;
  }
  if (!(largest > 0)) return -1;
  int axis = std::fabs(normal[1]) > std::fabs(normal[0]) ? 1 : 0;
  if (std::fabs(normal[2]) > std::fabs(normal[axis])) axis = 2;
  return axis;
}

double across(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// The angle at p between the ways to q and r, degrees.
double angle(const glm::dvec2& p, const glm::dvec2& q, const glm::dvec2& r) {
  return std::fabs(atan2_deg(across(q - p, r - p), glm::dot(q - p, r - p)));
}

/// A corner at an end of the diagonal; -1 when there is no saying.
int diagonal_of(const Quad& quad) {
  const int axis = view_axis(quad);
  if (axis < 0) return -1;
  std::array<glm::dvec2, 4> p;
  for (int k = 0; k < 4; ++k) p[k] = {quad[k][(axis + 1) % 3], quad[k][(axis + 2) % 3]};
  double area = 0;
  for (int k = 0; k < 4; ++k) area += across(p[k], p[(k + 1) % 4]);
  if (area == 0) return -1;
  if (area < 0) {  // seen from its front
    for (glm::dvec2& corner : p) corner.y = -corner.y;
  }
  constexpr int kLost[] = {0, 2, 3, 0};  // of corners k and k + 1, when they are one
  int lost = -1, concave = -1, count = 0;
  for (int k = 0; k < 4; ++k) {
    const glm::dvec2 &before = p[(k + 3) % 4], &after = p[(k + 1) % 4];
    if (p[k] == after) {
      if (lost >= 0) return -1;
      lost = kLost[k];
    }
    const double turn = across(p[k] - before, after - p[k]);
    if (turn > 0) continue;
    const bool spike = turn == 0 && glm::dot(p[k] - before, after - p[k]) < 0;
    concave = spike ? (k + 1) % 4 : k;
    ++count;
  }
  if (lost >= 0) return (lost + 1) % 4;
  if (count > 0) return count == 1 ? concave : -1;
  std::array<int, 4> order{0, 1, 2, 3};
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return std::pair(p[a].x, p[a].y) < std::pair(p[b].x, p[b].y); });
  const int end = order[1], other = (end + 1) % 4;
  constexpr double kTolerance = 0.01 * 180 / 3.14159265358979323846;
  const double opposed =
      angle(p[other], p[end], p[(end + 2) % 4]) + angle(p[(end + 3) % 4], p[end], p[(end + 2) % 4]);
  return opposed >= 180 + kTolerance ? other : end;
}

bool is_bent(const std::array<glm::dvec3, 4>& p) {
  constexpr double kFlat = 1e-7;
  double longest = 0;
  for (int k = 0; k < 4; ++k) longest = std::max(longest, glm::distance(p[k], p[(k + 1) % 4]));
  const double volume = glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]);
  return std::fabs(volume) > kFlat * longest * longest * longest;
}

bool is_bent_quad(const PolygonMesh& mesh, size_t f) {
  const uint32_t loop = mesh.face_starts[f];
  if (mesh.face_starts[f + 1] != loop + 1) return false;
  const uint32_t begin = mesh.loop_starts[loop];
  if (mesh.loop_starts[loop + 1] != begin + 4) return false;
  std::array<glm::dvec3, 4> p;
  for (int k = 0; k < 4; ++k) p[k] = mesh.points[mesh.corners[begin + k]];
  return is_bent(p);
}

/// A corner at an end of the diagonal that face `f` is to be cut along, or -1.
int cut_of(const PolygonMesh& mesh, size_t f, const std::vector<glm::dvec3>& seen,
           bool is_mirrored) {
  if (!is_bent_quad(mesh, f)) return -1;
  const uint32_t* corners = &mesh.corners[mesh.loop_starts[mesh.face_starts[f]]];
  Quad quad;
  for (int k = 0; k < 4; ++k) {
    const glm::dvec3& p = seen[corners[is_mirrored ? 3 - k : k]];
    for (int i = 0; i < 3; ++i) quad[k][i] = static_cast<float>(p[i]);
  }
  const int end = diagonal_of(quad);
  return is_mirrored && end >= 0 ? 3 - end : end;
}

}  // namespace

bool has_bent_quads(const PolygonMesh& mesh) {
  for (size_t f = 0; f < mesh.face_count(); ++f) {
    if (is_bent_quad(mesh, f)) return true;
  }
  return false;
}

void cut_bent_quads(PolygonMesh& mesh) { cut_bent_quads(mesh, mesh.points, false); }

void cut_bent_quads(PolygonMesh& mesh, const std::vector<glm::dvec3>& seen, bool is_mirrored) {
  std::vector<int8_t> cuts(mesh.face_count());
  bool any = false;
  for (size_t f = 0; f < cuts.size(); ++f) {
    cuts[f] = static_cast<int8_t>(cut_of(mesh, f, seen, is_mirrored));
    any |= cuts[f] >= 0;
  }
  if (!any) return;
  std::vector<uint32_t> corners, loop_starts{0}, face_starts{0}, surface, appearance_of;
  const auto end_loop = [&] { loop_starts.push_back(static_cast<uint32_t>(corners.size())); };
  const auto end_face = [&](size_t f) {
    face_starts.push_back(static_cast<uint32_t>(loop_starts.size() - 1));
    if (!mesh.surface.empty()) surface.push_back(mesh.surface[f]);
    if (!mesh.appearance_of.empty()) appearance_of.push_back(mesh.appearance_of[f]);
  };
  for (size_t f = 0; f < cuts.size(); ++f) {
    if (cuts[f] < 0) {
      for (uint32_t l = mesh.face_starts[f]; l < mesh.face_starts[f + 1]; ++l) {
        corners.insert(corners.end(), mesh.corners.begin() + mesh.loop_starts[l],
                       mesh.corners.begin() + mesh.loop_starts[l + 1]);
        end_loop();
      }
      end_face(f);
      continue;
    }
    const uint32_t* quad = &mesh.corners[mesh.loop_starts[mesh.face_starts[f]]];
    const int end = cuts[f];
    for (const int second : {1, 2}) {
      for (const int k : {0, second, second + 1}) corners.push_back(quad[(end + k) % 4]);
      end_loop();
      end_face(f);
    }
  }
  mesh.corners = std::move(corners);
  mesh.loop_starts = std::move(loop_starts);
  mesh.face_starts = std::move(face_starts);
  mesh.surface = std::move(surface);
  mesh.appearance_of = std::move(appearance_of);
}

}  // namespace csgrun
