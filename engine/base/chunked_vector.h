// A vector that grows without moving what it has.
#pragma once

#include <bit>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "engine/base/raw_vector.h"

namespace csgrun {

/// Elements in chunks of one size, for tables that only grow, and far: growing takes no second copy
/// of the memory, and references stay good. Only the first chunk, if it is one of many elements,
/// grows as vectors do, since most tables are small: references stay good once it is full. One
/// indirection more to an element than in a vector.
template <class T, size_t kSize = 2048>
class ChunkedVector {
  static_assert(std::is_trivially_copyable_v<T> && std::has_single_bit(kSize));

 public:
  static constexpr size_t kChunk = kSize;

  [[nodiscard]] size_t size() const { return size_; }
  const T& operator[](size_t i) const { return chunks_[i / kChunk].data()[i % kChunk]; }
  T& operator[](size_t i) { return chunks_[i / kChunk].data()[i % kChunk]; }
  [[nodiscard]] const T& back() const { return (*this)[size_ - 1]; }
  T& back() { return (*this)[size_ - 1]; }

  void push_back(const T& element) {
    if (size_ == kChunk * chunks_.size()) add_chunk();
    chunks_[size_ / kChunk].push_back(element);
    ++size_;
  }
  /// Keeps the memory of the first few chunks. O(size).
  void clear() {
    constexpr size_t kKept = 16;
    if (chunks_.size() > kKept) chunks_.resize(kKept);
    for (auto& chunk : chunks_) chunk.clear();
    size_ = 0;
  }

 private:
  void add_chunk() {
    constexpr bool kStartsWhole = kChunk <= 16;
    chunks_.emplace_back();
    if (size_ > 0 || kStartsWhole) chunks_.back().reserve(kChunk);
  }

  std::vector<RawVector<T>> chunks_;
  size_t size_ = 0;
};

}  // namespace csgrun
