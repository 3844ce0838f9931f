#include "lua_bindings/cli/alike.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <map>

namespace csgrun {
namespace {

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// What a warning says: without `file:line:` before it, and without digits.
std::string said(const std::string& warning) {
  size_t begin = 0;
  for (size_t colon = warning.find(':'); colon != std::string::npos;
       colon = warning.find(':', colon + 1)) {
    const auto after = static_cast<std::ptrdiff_t>(colon + 1);
    const auto end = std::find_if_not(warning.begin() + after, warning.end(), is_digit);
    if (end == warning.begin() + after || end == warning.end() || *end != ':') continue;
    begin = static_cast<size_t>(end - warning.begin());
    break;
  }
  std::string text = warning.substr(begin);
  std::erase_if(text, is_digit);
  return text;
}

}  // namespace

std::vector<std::string> few_alike(const std::vector<std::string>& warnings) {
  constexpr size_t kFew = 3;
  std::map<std::string, size_t> total, seen;
  for (const std::string& warning : warnings) ++total[said(warning)];
  std::vector<std::string> few;
  for (const std::string& warning : warnings) {
    const std::string text = said(warning);
    const size_t count = ++seen[text], all = total[text];
    // One more line is not saved by saying that there is one.
    if (count <= kFew || all == kFew + 1) few.push_back(warning);
    if (count == kFew && all > kFew + 1) {
      few.push_back(std::to_string(all - kFew) + " more like the one before");
    }
  }
  return few;
}

}  // namespace csgrun
