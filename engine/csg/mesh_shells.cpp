#include "engine/csg/mesh_shells.h"

#include <algorithm>
#include <utility>

#include "engine/base/none.h"
#include "engine/bsp/union_find.h"

namespace csgrun {
namespace {

/// Calls f(from, to) for the edges of a face.
template <class F>
void each_edge(const PolygonMesh& mesh, size_t face, F&& f) {
  for (uint32_t l = mesh.face_starts[face]; l < mesh.face_starts[face + 1]; ++l) {
    const uint32_t begin = mesh.loop_starts[l], end = mesh.loop_starts[l + 1];
    for (uint32_t c = begin; c < end; ++c) {
      f(mesh.corners[c], mesh.corners[c + 1 < end ? c + 1 : begin]);
    }
  }
}

/// Whether each edge runs back as often as it runs.
bool is_closed(const PolygonMesh& mesh) {
  using Edge = std::pair<uint64_t, int>;  // its points, the lower one first, and which way
  std::vector<Edge> edges;
  edges.reserve(mesh.corners.size());
  for (size_t f = 0; f < mesh.face_count(); ++f) {
    each_edge(mesh, f, [&](uint32_t from, uint32_t to) {
      if (from == to) return;
      const uint64_t low = std::min(from, to), high = std::max(from, to);
      edges.emplace_back(low << 32 | high, from < to ? 1 : -1);
    });
  }
  std::sort(edges.begin(), edges.end());
  for (size_t i = 0; i < edges.size();) {
    int sum = 0;
    const uint64_t points = edges[i].first;
    for (; i < edges.size() && edges[i].first == points; ++i) sum += edges[i].second;
    if (sum != 0) return false;
  }
  return true;
}

}  // namespace

MeshShells::MeshShells(std::shared_ptr<const PolygonMesh> mesh) : mesh_(std::move(mesh)) {
  const auto count = static_cast<uint32_t>(mesh_->face_count());
  UnionFind joined(mesh_->points.size());
  const auto corners = [&](uint32_t face) {
    const uint32_t begin = mesh_->loop_starts[mesh_->face_starts[face]];
    const uint32_t end = mesh_->loop_starts[mesh_->face_starts[face + 1]];
    return std::span(mesh_->corners).subspan(begin, end - begin);
  };
  const bool may_part = is_closed(*mesh_);
  for (uint32_t f = 0; f < count; ++f) {
    // All faces of a mesh that may not be parted are joined with the first one's.
    const uint32_t first = (may_part ? corners(f) : corners(0))[0];
    for (const uint32_t v : corners(f)) joined.join(first, v);
  }
  std::vector<uint32_t> number(joined.size(), kNone);
  for (uint32_t f = 0; f < count; ++f) {
    uint32_t& shell = number[joined.find(corners(f)[0])];
    if (shell == kNone) {
      shell = static_cast<uint32_t>(faces_.size());
      faces_.emplace_back();
      boxes_.push_back(PointBox::nothing());
    }
    faces_[shell].push_back(f);
    for (const uint32_t v : corners(f)) boxes_[shell].include(mesh_->points[v]);
  }
}

std::shared_ptr<const PolygonMesh> MeshShells::mesh_of(std::span<const uint32_t> shells) const {
  std::vector<uint32_t> faces, points;
  for (const uint32_t shell : shells) {
    faces.insert(faces.end(), faces_[shell].begin(), faces_[shell].end());
  }
  std::sort(faces.begin(), faces.end());
  for (const uint32_t f : faces) {
    each_edge(*mesh_, f, [&](uint32_t from, uint32_t) { points.push_back(from); });
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  auto part = std::make_shared<PolygonMesh>();
  for (const uint32_t p : points) part->points.push_back(mesh_->points[p]);
  for (const uint32_t f : faces) {
    for (uint32_t l = mesh_->face_starts[f]; l < mesh_->face_starts[f + 1]; ++l) {
      for (uint32_t c = mesh_->loop_starts[l]; c < mesh_->loop_starts[l + 1]; ++c) {
        const auto at = std::lower_bound(points.begin(), points.end(), mesh_->corners[c]);
        part->corners.push_back(static_cast<uint32_t>(at - points.begin()));
      }
      part->loop_starts.push_back(static_cast<uint32_t>(part->corners.size()));
    }
    part->face_starts.push_back(static_cast<uint32_t>(part->loop_count()));
    if (!mesh_->surface.empty()) part->surface.push_back(mesh_->surface[f]);
    if (!mesh_->appearance_of.empty()) part->appearance_of.push_back(mesh_->appearance_of[f]);
  }
  part->appearances = mesh_->appearances;
  part->keep_facets = mesh_->keep_facets;
  part->fill = mesh_->fill;
  part->overlaps = true;
  part->kind = mesh_->kind;
  return part;
}

}  // namespace csgrun
