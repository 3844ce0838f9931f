#include "engine/bsp/frame_map.h"

#include <algorithm>

#include "engine/exact/widths.h"

namespace csgrun {
namespace {

std::array<std::array<Int<2>, 3>, 3> adjugate_of(const std::array<std::array<int64_t, 3>, 3>& m) {
  std::array<std::array<Int<2>, 3>, 3> r;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      r[i][j] = Int<2>::from_int128(static_cast<Int128>(m[a][c]) * m[b][d] -
                                    static_cast<Int128>(m[a][d]) * m[b][c]);
    }
  }
  return r;
}

}  // namespace

FrameMap::FrameMap(const Frame& frame) : frame_(frame) {
  if (frame.is_identity) return;
  adjugate_ = adjugate_of(frame.matrix);
  determinant_ = Int<4>();
  for (int j = 0; j < 3; ++j) {
    determinant_ += multiply<4>(Int<2>(frame.matrix[0][j]), adjugate_[j][0]);
  }
  weight_ = Int<kPointLimbs>::from(determinant_.magnitude());
  weight_bits_ = weight_.bit_width();
}

Point FrameMap::point(const IVec3& q) const {
  if (frame_.is_identity) return grid_point(q[0], q[1], q[2]);
  // An entry of the adjugate has up to 113 bits: products of its limbs fit 128.
  constexpr int kCoordinate = 2 * widths::kFrame + 1 + widths::kFarGrid + 2 + Frame::kShift;
  static_assert(kCoordinate < 255 && widths::kFarGrid + 64 + 2 < 127);
  const bool flip = is_mirrored();
  const auto coordinate = [&](int i) {
    Int128 low = 0, high = 0;  // of high 2^64 + low
    for (int j = 0; j < 3; ++j) {
      const Int128 factor = flip ? -q[j] : q[j];
      low += factor * adjugate_[i][j].limb[0];
      high += factor * static_cast<int64_t>(adjugate_[i][j].limb[1]);
    }
    high += low >> 64;
    Int<4> sum;
    sum.limb = {static_cast<uint64_t>(low), static_cast<uint64_t>(high),
                static_cast<uint64_t>(high >> 64), static_cast<uint64_t>(high >> 127)};
    return sum.shifted_left(Frame::kShift);
  };
  const Int<4> x = coordinate(0), y = coordinate(1), z = coordinate(2);
  using Coordinate = Int<kPointLimbs>;
  return {Coordinate::from(x),
          Coordinate::from(y),
          Coordinate::from(z),
          weight_,
          std::max({x.bit_width(), y.bit_width(), z.bit_width()}),
          weight_bits_};
}

/// C^T n and 2^k d.
Plane FrameMap::plane(const Plane& p) const {
  if (frame_.is_identity) return p;
  const auto& m = frame_.matrix;
  const auto row = [&](int j) { return p.a * m[0][j] + p.b * m[1][j] + p.c * m[2][j]; };
  return {row(0), row(1), row(2), p.d << Frame::kShift};
}

}  // namespace csgrun
