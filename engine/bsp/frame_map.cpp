#include "engine/bsp/frame_map.h"

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
}

Point FrameMap::point(const IVec3& q) const {
  if (frame_.is_identity) return grid_point(q[0], q[1], q[2]);
  Point p;
  const auto coordinate = [&](int i) {
    Int<kPointLimbs> sum;
    for (int j = 0; j < 3; ++j) sum += multiply<kPointLimbs>(adjugate_[i][j], Int<1>(q[j]));
    return sum.shifted_left(Frame::kShift);
  };
  p.x = coordinate(0), p.y = coordinate(1), p.z = coordinate(2);
  p.w = Int<kPointLimbs>::from(determinant_);
  normalise(p);
  return p;
}

/// C^T n and 2^k d.
Plane FrameMap::plane(const Plane& p) const {
  if (frame_.is_identity) return p;
  const auto& m = frame_.matrix;
  const auto row = [&](int j) { return p.a * m[0][j] + p.b * m[1][j] + p.c * m[2][j]; };
  return {row(0), row(1), row(2), p.d << Frame::kShift};
}

}  // namespace csgrun
