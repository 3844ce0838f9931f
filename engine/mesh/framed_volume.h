// Volumes of faces that stand in a frame, from their whole numbers there.
#pragma once

#include <array>
#include <cstdint>

#include "engine/bsp/frame_map.h"
#include "engine/exact/fixed_int.h"

namespace csgrun {

/// Sums over triangles a, b, c of a leaf's faces, in its frame's grid steps.
struct FramedSums {
  Int128 determinants = 0;          ///< of det(a, b, c)
  std::array<Int128, 3> normals{};  ///< of (b - a) x (c - a)
};

/// The sum of det(a - o, b - o, c - o) in the world, where the triangles run the other way round if
/// the frame mirrors; times 2^192 and cut there, `cut` is set when it was not whole. REQUIRES:
/// |determinants| < 2^127, |normals| < 2^96.
Int<6> framed_determinants(const FramedSums& sums, const FrameMap& map, const IVec3& o, bool& cut);

}  // namespace csgrun
