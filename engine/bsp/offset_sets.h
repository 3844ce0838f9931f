// Disjoint sets of things that have numbers, of which differences are known.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace csgrun {

class OffsetSets {
 public:
  explicit OffsetSets(size_t count) : parent_(count), offset_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  /// The smallest member of a set, and by how much a number is above that of this member.
  struct Place {
    uint32_t root;
    int32_t offset;
  };
  Place find(uint32_t i) {
    int32_t sum = 0;
    while (parent_[i] != i) {
      const uint32_t above = parent_[i];
      offset_[i] += offset_[above];
      parent_[i] = parent_[above];
      sum += offset_[i];
      i = parent_[i];
    }
    return {i, sum};
  }
  /// Says that the number of `b` is `step` above that of `a`. False if it is known to be another.
  bool join(uint32_t a, uint32_t b, int32_t step) {
    const Place p = find(a), q = find(b);
    const int32_t apart = p.offset + step - q.offset;  // of the roots
    if (p.root == q.root) return apart == 0;
    parent_[std::max(p.root, q.root)] = std::min(p.root, q.root);
    offset_[std::max(p.root, q.root)] = p.root < q.root ? apart : -apart;
    return true;
  }

 private:
  std::vector<uint32_t> parent_;
  std::vector<int32_t> offset_;  ///< above the number of the parent
};

}  // namespace csgrun
