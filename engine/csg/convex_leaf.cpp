#include "engine/csg/convex_leaf.h"

#include <algorithm>
#include <bit>
#include <span>

#include "engine/csg/leaf_faces.h"
#include "engine/mesh/leaf_shape.h"

namespace csgrun {
namespace {

constexpr uint32_t kNone = UINT32_MAX;

/// Gives points numbers in the order in which they are asked for, equal points the same one.
class Numbering {
 public:
  explicit Numbering(const std::vector<IVec3>& points)
      : points_(points),
        number_(points.size(), kNone),
        table_(std::bit_ceil(2 * points.size() + 1), kNone) {
    vertices_.reserve(points.size());
  }

  uint32_t operator()(uint32_t point) {
    const uint32_t known = number_[point];
    return known != kNone ? known : find(point);
  }
  [[nodiscard]] bool merged() const { return merged_; }
  [[nodiscard]] const std::vector<IVec3>& vertices() const { return vertices_; }
  std::vector<IVec3> take_vertices() { return std::move(vertices_); }

 private:
  static uint64_t hash(const IVec3& p) {
    uint64_t h = 0;
    for (const int64_t c : p)
      h = (std::rotl(h, 29) ^ static_cast<uint64_t>(c)) * 0xff51afd7ed558ccdULL;
    return h ^ h >> 32;
  }

  uint32_t find(uint32_t point) {
    const IVec3& p = points_[point];
    const size_t mask = table_.size() - 1;
    size_t at = hash(p) & mask;
    while (table_[at] != kNone && vertices_[table_[at]] != p) at = (at + 1) & mask;
    if (table_[at] == kNone) {
      table_[at] = static_cast<uint32_t>(vertices_.size());
      vertices_.push_back(p);
    } else {
      merged_ = true;
    }
    return number_[point] = table_[at];
  }

  const std::vector<IVec3>& points_;
  std::vector<uint32_t> number_;
  std::vector<uint32_t> table_;  ///< of vertices, open; it is only asked, never walked through
  std::vector<IVec3> vertices_;
  bool merged_ = false;
};

bool has_area(const IVec3& a, const IVec3& b, const IVec3& c) {
  const IVec3 u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  return u[1] * v[2] != u[2] * v[1] || u[2] * v[0] != u[0] * v[2] || u[0] * v[1] != u[1] * v[0];
}

/// Leaves out vertices that no face uses, and puts the others in the order of their first use.
void renumber(LeafGeometry& leaf) {
  std::vector<uint32_t> number(leaf.vertices.size(), kNone);
  std::vector<IVec3> used;
  used.reserve(leaf.vertices.size());
  for (uint32_t& corner : leaf.corners) {
    uint32_t& known = number[corner];
    if (known == kNone) {
      known = static_cast<uint32_t>(used.size());
      used.push_back(leaf.vertices[corner]);
    }
    corner = known;
  }
  leaf.vertices = std::move(used);
}

}  // namespace

std::optional<ConvexFaces> take_convex_faces(const PolygonMesh& mesh,
                                             const std::vector<IVec3>& points, bool turn,
                                             const std::vector<uint32_t>& appearance) {
  if (mesh.loop_count() != mesh.face_count() || !is_compact(box_of_points(points)))
    return std::nullopt;
  std::optional<ConvexFaces> result(std::in_place);
  LeafGeometry& leaf = result->leaf;
  const size_t faces = mesh.face_count();
  leaf.corners.reserve(mesh.corners.size());
  leaf.face_starts.reserve(faces + 1);
  for (auto* labels : {&leaf.facet, &leaf.surface, &leaf.appearance}) labels->reserve(faces);
  Numbering number(points);
  bool dropped = false;
  for (uint32_t f = 0; f < faces; ++f) {
    if (mesh.face_starts[f] != f) return std::nullopt;  // not one loop
    const uint32_t begin = mesh.loop_starts[f], end = mesh.loop_starts[f + 1], count = end - begin;
    const size_t first = leaf.corners.size();
    for (uint32_t i = 0; i < count; ++i) {
      leaf.corners.push_back(number(mesh.corners[turn ? end - 1 - i : begin + i]));
    }
    const uint32_t* const loop = leaf.corners.data() + first;
    if (count == 3) {
      if (loop[0] == loop[1] || loop[1] == loop[2] || loop[2] == loop[0]) {
        leaf.corners.resize(first);
        dropped = true;
        continue;
      }
      const auto& v = number.vertices();
      if (!has_area(v[loop[0]], v[loop[1]], v[loop[2]])) return std::nullopt;
    } else if (!is_convex_polygon(number.vertices(), {loop, count})) {
      return std::nullopt;
    }
    leaf.face_starts.push_back(static_cast<uint32_t>(leaf.corners.size()));
    leaf.facet.push_back(mesh.keep_facets ? f + 1 : 0);
    leaf.surface.push_back(mesh.surface.empty() ? 0 : mesh.surface[f]);
    leaf.appearance.push_back(appearance[f]);
  }
  leaf.vertices = number.take_vertices();
  if (dropped) renumber(leaf);
  result->merged = dropped || number.merged();
  result->box = box_of_points(leaf.vertices);
  return result;
}

bool has_reversed_pair(const LeafGeometry& leaf, const std::vector<uint32_t>& opposite) {
  return with_face_of(leaf, [&](auto face_of) {
    for (uint32_t f = 0; f < leaf.face_count(); ++f) {
      const std::span edges(opposite.data() + leaf.face_starts[f],
                            opposite.data() + leaf.face_starts[f + 1]);
      const uint32_t other = face_of(edges[0]);
      if (leaf.face_starts[other + 1] - leaf.face_starts[other] == edges.size() &&
          std::all_of(edges.begin(), edges.end(),
                      [&](uint32_t edge) { return face_of(edge) == other; })) {
        return true;
      }
    }
    return false;
  });
}

}  // namespace csgrun
