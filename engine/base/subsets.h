// Subsets of a few things, as bits.
#pragma once

#include <cstdint>

namespace csgrun {

/// Calls `visit(some)` for all sets of bits of `all`, itself and none of them among these.
template <class Visit>
void for_each_subset(uint32_t all, Visit&& visit) {
  for (uint32_t some = all;; some = (some - 1) & all) {
    visit(some);
    if (some == 0) return;
  }
}

}  // namespace csgrun
