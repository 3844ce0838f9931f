// Results that the next operation changes where it touches them: what a chain of operations, each
// of whose results is looked at, goes from one to the next by.
//
// A version is a set of pieces in a store that all versions share (piece_store.h), found by a tree
// that versions share too. An operation takes the pieces in its tools' boxes, makes them convex,
// and cuts them as it would cut whole faces; all else stays. Pieces keep the polygon of the operand
// that they come from, so that in the end they are assembled as if all operations had been one:
// into the same boundary, to the last bit.
//
// (Nehring-Wirxel et al. 2021 keep an octree of plane-based pieces; here cells cut nothing.)
#pragma once

#include <memory>
#include <vector>

#include "engine/bsp/assemble.h"
#include "engine/bsp/kernel.h"
#include "engine/bsp/piece_store.h"
#include "engine/bsp/touch_list.h"

namespace csgrun {

struct ResultPieces {
  std::shared_ptr<PieceStore> store;
  PieceTree tree;
  bool touches_anywhere = false;  ///< it may touch itself anywhere, not only in `touches`
  TouchList touches;
  size_t bytes = 0;  ///< about what this version has that the one before had not
  /// Added to the sources of the store's operands, modulo 2^32: what goes on from a version may
  /// stand before it.
  uint32_t first_source = 0;
};
using PiecesPtr = std::shared_ptr<const ResultPieces>;

/// Makes these the pieces of the first version of a store.
void start_version(ResultPieces& version, const std::vector<uint32_t>& pieces);

/// As evaluate_boolean; null if a leaf in a frame has a vertex in whose faces nothing turns.
Result<PiecesPtr> evaluate_pieces(const std::vector<Operand>& operands,
                                  const Expression& expression, const GridBox& region,
                                  const KernelOptions& options, EvaluateStats& stats);

/// The same with a version as operand 0 of the expression, where it is and under the sources that
/// it has, and `others`, which may have lower ones, from 1 on. The time depends on the pieces in
/// the boxes of the others, if the expression drops or keeps what is outside of these; null if it
/// turns that over, or as above. Not thread-safe with others that share the store.
Result<PiecesPtr> change_pieces(const ResultPieces& version, const std::vector<Operand>& others,
                                const Expression& expression, const GridBox& region,
                                const KernelOptions& options, EvaluateStats& stats);

/// The boundary of a version: what evaluate_boolean gives for the operations as one. O(n log n).
Result<std::shared_ptr<const BoundaryMesh>> assemble_pieces(const ResultPieces& version,
                                                            bool name_untouched);

}  // namespace csgrun
