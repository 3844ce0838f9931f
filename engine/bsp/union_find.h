// Disjoint sets of numbers; the representative is the smallest member.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace csgrun {

class UnionFind {
 public:
  explicit UnionFind(size_t n = 0) { reset(n); }

  void reset(size_t n) {
    parent_.resize(n);
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  uint32_t find(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Leads each number of [begin, end) to its representative at once, if none of their sets reaches
  /// below `begin`.
  void flatten(uint32_t begin, uint32_t end) {
    for (uint32_t i = begin; i < end; ++i) parent_[i] = parent_[parent_[i]];
  }
  /// That of a number after flatten.
  [[nodiscard]] uint32_t root(uint32_t i) const { return parent_[i]; }
  void join(uint32_t a, uint32_t b) { join_with(find(a), b); }
  /// Joins a number with the set that has the representative `root`; returns that of both.
  uint32_t join_with(uint32_t root, uint32_t i) {
    if (parent_[i] == root) return root;
    i = find(i);
    parent_[std::max(root, i)] = std::min(root, i);
    return std::min(root, i);
  }
  [[nodiscard]] size_t size() const { return parent_.size(); }

 private:
  std::vector<uint32_t> parent_;
};

}  // namespace csgrun
