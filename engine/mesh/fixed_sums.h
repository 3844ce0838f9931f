// Sums over a triangle mesh in fixed point, with a bound of what the cut digits may amount to.
//
// With coordinates cut to F = 64 K fractional bits, the error of each is in [0, 2^-F), and that of
// the determinant of three points whose coordinates are at most M in magnitude is below
// 24 M^2 2^-F, that of its product with a sum of three coordinates below 128 M^3 2^-F. Only
// triangles with a corner that was really cut count. Points are taken relative to one grid point
// nearby, so that M is the extent of the mesh.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/exact/point.h"
#include "engine/mesh/double_double.h"
#include "engine/mesh/natural.h"

namespace csgrun {

using TriangleSpan = std::span<const std::array<uint32_t, 3>>;
using PointAccess = std::function<Point(uint32_t)>;

constexpr int kCoordinateBits = 42;  ///< of a difference of two points, before the binary point
constexpr int kTriangleBits = 32;    ///< of the number of triangles

inline const Int<kPointLimbs>& coordinate(const Point& p, int axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

/// Whether x is w * 2^(64 K) times less than 2^kCoordinateBits, and then floor(x * 2^(64 K) / w);
/// `cut` is set when the quotient was not whole.
template <int K>
bool fixed_point(const Int<kPointLimbs>& x, const Int<kPointLimbs>& w, Int<K + 1>& result,
                 bool& cut) {
  const int w_bits = w.bit_width();
  const Int<kPointLimbs> m = x.magnitude();
  if (m.bit_width() - w_bits >= kCoordinateBits - 1) return false;
  const int lift = (64 - w_bits % 64) % 64;
  const auto n = static_cast<size_t>((w_bits + 63) / 64);
  const Int<kPointLimbs + 1> divisor = Int<kPointLimbs + 1>::from(w).shifted_left(lift);
  // |x| * 2^(64 K + lift), over which the quotient has at most K + 1 limbs.
  std::array<uint64_t, kPointLimbs + K + 2> dividend{};
  const Int<kPointLimbs + 1> lifted = Int<kPointLimbs + 1>::from(m).shifted_left(lift);
  std::copy(lifted.limb.begin(), lifted.limb.end(), dividend.begin() + K);
  std::array<uint64_t, K + 1> digits{};
  divide_normalised(std::span(dividend.data(), n + K + 1), std::span(divisor.limb.data(), n),
                    digits);
  for (int i = 0; i <= K; ++i) result.limb[i] = digits[i];
  const bool whole = std::all_of(dividend.begin(), dividend.begin() + static_cast<long>(n),
                                 [](uint64_t limb) { return limb == 0; });
  if (x.negative()) result = whole ? -result : -result - Int<K + 1>(1);
  cut = cut || !whole;
  return true;
}

/// An exact sum and how far the true value may be from it: value and error * 2^exponent.
struct Sum {
  Signed value;
  Natural error;
};

/// What is known of a mesh after a round.
struct Sums {
  int fraction_bits = 0;  ///< F
  Sum six_volumes;        ///< * 2^-3F
  /// Sum of the determinants times the sums of their points' coordinates, relative to the origin:
  /// 24 times the volume times the centroid, * 2^-4F.
  std::array<Sum, 3> moments;
  DoubleDouble twice_area;
  double twice_area_error = 0;  ///< steps^2
};

template <int K>
class FixedRound {
 public:
  FixedRound(const PointAccess& point, TriangleSpan triangles, const std::vector<bool>& used,
             const std::array<int64_t, 3>& origin)
      : triangles_(triangles) {
    points_.resize(used.size());
    cut_.resize(used.size());
    for (uint32_t v = 0; v < used.size(); ++v) {
      if (used[v]) in_range_ = in_range_ && add(v, point(v), origin);
    }
  }

  [[nodiscard]] bool in_range() const { return in_range_; }

  [[nodiscard]] Sums sums() const {
    Sums result;
    result.fraction_bits = 64 * K;
    Volume six_volumes;
    std::array<Moment, 3> moments;
    uint64_t cut_triangles = 0;
    for (const auto& t : triangles_) {
      const Coordinates &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
      cut_triangles += cut_[t[0]] || cut_[t[1]] || cut_[t[2]] ? 1 : 0;
      Volume determinant;
      for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        determinant += multiply<3 * K + 3>(
            multiply<2 * K + 2>(b[i], c[j]) - multiply<2 * K + 2>(b[j], c[i]), a[k]);
      }
      six_volumes += determinant;
      for (int k = 0; k < 3; ++k) {
        moments[k] += multiply<4 * K + 4>(determinant, a[k] + b[k] + c[k]);
      }
      result.twice_area = result.twice_area + twice_area(a, b, c);
    }
    // Errors in units of the sums: a cut is one unit of 2^-F, M stands in the same units.
    const Natural count = natural(static_cast<UInt128>(cut_triangles));
    const Natural extent = natural(extent_ + Int<K + 1>(1));
    const Natural square = multiply(extent, extent);
    result.six_volumes = {signed_value(six_volumes),
                          multiply(multiply(square, count), natural(24))};
    for (int k = 0; k < 3; ++k) {
      result.moments[k] = {signed_value(moments[k]),
                           multiply(multiply(multiply(square, extent), count), natural(128))};
    }
    // An edge vector is wrong by less than 2 units, so twice the area by less than 16 M units.
    const double largest = std::ldexp(to_double(extent_), -64 * K);
    result.twice_area_error =
        std::ldexp(16 * largest * static_cast<double>(cut_triangles), -64 * K);
    return result;
  }

 private:
  using Fixed = Int<K + 1>;
  using Coordinates = std::array<Fixed, 3>;
  using Volume = Int<3 * K + 3>;
  using Moment = Int<4 * K + 4>;
  static_assert(kCoordinateBits + 64 * K + 2 < 64 * (K + 1), "a sum of three coordinates");
  static_assert(3 * (kCoordinateBits + 64 * K) + 3 + kTriangleBits < 64 * (3 * K + 3));
  static_assert(4 * (kCoordinateBits + 64 * K) + 5 + kTriangleBits < 64 * (4 * K + 4));

  bool add(uint32_t v, const Point& p, const std::array<int64_t, 3>& origin) {
    bool cut = false;
    for (int k = 0; k < 3; ++k) {
      Fixed x;
      if (!fixed_point<K>(coordinate(p, k), p.w, x, cut)) return false;
      x -= Fixed(origin[k]).shifted_left(64 * K);
      const Fixed m = x.magnitude();
      if (compare(extent_, m) < 0) extent_ = m;
      points_[v][k] = x;
    }
    cut_[v] = cut;
    return true;
  }

  static DoubleDouble twice_area(const Coordinates& a, const Coordinates& b, const Coordinates& c) {
    DoubleDouble squares;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const Int<2 * K + 2> cross = multiply<2 * K + 2>(b[i] - a[i], c[j] - a[j]) -
                                   multiply<2 * K + 2>(b[j] - a[j], c[i] - a[i]);
      const DoubleDouble component = double_double(cross, -128 * K);
      squares = squares + component * component;
    }
    return squares.square_root();
  }

  TriangleSpan triangles_;
  std::vector<Coordinates> points_;
  std::vector<bool> cut_;
  Fixed extent_;  ///< the largest magnitude
  bool in_range_ = true;
};

}  // namespace csgrun
