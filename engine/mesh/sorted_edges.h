// Edges by both their points: which of them run between the same two, and which way.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/base/counting_order.h"
#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/base/sort_few.h"

namespace csgrun {

/// The points of an edge.
struct EdgePoints {
  uint32_t from, to;
};

/// Edges, which have their places in a list for numbers, by both their points, the lower one first.
class SortedEdges {
 public:
  class Edge {
   public:
    Edge() = default;
    Edge(const EdgePoints& ends, uint32_t number)
        : high(std::max(ends.from, ends.to)),
          number_and_way_(number << 1 | (ends.from < ends.to ? 1 : 0)) {}
    [[nodiscard]] uint32_t number() const { return number_and_way_ >> 1; }
    [[nodiscard]] bool is_forward() const { return number_and_way_ & 1; }  ///< from the lower point

    uint32_t high;

   private:
    uint32_t number_and_way_;
  };
  /// Those between two points, by their numbers.
  struct Bundle {
    uint32_t low;
    std::span<const Edge> edges;
  };

  /// REQUIRES: no more than 2^31 edges.
  SortedEdges(const RawVector<EdgePoints>& edges, size_t point_count) {
    const auto lower = [&](size_t i) { return std::min(edges[i].from, edges[i].to); };
    by_low_.sort(edges.size(), point_count, lower,
                 [&](size_t i) { return Edge(edges[i], static_cast<uint32_t>(i)); });
    for_each_range(point_count, [&](size_t begin, size_t end) {
      for (size_t p = begin; p < end; ++p) {
        sort_few(by_low_.values.begin() + by_low_.starts[p],
                 by_low_.values.begin() + by_low_.starts[p + 1],
                 [](const Edge& a, const Edge& b) { return a.high < b.high; });
      }
    });
  }

  /// Calls visit(bundle) for those with lower points [begin, end), in their order.
  template <class Visit>
  void each_bundle(size_t begin, size_t end, Visit&& visit) const {
    for (size_t low = begin; low < end; ++low) {
      const Edge* const last = by_low_.values.data() + by_low_.starts[low + 1];
      for (const Edge *i = by_low_.values.data() + by_low_.starts[low], *j = i; i != last; i = j) {
        while (j != last && j->high == i->high) ++j;
        visit(Bundle{static_cast<uint32_t>(low), {i, j}});
      }
    }
  }

 private:
  CountingGroups<RawVector<Edge>> by_low_;
};

/// Whether as many run one way as the other.
inline bool is_balanced(const SortedEdges::Bundle& bundle) {
  size_t forward = 0;
  for (const SortedEdges::Edge& e : bundle.edges) forward += e.is_forward();
  return 2 * forward == bundle.edges.size();
}

}  // namespace csgrun
