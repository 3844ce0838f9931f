#include "engine/csg/collinear_triangles.h"

#include <algorithm>

#include "engine/csg/leaf_faces.h"
#include "engine/mesh/loop_faces.h"

namespace csgrun {
namespace {

bool has_equal_corners(const LeftOut& face) {
  const auto& [a, b, c] = face.corners;
  return a == b || b == c || c == a;
}

/// In place of a face of the leaf.
constexpr uint32_t kCollinear = UINT32_MAX;

/// The faces of the leaf with two corners that collinear ones have, and these, in the mesh's order.
/// LoopFace::facet names a face of the leaf, or is kCollinear.
std::vector<LoopFace> faces_beside(const LeafGeometry& leaf, std::span<const LeftOut> left_out) {
  std::vector<uint8_t> is_on_line(leaf.vertices.size(), 0);
  for (const LeftOut& face : left_out) {
    for (const uint32_t v : face.corners) is_on_line[v] |= has_equal_corners(face) ? 0 : 1;
  }
  std::vector<LoopFace> faces;
  const auto add = [&](std::span<const uint32_t> corners, uint32_t name) {
    faces.push_back({{std::vector<uint32_t>(corners.begin(), corners.end())}, name, 0, 0});
  };
  size_t next = 0;
  // As many were left out before a face of the leaf as its number in the mesh is greater.
  const auto add_left_out_before = [&](size_t f) {
    for (; next < left_out.size() && left_out[next].face <= f + next; ++next) {
      if (!has_equal_corners(left_out[next])) add(left_out[next].corners, kCollinear);
    }
  };
  for (uint32_t f = 0; f < leaf.face_count(); ++f) {
    const std::span corners(leaf.corners.data() + leaf.face_starts[f],
                            leaf.corners.data() + leaf.face_starts[f + 1]);
    uint32_t on_line = 0;
    for (const uint32_t v : corners) on_line += is_on_line[v];
    if (on_line < 2) continue;
    add_left_out_before(f);
    add(corners, f);
  }
  add_left_out_before(leaf.face_count());
  return faces;
}

}  // namespace

bool split_at_collinear(LeafGeometry& leaf, std::span<const LeftOut> left_out) {
  if (std::all_of(left_out.begin(), left_out.end(), has_equal_corners)) return true;
  std::vector<LoopFace> faces = faces_beside(leaf, left_out);
  const auto is_collinear = [&](const std::vector<uint32_t>& loop) {
    CornerPlane plane;
    return !corner_plane(leaf.vertices, loop.data(), loop.size(), plane);
  };
  drop_collinear_loops(leaf.vertices, faces, is_collinear);
  const auto size_in_leaf = [&](uint32_t f) {
    return leaf.face_starts[f + 1] - leaf.face_starts[f];
  };
  std::erase_if(faces, [&](const LoopFace& face) {
    return face.loops[0].size() == size_in_leaf(face.facet);  // as it was
  });
  const bool all_convex = std::all_of(faces.begin(), faces.end(), [&](const LoopFace& face) {
    return is_convex_polygon(leaf.vertices, face.loops[0]);
  });
  if (!all_convex) return false;
  std::vector<uint32_t> corners;
  corners.reserve(leaf.corners.size() + faces.size());
  uint32_t copied = 0, longer = 0;
  size_t changed = 0;
  const auto copy_to = [&](uint32_t end) {
    corners.insert(corners.end(), leaf.corners.begin() + copied, leaf.corners.begin() + end);
    copied = end;
  };
  for (uint32_t f = 0; f < leaf.face_count(); ++f) {
    const uint32_t begin = leaf.face_starts[f], end = leaf.face_starts[f + 1];
    leaf.face_starts[f] += longer;
    if (changed == faces.size() || faces[changed].facet != f) continue;
    const std::vector<uint32_t>& loop = faces[changed++].loops[0];
    copy_to(begin);
    corners.insert(corners.end(), loop.begin(), loop.end());
    copied = end;
    longer += static_cast<uint32_t>(loop.size()) - (end - begin);
  }
  copy_to(static_cast<uint32_t>(leaf.corners.size()));
  leaf.face_starts.back() += longer;
  leaf.corners = std::move(corners);
  return true;
}

}  // namespace csgrun
