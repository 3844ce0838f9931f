#include "engine/bsp/non_manifold.h"

#include <algorithm>
#include <tuple>

#include "engine/base/counting_order.h"
#include "engine/base/none.h"
#include "engine/base/sort_few.h"
#include "engine/bsp/corner_walk.h"

namespace csgrun {
namespace {

/// A directed edge at its lower end.
struct Use {
  uint32_t high, edge;
  bool forward;  ///< from the lower end to the higher one
};

}  // namespace

NonManifold find_non_manifold(const LeafGeometry& leaf) {
  if (!leaf.opposite.empty()) return {{}, find_vertices_of_fans(leaf), {}};
  const std::vector<uint32_t>& corners = leaf.corners;
  std::vector<uint32_t> end(corners.size());  // of each edge
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    const uint32_t first = leaf.face_starts[f], last = leaf.face_starts[f + 1] - 1;
    for (uint32_t c = first; c < last; ++c) end[c] = corners[c + 1];
    end[last] = corners[first];
  }
  CountingOrder by_low;
  by_low.sort(corners.size(), leaf.vertices.size(),
              [&](size_t e) { return std::min(corners[e], end[e]); });
  NonManifold found;
  std::vector<uint32_t>& opposite = found.opposite;
  opposite.assign(corners.size(), kNone);
  std::vector<uint8_t> is_at_edge(leaf.vertices.size(), 0);
  std::vector<Use> uses;
  for (uint32_t low = 0; low < leaf.vertices.size(); ++low) {
    uses.clear();
    for (uint32_t i = by_low.starts[low]; i < by_low.starts[low + 1]; ++i) {
      const uint32_t e = by_low.order[i];
      uses.push_back({std::max(corners[e], end[e]), e, corners[e] == low});
    }
    sort_few(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
      return std::tie(a.high, a.edge) < std::tie(b.high, b.edge);
    });
    for (size_t i = 0, j = 0; i < uses.size(); i = j) {
      while (j < uses.size() && uses[j].high == uses[i].high) ++j;
      if (j - i == 2 && uses[i].forward != uses[i + 1].forward) {
        opposite[uses[i].edge] = uses[i + 1].edge;
        opposite[uses[i + 1].edge] = uses[i].edge;
        continue;
      }
      found.edges.push_back({low, uses[i].high});
      is_at_edge[low] = is_at_edge[uses[i].high] = 1;
    }
  }
  found.vertices = find_vertices_of_fans(leaf, opposite, is_at_edge);
  return found;
}

}  // namespace csgrun
