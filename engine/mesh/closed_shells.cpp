#include "engine/mesh/closed_shells.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "engine/base/none.h"
#include "engine/bsp/union_find.h"
#include "engine/mesh/edge_table.h"
#include "engine/mesh/leaf_shape.h"

namespace csgrun {
namespace {

/// Joins the faces at each edge. The table has the edges from one vertex to another by their faces.
void join_over_edges(const LeafGeometry& leaf, UnionFind& shells) {
  if (!leaf.opposite.empty()) {
    with_face_of(leaf, [&](auto face_of) {
      for (uint32_t e = 0; e < leaf.opposite.size(); ++e) {
        if (e < leaf.opposite[e]) shells.join(face_of(e), face_of(leaf.opposite[e]));
      }
    });
    return;
  }
  const EdgeTable edges(leaf);
  for (uint32_t v = 0; v < edges.vertex_count(); ++v) {
    const auto leaving = edges.leaving(v);
    for (size_t i = 0; i < leaving.size();) {
      const uint32_t to = leaving[i].to;
      size_t end = i;
      while (end < leaving.size() && leaving[end].to == to) ++end;
      if (v < to) {
        const auto back = edges.between(to, v);
        assert(back.size() == end - i);  // the surface is closed
        for (size_t k = 0; i + k < end; ++k) shells.join(leaving[i + k].face, back[k].face);
      }
      i = end;
    }
  }
}

/// The numbers of some faces, stored only where they are neither all the same nor count up.
FaceNumbers numbers_of(const FaceNumbers& all, std::span<const uint32_t> faces) {
  std::vector<uint32_t> each;
  each.reserve(faces.size());
  for (const uint32_t f : faces) each.push_back(all[f]);
  bool same = true, counts_up = true;
  for (size_t i = 1; i < each.size(); ++i) {
    same = same && each[i] == each[0];
    counts_up = counts_up && each[i] == each[0] + i;
  }
  if (same) return FaceNumbers::all(each.empty() ? 0 : each[0]);
  return counts_up ? FaceNumbers::ascending(each[0]) : FaceNumbers(std::move(each));
}

}  // namespace

std::vector<Shell> closed_shells(const LeafGeometry& leaf) {
  const auto faces = static_cast<uint32_t>(leaf.face_count());
  UnionFind joined(faces);
  join_over_edges(leaf, joined);
  for (uint32_t f = 1; f < faces; ++f) {
    if (leaf.facet[f] != 0 && leaf.facet[f] == leaf.facet[f - 1]) joined.join(f - 1, f);
  }
  std::vector<Shell> shells;
  std::vector<uint32_t> shell_of(faces, kNone);  // by the first face, which represents it
  for (uint32_t f = 0; f < faces; ++f) {
    const uint32_t first = joined.find(f);
    if (first == f) {
      shell_of[f] = static_cast<uint32_t>(shells.size());
      shells.emplace_back();
    }
    shells[shell_of[first]].push_back(f);
  }
  return shells;
}

LeafGeometry leaf_of_faces(const LeafGeometry& leaf, std::span<const uint32_t> faces) {
  LeafGeometry part;
  // Shells are many, and small: no list of all the leaf's vertices for each.
  std::vector<uint32_t> used;
  for (const uint32_t f : faces) {
    used.insert(used.end(), leaf.corners.begin() + leaf.face_starts[f],
                leaf.corners.begin() + leaf.face_starts[f + 1]);
    part.face_starts.push_back(static_cast<uint32_t>(used.size()));
  }
  std::vector<uint32_t> sorted = used;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  part.vertices.reserve(sorted.size());
  for (const uint32_t v : sorted) part.vertices.push_back(leaf.vertices[v]);
  for (uint32_t& v : used) {
    v = static_cast<uint32_t>(std::lower_bound(sorted.begin(), sorted.end(), v) - sorted.begin());
  }
  part.corners = std::move(used);
  part.facet = numbers_of(leaf.facet, faces);
  part.surface = numbers_of(leaf.surface, faces);
  part.appearance = numbers_of(leaf.appearance, faces);
  return part;
}

}  // namespace csgrun
