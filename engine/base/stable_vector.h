// A vector of large things that grows without moving them: references stay valid, and no page is
// touched twice.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace csgrun {

template <class T>
class StableVector {
 public:
  [[nodiscard]] size_t size() const { return size_; }
  [[nodiscard]] const T& operator[](size_t i) const { return chunks_[i / kChunk][i % kChunk]; }
  void push_back(T value) {
    if (size_ == chunks_.size() * kChunk) {
      chunks_.push_back(std::make_unique_for_overwrite<T[]>(kChunk));
    }
    chunks_[size_ / kChunk][size_ % kChunk] = std::move(value);
    ++size_;
  }
  /// Keeps the memory.
  void clear() { size_ = 0; }

 private:
  static constexpr size_t kChunk = 16;
  std::vector<std::unique_ptr<T[]>> chunks_;
  size_t size_ = 0;
};

}  // namespace csgrun
