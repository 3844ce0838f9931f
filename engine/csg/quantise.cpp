#include "engine/csg/quantise.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>
#include <utility>

#include "engine/base/none.h"
#include "engine/base/parallel.h"
#include "engine/bsp/corner_walk.h"
#include "engine/csg/convex_hull.h"
#include "engine/csg/convex_leaf.h"
#include "engine/csg/fine_triangles.h"
#include "engine/csg/flat_sides.h"
#include "engine/csg/leaf_faces.h"
#include "engine/csg/point_hash.h"
#include "engine/mesh/convex_surface.h"
#include "engine/mesh/leaf_check.h"
#include "engine/mesh/leaf_shape.h"
#include "engine/mesh/opposite_edges.h"

namespace csgrun {
namespace {

/// Vertices without repetition, and the faces over them.
struct Merged {
  std::vector<IVec3> vertices;
  std::vector<LoopFace> faces;
  bool any = false;  // points became one
};

/// `triangles`, if there are any, take the places of faces (see fine_triangles).
Merged merge_points(const PolygonMesh& mesh, const std::vector<IVec3>& points, bool turn,
                    const FaceNumbers& appearance,
                    std::span<const std::vector<std::array<uint32_t, 3>>> triangles = {}) {
  Merged result;
  std::unordered_map<IVec3, uint32_t, PointHash> vertex_at;
  vertex_at.reserve(points.size());
  std::vector<uint32_t> vertex_of(points.size(), kNone);
  result.faces.reserve(mesh.face_count());
  const auto merged_loop = [&](std::span<const uint32_t> corners) {
    std::vector<uint32_t> loop;
    loop.reserve(corners.size());
    for (const uint32_t point : corners) {
      if (vertex_of[point] == kNone) {
        const auto [found, is_new] =
            vertex_at.try_emplace(points[point], static_cast<uint32_t>(result.vertices.size()));
        if (is_new) result.vertices.push_back(points[point]);
        result.any |= !is_new;
        vertex_of[point] = found->second;
      }
      loop.push_back(vertex_of[point]);
    }
    if (turn) std::reverse(loop.begin(), loop.end());
    return loop;
  };
  for (size_t f = 0; f < mesh.face_count(); ++f) {
    LoopFace face;
    face.facet = mesh.keep_facets ? static_cast<uint32_t>(f) + 1 : 0;
    face.surface = mesh.surface.empty() ? 0 : mesh.surface[f];
    face.appearance = appearance[f];
    if (!triangles.empty() && !triangles[f].empty()) {
      for (const auto& triangle : triangles[f]) {
        result.faces.push_back(face);
        result.faces.back().loops.push_back(merged_loop(triangle));
      }
      continue;
    }
    for (uint32_t l = mesh.face_starts[f]; l < mesh.face_starts[f + 1]; ++l) {
      face.loops.push_back(merged_loop(
          std::span(mesh.corners)
              .subspan(mesh.loop_starts[l], mesh.loop_starts[l + 1] - mesh.loop_starts[l])));
    }
    result.faces.push_back(std::move(face));
  }
  return result;
}

/// Faces as arrays, over the vertices that they use, in order of first use.
LeafGeometry pack(const std::vector<IVec3>& vertices, const std::vector<LoopFace>& faces) {
  LeafGeometry leaf;
  std::vector<uint32_t> facet, surface, appearance;
  for (auto* numbers : {&facet, &surface, &appearance}) numbers->reserve(faces.size());
  std::vector<uint32_t> number(vertices.size(), kNone);
  for (const LoopFace& face : faces) {
    for (uint32_t v : face.loops[0]) {
      if (number[v] == kNone) {
        number[v] = static_cast<uint32_t>(leaf.vertices.size());
        leaf.vertices.push_back(vertices[v]);
      }
      leaf.corners.push_back(number[v]);
    }
    leaf.face_starts.push_back(static_cast<uint32_t>(leaf.corners.size()));
    facet.push_back(face.facet);
    surface.push_back(face.surface);
    appearance.push_back(face.appearance);
  }
  leaf.facet = std::move(facet);
  leaf.surface = std::move(surface);
  leaf.appearance = std::move(appearance);
  return leaf;
}

/// Whether two planes of corners, which are one plane, look to opposite sides.
bool are_back_to_back(const CornerPlane& a, const CornerPlane& b) {
  for (size_t k = 0; k < 3; ++k) {
    if (a.normal[k] != 0) return (a.normal[k] > 0) != (b.normal[k] > 0);
  }
  return false;
}

/// Whether no face has a neighbour in front of it, or on its back: a thin body becomes a sheet that
/// is folded there. For the surface of one body of genus 0, which a mesh that promises to be convex
/// is, this is convexity.
bool is_locally_convex(const LeafGeometry& leaf) {
  if (leaf.opposite.empty()) return false;
  const auto find_plane = [&](size_t f, CornerPlane& plane) {
    const uint32_t begin = leaf.face_starts[f], end = leaf.face_starts[f + 1];
    return corner_plane(leaf.vertices, &leaf.corners[begin], end - begin, plane);
  };
  return with_face_of(leaf, [&](auto face_of) {
    for (size_t f = 0; f < leaf.face_count(); ++f) {
      CornerPlane plane, back;
      if (!find_plane(f, plane)) return false;
      for (uint32_t edge = leaf.face_starts[f]; edge < leaf.face_starts[f + 1]; ++edge) {
        // The neighbour is flat and convex: all its corners that are not in line with the edge are
        // on one side, so that one of them tells.
        const uint32_t start = leaf.opposite[edge], other = face_of(start);
        const uint32_t first = leaf.face_starts[other], last = leaf.face_starts[other + 1] - 1;
        const uint32_t stop = start < last ? start + 1 : first;
        int side = 0;
        for (uint32_t c = first; c <= last && side == 0; ++c) {
          if (c != start && c != stop) side = plane.side(leaf.vertices[leaf.corners[c]]);
        }
        if (side > 0) return false;
        if (side < 0) continue;
        if (!find_plane(other, back) || are_back_to_back(plane, back)) return false;
      }
    }
    return true;
  });
}

/// Whether faces at a corner may become a face that has no corner there, while other faces, which
/// the edges there do not connect with them, keep theirs.
bool may_lose_common_corners(const LeafGeometry& leaf) {
  return !leaf.has_single_fans && !(leaf.keeps_facets() && leaf.consists_of_triangles());
}

/// Whether all points lie in a plane across an axis.
bool is_pressed_flat(const GridBox& box) {
  bool any = false;
  for (size_t k = 0; k < 3; ++k) any = any || box.lo[k] == box.hi[k];
  return any;
}

/// Checks what convex faces enclose. `box` is that of the leaf's vertices.
PreparedLeaf examine(LeafGeometry&& geometry, EdgePairing&& pairing, const GridBox& box,
                     bool promised_convex) {
  PreparedLeaf result;
  result.box = box;
  if (!pairing.is_balanced) {
    result.status = PreparedLeaf::Status::kOpen;
    return result;
  }
  if (is_pressed_flat(box)) return result;
  auto leaf = std::make_shared<LeafGeometry>(std::move(geometry));
  leaf->opposite = std::move(pairing.opposite);
  // Rounding can close a gap that is narrower than a step, whatever was promised of the original
  // mesh; convexity is seen from the faces themselves.
  const auto walk_fans = [&] {
    return !leaf->opposite.empty() && find_vertices_of_fans(*leaf).empty();
  };
  const ConvexSurface surface = find_convex_surface(*leaf, box);
  leaf->convex = leaf->has_single_fans = surface.is_convex;
  if (!leaf->convex && promised_convex && is_locally_convex(*leaf)) {
    // Where a thin body was pinched to a point it is two.
    leaf->convex = leaf->has_single_fans = walk_fans();
  }
  result.status = PreparedLeaf::Status::kGood;
  if (!leaf->convex) {
    SurfaceCheck check = check_surface(*leaf);
    if (!check.crossings.empty() || !check.bounds_solid) {
      result.status = PreparedLeaf::Status::kTangled;
    }
    result.crossings = std::move(check.crossings);
    result.connected = check.connected;
    leaf->has_single_fans = check.has_single_fans || (!result.crossings.empty() && walk_fans());
  }
  leaf->may_touch = !result.crossings.empty() || (!leaf->convex && may_lose_common_corners(*leaf));
  // Facets that are kept as they are have no others of their label.
  leaf->may_have_flat_edges = !surface.is_convex || surface.has_flat_edges;
  if (leaf->convex && leaf->may_have_flat_edges && !leaf->opposite.empty() &&
      !leaf->keeps_facets()) {
    join_flat_faces(*leaf);
  }
  result.geometry = std::move(leaf);
  return result;
}

/// The hull of points as a leaf of one appearance.
PreparedLeaf hull_leaf(const std::vector<IVec3>& points) {
  PreparedLeaf result;
  auto leaf = std::make_shared<LeafGeometry>(convex_hull(points));
  if (leaf->face_count() == 0) return result;
  result.status = PreparedLeaf::Status::kGood;
  result.box = box_of_points(leaf->vertices);
  result.geometry = std::move(leaf);
  return result;
}

}  // namespace

std::vector<uint8_t> find_used_points(const PolygonMesh& mesh) {
  std::vector<uint8_t> is_used(mesh.points.size(), mesh.hull_of_points ? 1 : 0);
  for (const uint32_t corner : mesh.corners) is_used[corner] = 1;
  return is_used;
}

std::optional<std::vector<IVec3>> round_points(const PolygonMesh& mesh,
                                               const LeafRounding& rounding,
                                               const Quantiser& quantiser) {
  std::vector<IVec3> points(mesh.points.size(), IVec3{0, 0, 0});
  const std::vector<uint8_t> is_used = find_used_points(mesh);
  std::array<int, 3> sign;
  for (int i = 0; i < 3; ++i) {
    sign[rounding.permutation.axis[i]] = rounding.permutation.sign[i];
  }
  for (size_t p = 0; p < points.size(); ++p) {
    if (!is_used[p]) continue;
    glm::dvec3 x;
    if (rounding.in_world) {
      x = rounding.map.apply(mesh.points[p]);
    } else {
      for (int j = 0; j < 3; ++j) {
        x[j] = std::clamp(rounding.scale[j] * mesh.points[p][j] + rounding.offset[j],
                          rounding.lo[j], rounding.hi[j]);
      }
    }
    for (int j = 0; j < 3; ++j) {
      const auto rounded = quantiser(sign[j] < 0 ? -x[j] : x[j]);
      if (!rounded || *rounded >= kFarLimit || *rounded <= -kFarLimit) return std::nullopt;
      points[p][j] = sign[j] < 0 ? -*rounded : *rounded;
    }
  }
  return points;
}

PreparedLeaf prepare_leaf(const PolygonMesh& mesh, const std::vector<IVec3>& points, bool turn,
                          const FaceNumbers& appearance) {
  expect_faces(mesh.face_count());
  if (mesh.hull_of_points) return hull_leaf(points);
  if (auto taken = take_convex_faces(mesh, points, turn, appearance)) {
    if (taken->leaf.face_count() == 0) return {};
    EdgePairing pairing = pair_edges(taken->leaf);
    // Faces on each other's back must go.
    if (!taken->merged || !pairing.is_balanced ||
        (!pairing.opposite.empty() && !has_reversed_pair(taken->leaf, pairing.opposite))) {
      return examine(std::move(taken->leaf), std::move(pairing), taken->box, mesh.convex);
    }
  }
  Merged merged = merge_points(mesh, points, turn, appearance);
  bool by_rounding = false;
  if (!make_convex_faces(merged.vertices, mesh.convex, merged.any, merged.faces)) {
    merged = merge_points(mesh, points, turn, appearance, fine_triangles(mesh));
    by_rounding = make_convex_faces(merged.vertices, mesh.convex, merged.any, merged.faces);
  }
  LeafGeometry leaf = pack(merged.vertices, merged.faces);
  if (leaf.face_count() == 0) return {};
  EdgePairing pairing = pair_edges(leaf);
  const GridBox box = box_of_points(leaf.vertices);
  PreparedLeaf prepared = examine(std::move(leaf), std::move(pairing), box, mesh.convex);
  prepared.by_rounding = by_rounding;
  return prepared;
}

PreparedLeaf prepare_faces(LeafGeometry&& leaf) {
  EdgePairing pairing = pair_edges(leaf);
  const GridBox box = box_of_points(leaf.vertices);
  return examine(std::move(leaf), std::move(pairing), box, false);
}

LeafGeometry permuted(const LeafGeometry& leaf, const SignedPermutation& permutation) {
  LeafGeometry result = leaf;
  for (IVec3& v : result.vertices) v = permutation.apply(v);
  if (permutation.determinant() > 0) return result;
  // An edge that left the corner before the last one now leaves the first, and so on.
  std::vector<uint32_t> moved(leaf.corners.size());
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    const uint32_t begin = leaf.face_starts[f], end = leaf.face_starts[f + 1];
    std::reverse(result.corners.begin() + begin, result.corners.begin() + end);
    for (uint32_t c = begin; c + 1 < end; ++c) moved[c] = begin + end - 2 - c;
    moved[end - 1] = end - 1;
  }
  for (size_t edge = 0; edge < leaf.opposite.size(); ++edge) {
    result.opposite[moved[edge]] = moved[leaf.opposite[edge]];
  }
  return result;
}

}  // namespace csgrun
