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

  using Position = std::array<double, 3>;
  /// What the filter needs of three vertices.
  struct Base {
    Position origin, normal;
    Position reach;  ///< how far the others are from the first one along each axis, at most
  };
  static Base base(const Position& a, const Position& b, const Position& c) {
    const double bx = b[0] - a[0], by = b[1] - a[1], bz = b[2] - a[2];
    const double cx = c[0] - a[0], cy = c[1] - a[1], cz = c[2] - a[2];
    return {a,
            {by * cz - bz * cy, bz * cx - bx * cz, bx * cy - by * cx},
            {std::max(std::fabs(bx), std::fabs(cx)), std::max(std::fabs(by), std::fabs(cy)),
             std::max(std::fabs(bz), std::fabs(cz))}};
  }

  /// The sign of det(b - a, c - a, d - a): +1 when d is on the side of a b c from which they run
  /// counter-clockwise. `error` bounds the error of each coordinate. kUnsure only when that is not
  /// 0 or coordinates are 2^40 steps apart.
  [[nodiscard]] int orient(const Position& a, const Position& b, const Position& c,
                           const Position& d, double error) {
    if (const int sign = filter(base(a, b, c), d, error)) return sign;
    Position u{}, v{}, w{};
    double most = 0;
    for (size_t k = 0; k < 3; ++k) {
      u[k] = b[k] - a[k], v[k] = c[k] - a[k], w[k] = d[k] - a[k];
      most = std::max({most, std::fabs(u[k]), std::fabs(v[k]), std::fabs(w[k])});
    }
    if (error > 0 || most >= 0x1p40) {
      ++filtered;
      return kUnsure;
    }
    ++exact;
    const auto whole = [](double x) { return static_cast<Int128>(static_cast<int64_t>(x)); };
    const Int128 value = whole(u[0]) * (whole(v[1]) * whole(w[2]) - whole(v[2]) * whole(w[1])) -
                         whole(u[1]) * (whole(v[0]) * whole(w[2]) - whole(v[2]) * whole(w[0])) +
                         whole(u[2]) * (whole(v[0]) * whole(w[1]) - whole(v[1]) * whole(w[0]));
    return value > 0 ? 1 : value < 0 ? -1 : 0;
  }
  /// The same, or 0 if doubles do not tell.
  ///
  /// Error bound of the determinant: with exact coordinates 5.2e-15 X Y Z, for X, Y, Z the largest
  /// differences along the axes (Shewchuk's bound with these put in). An error of 2 e in each
  /// difference changes it by less than 44 e M^2 for M the largest and e < M / 10; for greater e
  /// the bound exceeds 6 M^3, and nothing is decided.
  [[nodiscard]] int filter(const Base& base, const Position& d, double error) {
    const double dx = d[0] - base.origin[0], dy = d[1] - base.origin[1], dz = d[2] - base.origin[2];
    const double det = dx * base.normal[0] + dy * base.normal[1] + dz * base.normal[2];
    const double x = std::max(base.reach[0], std::fabs(dx)),
                 y = std::max(base.reach[1], std::fabs(dy)),
                 z = std::max(base.reach[2], std::fabs(dz));
    const double most = std::max({x, y, z});
    const double bound = 5.2e-15 * x * y * z + 64 * error * most * most;
    if (!(std::fabs(det) > bound)) return 0;
    ++filtered;
    return det > 0 ? 1 : -1;
  }

  /// Points whose coordinates are so far from those of the middle, at most, but for a rounding.
  struct Box {
    Position middle, reach;
  };
  /// That of all points of a box, or 0 if they are not all told to have the same.
  ///
  /// Seen exactly, the determinant of a point with the normal that was computed is off that of the
  /// middle by the normal times `reach` at most. What the normal's rounding does to it is in the
  /// bound of filter(); each of the two sums, of less than 6 X Y Z in all, is off by 5 u of that
  /// with u = 2^-53, and the box by 2 u of its reach: 1.4e-14 X Y Z together.
  [[nodiscard]] int filter(const Base& base, const Box& box, double error) {
    double det = 0, spread = 0, most = 0, volume = 1;
    for (size_t k = 0; k < 3; ++k) {
      const double d = box.middle[k] - base.origin[k];
      det += d * base.normal[k];
      spread += std::fabs(base.normal[k]) * box.reach[k];
      const double extent = std::max(base.reach[k], std::fabs(d) + box.reach[k]);
      most = std::max(most, extent);
      volume *= extent;
    }
    const double bound = 2e-14 * volume + 64 * error * most * most;
    if (!(std::fabs(det) - spread > bound)) return 0;
    ++filtered;
    return det > 0 ? 1 : -1;
  }

  uint64_t filtered = 0, exact = 0;  ///< how often either decided

 private:
  std::vector<double> errors_;
};

}  // namespace csgrun
