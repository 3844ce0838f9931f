// Whether a map has only finite entries.
#pragma once

#include <cmath>

#include <csgrun/engine/csg_tree.h>

namespace csgrun {

inline bool is_finite(const Affine& map) {
  for (const auto& row : map.m) {
    for (const double entry : row) {
      if (!std::isfinite(entry)) return false;
    }
  }
  return true;
}

}  // namespace csgrun
