#include "engine/mesh/leaf_check.h"

#include <algorithm>
#include <optional>
#include <span>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "engine/bsp/packed_boxes.h"
#include "engine/bsp/union_find.h"
#include "engine/mesh/box_frame.h"
#include "engine/mesh/edge_table.h"
#include "engine/mesh/face_pair.h"
#include "engine/mesh/leaf_shape.h"
#include "engine/mesh/single_sheets.h"
#include "engine/mesh/star_surface.h"
#include "engine/mesh/triangle_pairs.h"
#include "engine/mesh/winding.h"

namespace csgrun {
namespace {

constexpr size_t kTasks = 256;
constexpr size_t kFewFaces = 2000;  ///< for which threads do not pay
constexpr size_t kFewRays = 8;      ///< for which a tree does not pay

using Pairs = std::vector<std::array<uint32_t, 2>>;

/// Of the faces at the places of the tree, which `order` names.
Pairs find_crossings(const LeafGeometry& leaf, const PackedBoxes& tree,
                     std::span<const uint32_t> order, bool is_balanced) {
  const FacePairs faces(leaf);
  std::optional<TrianglePairs> triangles;
  if (TrianglePairs::covers(leaf)) triangles.emplace(leaf, order, is_balanced);
  const auto search = [&](const PackedBoxes::Task& task, FacePairs::Scratch& scratch,
                          Pairs& found) {
    TrianglePairs::Near near;
    tree.visit_rows(task, [&](uint32_t place, uint32_t group, uint32_t hits) {
      if (triangles) {
        hits &= ~triangles->spread_neighbours(place, group);
        if (hits != 0) hits &= ~triangles->plainly_apart(place, group, hits, near);
      }
      PackedBoxes::for_each_bit(hits, [&](uint32_t bit) {
        const auto [f, g] = std::minmax({order[place], order[8 * group + bit]});
        if (triangles && triangles->apart(f, g)) return;
        if (faces.conflict(f, g, scratch)) found.push_back({f, g});
      });
    });
  };
  Pairs all;
  if (leaf.face_count() < kFewFaces) {
    FacePairs::Scratch scratch;
    for (const auto& task : tree.pair_tasks(1)) search(task, scratch, all);
  } else {
    const std::vector<PackedBoxes::Task> tasks = tree.pair_tasks(kTasks);
    std::vector<Pairs> found(tasks.size());
    tbb::enumerable_thread_specific<FacePairs::Scratch> scratches;
    tbb::parallel_for(size_t{0}, tasks.size(),
                      [&](size_t t) { search(tasks[t], scratches.local(), found[t]); });
    for (const Pairs& some : found) all.insert(all.end(), some.begin(), some.end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Calls `visit(f, g)` for the faces of each edge that has two.
template <class Visit>
void for_each_neighbours(const LeafGeometry& leaf, Visit visit) {
  if (!leaf.opposite.empty()) {
    with_face_of(leaf, [&](auto face_of) {
      for (uint32_t edge = 0; edge < leaf.opposite.size(); ++edge) {
        if (edge < leaf.opposite[edge]) visit(face_of(edge), face_of(leaf.opposite[edge]));
      }
    });
    return;
  }
  const EdgeTable edges(leaf);
  for (uint32_t v = 0; v < edges.vertex_count(); ++v) {
    for (const EdgeTable::Edge& edge : edges.leaving(v)) {
      if (edge.to < v || edges.between(v, edge.to).size() != 1) continue;
      const auto reverse = edges.between(edge.to, v);
      if (reverse.size() == 1) visit(edge.face, reverse[0].face);
    }
  }
}

/// One face of each part of the surface that is connected by edges of two faces: within a part the
/// winding numbers in front of faces, and those behind, are the same.
std::vector<uint32_t> one_face_of_each_part(const LeafGeometry& leaf) {
  UnionFind parts(leaf.face_count());
  for_each_neighbours(leaf, [&](uint32_t f, uint32_t g) { parts.join(f, g); });
  std::vector<uint32_t> faces;
  for (uint32_t f = 0; f < leaf.face_count(); ++f) {
    if (parts.find(f) == f) faces.push_back(f);
  }
  return faces;
}

}  // namespace

Pairs find_self_intersections(const LeafGeometry& leaf) {
  const PackedBoxes tree(face_boxes(leaf, find_box_frame(leaf)));
  return find_crossings(leaf, tree, tree.order(), false);
}

SurfaceCheck check_surface(const LeafGeometry& leaf) {
  SurfaceCheck result;
  if (is_star_surface(leaf)) {
    result.bounds_solid = result.connected = result.is_star = true;
    return result;
  }
  std::optional<PackedBoxes> tree;  // of all faces along the axes, if there is one
  if (const auto faces = faces_off_single_sheets(leaf)) {
    const PackedBoxes some(face_boxes(leaf, *faces, find_box_frame(leaf)));
    std::vector<uint32_t> order = some.order();
    for (uint32_t& face : order) face = (*faces)[face];
    result.crossings = find_crossings(leaf, some, order, true);
  } else {
    const auto frame = find_box_frame(leaf);
    tree.emplace(face_boxes(leaf, frame));
    result.crossings = find_crossings(leaf, *tree, tree->order(), true);
    if (frame) tree.reset();
  }
  if (!result.crossings.empty()) return result;
  const std::vector<uint32_t> parts = one_face_of_each_part(leaf);
  result.connected = parts.size() == 1;
  if (!tree && parts.size() > kFewRays) tree.emplace(face_boxes(leaf, std::nullopt));
  result.bounds_solid = std::all_of(parts.begin(), parts.end(), [&](uint32_t face) {
    return winding_in_front(leaf, tree ? &*tree : nullptr, face) == 0;
  });
  return result;
}

std::array<double, 3> intersection_place(const LeafGeometry& leaf, uint32_t f, uint32_t g) {
  LeafGeometry two;
  two.vertices = leaf.vertices;
  for (const uint32_t face : {f, g}) {
    two.corners.insert(two.corners.end(), leaf.corners.begin() + leaf.face_starts[face],
                       leaf.corners.begin() + leaf.face_starts[face + 1]);
    two.face_starts.push_back(static_cast<uint32_t>(two.corners.size()));
  }
  return FacePairs(two).place(0, 1);
}

}  // namespace csgrun
