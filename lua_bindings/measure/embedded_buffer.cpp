#include "lua_bindings/measure/embedded_buffer.h"

#include <cstdint>

namespace csgrun {
namespace {

/// The value of a character of base 64 (RFC 4648), or -1.
int digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

}  // namespace

std::optional<std::string> decode_data_address(std::string_view address) {
  constexpr std::string_view kMark = ";base64,";
  const size_t mark = address.find(kMark);
  if (address.substr(0, 5) != "data:" || mark == std::string_view::npos) return std::nullopt;
  std::string_view text = address.substr(mark + kMark.size());
  if (text.size() % 4 != 0) return std::nullopt;
  for (int k = 0; k < 2 && !text.empty() && text.back() == '='; ++k) text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int value = digit(c);
    if (value < 0) return std::nullopt;
    bits = bits << 6 | static_cast<uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<char>(bits >> count & 0xff));
  }
  return bytes;
}

}  // namespace csgrun
