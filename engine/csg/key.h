// 128-bit content keys (XXH3) of leaves and nodes.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace csgrun {

using Key = std::array<uint64_t, 2>;

struct KeyHash {
  size_t operator()(const Key& key) const { return static_cast<size_t>(key[0]); }
};

/// Gathers bytes and hashes them; long lists are hashed where they are. Everything is put with its
/// length where it varies, so that different sequences give different bytes. Numbers are hashed as
/// this machine holds them. They are values only, nothing of a process: other runs have the same
/// keys (disk_boundaries.h).
class KeyBuilder {
 public:
  explicit KeyBuilder(std::string_view domain);
  ~KeyBuilder();
  KeyBuilder(const KeyBuilder&) = delete;
  KeyBuilder& operator=(const KeyBuilder&) = delete;

  template <class T>
  KeyBuilder& number(T value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    append(&value, sizeof(value));
    return *this;
  }
  template <class T, size_t N>
  KeyBuilder& numbers(const std::array<T, N>& values) {
    for (const T& value : values) number(value);
    return *this;
  }
  template <class T>
  KeyBuilder& list(const std::vector<T>& values) {
    number(static_cast<uint64_t>(values.size()));
    return bare_list(std::span<const T>(values));
  }
  /// Without their number, as if one by one.
  template <class T>
  KeyBuilder& bare_list(std::span<const T> values) {
    static_assert(std::has_unique_object_representations_v<T>);
    append(values.data(), values.size_bytes());
    return *this;
  }
  KeyBuilder& text(std::string_view value) {
    number(static_cast<uint64_t>(value.size()));
    append(value.data(), value.size());
    return *this;
  }
  [[nodiscard]] Key key();

 private:
  struct Stream;

  void append(const void* data, size_t size) {
    if (size > first_.size() - size_) return hash(data, size);
    if (size > 0) std::memcpy(first_.data() + size_, data, size);
    size_ += size;
  }
  void hash(const void* data, size_t size);

  std::array<char, 512> first_;     ///< bytes that are not hashed yet: all of most keys
  size_t size_ = 0;                 ///< of these
  std::unique_ptr<Stream> stream_;  ///< of what is hashed
};

}  // namespace csgrun
