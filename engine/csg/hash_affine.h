// Maps as keys.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <csgrun/engine/csg_tree.h>

namespace csgrun {

/// A hash of what is equal for equal maps, on top of another one.
inline size_t hash_affine(uint64_t h, const Affine& map) {
  for (const auto& row : map.m) {
    for (double entry : row) {
      uint64_t bits;
      entry += 0.0;  // negative zero equals zero
      std::memcpy(&bits, &entry, sizeof(bits));
      h = (h ^ bits) * 0xff51afd7ed558ccdULL;
      h ^= h >> 32;
    }
  }
  return static_cast<size_t>(h);
}

}  // namespace csgrun
