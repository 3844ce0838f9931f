// The directed edges of a leaf, by their ends.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

/// The directed edges of a leaf by the vertex that they leave, then by the one that they reach.
class EdgeTable {
 public:
  struct Edge {
    uint32_t to, face;
    bool operator<(const Edge& o) const { return std::pair(to, face) < std::pair(o.to, o.face); }
  };

  explicit EdgeTable(const LeafGeometry& leaf) : starts_(leaf.vertices.size() + 1, 0) {
    for (uint32_t v : leaf.corners) ++starts_[v + 1];
    for (size_t v = 1; v < starts_.size(); ++v) starts_[v] += starts_[v - 1];
    edges_.resize(leaf.corners.size());
    std::vector<uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (uint32_t f = 0; f < leaf.face_count(); ++f) {
      const uint32_t begin = leaf.face_starts[f], end = leaf.face_starts[f + 1];
      for (uint32_t c = begin; c < end; ++c) {
        const uint32_t to = leaf.corners[c + 1 < end ? c + 1 : begin];
        edges_[next[leaf.corners[c]]++] = {to, f};
      }
    }
    for (uint32_t v = 0; v + 1 < starts_.size(); ++v) {
      std::sort(edges_.begin() + starts_[v], edges_.begin() + starts_[v + 1]);
    }
  }

  [[nodiscard]] size_t vertex_count() const { return starts_.size() - 1; }
  [[nodiscard]] std::span<const Edge> leaving(uint32_t v) const {
    return {edges_.data() + starts_[v], starts_[v + 1] - starts_[v]};
  }
  /// The edges from one vertex to another.
  [[nodiscard]] std::span<const Edge> between(uint32_t from, uint32_t to) const {
    const auto all = leaving(from);
    const auto first =
        std::partition_point(all.begin(), all.end(), [to](const Edge& e) { return e.to < to; });
    auto last = first;
    while (last != all.end() && last->to == to) ++last;
    return {first, last};
  }

 private:
  std::vector<uint32_t> starts_;
  std::vector<Edge> edges_;
};

}  // namespace csgrun
