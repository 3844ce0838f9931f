// The planes of a store's pieces, made if they were not.
#pragma once

#include "engine/bsp/piece_store.h"

namespace csgrun::test {

inline PlaneId support_of(PieceStore& store, uint32_t piece) {
  const PlaneId known = store.piece(piece).support;
  return known.valid() ? known : store.take_support(piece, store.reduced_support(piece));
}

inline uint32_t edge_plane_of(PieceStore& store, uint32_t piece, uint32_t edge) {
  const uint32_t known = store.edges(piece)[edge];
  return known != PieceStore::kNoNumber
             ? known
             : store.take_edge(piece, edge, store.reduced_edge(piece, edge));
}

}  // namespace csgrun::test
