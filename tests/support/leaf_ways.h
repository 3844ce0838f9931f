// The quick way to a leaf against the general one. Stretched by a power of two a mesh is too large
// for the arithmetic of the quick way, so it goes the other one: through lists of loops, and with
// every pair of near faces decided by signs. All but the coordinates must be the same.
#pragma once

#include <cstddef>
#include <vector>

#include <csgrun/engine/polygon_mesh.h>

#include "engine/bsp/operand.h"

namespace csgrun::test {

/// What was compared.
struct Tally {
  size_t good = 0, tangled = 0, flat = 0, open = 0, crossings = 0, quick = 0, merged = 0,
         convex = 0, sharp = 0;
};

std::vector<IVec3> stretched(std::vector<IVec3> points, int64_t by);

/// Whether no vertex is in front of a face.
bool nothing_in_front(const LeafGeometry& leaf);

/// Whether the plane of each face has no vertices but those of its corners.
bool has_one_face_in_each_plane(const LeafGeometry& leaf);

/// REQUIRES: coordinates below 2^39 / stretch.
void expect_same_both_ways(const PolygonMesh& mesh, const std::vector<IVec3>& points, bool turn,
                           Tally& tally, int64_t stretch = int64_t{1} << 30);

}  // namespace csgrun::test
