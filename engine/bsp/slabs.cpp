#include "engine/bsp/slabs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "engine/base/vec3d.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace csgrun {
namespace {

/// Four numbers, of which the processor takes all at once, and what comparing them gives.
using Four = float __attribute__((vector_size(16)));
using Lanes = int32_t __attribute__((vector_size(16)));
constexpr Four kZeros{0, 0, 0, 0}, kOnes{1, 1, 1, 1};

/// A bit for each lane that compared as true.
uint32_t bits_of(Lanes lanes) {
#if defined(__SSE2__)
  return static_cast<uint32_t>(_mm_movemask_ps(std::bit_cast<__m128>(lanes)));
#else
  uint32_t bits = 0;
  for (uint32_t lane = 0; lane < 4; ++lane)
    bits |= (static_cast<uint32_t>(lanes[lane]) & 1) << lane;
  return bits;
#endif
}

/// Where the corners of four of the triangles, from number `half` on, are along a direction.
std::array<Four, 3> along(const std::array<float, 3>& direction, const EightTriangles& others,
                          uint32_t half) {
  std::array<Four, 3> places{};
  for (size_t corner = 0; corner < 3; ++corner) {
    for (size_t k = 0; k < 3; ++k) {
      Four at;
      std::memcpy(&at, &others.at[corner][k][half], sizeof at);
      places[corner] += at * direction[k];
    }
  }
  return places;
}

}  // namespace

Slabs::Slabs(const std::array<Vec3d, 3>& corners, double reach) {
  // With u = 2^-24: rounding a point moves it by u of the reach along each axis, three products and
  // two sums add as much as that each, and so does a bound: below 16 u, as directions have
  // length 1.
  const double slack = 0x1p-19 * reach;
  // A place on a clipped side is off by five roundings of a difference of two places, below 4 times
  // the reach, and one of the sum: 22 u.
  slack_ = static_cast<float>(slack);
  const Vec3d normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
  for (size_t i = 0; i < slabs_.size(); ++i) {
    const Vec3d way = i == 0 ? normal : cross(minus(corners[i % 3], corners[i - 1]), normal);
    const double length = std::sqrt(dot(way, way));
    Slab& slab = slabs_[i];
    for (size_t k = 0; k < 3; ++k) slab.along[k] = static_cast<float>(way[k] / length);
    Vec3d place{};
    for (size_t c = 0; c < 3; ++c) {
      // Whatever direction that is: these are where the corners stand along it.
      for (size_t k = 0; k < 3; ++k) place[c] += double{slab.along[k]} * corners[c][k];
    }
    // Which is the least is chance: no branches on that.
    const double least = std::min(std::min(place[0], place[1]), place[2]),
                 most = std::max(std::max(place[0], place[1]), place[2]);
    slab.lo = static_cast<float>(least - slack);
    slab.hi = static_cast<float>(most + slack);
  }
}

// Where a direction is not a number, no comparison holds.
Slabs::Places Slabs::places(const Slab& slab, const EightTriangles& others, uint32_t which) {
  Places result;
  for (uint32_t half = 0; half < 8; half += 4) {
    if ((which >> half & 0xf) == 0) continue;
    const auto [a, b, c] = along(slab.along, others, half);
    const Lanes above = (a > slab.hi) & (b > slab.hi) & (c > slab.hi),
                below = (a < slab.lo) & (b < slab.lo) & (c < slab.lo),
                inside = (a >= slab.lo) & (b >= slab.lo) & (c >= slab.lo) & (a <= slab.hi) &
                         (b <= slab.hi) & (c <= slab.hi);
    result.beyond |= bits_of(above | below) << half;
    result.inside |= bits_of(inside) << half;
  }
  return result;
}

// The corners of a box that are the least and the most along a direction. Those that are not there
// give no number or an infinite one: whatever is said of them is not asked for.
uint32_t Slabs::beyond(const Slab& slab, const EightBoxes& boxes) {
  std::array<const std::array<float, 8>*, 3> least{}, most{};
  for (size_t k = 0; k < 3; ++k) {
    least[k] = &boxes.lo[k], most[k] = &boxes.hi[k];
    if (slab.along[k] < 0) std::swap(least[k], most[k]);
  }
  uint32_t bits = 0;
#if defined(__SSE2__)
  for (size_t half = 0; half < 8; half += 4) {
    const auto place = [&](const auto& corner) {
      __m128 sum = _mm_setzero_ps();
      for (size_t k = 0; k < 3; ++k) {
        const __m128 at = _mm_load_ps(corner[k]->data() + half);
        sum = _mm_add_ps(sum, _mm_mul_ps(at, _mm_set1_ps(slab.along[k])));
      }
      return sum;
    };
    const __m128 out = _mm_or_ps(_mm_cmpgt_ps(place(least), _mm_set1_ps(slab.hi)),
                                 _mm_cmplt_ps(place(most), _mm_set1_ps(slab.lo)));
    bits |= static_cast<uint32_t>(_mm_movemask_ps(out)) << half;
  }
#else
  for (uint32_t lane = 0; lane < 8; ++lane) {
    float from = 0, to = 0;
    for (size_t k = 0; k < 3; ++k) {
      from += (*least[k])[lane] * slab.along[k];
      to += (*most[k])[lane] * slab.along[k];
    }
    bits |= static_cast<uint32_t>((from > slab.hi) | (to < slab.lo)) << lane;
  }
#endif
  return bits;
}

uint32_t Slabs::apart(const EightBoxes& boxes, uint32_t which) const {
  uint32_t left = which;
  for (size_t i = 0; i < slabs_.size() && left != 0; ++i) left &= ~beyond(slabs_[i], boxes);
  return which & ~left;
}

uint32_t Slabs::beyond_sides(const EightTriangles& others, uint32_t which) const {
  uint32_t left = which;
  for (size_t i = 1; i < slabs_.size() && left != 0; ++i) {
    left &= ~places(slabs_[i], others, left).beyond;
  }
  return which & ~left;
}

uint32_t Slabs::beyond_where_clipped(const EightTriangles& others, uint32_t which) const {
  uint32_t bits = 0;
  for (uint32_t half = 0; half < 8; half += 4) {
    if ((which >> half & 0xf) == 0) continue;
    const std::array<Four, 3> heights = along(slabs_[0].along, others, half);
    const float lo = slabs_[0].lo, hi = slabs_[0].hi;
    // Of each side, from its first corner: where its part in the slab begins and ends, in either
    // order; all of it if it is level.
    std::array<Four, 3> begin{}, end{};
    std::array<Lanes, 3> has_none{};
    for (size_t i = 0; i < 3; ++i) {
      const Four a = heights[i], b = heights[(i + 1) % 3];
      begin[i] = (lo - a) / (b - a), end[i] = (hi - a) / (b - a);
      begin[i] = begin[i] > kZeros ? begin[i] : kZeros;  // 0 / 0 is no number
      begin[i] = begin[i] < kOnes ? begin[i] : kOnes;
      end[i] = end[i] < kOnes ? end[i] : kOnes;
      end[i] = end[i] > kZeros ? end[i] : kZeros;
      has_none[i] = ((a > hi) & (b > hi)) | ((a < lo) & (b < lo));
    }
    Lanes beyond{};
    for (size_t side = 1; side < slabs_.size(); ++side) {
      const std::array<Four, 3> at = along(slabs_[side].along, others, half);
      const float most = slabs_[side].hi + slack_, least = slabs_[side].lo - slack_;
      Lanes above = ~Lanes{}, below = ~Lanes{};
      for (size_t i = 0; i < 3; ++i) {
        const Four a = at[i], way = at[(i + 1) % 3] - a;
        const Four first = a + way * begin[i], last = a + way * end[i];
        above &= has_none[i] | ((first > most) & (last > most));
        below &= has_none[i] | ((first < least) & (last < least));
      }
      beyond |= above | below;
    }
    bits |= bits_of(beyond) << half;
  }
  return bits & which;
}

uint32_t Slabs::apart_in_space(const EightTriangles& others, uint32_t which) const {
  const Places along_normal = places(slabs_[0], others, which);
  uint32_t apart = which & along_normal.beyond;
  const uint32_t crossing = which & ~apart & ~along_normal.inside;
  apart |= beyond_sides(others, crossing);
  return apart | beyond_where_clipped(others, crossing & ~apart);
}

}  // namespace csgrun
