// Points of a store of pieces in fixed point, which the store keeps.
#pragma once

#include "engine/bsp/piece_store.h"
#include "engine/mesh/fixed_sums.h"

namespace csgrun {

/// A point relative to the store's origin, cut to 64 fractional bits; null when it is out of range.
inline const PieceStore::CutPoint* find_cut_point(PieceStore& store, uint32_t point) {
  PieceStore::CutPoint& known = store.cut_point(point);
  if (known.is_known) return &known;
  constexpr int kFraction = 64;
  const Point p = store.exact(point);
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<size_t>(k);
    if (!fixed_point<1>(coordinate(p, k), p.w, known.at[axis], known.is_cut)) return nullptr;
    known.at[axis] -= Int<2>(store.origin()[axis]).shifted_left(kFraction);
  }
  known.is_known = true;
  return &known;
}

}  // namespace csgrun
