// Numbers in bytes, of either byte order, whatever the machine's own.
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

namespace csgrun {

/// An unsigned integer of N bytes at `at`. REQUIRES: they are there.
template <int N>
uint64_t read_unsigned(std::string_view bytes, size_t at, bool big_endian) {
  uint64_t value = 0;
  for (int i = 0; i < N; ++i) {
    const auto byte = static_cast<unsigned char>(bytes[at + (big_endian ? i : N - 1 - i)]);
    value = value << 8 | byte;
  }
  return value;
}

inline float read_float(std::string_view bytes, size_t at, bool big_endian) {
  return std::bit_cast<float>(static_cast<uint32_t>(read_unsigned<4>(bytes, at, big_endian)));
}

inline double read_double(std::string_view bytes, size_t at, bool big_endian) {
  return std::bit_cast<double>(read_unsigned<8>(bytes, at, big_endian));
}

}  // namespace csgrun
