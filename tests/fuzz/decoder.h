// Reads an input as a sequence of choices. Beyond its end everything is 0, so every prefix of an
// input is an input, and what a byte means does not depend on the length.
#pragma once

#include <cstddef>
#include <cstdint>

namespace csgrun::fuzz {

class Decoder {
 public:
  Decoder(const uint8_t* data, size_t size) : at_(data), end_(data + size) {}

  [[nodiscard]] bool done() const { return at_ == end_; }
  uint8_t byte() { return at_ == end_ ? uint8_t{0} : *at_++; }
  /// In [0, count).
  uint32_t choose(uint32_t count) { return byte() % count; }
  /// In [low, high].
  int64_t integer(int low, int high) {
    return low + static_cast<int64_t>(choose(static_cast<uint32_t>(high - low + 1)));
  }

 private:
  const uint8_t* at_;
  const uint8_t* end_;
};

}  // namespace csgrun::fuzz
