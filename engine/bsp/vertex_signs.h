// Orientation of four vertices of a job, without planes: a filter on doubles, then 128-bit
// integers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/bsp/job.h"
#include "engine/exact/fixed_int.h"

namespace csgrun {

/// A sign that could not be told.
constexpr int kUnsure = 2;

class VertexSigns {
 public:
  /// `whole_results`: of an operand in pieces, those that the job does not have are asked about,
  /// too.
  VertexSigns(const Job& job, bool whole_results);

  /// How far the coordinates that the job has for an operand's vertices may be from the true ones;
  /// 0 for those on the grid.
  [[nodiscard]] double error(uint32_t operand) const { return errors_[operand]; }

  /// The sign of det(b - a, c - a, d - a): +1 when d is on the side of a b c from which they run
  /// counter-clockwise. `error` bounds the error of each coordinate. kUnsure only when that is not
  /// 0 or coordinates are 2^40 steps apart.
  ///
  /// Error bound of the determinant: with exact coordinates 5.2e-15 X Y Z, for X, Y, Z the largest
  /// differences along the axes (Shewchuk's bound with these put in). An error of 2 e in each
  /// difference changes it by less than 44 e M^2 for M the largest and e < M / 10; for greater e
  /// the bound exceeds 6 M^3, and nothing is decided.
  [[nodiscard]] int orient(const std::array<double, 3>& a, const std::array<double, 3>& b,
                           const std::array<double, 3>& c, const std::array<double, 3>& d,
                           double error) {
    const double bx = b[0] - a[0], by = b[1] - a[1], bz = b[2] - a[2];
    const double cx = c[0] - a[0], cy = c[1] - a[1], cz = c[2] - a[2];
    const double dx = d[0] - a[0], dy = d[1] - a[1], dz = d[2] - a[2];
    const double det =
        bx * (cy * dz - cz * dy) - by * (cx * dz - cz * dx) + bz * (cx * dy - cy * dx);
    const double x = std::max({std::fabs(bx), std::fabs(cx), std::fabs(dx)});
    const double y = std::max({std::fabs(by), std::fabs(cy), std::fabs(dy)});
    const double z = std::max({std::fabs(bz), std::fabs(cz), std::fabs(dz)});
    const double most = std::max({x, y, z});
    const double bound = 5.2e-15 * x * y * z + 64 * error * most * most;
    ++filtered;
    if (det > bound) return 1;
    if (det < -bound) return -1;
    if (error > 0 || most >= 0x1p40) return kUnsure;
    --filtered;
    ++exact;
    const auto whole = [](double v) { return static_cast<Int128>(static_cast<int64_t>(v)); };
    const Int128 value = whole(bx) * (whole(cy) * whole(dz) - whole(cz) * whole(dy)) -
                         whole(by) * (whole(cx) * whole(dz) - whole(cz) * whole(dx)) +
                         whole(bz) * (whole(cx) * whole(dy) - whole(cy) * whole(dx));
    return value > 0 ? 1 : value < 0 ? -1 : 0;
  }

  uint64_t filtered = 0, exact = 0;  ///< how often either decided

 private:
  std::vector<double> errors_;
};

}  // namespace csgrun
