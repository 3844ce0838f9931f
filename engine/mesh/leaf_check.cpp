#include "engine/mesh/leaf_check.h"

#include <algorithm>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "engine/bsp/union_find.h"
#include "engine/mesh/box_tree.h"
#include "engine/mesh/face_pair.h"
#include "engine/mesh/winding.h"

namespace csgrun {
namespace {

constexpr size_t kTasks = 256;
constexpr size_t kFewFaces = 2000;  ///< for which threads do not pay

using Pairs = std::vector<std::array<uint32_t, 2>>;

Pairs find_crossings(const FacePairs& faces, const BoxTree& tree) {
  const bool few = faces.boxes().size() < kFewFaces;
  const std::vector<BoxTree::Task> tasks = tree.pair_tasks(few ? 1 : kTasks);
  std::vector<Pairs> found(tasks.size());
  const auto run = [&](size_t t, FacePairs::Scratch& scratch) {
    tree.visit_pairs(tasks[t], [&](uint32_t f, uint32_t g) {
      if (faces.conflict(f, g, scratch)) found[t].push_back({f, g});
    });
  };
  if (few) {
    FacePairs::Scratch scratch;
    for (size_t t = 0; t < tasks.size(); ++t) run(t, scratch);
  } else {
    tbb::enumerable_thread_specific<FacePairs::Scratch> scratches;
    tbb::parallel_for(size_t{0}, tasks.size(), [&](size_t t) { run(t, scratches.local()); });
  }
  Pairs all;
  for (const Pairs& some : found) all.insert(all.end(), some.begin(), some.end());
  std::sort(all.begin(), all.end());
  return all;
}

/// One face of each part of the surface that is connected by edges of two faces: within a part the
/// winding numbers in front of faces, and those behind, are the same.
std::vector<uint32_t> one_face_of_each_part(const LeafGeometry& leaf, const EdgeTable& edges) {
  UnionFind parts(leaf.face_count());
  for (uint32_t v = 0; v < edges.vertex_count(); ++v) {
    for (const EdgeTable::Edge& edge : edges.leaving(v)) {
      if (edge.to < v || edges.between(v, edge.to).size() != 1) continue;
      const auto reverse = edges.between(edge.to, v);
      if (reverse.size() == 1) parts.join(edge.face, reverse[0].face);
    }
  }
  std::vector<uint32_t> faces;
  for (uint32_t f = 0; f < leaf.face_count(); ++f) {
    if (parts.find(f) == f) faces.push_back(f);
  }
  return faces;
}

}  // namespace

Pairs find_self_intersections(const LeafGeometry& leaf) {
  const FacePairs faces(leaf);
  const BoxTree tree(faces.boxes());
  return find_crossings(faces, tree);
}

SurfaceCheck check_surface(const LeafGeometry& leaf, const EdgeTable& edges) {
  const FacePairs faces(leaf);
  const BoxTree tree(faces.boxes());
  SurfaceCheck result;
  result.crossings = find_crossings(faces, tree);
  if (!result.crossings.empty()) return result;
  const std::vector<uint32_t> parts = one_face_of_each_part(leaf, edges);
  result.connected = parts.size() == 1;
  result.bounds_solid = std::all_of(parts.begin(), parts.end(), [&](uint32_t face) {
    return winding_in_front(leaf, tree, face) == 0;
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
