#include "engine/mesh/eight_slabs.h"

#include <cstddef>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace csgrun {
namespace {

using Four = float __attribute__((vector_size(16)));

Four all(float x) { return Four{x, x, x, x}; }
Four lesser(Four a, Four b) { return a < b ? a : b; }
Four greater(Four a, Four b) { return a > b ? a : b; }
Four magnitude(Four a) { return greater(a, -a); }

/// A bit for each of four where a > b or c < d.
uint32_t either(Four a, Four b, Four c, Four d) {
  const auto any = (a > b) | (c < d);
#if defined(__SSE2__)
  return static_cast<uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(any)));
#else
  uint32_t bits = 0;
  for (uint32_t i = 0; i < 4; ++i) bits |= static_cast<uint32_t>(any[i] != 0) << i;
  return bits;
#endif
}

}  // namespace

// Any direction serves, as long as it is the same for all corners. A place along it is off by
// u = 2^-24 of the reach times the sum of its parts for each of: rounding the points, the three
// products, and the two sums. That is 4 u for a corner of either triangle, and u each for a
// bound and for the slack itself: less than 16 u. Parts of normals are below 2^61, of directions
// across sides below 2^92, places below 2^123: floats reach further.
EightSlabs::EightSlabs(const Corners& corners, uint32_t lanes, double reach) : lanes_(lanes) {
  const Four unit_slack = all(static_cast<float>(0x1p-20 * reach));
  for (size_t half = 0; half < kHalves; ++half) {
    std::array<std::array<Four, 3>, 3> at;  // [corner][axis]
    for (size_t i = 0; i < 3; ++i) {
      for (size_t k = 0; k < 3; ++k) {
        std::memcpy(&at[i][k], &corners[i][k][4 * half], sizeof(Four));
        corners_[i][k][half] = at[i][k];
      }
    }
    const auto side = [&](size_t i) {
      const std::array<Four, 3>&from = at[i], &to = at[i < 2 ? i + 1 : 0];
      return std::array<Four, 3>{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    };
    const auto cross = [](const std::array<Four, 3>& a, const std::array<Four, 3>& b) {
      return std::array<Four, 3>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                 a[0] * b[1] - a[1] * b[0]};
    };
    const std::array<Four, 3> normal = cross(side(0), side(1));
    for (size_t s = 0; s < slabs_.size(); ++s) {
      const std::array<Four, 3> way = s < 3 ? cross(side(s), normal) : normal;
      Slab& slab = slabs_[s];
      for (size_t k = 0; k < 3; ++k) slab.along[k][half] = way[k];
      Four least{}, most{};
      for (size_t i = 0; i < 3; ++i) {
        const Four place = at[i][0] * way[0] + at[i][1] * way[1] + at[i][2] * way[2];
        least = i == 0 ? place : lesser(least, place);
        most = i == 0 ? place : greater(most, place);
      }
      const Four slack = unit_slack * (magnitude(way[0]) + magnitude(way[1]) + magnitude(way[2]));
      slab.lo[half] = least - slack;
      slab.hi[half] = most + slack;
    }
  }
}

uint32_t EightSlabs::apart(const EightSlabs& others, uint32_t lane, uint32_t which) const {
  which &= lanes_;
  if ((others.lanes_ >> lane & 1) == 0) return 0;
  const size_t from = lane / 4, in = lane % 4;
  const auto of_one = [&](const Eight& numbers) { return all(numbers[from][in]); };
  uint32_t found = 0;
  for (size_t half = 0; half < kHalves; ++half) {
    uint32_t left = which >> 4 * half & 0xf;
    for (size_t s = 0; s < slabs_.size() && left != 0; ++s) {
      // The one's slab and the corners of four, the slabs of the four and the one's corners.
      const Slab &ones = others.slabs_[s], &fours = slabs_[s];
      Four least{}, most{}, least_of_one{}, most_of_one{};
      for (size_t i = 0; i < 3; ++i) {
        Four place{}, place_of_one{};
        for (size_t k = 0; k < 3; ++k) {
          place += corners_[i][k][half] * of_one(ones.along[k]);
          place_of_one += of_one(others.corners_[i][k]) * fours.along[k][half];
        }
        least = i == 0 ? place : lesser(least, place);
        most = i == 0 ? place : greater(most, place);
        least_of_one = i == 0 ? place_of_one : lesser(least_of_one, place_of_one);
        most_of_one = i == 0 ? place_of_one : greater(most_of_one, place_of_one);
      }
      left &= ~either(least, of_one(ones.hi), most, of_one(ones.lo));
      left &= ~either(least_of_one, fours.hi[half], most_of_one, fours.lo[half]);
    }
    found |= (which & ~(left << 4 * half)) & 0xfu << 4 * half;
  }
  return found;
}

}  // namespace csgrun
