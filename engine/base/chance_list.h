// A list to which things are added or not as chance has it: without a branch, which the processor
// would guess wrong half of the time.
#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include "engine/base/raw_vector.h"

namespace csgrun {

/// Of numbers and other things that may be copied for nothing.
template <class T>
class ChanceList {
 public:
  /// With room for so many things.
  explicit ChanceList(size_t room = 0) : list_(room) {}

  /// Room for so many more, in amortised constant time each.
  void make_room(size_t more) {
    if (count_ + more > list_.size()) list_.resize(2 * list_.size() + more);
  }
  /// REQUIRES: there is room for one more, also if it is not added.
  void add_if(bool is_added, const T& thing) {
    list_[count_] = thing;
    count_ += static_cast<size_t>(is_added);
  }
  [[nodiscard]] size_t size() const { return count_; }
  const T& operator[](size_t i) const { return list_[i]; }
  [[nodiscard]] std::span<const T> view() const { return {list_.data(), count_}; }
  /// All that was added; leaves nothing behind.
  RawVector<T> take() {
    list_.resize(std::exchange(count_, 0));
    return std::move(list_);
  }

 private:
  RawVector<T> list_;
  size_t count_ = 0;
};

}  // namespace csgrun
