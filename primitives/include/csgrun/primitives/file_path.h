// Paths that files name: a model from somewhere must not make us read what lies elsewhere.
#pragma once

#include <string_view>

namespace csgrun {

/// Whether a path that a file names may lead out of that file's folder: it is absolute, an address
/// of the net, or goes up anywhere. "a..b/c" does not.
inline bool leads_out_of_folder(std::string_view path) {
  constexpr std::string_view kForeign(":\\\0", 3);  // drives, schemes, other systems' slashes
  if (path.starts_with('/') || path.find_first_of(kForeign) != std::string_view::npos) return true;
  while (!path.empty()) {
    const size_t end = path.find('/');
    if (path.substr(0, end) == "..") return true;
    path.remove_prefix(end == std::string_view::npos ? path.size() : end + 1);
  }
  return false;
}

}  // namespace csgrun
