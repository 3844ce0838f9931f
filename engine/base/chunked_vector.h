// A vector that grows without moving what it has.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>
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
  void append(std::span<const T> elements) {
    append_in_parts(elements.size(), [&](RawVector<T>& chunk, size_t begin, size_t count) {
      const auto part = elements.subspan(begin, count);
      chunk.insert(chunk.end(), part.begin(), part.end());
    });
  }
  void append(size_t count, const T& element) {
    append_in_parts(count, [&](RawVector<T>& chunk, size_t, size_t some) {
      chunk.insert(chunk.end(), some, element);
    });
  }
  /// Keeps the memory of the first few chunks. O(size).
  void clear() {
    constexpr size_t kKept = 16;
    if (chunks_.size() > kKept) chunks_.resize(kKept);
    for (auto& chunk : chunks_) chunk.clear();
    size_ = 0;
  }

 private:
  /// Calls append(chunk, begin, count) for what each chunk takes of `count` elements.
  template <class Append>
  void append_in_parts(size_t count, Append&& append) {
    for (size_t begin = 0; begin < count;) {
      if (size_ == kChunk * chunks_.size()) add_chunk();
      const size_t some = std::min(count - begin, kChunk - size_ % kChunk);
      append(chunks_[size_ / kChunk], begin, some);
      size_ += some;
      begin += some;
    }
  }
  void add_chunk() {
    constexpr bool kStartsWhole = kChunk <= 16;
    chunks_.emplace_back();
    if (size_ > 0 || kStartsWhole) chunks_.back().reserve(kChunk);
  }

  std::vector<RawVector<T>> chunks_;
  size_t size_ = 0;
};

}  // namespace csgrun
