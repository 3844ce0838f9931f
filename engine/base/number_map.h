// What some of many numbers stand for.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace csgrun {

/// From numbers, but for the last one (~0), to numbers. Takes no memory for an entry by itself, as
/// std::unordered_map does: threads wait for one another where they ask for memory.
class NumberMap {
 public:
  [[nodiscard]] size_t size() const { return size_; }

  /// What a number stands for; `value` from now on if it stands for nothing yet: then the second is
  /// true. O(1) on average.
  std::pair<uint32_t, bool> find_or_add(uint32_t number, uint32_t value) {
    if (2 * (size_ + 1) > slots_.size()) grow();
    Slot& slot = slots_[place_of(number)];
    if (slot.number == number) return {slot.value, false};
    slot = {number, value};
    ++size_;
    return {value, true};
  }

 private:
  static constexpr uint32_t kFree = ~0u;
  static constexpr size_t kFewest = 16;
  struct Slot {
    uint32_t number = kFree, value = 0;
  };

  /// Where a number is, or is to be. REQUIRES: some slots are free.
  [[nodiscard]] size_t place_of(uint32_t number) const {
    constexpr uint64_t kGolden = 0x9e3779b97f4a7c15;  // spreads numbers that follow each other
    const size_t mask = slots_.size() - 1;
    auto at = static_cast<size_t>(number * kGolden >> std::countl_zero(mask));
    while (slots_[at].number != number && slots_[at].number != kFree) at = (at + 1) & mask;
    return at;
  }
  void grow() {
    std::vector<Slot> old(slots_.empty() ? kFewest : 2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.number != kFree) slots_[place_of(slot.number)] = slot;
    }
  }

  std::vector<Slot> slots_;  ///< open addressing; a power of two
  size_t size_ = 0;
};

}  // namespace csgrun
