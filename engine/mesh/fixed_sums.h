// Sums over a closed triangle mesh in fixed point, with a bound of what the cut digits may amount
// to.
//
// Coordinates are cut to F = 64 K fractional bits: each point moves by less than e = 2^-F along
// each axis, as one, so the surface stays closed. To first order the volume then changes by the
// integral of that motion over the surface, at most sqrt(3) e times its area A, and the integral of
// x over the volume by at most M as much again, where |x| <= M. What is of second order in e is
// bounded for each triangle by itself. Points are taken relative to one grid point nearby, so that
// M is the extent of the mesh.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <span>
#include <vector>

#include "engine/exact/plane.h"
#include "engine/exact/point.h"
#include "engine/mesh/fixed_quotients.h"
#include "engine/mesh/leading_bits.h"
#include "engine/mesh/measure.h"
#include "engine/mesh/natural.h"

namespace csgrun {

using TriangleSpan = std::span<const std::array<uint32_t, 3>>;
using PointAccess = std::function<Point(uint32_t)>;

constexpr int kTriangleBits = 32;  ///< of the number of triangles

inline const Int<kPointLimbs>& coordinate(const Point& p, int axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

/// a * b, all of it. Without branches: the signs of coordinates are as good as random.
template <int A, int B>
Int<A + B> full_product(const Int<A>& a, const Int<B>& b) {
  Int<A + B> r;
  for (int i = 0; i < A; ++i) {
    uint64_t carry = 0;
    for (int j = 0; j < B; ++j) {
      const UInt128 t = static_cast<UInt128>(a.limb[i]) * b.limb[j] + r.limb[i + j] + carry;
      r.limb[i + j] = static_cast<uint64_t>(t);
      carry = static_cast<uint64_t>(t >> 64);
    }
    r.limb[i + B] = carry;
  }
  // As unsigned limbs a negative number reads 2^(64 size) too large: the excess is taken off again.
  const auto take_off = [&r](const auto& factor, int from, bool negative) {
    const uint64_t mask = -static_cast<uint64_t>(negative);
    unsigned char borrow = 0;
    for (int i = from; i < A + B; ++i) {
      r.limb[i] = subtract_borrow(r.limb[i], factor.limb[i - from] & mask, borrow);
    }
  };
  take_off(b, A, a.negative());
  take_off(a, B, b.negative());
  return r;
}

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

/// Coordinates that are whole and less than 2^29 from the origin, or kFar.
using Near = std::array<int64_t, 3>;
constexpr int64_t kNearLimit = int64_t{1} << 29;
constexpr int64_t kFar = INT64_MAX;

/// Twice the area vector of a triangle of near points. Differences have 30 bits, so it has 61.
inline std::array<int64_t, 3> normal_of(const Near& a, const Near& b, const Near& c) {
  std::array<int64_t, 3> n{};
  for (size_t k = 0; k < 3; ++k) {
    const size_t i = (k + 1) % 3, j = (k + 2) % 3;
    n[k] = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
  }
  return n;
}

/// The sums over triangles of near points: with fewer digits, and no less exact.
class WholeSums {
 public:
  /// Adds det(a, b, c) and, if these are wanted, its moments; returns twice the area.
  template <bool kMoments>
  DoubleDouble add(const Near& a, const Near& b, const Near& c) {
    Int128 determinant = 0;
    DoubleDouble squares;
    const auto n = normal_of(a, b, c);
    for (int k = 0; k < 3; ++k) {
      determinant += static_cast<Int128>(n[k]) * a[k];
      const auto rounded = static_cast<double>(n[k]);
      const DoubleDouble component{rounded,
                                   static_cast<double>(n[k] - static_cast<int64_t>(rounded))};
      squares = squares + component * component;
    }
    six_volumes_ += determinant;
    if (!kMoments) return sqrt(squares);
    const auto high = static_cast<int64_t>(determinant >> kSplit);
    const auto low = static_cast<int64_t>(determinant & ((int64_t{1} << kSplit) - 1));
    for (int k = 0; k < 3; ++k) {
      const int64_t sum = a[k] + b[k] + c[k];
      high_moments_[k] += static_cast<Int128>(high) * sum;
      low_moments_[k] += static_cast<Int128>(low) * sum;
    }
    return sqrt(squares);
  }

  template <class Volume>
  [[nodiscard]] Volume six_volumes() const {
    return Volume::from(Int<2>::from_int128(six_volumes_));
  }
  template <class Moment>
  [[nodiscard]] Moment moment(int axis) const {
    return Moment::from(Int<2>::from_int128(high_moments_[axis])).shifted_left(kSplit) +
           Moment::from(Int<2>::from_int128(low_moments_[axis]));
  }

 private:
  // A determinant has less than 93 bits, a sum of coordinates 31, a number of triangles 32.
  static constexpr int kSplit = 48;
  Int128 six_volumes_ = 0;
  std::array<Int128, 3> high_moments_{}, low_moments_{};
};

template <int K>
class FixedRound {
 public:
  FixedRound(const PointAccess& point, TriangleSpan triangles, const std::vector<bool>& used,
             const std::array<int64_t, 3>& origin, Wanted wanted)
      : triangles_(triangles), wanted_(wanted) {
    points_.resize(used.size());
    cut_.resize(used.size());
    near_.resize(used.size(), {kFar, kFar, kFar});
    for (uint32_t v = 0; v < used.size(); ++v) {
      if (used[v]) in_range_ = in_range_ && take(v, point(v), origin);
    }
  }

  [[nodiscard]] bool in_range() const { return in_range_; }

  [[nodiscard]] Sums sums() const {
    if (wanted_ == Wanted::kVolume) return volume();
    return wanted_ == Wanted::kAll ? all<true>() : all<false>();
  }

 private:
  using Fixed = Int<K + 1>;
  using Coordinates = std::array<Fixed, 3>;
  using Volume = Int<3 * K + 3>;
  using Moment = Int<4 * K + 4>;
  static_assert(kCoordinateBits + 64 * K + 2 < 64 * (K + 1), "a sum of three coordinates");
  static_assert(3 * (kCoordinateBits + 64 * K) + 3 + kTriangleBits < 64 * (3 * K + 3));
  static_assert(4 * (kCoordinateBits + 64 * K) + 5 + kTriangleBits < 64 * (4 * K + 4));

  template <bool kMoments>
  [[nodiscard]] Sums all() const {
    Sums result;
    result.fraction_bits = 64 * K;
    Volume six_volumes;
    std::array<Moment, 3> moments;
    uint64_t cut_triangles = 0;
    WholeSums whole;
    for (const auto& t : triangles_) {
      const Near &p = near_[t[0]], &q = near_[t[1]], &r = near_[t[2]];
      if (p[0] != kFar && q[0] != kFar && r[0] != kFar) {
        result.twice_area = result.twice_area + whole.template add<kMoments>(p, q, r);
        continue;
      }
      const Coordinates &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
      cut_triangles += cut_[t[0]] | cut_[t[1]] | cut_[t[2]];
      // det(a, b, c) is a . n, and |n| twice the area.
      Volume determinant;
      DoubleDouble squares;
      for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const Int<2 * K + 2> n =
            full_product(b[i] - a[i], c[j] - a[j]) - full_product(b[j] - a[j], c[i] - a[i]);
        determinant += full_product(n, a[k]);
        const DoubleDouble component = double_double(n, -2 * K);
        squares = squares + component * component;
      }
      six_volumes += determinant;
      for (int k = 0; kMoments && k < 3; ++k) {
        moments[k] += full_product(determinant, a[k] + b[k] + c[k]);
      }
      result.twice_area = result.twice_area + sqrt(squares);
    }
    six_volumes += whole.six_volumes<Volume>().shifted_left(3 * result.fraction_bits);
    for (int k = 0; kMoments && k < 3; ++k) {
      moments[k] += whole.moment<Moment>(k).shifted_left(4 * result.fraction_bits);
    }
    result.six_volumes.value = signed_value(six_volumes);
    for (int k = 0; k < 3; ++k) result.moments[k].value = signed_value(moments[k]);
    if (cut_triangles > 0) bound_errors(cut_triangles, result);
    return result;
  }

  [[nodiscard]] Sums volume() const {
    Sums result;
    result.fraction_bits = 64 * K;
    Volume six_volumes;
    uint64_t cut_triangles = 0;
    Int128 whole = 0;
    double twice_area = 0;  // by the sum of a normal's coordinates, which is no less
    for (const auto& t : triangles_) {
      const Near &p = near_[t[0]], &q = near_[t[1]], &r = near_[t[2]];
      if (p[0] != kFar && q[0] != kFar && r[0] != kFar) {
        const auto n = normal_of(p, q, r);
        for (int k = 0; k < 3; ++k) {
          whole += static_cast<Int128>(n[k]) * p[k];
          twice_area += std::fabs(static_cast<double>(n[k]));
        }
        continue;
      }
      const Coordinates &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
      cut_triangles += cut_[t[0]] | cut_[t[1]] | cut_[t[2]];
      for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const Int<2 * K + 2> n =
            full_product(b[i] - a[i], c[j] - a[j]) - full_product(b[j] - a[j], c[i] - a[i]);
        six_volumes += full_product(n, a[k]);
        twice_area += std::fabs(double_double(n, -2 * K).hi);
      }
    }
    six_volumes += Volume::from(Int<2>::from_int128(whole)).shifted_left(3 * result.fraction_bits);
    result.six_volumes.value = signed_value(six_volumes);
    // Far more than what rounding may have taken from it.
    result.twice_area.hi = twice_area * (1 + 0x1p-16);
    if (cut_triangles > 0) bound_errors(cut_triangles, result);
    return result;
  }

  bool take(uint32_t v, const Point& p, const std::array<int64_t, 3>& origin) {
    bool cut = false;
    const bool whole = p.w_bits == 1 && p.xyz_bits < kCoordinateBits - 1;
    const FixedQuotients<K> over_w(p.w);
    Near near{};
    bool is_near = whole;
    for (int k = 0; k < 3; ++k) {
      Fixed x;
      if (whole) {
        const auto c = static_cast<int64_t>(coordinate(p, k).limb[0]);
        near[k] = c - origin[k];
        is_near = is_near && std::abs(near[k]) < kNearLimit;
        x = Fixed(c).shifted_left(64 * K);
      } else if (!over_w.divide(coordinate(p, k), x, cut)) {
        return false;
      }
      x -= Fixed(origin[k]).shifted_left(64 * K);
      const Fixed m = x.magnitude();
      if (compare(extent_, m) < 0) extent_ = m;
      points_[v][k] = x;
    }
    cut_[v] = cut;
    if (is_near) near_[v] = near;
    return true;
  }

  /// Errors in units of the sums; one unit of 2^-F is the cut, M and the area stand in such units.
  void bound_errors(uint64_t cut_triangles, Sums& sums) const {
    const Natural extent = natural(extent_ + Fixed(1));
    const Natural twice_area = in_units(sums.twice_area.hi);
    const Natural count = natural(static_cast<UInt128>(cut_triangles));
    // 6 sqrt(3) A < 6 (2 A). Two corners of a determinant moved: three pairs, six products each.
    sums.six_volumes.error =
        add(multiply(natural(6), twice_area), multiply(multiply(natural(24), count), extent));
    // 24 M sqrt(3) A < 24 M (2 A); two of four factors moved, or more: less than 256 M^2.
    for (Sum& moment : sums.moments) {
      moment.error = add(multiply(multiply(natural(24), extent), twice_area),
                         multiply(multiply(natural(256), count), multiply(extent, extent)));
    }
    // The area itself: an edge is wrong by less than 2 units, twice an area by less than 16 M.
    const double largest = std::ldexp(to_double(extent_ + Fixed(1)), -64 * K);
    sums.twice_area_error = std::ldexp(16 * largest * static_cast<double>(cut_triangles), -64 * K);
  }

  /// An area of x steps^2 in units of 2^-2F, a little enlarged.
  static Natural in_units(double x) {
    int exponent = 0;
    const double m = std::frexp(x, &exponent);
    const Natural leading = natural(static_cast<UInt128>(std::ldexp(m, 53)) + 2);
    const int shift = exponent - 53 + 128 * K;
    return shift >= 0 ? shift_left(leading, shift) : leading;
  }

  TriangleSpan triangles_;
  Wanted wanted_;
  std::vector<Coordinates> points_;
  std::vector<uint8_t> cut_;
  std::vector<Near> near_;
  Fixed extent_;  ///< the largest magnitude
  bool in_range_ = true;
};

}  // namespace csgrun
