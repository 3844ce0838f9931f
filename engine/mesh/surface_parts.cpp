#include "engine/mesh/surface_parts.h"

#include "engine/base/chance_list.h"
#include "engine/bsp/union_find.h"
#include "engine/mesh/edge_table.h"
#include "engine/mesh/leaf_shape.h"

namespace csgrun {
namespace {

/// From face to face, where each edge has one opposite.
template <class FaceOf>
std::vector<uint32_t> flood(const LeafGeometry& leaf, FaceOf face_of) {
  std::vector<uint32_t> lowest;
  std::vector<uint8_t> is_reached(leaf.face_count(), 0);
  ChanceList<uint32_t> queue(leaf.face_count() + 1);
  size_t head = 0;
  for (uint32_t f = 0; f < leaf.face_count(); ++f) {
    if (is_reached[f] != 0) continue;
    lowest.push_back(f);
    is_reached[f] = 1;
    for (queue.add_if(true, f); head < queue.size();) {
      const uint32_t face = queue[head++];
      for (uint32_t e = leaf.face_starts[face]; e < leaf.face_starts[face + 1]; ++e) {
        const uint32_t neighbour = face_of(leaf.opposite[e]);
        queue.add_if(is_reached[neighbour] == 0, neighbour);
        is_reached[neighbour] = 1;
      }
    }
  }
  return lowest;
}

/// Where edges may have any number of faces.
std::vector<uint32_t> join(const LeafGeometry& leaf) {
  UnionFind parts(leaf.face_count());
  const EdgeTable edges(leaf);
  for (uint32_t v = 0; v < edges.vertex_count(); ++v) {
    for (const EdgeTable::Edge& edge : edges.leaving(v)) {
      if (edge.to < v || edges.between(v, edge.to).size() != 1) continue;
      const auto reverse = edges.between(edge.to, v);
      if (reverse.size() == 1) parts.join(edge.face, reverse[0].face);
    }
  }
  std::vector<uint32_t> lowest;
  for (uint32_t f = 0; f < leaf.face_count(); ++f) {
    if (parts.find(f) == f) lowest.push_back(f);
  }
  return lowest;
}

}  // namespace

std::vector<uint32_t> one_face_of_each_part(const LeafGeometry& leaf) {
  if (leaf.opposite.empty()) return join(leaf);
  return with_face_of(leaf, [&](auto face_of) { return flood(leaf, face_of); });
}

}  // namespace csgrun
