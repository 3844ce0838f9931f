// Bit widths of every exact quantity, computed from two parameters: the bits of grid coordinates
// and the bits that a frame adds. The code that holds a quantity asserts that it fits; nothing is
// remembered. Widths are of magnitudes: |value| < 2^bits. (docs/numerics.md has the table.)
//
// The bounds are products and sums of bounds, a little above the tight ones (shared analysis: a
// triangle's normal component is twice the area of a projected triangle, an offset six times the
// volume of a tetrahedron).
#pragma once

namespace csgrun::widths {

/// |coordinate| < 2^kGrid for a leaf; a leaf that reaches far outside the region of interest may
/// have kFarGrid.
constexpr int kGrid = 27;
constexpr int kFarGrid = 40;
/// Entries of a frame's integer matrix: |entry| <= 2^kFrame (kFrameShift for rotations, the rest
/// for the inverses of shears).
constexpr int kFrameShift = 40;
constexpr int kFrame = 56;

/// Normal of a plane through grid points: products of two differences, two terms.
constexpr int normal(int grid) { return 2 * (grid + 1); }
/// Offset: normal . point, three terms; tight bound 4 V^3.
constexpr int offset(int grid) { return 3 * grid + 2; }
/// Mapped to the world by a frame: C^T n has three terms, d is shifted.
constexpr int framed_normal(int n, int frame) { return n + frame + 2; }
constexpr int framed_offset(int d) { return d + kFrameShift; }

/// Intersection of three planes: w = det of the normals (six products), x y z = det with one column
/// of offsets.
constexpr int point_w(int n) { return 3 * n + 3; }
constexpr int point_xyz(int n, int d) { return 2 * n + d + 3; }
/// Plane at a point: three products n . xyz and one d w.
constexpr int side(int xyz, int w, int n, int d) { return (xyz + n > w + d ? xyz + n : w + d) + 2; }

constexpr int max_of(int a, int b) { return a > b ? a : b; }

/// The widest plane that is ever made: far leaves have no frame but the identity's (csg/frames),
/// and framed leaves are not far.
constexpr int kMaxNormal = max_of(normal(kFarGrid), framed_normal(normal(kGrid), kFrame));
constexpr int kMaxOffset = max_of(offset(kFarGrid), framed_offset(offset(kGrid)));
constexpr int kMaxPointW = point_w(kMaxNormal);
constexpr int kMaxPointXyz = point_xyz(kMaxNormal, kMaxOffset);
constexpr int kMaxSide = side(kMaxPointXyz, kMaxPointW, kMaxNormal, kMaxOffset);

/// Limbs of 64 bits that hold a magnitude of `bits` and a sign.
constexpr int limbs(int bits) { return (bits + 1 + 63) / 64; }

}  // namespace csgrun::widths
