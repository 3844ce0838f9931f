// A vector that is mostly short, and then asks nobody for memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <type_traits>

namespace csgrun {

/// A list of elements that are set all at once: up to kFew of them are within it.
template <class T, size_t kFew>
class FewVector {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_default_constructible_v<T>);

 public:
  FewVector() = default;
  explicit FewVector(std::span<const T> elements) { set(elements); }
  FewVector(const FewVector& other) { set(other); }
  FewVector(FewVector&& other) noexcept { take(other); }
  FewVector& operator=(const FewVector& other) { return *this = FewVector(other); }
  FewVector& operator=(FewVector&& other) noexcept {
    if (this == &other) return *this;
    free();
    take(other);
    return *this;
  }
  FewVector& operator=(std::span<const T> elements) { return *this = FewVector(elements); }
  ~FewVector() { free(); }

  [[nodiscard]] size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  T* data() { return has_few() ? few_ : many_; }
  [[nodiscard]] const T* data() const { return has_few() ? few_ : many_; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  [[nodiscard]] const T* begin() const { return data(); }
  [[nodiscard]] const T* end() const { return data() + size_; }
  T& operator[](size_t i) { return data()[i]; }
  const T& operator[](size_t i) const { return data()[i]; }

 private:
  [[nodiscard]] bool has_few() const { return size_ <= kFew; }
  void free() {
    if (!has_few()) delete[] many_;
  }
  /// Of one that has nothing.
  void set(std::span<const T> elements) {
    if (elements.size() > kFew) many_ = new T[elements.size()];
    size_ = elements.size();
    std::copy(elements.begin(), elements.end(), data());
  }
  void take(FewVector& other) noexcept {
    size_ = other.size_;
    if (has_few()) {
      std::copy(other.few_, other.few_ + size_, few_);
    } else {
      many_ = other.many_;
    }
    other.size_ = 0;
  }

  size_t size_ = 0;
  union {
    T few_[kFew];
    T* many_;
  };
};

}  // namespace csgrun
