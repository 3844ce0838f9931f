// What is wrong with a text that is no JSON, in the words of the parser but without its codes.
#pragma once

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace csgrun {

/// "12: malformed JSON: syntax error while parsing value - ...", where 12 is the line.
inline std::string json_fault(const std::string& text, const nlohmann::json::parse_error& error) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
  std::string what = error.what();
  // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error ..."
  const size_t column = what.find("column ");
  const size_t colon = what.find(": ", column == std::string::npos ? 0 : column);
  if (colon != std::string::npos) what.erase(0, colon + 2);
  return fmt::format("{}: malformed JSON: {}", 1 + std::count(text.begin(), end, '\n'), what);
}

}  // namespace csgrun
