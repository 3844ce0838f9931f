// Between the lower and the upper half of such a loop the sweep line meets one piece of the
// interior, so all that the sweep keeps is one chain (triangulate.cpp), which grows at both ends.
#include "engine/mesh/triangulate_monotone.h"

#include <algorithm>

namespace csgrun {
namespace {

constexpr uint32_t kMostCorners = 24;

class MonotoneLoop {
 public:
  MonotoneLoop(std::span<const uint32_t> loop, const PlanarOracle& oracle,
               std::vector<std::array<uint32_t, 3>>& triangles)
      : loop_(loop),
        count_(static_cast<uint32_t>(loop.size())),
        oracle_(oracle),
        triangles_(triangles) {}

  bool run() {
    const size_t before = triangles_.size();
    triangles_.reserve(before + count_ - 2);
    if (rank_corners() && split_halves() && sweep()) return true;
    triangles_.resize(before);
    return false;
  }

 private:
  /// False when two corners are one point.
  bool rank_corners() {
    std::array<double, kMostCorners> along;
    for (uint32_t i = 0; i < count_; ++i) {
      along[i] = oracle_.along(loop_[i]);
      uint32_t at = i;
      for (; at > 0; --at) {
        const uint32_t before = corner_[at - 1];
        if (along[before] < along[i]) break;
        if (along[before] == along[i]) {
          const int order = oracle_.compare(loop_[i], loop_[before]);
          if (order == 0) return false;
          if (order > 0) break;
        }
        corner_[at] = before;
      }
      corner_[at] = i;
    }
    for (uint32_t rank = 0; rank < count_; ++rank) rank_[corner_[rank]] = rank;
    return true;
  }

  /// The lower half runs along the sweep, the upper one back. False when there are more parts.
  bool split_halves() {
    uint32_t at = corner_[0];
    bool is_lower = true;
    for (uint32_t i = 1; i < count_; ++i) {
      const uint32_t from = rank_[at];
      at = at + 1 < count_ ? at + 1 : 0;
      const uint32_t to = rank_[at];
      if (is_lower != (from < to)) return false;
      is_lower_[to] = is_lower;
      if (to + 1 == count_) is_lower = false;
    }
    return true;
  }

  bool sweep() {
    chain_[head_] = 0;
    for (uint32_t v = 1; v < count_; ++v) {
      const bool at_head = is_lower_[v] || v + 1 == count_;
      while (head_ != tail_) {
        const uint32_t low = at_head ? chain_[head_] : chain_[tail_ - 1];
        const uint32_t high = at_head ? chain_[head_ + 1] : chain_[tail_];
        if (!emit(low, v, high)) break;
        at_head ? ++head_ : --tail_;
      }
      chain_[at_head ? --head_ : ++tail_] = v;
    }
    // The last corner has seen all of the chain.
    return head_ + 1 == tail_;
  }

  /// As the general sweep: nothing that is flat or turned over, the lowest rank first.
  bool emit(uint32_t a, uint32_t b, uint32_t c) {
    const auto id = [&](uint32_t rank) { return loop_[corner_[rank]]; };
    if (oracle_.orient(id(a), id(b), id(c)) <= 0) return false;
    while (a > b || a > c) {
      const uint32_t first = a;
      a = b, b = c, c = first;
    }
    triangles_.push_back({id(a), id(b), id(c)});
    return true;
  }

  std::span<const uint32_t> loop_;
  const uint32_t count_;
  const PlanarOracle& oracle_;
  std::vector<std::array<uint32_t, 3>>& triangles_;
  std::array<uint32_t, kMostCorners> corner_{}, rank_{};  ///< corners by rank, and the reverse
  std::array<bool, kMostCorners> is_lower_{};             ///< by rank
  /// Ranks, from the lower end of the chain to the upper one.
  std::array<uint32_t, 2 * kMostCorners> chain_{};
  uint32_t head_ = kMostCorners, tail_ = kMostCorners;
};

}  // namespace

bool triangulate_monotone(std::span<const uint32_t> loop, const PlanarOracle& oracle,
                          std::vector<std::array<uint32_t, 3>>& triangles) {
  if (loop.size() < 3 || loop.size() > kMostCorners) return false;
  return MonotoneLoop(loop, oracle, triangles).run();
}

}  // namespace csgrun
