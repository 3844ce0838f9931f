// Patches: faces that hang together over edges which exactly two uses share. Within a patch the
// orientation of one face decides that of all others.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/mesh/edge_uses.h"

namespace csgrun {

struct Patches {
  std::vector<uint32_t> of_face;  ///< numbered in the order of their first faces
  std::vector<bool> turned;  ///< per face: it must be turned to agree with the most of its patch
  uint32_t count = 0;
  /// An edge over which a patch does not agree with itself, by its vertices: like a Moebius strip.
  std::optional<std::pair<uint32_t, uint32_t>> twisted;
};

/// O(n).
Patches find_patches(const std::vector<LoopFace>& faces, const EdgeUses& edges);

/// How patches meet in an edge that more than two uses share: each patch whose own uses, turned as
/// the patch wants, do not cancel, with what is left.
struct Junction {
  std::vector<std::pair<uint32_t, int64_t>> left;  ///< (patch, uses forward less uses back)
  uint32_t low = 0, high = 0;                      ///< one edge where they meet so

  /// What no orientation of the patches can cancel: 0 or 1.
  [[nodiscard]] int64_t parity() const;
};

/// All different junctions of at least one patch, sorted.
std::vector<Junction> find_junctions(const Patches& patches, const EdgeUses& edges);

/// Which patches to turn so that at every junction the rest is as small as parity lets it be, as
/// few patches as a search in their order finds; nothing if there is no such choice, or none is
/// found within a fixed number of steps. `failed` is then a junction that was in the way.
std::optional<std::vector<bool>> balance_junctions(uint32_t patch_count,
                                                   const std::vector<Junction>& junctions,
                                                   const Junction** failed);

}  // namespace csgrun
