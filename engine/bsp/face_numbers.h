// A number for each face of a leaf. Mostly all have the same one, or one after another: these are
// not stored.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace csgrun {

class FaceNumbers {
 public:
  /// 0 for all faces.
  FaceNumbers() = default;
  /// As they are listed.
  FaceNumbers(std::vector<uint32_t> each) : each_(std::move(each)) {}
  static FaceNumbers all(uint32_t number) {
    FaceNumbers numbers;
    numbers.first_ = number;
    return numbers;
  }
  /// Face f has first + f.
  static FaceNumbers ascending(uint32_t first) {
    FaceNumbers numbers = all(first);
    numbers.step_ = 1;
    return numbers;
  }

  uint32_t operator[](size_t face) const {
    return each_.empty() ? first_ + step_ * static_cast<uint32_t>(face) : each_[face];
  }
  /// The number that all faces have, if they do. O(n).
  [[nodiscard]] std::optional<uint32_t> common() const {
    if (each_.empty()) return step_ == 0 ? std::optional(first_) : std::nullopt;
    const bool differ =
        std::adjacent_find(each_.begin(), each_.end(), std::not_equal_to<>()) != each_.end();
    return differ ? std::nullopt : std::optional(each_[0]);
  }
  /// Whether none is less than that of the face before. O(n).
  [[nodiscard]] bool ascend() const { return std::is_sorted(each_.begin(), each_.end()); }
  /// Whether each face has the number of the one before and one. False where they are listed.
  [[nodiscard]] bool count_up() const { return each_.empty() && step_ == 1; }
  /// Those of the first `count` faces.
  [[nodiscard]] std::vector<uint32_t> list(size_t count) const {
    std::vector<uint32_t> numbers(count);
    for (size_t f = 0; f < count; ++f) numbers[f] = (*this)[f];
    return numbers;
  }
  /// How many are stored.
  [[nodiscard]] size_t stored() const { return each_.size(); }

 private:
  uint32_t first_ = 0, step_ = 0;
  std::vector<uint32_t> each_;  ///< if it is not empty, it counts
};

}  // namespace csgrun
