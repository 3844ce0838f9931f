// Numbers as bytes, as this machine holds them, and back.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace csgrun {

/// What has no bytes that mean nothing: equal values are equal bytes, or doubles.
template <class T>
concept PlainBytes = std::is_trivially_copyable_v<T> &&
    (std::has_unique_object_representations_v<T> || std::is_same_v<T, double> ||
     std::is_same_v<T, std::array<double, 3>>);

class ByteWriter {
 public:
  template <class T>
  void number(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    append(&value, sizeof value);
  }
  /// Of a vector, say, with its length before it.
  template <class Values>
  void list(const Values& values) {
    static_assert(PlainBytes<typename Values::value_type>);
    number(static_cast<uint64_t>(values.size()));
    append(values.data(), values.size() * sizeof(typename Values::value_type));
  }
  void text(std::string_view value) { list(value); }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  void append(const void* data, size_t size) {
    if (size > 0) bytes_.append(static_cast<const char*>(data), size);
  }
  std::string bytes_;
};

/// Reads what a ByteWriter wrote. Once something is missing, all that follows is 0 or empty, and
/// is_good() false.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  T number() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value{};
    if (has(sizeof value)) {
      std::memcpy(&value, rest_.data(), sizeof value);
      rest_.remove_prefix(sizeof value);
    }
    return value;
  }
  /// Into a vector of any allocator.
  template <class Vector>
  void list(Vector& values) {
    using T = typename Vector::value_type;
    static_assert(PlainBytes<T>);
    values.clear();
    const auto count = number<uint64_t>();
    if (count > rest_.size() / sizeof(T)) is_good_ = false;
    if (!is_good_) return;
    values.resize(count);
    if (count > 0) std::memcpy(values.data(), rest_.data(), count * sizeof(T));
    rest_.remove_prefix(count * sizeof(T));
  }
  [[nodiscard]] bool is_good() const { return is_good_; }
  [[nodiscard]] bool is_at_end() const { return is_good_ && rest_.empty(); }

 private:
  bool has(size_t size) {
    is_good_ = is_good_ && size <= rest_.size();
    return is_good_;
  }
  std::string_view rest_;
  bool is_good_ = true;
};

}  // namespace csgrun
