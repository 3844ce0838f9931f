#include "engine/mesh/opposite_edges.h"

#include <algorithm>
#include <utility>

#include "engine/mesh/leaf_shape.h"

namespace csgrun {
namespace {

constexpr uint32_t kNone = UINT32_MAX;

/// A directed edge among those of one lower end.
struct Use {
  uint32_t high;  ///< the end of greater number
  uint32_t edge;
  bool forward;  ///< from the lower end to the higher one
};

/// Sorts by the higher end.
void sort_uses(std::vector<Use>& uses) {
  constexpr size_t kFew = 12;
  if (uses.size() > kFew) {
    std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
      return std::pair(a.high, a.edge) < std::pair(b.high, b.edge);
    });
    return;
  }
  for (size_t i = 1; i < uses.size(); ++i) {
    const Use use = uses[i];
    size_t at = i;
    for (; at > 0 && uses[at - 1].high > use.high; --at) uses[at] = uses[at - 1];
    uses[at] = use;
  }
}

/// Pairs the uses of one lower end that stand alone with their reverse. False when some other edge
/// is not balanced; `all_paired` becomes false when some other edge is.
bool pair_uses(const std::vector<Use>& uses, std::vector<uint32_t>& opposite, bool& all_paired) {
  for (size_t i = 0; i < uses.size();) {
    size_t end = i;
    int64_t balance = 0;
    for (; end < uses.size() && uses[end].high == uses[i].high; ++end) {
      balance += uses[end].forward ? 1 : -1;
    }
    if (balance != 0) return false;
    if (end - i == 2) {
      opposite[uses[i].edge] = uses[i + 1].edge;
      opposite[uses[i + 1].edge] = uses[i].edge;
    } else {
      all_paired = false;
    }
    i = end;
  }
  return true;
}

/// `next(corner)` is the corner that follows in its face.
template <class Next>
EdgePairing pair_edges(const LeafGeometry& leaf, Next next) {
  EdgePairing result;
  const std::vector<uint32_t>& corners = leaf.corners;
  // Until they are paired, the edges of one lower end are a chain.
  std::vector<uint32_t>& chain = result.opposite;
  chain.resize(corners.size());
  std::vector<uint32_t> first(leaf.vertices.size(), kNone);
  for (uint32_t edge = 0; edge < corners.size(); ++edge) {
    uint32_t& head = first[std::min(corners[edge], corners[next(edge)])];
    chain[edge] = head;
    head = edge;
  }
  bool all_paired = true;
  std::vector<Use> uses;
  for (uint32_t v = 0; v < first.size(); ++v) {
    uses.clear();
    for (uint32_t edge = first[v]; edge != kNone; edge = chain[edge]) {
      const bool forward = corners[edge] == v;
      uses.push_back({forward ? corners[next(edge)] : corners[edge], edge, forward});
    }
    sort_uses(uses);
    if (!pair_uses(uses, result.opposite, all_paired)) return {};
  }
  result.is_balanced = true;
  if (!all_paired) result.opposite.clear();
  return result;
}

}  // namespace

EdgePairing pair_edges(const LeafGeometry& leaf) {
  if (consists_of_triangles(leaf)) {
    return pair_edges(leaf,
                      [](uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; });
  }
  std::vector<uint32_t> next(leaf.corners.size());
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    const uint32_t begin = leaf.face_starts[f], end = leaf.face_starts[f + 1];
    for (uint32_t c = begin; c < end; ++c) next[c] = c + 1 < end ? c + 1 : begin;
  }
  return pair_edges(leaf, [&](uint32_t corner) { return next[corner]; });
}

}  // namespace csgrun
