// Quick answers for pairs of triangles of a leaf: most pairs that are near each other are
// neighbours around a vertex, or on different sides of a plane or a line.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/raw_vector.h"
#include "engine/bsp/operand.h"
#include "engine/mesh/eight_slabs.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace csgrun {

/// Neighbours are told from the vertices that they have in common: see spread_vertices.h.
class TrianglePairs {
 public:
  /// Whether the leaf fits the arithmetic.
  static bool covers(const LeafGeometry& leaf);

  /// REQUIRES: covers(leaf), and no face is degenerate; the leaf outlives this. `order` lists
  /// the faces, all or all but those of single_sheets.h; `is_spread` is of its vertices as
  /// find_spread_vertices tells, or empty: then none is taken for spread. `are_long`: most pairs
  /// will be told apart by slabs, which are made for this. O(n).
  TrianglePairs(const LeafGeometry& leaf, std::span<const uint32_t> order,
                std::span<const uint8_t> is_spread, bool are_long);

  /// A bit for each triangle at places 8 group .. 8 group + 7 in the order that has a spread vertex
  /// in common with the one at `place`.
  [[nodiscard]] uint32_t spread_neighbours(uint32_t place, uint32_t group) const {
    const std::array<uint32_t, 3>& own = spread_[place];
    const auto& others = corners_[group];
#if defined(__SSE2__)
    uint32_t bits = 0;
    for (size_t half = 0; half < 8; half += 4) {
      __m128i any = _mm_setzero_si128();
      for (size_t i = 0; i < 3; ++i) {
        const auto* const lanes = reinterpret_cast<const __m128i*>(&others.corners[i][half]);
        const __m128i four = _mm_load_si128(lanes);
        for (size_t k = 0; k < 3; ++k) {
          const __m128i vertex = _mm_set1_epi32(static_cast<int>(own[k]));
          any = _mm_or_si128(any, _mm_cmpeq_epi32(four, vertex));
        }
      }
      bits |= static_cast<uint32_t>(_mm_movemask_ps(_mm_castsi128_ps(any))) << half;
    }
    return bits;
#else
    uint32_t bits = 0;
    for (uint32_t lane = 0; lane < 8; ++lane) {
      bool any = false;
      for (size_t i = 0; i < 3; ++i) {
        for (size_t k = 0; k < 3; ++k) any = any | (others.corners[i][lane] == own[k]);
      }
      bits |= static_cast<uint32_t>(any) << lane;
    }
    return bits;
#endif
  }

  /// Of the triangles at places 8 group .. 8 group + 7, as bits, those of `hits` that certainly
  /// have no point in common with the one at `place`; none if they are not long.
  [[nodiscard]] uint32_t plainly_apart(uint32_t place, uint32_t group, uint32_t hits) const {
    return slabs_.empty() ? 0 : slabs_[group].apart(slabs_[place / 8], place % 8, hits);
  }

  /// True only when two faces are triangles that meet nowhere but in corners and edges that both
  /// have. False says nothing.
  [[nodiscard]] bool apart(uint32_t f, uint32_t g) const;

 private:
  /// The corners of eight triangles.
  struct alignas(16) Group {
    std::array<std::array<uint32_t, 8>, 3> corners;
  };

  [[nodiscard]] bool is_triangle(uint32_t f) const {
    return leaf_.face_starts[f + 1] - leaf_.face_starts[f] == 3;
  }

  void make_slabs();

  const LeafGeometry& leaf_;
  RawVector<Group> corners_;                   ///< by place; lanes without a triangle hold kNone
  RawVector<std::array<uint32_t, 3>> spread_;  ///< by place: corners that are spread, else kOther
  RawVector<EightSlabs> slabs_;                ///< by group; none if they are not long
};

}  // namespace csgrun
