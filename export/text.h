// Text of files: numbers without a locale, names that cannot break a format.
#pragma once

#include <charconv>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>

#include <csgrun/engine/solid.h>

namespace csgrun {

/// Appends the shortest decimal that reads back as the same double.
inline void append_number(std::string& text, double value) {
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  text.append(buffer, end);
}

inline void append_number(std::string& text, uint64_t value) {
  char buffer[24];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  text.append(buffer, end);
}

/// The name with every byte that is not part of valid UTF-8 replaced by U+FFFD.
std::string valid_utf8(std::string_view name);

/// The name as one word of a line: white space and control characters become '_'.
std::string one_word(std::string_view name);

/// The name, with _2, _3 and so on behind it if it is taken already; it is taken then.
std::string distinct(const std::string& name, std::set<std::string>& taken);

/// The leaf with this number in the solid's sources, on one line: "cube, model.lua:3"; empty if
/// there is none.
std::string source_text(const Solid& solid, uint32_t source);

/// The text on one line: control characters become spaces.
std::string one_line(std::string_view text);

/// Text in an attribute or an element of XML, on one line. What is no character there (XML 1.0,
/// section 2.2) is replaced by U+FFFD.
std::string xml_text(std::string_view text);

}  // namespace csgrun
