// Repair of orientation: faces agree with their neighbours, surfaces face outwards.
#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <span>

#include "engine/base/none.h"
#include "engine/bsp/union_find.h"
#include "engine/bsp/winding.h"
#include "engine/mesh/box_tree.h"
#include "engine/mesh/mesh_text.h"
#include "engine/mesh/repair_patches.h"
#include "engine/mesh/repair_steps.h"

namespace csgrun {
namespace {

void turn(LoopFace& face) {
  for (auto& loop : face.loops) std::reverse(loop.begin(), loop.end());
}

std::string edge_text(const RepairMesh& mesh, uint32_t low, uint32_t high) {
  return place_text(mesh.points[low]) + " - " + place_text(mesh.points[high]);
}

/// Surfaces that are balanced each on its own: patches, joined where they balance each other.
struct Surfaces {
  std::vector<uint32_t> of_face;
  uint32_t count = 0;
};

Surfaces find_surfaces(const RepairMesh& mesh) {
  const EdgeUses edges(mesh.faces, mesh.points.size());
  const Patches patches = find_patches(mesh.faces, edges);
  UnionFind joined(patches.count);
  for (const Junction& junction : find_junctions(patches, edges)) {
    for (const auto& [patch, left] : junction.left) joined.join(patch, junction.left[0].first);
  }
  Surfaces surfaces;
  std::vector<uint32_t> number(patches.count, kNone);
  for (const uint32_t patch : patches.of_face) {
    uint32_t& n = number[joined.find(patch)];
    if (n == kNone) n = surfaces.count++;
    surfaces.of_face.push_back(n);
  }
  return surfaces;
}

/// The side of a point on the line through two others, all seen along Z: which one it is must not
/// depend on the direction of the edge, and is never 0.
int side_seen_along_z(const std::vector<glm::dvec3>& points, uint32_t a, uint32_t b,
                      const glm::dvec3& p) {
  if (a > b) return -side_seen_along_z(points, b, a, p);
  const glm::dvec3 &q = points[a], &r = points[b];
  const double area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  if (area != 0) return area > 0 ? 1 : -1;
  // The point a little to the right, and much less upwards.
  if (q.y != r.y) return q.y < r.y ? -1 : 1;
  return q.x <= r.x ? 1 : -1;
}

using Corners = std::array<uint32_t, 3>;

Box box_of(const glm::dvec3& p) { return {{p.x, p.y, p.z}, {p.x, p.y, p.z}}; }

/// The triangles of a surface, to be found by what is below them.
class TrianglesAbove {
 public:
  TrianglesAbove(const std::vector<glm::dvec3>& points, std::vector<Corners> triangles)
      : triangles_(std::move(triangles)), boxes_(boxes_of(points, triangles_)), tree_(boxes_) {}
  TrianglesAbove(const TrianglesAbove&) = delete;
  TrianglesAbove& operator=(const TrianglesAbove&) = delete;

  /// Calls `visit` for each triangle whose box a ray upwards from a point meets.
  template <class Visit>
  void for_each(const glm::dvec3& p, Visit visit) const {
    constexpr double kFar = std::numeric_limits<double>::max();
    tree_.visit_all({{p.x, p.y, p.z}, {p.x, p.y, kFar}}, [&](uint32_t t) { visit(triangles_[t]); });
  }

 private:
  static std::vector<Box> boxes_of(const std::vector<glm::dvec3>& points,
                                   const std::vector<Corners>& triangles) {
    std::vector<Box> boxes;
    boxes.reserve(triangles.size());
    for (const Corners& corners : triangles) {
      boxes.push_back(box_of(points[corners[0]]));
      for (const uint32_t v : corners) boxes.back().include(box_of(points[v]));
    }
    return boxes;
  }

  std::vector<Corners> triangles_;
  std::vector<Box> boxes_;
  BoxTree tree_;  ///< of them
};

class Nesting {
 public:
  Nesting(const RepairMesh& mesh, const Surfaces& surfaces)
      : mesh_(mesh),
        faces_(surfaces.count),
        boxes_(surfaces.count),
        volume_(surfaces.count, 0),
        rays_(surfaces.count, 0),
        above_(surfaces.count) {
    for (uint32_t f = 0; f < mesh.faces.size(); ++f) faces_[surfaces.of_face[f]].push_back(f);
    for (uint32_t s = 0; s < surfaces.count; ++s) measure(s);
  }

  [[nodiscard]] double volume(uint32_t s) const { return volume_[s]; }
  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

  /// Whether surface `outer` winds around most of some points of surface `inner`. Surfaces may
  /// touch in corners and edges, so these are the middles of faces.
  [[nodiscard]] bool encloses(uint32_t outer, uint32_t inner) {
    if (outer == inner) return false;
    for (int i = 0; i < 3; ++i) {
      if (boxes_[inner].lo[i] < boxes_[outer].lo[i] || boxes_[outer].hi[i] < boxes_[inner].hi[i])
        return false;
    }
    constexpr size_t kPoints = 5;
    const std::vector<uint32_t>& faces = faces_[inner];
    int inside = 0;
    for (size_t k = 0; k < kPoints; ++k) {
      const auto& loop = mesh_.faces[faces[k * faces.size() / kPoints]].loops[0];
      glm::dvec3 middle(0);
      for (int i = 0; i < 3; ++i) middle += mesh_.points[loop[static_cast<size_t>(i)]] / 3.0;
      inside += winding(outer, middle) != 0 ? 1 : -1;
    }
    return inside > 0;
  }

  [[nodiscard]] const std::vector<uint32_t>& faces(uint32_t s) const { return faces_[s]; }

 private:
  template <class Visit>
  void for_each_triangle(uint32_t s, Visit visit) const {
    for (const uint32_t f : faces_[s]) {
      for (const auto& loop : mesh_.faces[f].loops) {
        for (size_t i = 1; i + 1 < loop.size(); ++i) visit(Corners{loop[0], loop[i], loop[i + 1]});
      }
    }
  }

  void measure(uint32_t s) {
    const glm::dvec3 origin = mesh_.points[mesh_.faces[faces_[s][0]].loops[0][0]];
    boxes_[s] = box_of(origin);
    for_each_triangle(s, [&](const Corners& t) {
      for (const uint32_t v : t) boxes_[s].include(box_of(mesh_.points[v]));
      const glm::dvec3 a = mesh_.points[t[0]] - origin, b = mesh_.points[t[1]] - origin,
                       c = mesh_.points[t[2]] - origin;
      volume_[s] += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
                    a.z * (b.x * c.y - b.y * c.x);
    });
  }

  /// How often the surface is met above a point, upwards less downwards: its winding number. Points
  /// on it and within rounding of it may count either way. O(log n) and what is met, but for the
  /// first rays of a surface, which look at all of it.
  [[nodiscard]] int64_t winding(uint32_t s, const glm::dvec3& p) {
    int64_t sum = 0;
    const auto count = [&](const Corners& t) {
      const int side = side_seen_along_z(mesh_.points, t[0], t[1], p);
      if (side_seen_along_z(mesh_.points, t[1], t[2], p) != side ||
          side_seen_along_z(mesh_.points, t[2], t[0], p) != side) {
        return;
      }
      const glm::dvec3 a = mesh_.points[t[0]] - p, b = mesh_.points[t[1]] - p,
                       c = mesh_.points[t[2]] - p;
      const double above = a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
                           a.z * (b.x * c.y - b.y * c.x);
      if (above * side > 0) sum += side;
    };
    if (rays_[s] < kFewRays) {
      ++rays_[s];
      for_each_triangle(s, count);
    } else {
      triangles_above(s).for_each(p, count);
    }
    return sum;
  }

  const TrianglesAbove& triangles_above(uint32_t s) {
    if (!above_[s]) {
      std::vector<Corners> triangles;
      for_each_triangle(s, [&](const Corners& t) { triangles.push_back(t); });
      above_[s] = std::make_unique<TrianglesAbove>(mesh_.points, std::move(triangles));
    }
    return *above_[s];
  }

  const RepairMesh& mesh_;
  std::vector<std::vector<uint32_t>> faces_;
  std::vector<Box> boxes_;
  std::vector<double> volume_;
  std::vector<size_t> rays_;                            ///< so many that looked at all faces
  std::vector<std::unique_ptr<TrianglesAbove>> above_;  ///< of surfaces with more rays
};

}  // namespace

Status orient_faces(RepairMesh& mesh, StepNote& note) {
  const EdgeUses edges(mesh.faces, mesh.points.size());
  const Patches patches = find_patches(mesh.faces, edges);
  if (patches.twisted) {
    return Error{ErrorCode::kInvalidMesh,
                 "the surface has one side only, like a Moebius strip, and no orientation: around "
                 "it faces disagree at the edge " +
                     edge_text(mesh, patches.twisted->first, patches.twisted->second),
                 {}};
  }
  const std::vector<Junction> junctions = find_junctions(patches, edges);
  const Junction* failed = nullptr;
  const auto turned = balance_junctions(patches.count, junctions, &failed);
  if (!turned) {
    return Error{ErrorCode::kInvalidMesh,
                 "no orientation of the surfaces that meet in edges of more than two faces makes "
                 "them agree: tried in vain at the edge " +
                     edge_text(mesh, failed->low, failed->high),
                 {}};
  }
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    if (patches.turned[f] == (*turned)[patches.of_face[f]]) continue;
    note.add_at(mesh.points[mesh.faces[f].loops[0][0]]);
    turn(mesh.faces[f]);
  }
  return std::monostate{};
}

void orient_outwards(RepairMesh& mesh, StepNote& note) {
  const Surfaces surfaces = find_surfaces(mesh);
  Nesting nesting(mesh, surfaces);
  std::vector<uint32_t> inverted;
  for (uint32_t s = 0; s < surfaces.count; ++s) {
    if (nesting.volume(s) < 0) inverted.push_back(s);
  }
  if (inverted.empty()) return;
  const BoxTree tree(nesting.boxes());
  std::vector<bool> turned(surfaces.count, false);
  for (const uint32_t s : inverted) {
    bool is_outermost = true;
    tree.visit_all(nesting.boxes()[s], [&](uint32_t o) {
      if (is_outermost) is_outermost = !nesting.encloses(o, s);
    });
    turned[s] = is_outermost;
  }
  const std::vector<bool> outermost = turned;
  for (const uint32_t s : inverted) {
    if (!outermost[s]) continue;
    tree.visit_all(nesting.boxes()[s], [&](uint32_t inner) {
      if (!turned[inner] && nesting.encloses(s, inner)) turned[inner] = true;
    });
  }
  for (uint32_t s = 0; s < surfaces.count; ++s) {
    if (!turned[s]) continue;
    note.add_at(mesh.points[mesh.faces[nesting.faces(s)[0]].loops[0][0]]);
    for (const uint32_t f : nesting.faces(s)) turn(mesh.faces[f]);
  }
}

}  // namespace csgrun
