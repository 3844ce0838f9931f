// Quick answers for pairs of triangles of a leaf: most pairs that are near each other are
// neighbours around a vertex, or on different sides of a plane.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/bsp/operand.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace csgrun {

/// Neighbours are told from the vertices that they have in common. A vertex is *spread* when there
/// is a direction in which all its triangles face, and its triangles, seen from there, surround it
/// once. They are then sectors that do not overlap: a map that is one to one on each of them takes
/// no two points to one unless they lie on the edge that two neighbouring sectors have. So two
/// triangles of a spread vertex have nothing in common but corners and edges of both.
class TrianglePairs {
 public:
  /// Whether the leaf has triangles only, and fits the arithmetic.
  static bool covers(const LeafGeometry& leaf, const GridBox& box);

  /// REQUIRES: covers(leaf, box), `box` holds its vertices, and no triangle is degenerate. `order`
  /// lists all faces; `is_balanced` says that every directed edge occurs as often as its reverse
  /// (else no vertex is taken for spread). O(n).
  TrianglePairs(const LeafGeometry& leaf, const GridBox& box, std::span<const uint32_t> order,
                bool is_balanced);

  /// True only when the triangles at two different places in the order meet nowhere but in corners
  /// and edges that both have. False says nothing.
  [[nodiscard]] bool apart(uint32_t a, uint32_t b) const {
    const Shape &f = shapes_[a], &g = shapes_[b];
    const uint32_t common = common_corners(f, g);
    if ((common & f.spread) != 0) return true;
    return common == 0 ? separated(f, g) : neighbours_apart(f, g);
  }

 private:
  using Point = std::array<double, 3>;
  struct Shape {
    Point normal;                     ///< each component rounded once
    double offset;                    ///< of the plane
    double slack;                     ///< what a point's distance may be off by rounding
    std::array<uint32_t, 4> corners;  ///< the last is the third again
    uint32_t spread;                  ///< a bit for each corner that is a spread vertex
    uint32_t facing;                  ///< a bit for each direction that it faces
  };

  /// A bit for each corner of f that g has too.
  static uint32_t common_corners(const Shape& f, const Shape& g) {
#if defined(__SSE2__)
    const auto load = [](const Shape& s) {
      return _mm_loadu_si128(reinterpret_cast<const __m128i*>(s.corners.data()));
    };
    const __m128i own = load(f), other = load(g);
    const __m128i first = _mm_cmpeq_epi32(own, _mm_shuffle_epi32(other, 0x00)),
                  second = _mm_cmpeq_epi32(own, _mm_shuffle_epi32(other, 0x55)),
                  third = _mm_cmpeq_epi32(own, _mm_shuffle_epi32(other, 0xaa));
    const __m128i any = _mm_or_si128(_mm_or_si128(first, second), third);
    return static_cast<uint32_t>(_mm_movemask_ps(_mm_castsi128_ps(any))) & 7;
#else
    uint32_t bits = 0;
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t v = f.corners[i];
      bits |= static_cast<uint32_t>((v == g.corners[0]) | (v == g.corners[1]) | (v == g.corners[2]))
              << i;
    }
    return bits;
#endif
  }

  [[nodiscard]] double distance(const Shape& f, uint32_t v) const {
    const Point& p = points_[v];
    return f.normal[0] * p[0] + f.normal[1] * p[1] + f.normal[2] * p[2] - f.offset;
  }
  [[nodiscard]] bool beside_plane(const Shape& f, const Shape& g) const;
  [[nodiscard]] bool separated(const Shape& f, const Shape& g) const;
  [[nodiscard]] bool neighbours_apart(const Shape& f, const Shape& g) const;
  void find_spread_vertices(const LeafGeometry& leaf);

  std::vector<Point> points_;  ///< from the middle of the leaf: exact
  std::vector<Shape> shapes_;  ///< in the order that was given
};

}  // namespace csgrun
