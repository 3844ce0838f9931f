#include "engine/mesh/opposite_edges.h"

#include <algorithm>
#include <span>
#include <utility>

namespace csgrun {
namespace {

/// A directed edge among those of one lower end.
struct Use {
  uint32_t high;  ///< the end of greater number
  uint32_t edge;  ///< twice the index of the corner, and 1 if it runs from low to high
};

/// Pairs the uses of one lower end that stand alone with their reverse. False when some other edge
/// is not balanced; `all_paired` becomes false when some other edge is.
bool pair_uses(std::span<Use> uses, std::vector<uint32_t>& opposite, bool& all_paired) {
  constexpr size_t kFew = 12;
  if (uses.size() > kFew) {
    std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
      return std::pair(a.high, a.edge) < std::pair(b.high, b.edge);
    });
  } else {
    for (size_t i = 1; i < uses.size(); ++i) {
      const Use use = uses[i];
      size_t at = i;
      for (; at > 0 && uses[at - 1].high > use.high; --at) uses[at] = uses[at - 1];
      uses[at] = use;
    }
  }
  for (size_t i = 0; i < uses.size();) {
    size_t end = i;
    int64_t balance = 0;
    for (; end < uses.size() && uses[end].high == uses[i].high; ++end) {
      balance += (uses[end].edge & 1) != 0 ? 1 : -1;
    }
    if (balance != 0) return false;
    if (end - i == 2) {
      opposite[uses[i].edge >> 1] = uses[i + 1].edge >> 1;
      opposite[uses[i + 1].edge >> 1] = uses[i].edge >> 1;
    } else {
      all_paired = false;
    }
    i = end;
  }
  return true;
}

}  // namespace

EdgePairing pair_edges(const LeafGeometry& leaf) {
  EdgePairing result;
  const std::vector<uint32_t>& corners = leaf.corners;
  const auto for_each_edge = [&](auto visit) {
    for (size_t f = 0; f < leaf.face_count(); ++f) {
      const uint32_t begin = leaf.face_starts[f], end = leaf.face_starts[f + 1];
      for (uint32_t c = begin, last = end - 1; c < end; last = c++) {
        visit(last, corners[last], corners[c]);
      }
    }
  };
  // starts[v + 1] is where the uses of v go next while they are distributed.
  std::vector<uint32_t> starts(leaf.vertices.size() + 2, 0);
  for_each_edge([&](uint32_t, uint32_t a, uint32_t b) { ++starts[std::min(a, b) + 2]; });
  for (size_t v = 2; v < starts.size(); ++v) starts[v] += starts[v - 1];
  std::vector<Use> uses(corners.size());
  for_each_edge([&](uint32_t corner, uint32_t a, uint32_t b) {
    uses[starts[std::min(a, b) + 1]++] = {std::max(a, b), 2 * corner + (a < b ? 1 : 0)};
  });
  result.opposite.resize(corners.size());
  bool all_paired = true;
  for (size_t v = 0; v < leaf.vertices.size(); ++v) {
    const std::span group(uses.data() + starts[v], uses.data() + starts[v + 1]);
    if (!pair_uses(group, result.opposite, all_paired)) return {};
  }
  result.is_balanced = true;
  if (!all_paired) result.opposite.clear();
  return result;
}

}  // namespace csgrun
