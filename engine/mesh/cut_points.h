// Points of a store of pieces for sums over them: whole numbers near its origin, or fixed point.
#pragma once

#include <cstdlib>
#include <span>
#include <vector>

#include "engine/bsp/piece_store.h"
#include "engine/mesh/fixed_sums.h"

namespace csgrun {

constexpr int kFraction = 64;  ///< bits of a point in fixed point

/// False unless all corners are whole and near the store's origin, relative to which `near` has
/// them then.
inline bool take_near(const PieceStore& store, std::span<const uint32_t> corners,
                      std::vector<Near>& near) {
  near.clear();
  for (const uint32_t point : corners) {
    if (!store.is_on_grid(point)) return false;
    Near& at = near.emplace_back();
    for (size_t k = 0; k < 3; ++k) {
      at[k] = static_cast<int64_t>(store.rounded(point)[k]) - store.origin()[k];
      if (std::abs(at[k]) >= kNearLimit) return false;
    }
  }
  return true;
}

/// A point relative to the store's origin, cut to 64 fractional bits; null when it is out of range.
inline const PieceStore::CutPoint* find_cut_point(PieceStore& store, uint32_t point) {
  PieceStore::CutPoint& known = store.cut_point(point);
  if (known.is_known) return &known;
  const Point p = store.exact(point);
  const FixedQuotients<1> over_w(p.w);
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<size_t>(k);
    if (!over_w.divide(coordinate(p, k), known.at[axis], known.is_cut)) return nullptr;
    known.at[axis] -= Int<2>(store.origin()[axis]).shifted_left(kFraction);
  }
  known.is_known = true;
  return &known;
}

}  // namespace csgrun
