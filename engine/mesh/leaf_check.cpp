#include "engine/mesh/leaf_check.h"

#include <algorithm>
#include <optional>
#include <span>

#include "engine/base/parallel.h"
#include "engine/base/per_thread.h"
#include "engine/bsp/corner_walk.h"
#include "engine/bsp/packed_boxes.h"
#include "engine/bsp/winding.h"
#include "engine/mesh/box_frame.h"
#include "engine/mesh/face_pair.h"
#include "engine/mesh/leaf_shape.h"
#include "engine/mesh/single_sheets.h"
#include "engine/mesh/spread_vertices.h"
#include "engine/mesh/star_surface.h"
#include "engine/mesh/surface_parts.h"
#include "engine/mesh/triangle_pairs.h"

namespace csgrun {
namespace {

constexpr size_t kTasks = 256;
constexpr size_t kFewFaces = 2000;  ///< for which threads do not pay

using Pairs = std::vector<std::array<uint32_t, 2>>;

/// Of the faces at the places of the tree, which `order` names; see TrianglePairs.
Pairs find_crossings(const LeafGeometry& leaf, const PackedBoxes& tree,
                     std::span<const uint32_t> order, std::span<const uint8_t> is_spread,
                     bool are_long) {
  const FacePairs faces(leaf);
  std::optional<TrianglePairs> triangles;
  if (TrianglePairs::covers(leaf)) triangles.emplace(leaf, order, is_spread, are_long);
  const auto search = [&](const PackedBoxes::Task& task, FacePairs::Scratch& scratch,
                          Pairs& found) {
    tree.visit_rows(task, [&](uint32_t place, uint32_t group, uint32_t hits) {
      if (triangles) {
        hits &= ~triangles->spread_neighbours(place, group);
        if (hits != 0) hits &= ~triangles->plainly_apart(place, group, hits);
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
    PerThread scratches([] { return FacePairs::Scratch(); });
    for_each_alone(tasks.size(), true,
                   [&](size_t t) { search(tasks[t], scratches.local(), found[t]); });
    for (const Pairs& some : found) all.insert(all.end(), some.begin(), some.end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Of all faces.
PackedBoxes tree_of_pairs(const LeafGeometry& leaf, const std::optional<BoxFrame>& frame,
                          bool are_long) {
  const std::vector<FloatBox> boxes = face_boxes(leaf, frame);
  return are_long ? PackedBoxes(boxes, face_diagonals(leaf)) : PackedBoxes(boxes);
}

/// Whether the faces at each vertex are one fan, of a surface with opposite edges. A vertex that is
/// spread is surrounded once, and so is one of a single sheet: where all faces face one way, two
/// fans would be crossed twice. `off_sheets`: the faces of all others; nothing: these are all.
bool have_single_fans(const LeafGeometry& leaf,
                      const std::optional<std::vector<uint32_t>>& off_sheets,
                      std::span<const uint8_t> is_spread) {
  if (is_spread.empty()) return find_vertices_of_fans(leaf).empty();
  std::vector<uint8_t> is_known(is_spread.begin(), is_spread.end());
  if (off_sheets) {
    size_t next = 0;
    for (uint32_t f = 0; f < leaf.face_count(); ++f) {
      if (next < off_sheets->size() && (*off_sheets)[next] == f) {
        ++next;
        continue;
      }
      for (uint32_t c = leaf.face_starts[f]; c < leaf.face_starts[f + 1]; ++c) {
        is_known[leaf.corners[c]] = 1;
      }
    }
  }
  if (std::find(is_known.begin(), is_known.end(), 0) == is_known.end()) return true;
  return find_vertices_of_fans(leaf, leaf.opposite, is_known).empty();
}

}  // namespace

Pairs find_self_intersections(const LeafGeometry& leaf) {
  const bool are_long = has_long_triangles(leaf);
  const PackedBoxes tree = tree_of_pairs(leaf, find_box_frame(leaf), are_long);
  return find_crossings(leaf, tree, tree.order(), {}, are_long);
}

SurfaceCheck check_surface(const LeafGeometry& leaf) {
  SurfaceCheck result;
  if (is_star_surface(leaf)) {
    result.bounds_solid = result.connected = result.has_single_fans = true;
    return result;
  }
  std::optional<PackedBoxes> tree;  // of all faces along the axes, if there is one
  const auto faces = faces_off_single_sheets(leaf);
  std::vector<uint8_t> is_spread;
  if (TrianglePairs::covers(leaf)) {
    is_spread = faces ? find_spread_vertices(leaf, *faces) : find_spread_vertices(leaf);
  }
  if (faces) {
    // Of a mesh of small faces: other axes than the coordinates' would make boxes hardly smaller.
    const PackedBoxes some(face_boxes(leaf, *faces, std::nullopt));
    std::vector<uint32_t> order = some.order();
    for (uint32_t& face : order) face = (*faces)[face];
    result.crossings = find_crossings(leaf, some, order, is_spread, false);
  } else {
    const auto frame = find_box_frame(leaf);
    const bool are_long = has_long_triangles(leaf);
    tree.emplace(tree_of_pairs(leaf, frame, are_long));
    result.crossings = find_crossings(leaf, *tree, tree->order(), is_spread, are_long);
    if (frame) tree.reset();
  }
  if (!result.crossings.empty()) return result;
  result.has_single_fans = !leaf.opposite.empty() && have_single_fans(leaf, faces, is_spread);
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
