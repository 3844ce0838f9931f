// The endings of file names, by which formats are known.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace csgrun {

/// Whether a path ends so, in capital letters or small ones: has_ending("A.STL", ".stl").
/// REQUIRES: small letters in `ending`.
inline bool has_ending(std::string_view path, std::string_view ending) {
  return path.size() >= ending.size() &&
         std::equal(
             ending.begin(), ending.end(), path.end() - static_cast<std::ptrdiff_t>(ending.size()),
             [](char wanted, char c) {
               return wanted == (c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
             });
}

}  // namespace csgrun
