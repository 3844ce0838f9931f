#include "engine/mesh/edge_uses.h"

#include <algorithm>

namespace csgrun {
namespace {

template <class Visit>
void for_each_use(const std::vector<LoopFace>& faces, Visit visit) {
  for (uint32_t f = 0; f < faces.size(); ++f) {
    for (const std::vector<uint32_t>& loop : faces[f].loops) {
      for (size_t i = 0; i < loop.size(); ++i) {
        const uint32_t a = loop[i], b = loop[i + 1 < loop.size() ? i + 1 : 0];
        visit(EdgeUse{std::min(a, b), std::max(a, b), f, a < b});
      }
    }
  }
}

}  // namespace

EdgeUses::EdgeUses(const std::vector<LoopFace>& faces, size_t vertex_count) {
  std::vector<size_t> starts(vertex_count + 1, 0);
  for_each_use(faces, [&](const EdgeUse& use) { ++starts[use.low + 1]; });
  for (size_t v = 0; v < vertex_count; ++v) starts[v + 1] += starts[v];
  uses_.resize(starts.back());
  std::vector<size_t> next = starts;
  for_each_use(faces, [&](const EdgeUse& use) { uses_[next[use.low]++] = use; });
  for (size_t v = 0; v < vertex_count; ++v) {
    std::stable_sort(uses_.begin() + static_cast<std::ptrdiff_t>(starts[v]),
                     uses_.begin() + static_cast<std::ptrdiff_t>(starts[v + 1]),
                     [](const EdgeUse& a, const EdgeUse& b) { return a.high < b.high; });
  }
}

int64_t excess(std::span<const EdgeUse> uses) {
  int64_t sum = 0;
  for (const EdgeUse& use : uses) sum += use.forward ? 1 : -1;
  return sum;
}

}  // namespace csgrun
