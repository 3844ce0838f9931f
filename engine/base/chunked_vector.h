// A vector that grows without moving what it has.
#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

#include "engine/base/raw_vector.h"

namespace csgrun {

/// Elements in chunks of one size, for tables that only grow, and far: growing takes no second copy
/// of the memory, and references stay good once there are `kChunk` elements. (The first chunk grows
/// as vectors do: most tables are small.) One indirection more to an element than in a vector.
template <class T>
class ChunkedVector {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  static constexpr size_t kChunk = 2048;

  [[nodiscard]] size_t size() const { return size_; }
  const T& operator[](size_t i) const { return chunks_[i / kChunk].data()[i % kChunk]; }
  T& operator[](size_t i) { return chunks_[i / kChunk].data()[i % kChunk]; }
  [[nodiscard]] const T& back() const { return (*this)[size_ - 1]; }
  T& back() { return (*this)[size_ - 1]; }

  void push_back(const T& element) {
    if (size_ % kChunk == 0) add_chunk();
    chunks_.back().push_back(element);
    ++size_;
  }

 private:
  void add_chunk() {
    chunks_.emplace_back();
    if (size_ > 0) chunks_.back().reserve(kChunk);
  }

  std::vector<RawVector<T>> chunks_;
  size_t size_ = 0;
};

}  // namespace csgrun
