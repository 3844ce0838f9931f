// What is known of patches before any ray is sent: on which side of an operand they are that bounds
// them, or that they touch.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/parallel_sort.h"
#include "engine/bsp/cut_polygon.h"

namespace csgrun {

class PatchFacts {
 public:
  void add(uint32_t patch, const CutLoops::Fact& fact) {
    const Entry entry{patch, {fact.operand, fact.front, fact.back}};
    if (entries_.empty() || entries_.back() != entry) entries_.push_back(entry);
  }

  /// Adds what others were told.
  void add(const PatchFacts& more) {
    entries_.insert(entries_.end(), more.entries_.begin(), more.entries_.end());
  }

  /// To be called after all were added; false if two contradict one another, but for those that may
  /// (see CutLoops::may_contradict). O(n log n).
  [[nodiscard]] bool finish(std::span<const uint8_t> is_open) {
    sort_all(entries_.begin(), entries_.end());
    entries_.erase(std::unique(entries_.begin(), entries_.end()), entries_.end());
    facts_.reserve(entries_.size());
    for (const Entry& e : entries_) facts_.push_back(e.fact);
    const auto contradict = [&](const Entry& a, const Entry& b) {
      return a.patch == b.patch && a.fact.operand == b.fact.operand &&
             !CutLoops::may_contradict(a.fact, b.fact, is_open);
    };
    return std::adjacent_find(entries_.begin(), entries_.end(), contradict) == entries_.end();
  }

  /// Those of a patch, by ascending operands. O(log n).
  [[nodiscard]] std::span<const CutLoops::Fact> of(uint32_t patch) const {
    const auto begin = std::partition_point(entries_.begin(), entries_.end(),
                                            [&](const Entry& e) { return e.patch < patch; });
    const auto end = std::partition_point(begin, entries_.end(),
                                          [&](const Entry& e) { return e.patch == patch; });
    return {facts_.data() + (begin - entries_.begin()), static_cast<size_t>(end - begin)};
  }

 private:
  struct Entry {
    uint32_t patch;
    CutLoops::Fact fact;
    bool operator==(const Entry&) const = default;
    auto operator<=>(const Entry&) const = default;
  };

  std::vector<Entry> entries_;
  std::vector<CutLoops::Fact> facts_;  ///< of the entries
};

}  // namespace csgrun
