// Which faces use which edges, whatever their number and direction.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh/loop_faces.h"

namespace csgrun {

/// One face's use of the edge between two vertices.
struct EdgeUse {
  uint32_t low, high;  ///< the vertices, by number
  uint32_t face;
  bool forward;  ///< from low to high

  [[nodiscard]] uint32_t from() const { return forward ? low : high; }
  [[nodiscard]] uint32_t to() const { return forward ? high : low; }
};

/// All uses, those of one edge together, in the order of the faces. Edges are in the order of their
/// vertices' numbers.
class EdgeUses {
 public:
  /// REQUIRES: loops without repeated neighbours, vertices below `vertex_count`. O(n log k) with at
  /// most k uses a vertex.
  EdgeUses(const std::vector<LoopFace>& faces, size_t vertex_count);

  /// Calls `visit(uses of one edge)` for each edge.
  template <class Visit>
  void for_each_edge(Visit visit) const {
    for (size_t begin = 0; begin < uses_.size();) {
      size_t end = begin + 1;
      while (end < uses_.size() && uses_[end].low == uses_[begin].low &&
             uses_[end].high == uses_[begin].high) {
        ++end;
      }
      visit(std::span<const EdgeUse>(uses_.data() + begin, end - begin));
      begin = end;
    }
  }

 private:
  std::vector<EdgeUse> uses_;
};

/// How many more uses go forward than back.
int64_t excess(std::span<const EdgeUse> uses);

}  // namespace csgrun
