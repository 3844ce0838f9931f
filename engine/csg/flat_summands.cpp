#include "engine/csg/flat_summands.h"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>

#include "engine/csg/leaf_faces.h"
#include "engine/csg/point_hash.h"
#include "engine/csg/quantise.h"

namespace csgrun {
namespace {

/// Points that differ, in order.
std::vector<IVec3> distinct(std::vector<IVec3> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

/// The vertices of a mesh without repetition, and its faces over them.
class FlatFaces {
 public:
  FlatFaces(const PolygonMesh& mesh, const std::vector<IVec3>& points)
      : mesh_(mesh), points_(points), vertex_of_(points.size()) {
    std::unordered_map<IVec3, uint32_t, PointHash> vertex_at;
    for (size_t p = 0; p < points.size(); ++p) {
      const auto [found, is_new] =
          vertex_at.try_emplace(points[p], static_cast<uint32_t>(vertices_.size()));
      if (is_new) vertices_.push_back(points[p]);
      vertex_of_[p] = found->second;
    }
  }

  /// Each piece once, though two faces on each other's back have it.
  [[nodiscard]] std::set<std::vector<IVec3>> pieces() const {
    std::set<std::vector<IVec3>> result;
    for (size_t f = 0; f < mesh_.face_count(); ++f) {
      std::vector<LoopFace> parts{face_at(f)};
      std::vector<uint32_t> corners;
      for (const auto& loop : parts[0].loops)
        corners.insert(corners.end(), loop.begin(), loop.end());
      make_convex_faces(vertices_, false, false, parts);
      for (const LoopFace& part : parts) result.insert(points_of(part.loops[0]));
      if (parts.empty() && !corners.empty()) result.insert(points_of(corners));  // of a segment
    }
    return result;
  }

 private:
  [[nodiscard]] LoopFace face_at(size_t f) const {
    LoopFace face;
    for (uint32_t l = mesh_.face_starts[f]; l < mesh_.face_starts[f + 1]; ++l) {
      auto& loop = face.loops.emplace_back();
      for (uint32_t c = mesh_.loop_starts[l]; c < mesh_.loop_starts[l + 1]; ++c) {
        loop.push_back(vertex_of_[mesh_.corners[c]]);
      }
    }
    return face;
  }

  [[nodiscard]] std::vector<IVec3> points_of(const std::vector<uint32_t>& vertices) const {
    std::vector<IVec3> result;
    for (const uint32_t v : vertices) result.push_back(vertices_[v]);
    return distinct(std::move(result));
  }

  const PolygonMesh& mesh_;
  const std::vector<IVec3>& points_;
  std::vector<uint32_t> vertex_of_;
  std::vector<IVec3> vertices_;
};

}  // namespace

Result<std::vector<Summand>> flat_summands(const PlacedNode& leaf, const GridStep& step) {
  const PolygonMesh& mesh = *leaf.node->mesh();
  LeafRounding rounding;
  rounding.in_world = true;
  rounding.map = leaf.map;
  const auto points = round_points(mesh, rounding, Quantiser(step));
  if (!points)
    return Error{ErrorCode::kOutOfRange, "reaches too far from the origin for the grid", {}};
  std::vector<Summand> result;
  if (mesh.hull_of_points || mesh.convex) {
    const std::vector<uint8_t> is_used = find_used_points(mesh);
    std::vector<IVec3> used;
    for (size_t p = 0; p < points->size(); ++p) {
      if (is_used[p] != 0) used.push_back((*points)[p]);
    }
    if (!used.empty()) result.push_back(convex_summand(distinct(std::move(used))));
    return result;
  }
  for (const std::vector<IVec3>& piece : FlatFaces(mesh, *points).pieces())
    result.push_back(convex_summand(piece));
  return result;
}

}  // namespace csgrun
