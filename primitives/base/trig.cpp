// Sine and cosine of degrees in integer fixed point, so that every machine gives the same bits.
//
// (1) The argument is reduced exactly: fmod by 360, then r - 90 q, which Sterbenz's lemma makes
// exact
//     for q > 0; what remains lies in [-45, 45] degrees.
// (2) The Taylor series is summed with N 64-bit limbs after the point. Each operation truncates;
// the
//     error of the whole is below 2^8 units of the last limb (coefficients, powers and products
//     lose at most one unit each, and each Horner step multiplies what was lost by at most 0.62).
// (3) The result is rounded once. The value is an algebraic number that is rational only for 0, 1/2
//     and 1 (Niven), so it is never half way between two doubles. With N = 2 the rounding is
//     certain unless the tail lies within 2^-57 of half way; then the sum is repeated with N = 4.
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include <csgrun/primitives/trig.h>

namespace csgrun {
namespace {

using uint128 = unsigned __int128;

/// A fraction in [0, 1) of N limbs, the least significant first.
template <int N>
using Fraction = std::array<uint64_t, N>;

/// pi / 180 * 32 = 0.5585..., truncated to 256 bits.
constexpr Fraction<4> kRadiansTimes32 = {0xe502a9b4c94c8512u, 0x00b7aef501b5e6b8u,
                                         0x0ec5f66e9485c4d9u, 0x8efa351294e9c8aeu};

template <int N>
constexpr Fraction<N> top_limbs(const Fraction<4>& x) {
  Fraction<N> r{};
  for (int i = 0; i < N; ++i) r[i] = x[4 - N + i];
  return r;
}

/// The high half of the product.
template <int N>
Fraction<N> multiply(const Fraction<N>& a, const Fraction<N>& b) {
  std::array<uint64_t, 2 * N> product{};
  for (int i = 0; i < N; ++i) {
    uint64_t carry = 0;
    for (int j = 0; j < N; ++j) {
      const uint128 t = static_cast<uint128>(a[i]) * b[j] + product[i + j] + carry;
      product[i + j] = static_cast<uint64_t>(t);
      carry = static_cast<uint64_t>(t >> 64);
    }
    product[i + N] = carry;
  }
  Fraction<N> r{};
  for (int i = 0; i < N; ++i) r[i] = product[N + i];
  return r;
}

/// a - b for b <= a.
template <int N>
Fraction<N> subtract(const Fraction<N>& a, const Fraction<N>& b) {
  Fraction<N> r{};
  uint64_t borrow = 0;
  for (int i = 0; i < N; ++i) {
    const uint128 t = static_cast<uint128>(a[i]) - b[i] - borrow;
    r[i] = static_cast<uint64_t>(t);
    borrow = static_cast<uint64_t>(t >> 64) != 0 ? 1 : 0;
  }
  return r;
}

/// 1 - a, less one unit of the last limb.
template <int N>
Fraction<N> complement(Fraction<N> a) {
  for (uint64_t& limb : a) limb = ~limb;
  return a;
}

template <int N>
Fraction<N> shift_left(const Fraction<N>& a, int bits) {
  Fraction<N> r{};
  const int limbs = bits / 64, rest = bits % 64;
  for (int i = N - 1; i >= limbs; --i) {
    r[i] = a[i - limbs] << rest;
    if (rest != 0 && i - limbs > 0) r[i] |= a[i - limbs - 1] >> (64 - rest);
  }
  return r;
}

template <int N>
Fraction<N> shift_right(const Fraction<N>& a, int bits) {
  Fraction<N> r{};
  if (bits >= 64 * N) return r;
  const int limbs = bits / 64, rest = bits % 64;
  for (int i = 0; i + limbs < N; ++i) {
    r[i] = a[i + limbs] >> rest;
    if (rest != 0 && i + limbs + 1 < N) r[i] |= a[i + limbs + 1] << (64 - rest);
  }
  return r;
}

/// Enough terms that the first one left out is below one unit of the last limb (u < 0.62).
template <int N>
constexpr int kTerms = N == 2 ? 17 : 30;

/// The coefficients 1/(2k+odd)! for k = 1, 2, ...
template <int N>
constexpr auto inverse_factorials(int odd) {
  std::array<Fraction<N>, kTerms<N>> table{};
  Fraction<N + 1> value{};  // one limb in front of the point
  value[N] = 1;
  int factor = 1;
  for (int k = 1; k <= kTerms<N>; ++k) {
    for (; factor <= 2 * k + odd; ++factor) {
      uint64_t remainder = 0;
      for (int i = N; i >= 0; --i) {
        const uint128 t = (static_cast<uint128>(remainder) << 64) | value[i];
        value[i] = static_cast<uint64_t>(t / factor);
        remainder = static_cast<uint64_t>(t % factor);
      }
    }
    for (int i = 0; i < N; ++i) table[k - 1][i] = value[i];
  }
  return table;
}

template <int N>
constexpr auto kSinCoefficients = inverse_factorials<N>(1);
template <int N>
constexpr auto kCosCoefficients = inverse_factorials<N>(0);

/// u (c1 - u (c2 - u (c3 - ...))).
template <int N>
Fraction<N> alternating_series(const Fraction<N>& u,
                               const std::array<Fraction<N>, kTerms<N>>& coefficients) {
  Fraction<N> sum = coefficients.back();
  for (int k = kTerms<N> - 2; k >= 0; --k) {
    sum = subtract<N>(coefficients[k], multiply<N>(u, sum));
  }
  return multiply<N>(u, sum);
}

/// The double nearest to 0.value * 2^exponent; nothing when that is not certain.
template <int N>
std::optional<double> round_to_double(Fraction<N> value, int exponent) {
  const int lead = __builtin_clzll(value[N - 1]);  // the caller's values are at least 1/8
  value = shift_left<N>(value, lead);
  exponent -= lead;
  constexpr int kMinExponent = std::numeric_limits<double>::min_exponent;
  const int bits = exponent >= kMinExponent ? 53 : 53 - (kMinExponent - exponent);
  if (bits < 0) return 0.0;
  uint64_t mantissa = bits == 0 ? 0 : value[N - 1] >> (64 - bits);
  const uint64_t tail = shift_left<N>(value, bits)[N - 1];
  constexpr uint64_t kHalf = uint64_t{1} << 63;
  if (N == 2 && tail - (kHalf - 64) <= 128) return std::nullopt;
  if (tail >= kHalf) ++mantissa;
  return std::ldexp(static_cast<double>(mantissa), exponent - bits);
}

/// sin (or cos) of `degrees` in [0, 45.01], correctly rounded.
template <int N>
std::optional<double> evaluate(double degrees, bool cosine) {
  int exponent = 0;
  const double mantissa = std::frexp(degrees, &exponent);  // in [1/2, 1)
  Fraction<N> f{};
  f[N - 1] = static_cast<uint64_t>(std::ldexp(mantissa, 64));
  const Fraction<N> y = multiply<N>(f, top_limbs<N>(kRadiansTimes32));
  const int shift = exponent - 5;  // radians = y * 2^shift; shift <= 1
  const Fraction<N> x = shift > 0 ? shift_left<N>(y, shift) : shift_right<N>(y, -shift);
  const Fraction<N> u = multiply<N>(x, x);
  if (cosine) {
    return round_to_double<N>(complement<N>(alternating_series<N>(u, kCosCoefficients<N>)), 0);
  }
  const Fraction<N> ratio = complement<N>(alternating_series<N>(u, kSinCoefficients<N>));
  return round_to_double<N>(multiply<N>(y, ratio), shift);
}

double first_octant(double degrees, bool cosine) {
  if (degrees == 0) return cosine ? 1.0 : 0.0;
  if (const auto quick = evaluate<2>(degrees, cosine)) return *quick;
  return *evaluate<4>(degrees, cosine);
}

double sin_shifted(double degrees, int quarter_turns) {
  if (!std::isfinite(degrees)) return std::numeric_limits<double>::quiet_NaN();
  const double r = std::fmod(std::fabs(degrees), 360.0);
  const int q = static_cast<int>(r / 90.0 + 0.5);
  double t = r - 90.0 * q;
  int turns = q;
  bool negative = false;
  if (quarter_turns == 0) {
    negative = degrees < 0;  // sin is odd, cos is even
  } else {
    turns += quarter_turns;
  }
  const bool cosine = (turns & 1) != 0;
  if ((turns & 2) != 0) negative = !negative;
  if (t < 0) {
    t = -t;
    if (!cosine) negative = !negative;
  }
  const double value = first_octant(t, cosine);
  return negative && value != 0 ? -value : value;
}

}  // namespace

double sin_deg(double degrees) { return sin_shifted(degrees, 0); }

double cos_deg(double degrees) { return sin_shifted(degrees, 1); }

double tan_deg(double degrees) { return sin_deg(degrees) / cos_deg(degrees); }

namespace {

/// The angle of (x, y), 0 <= y <= x, x > 0: two Newton steps on the correctly rounded sine and
/// cosine.
double angle_in_octant(double y, double x) {
  constexpr double kDegrees = 57.295779513082320877;
  const double a = y / x;
  double angle = a / (1 + 0.28 * a * a) * kDegrees;  // within 0.3 degrees
  const double length = std::sqrt(x * x + y * y);
  for (int i = 0; i < 2; ++i) {
    const double d = (y * cos_deg(angle) - x * sin_deg(angle)) / length;
    angle += (d + d * d * d / 6) * kDegrees;
  }
  return angle;
}

double angle_of(double y, double x) {
  const double ax = std::fabs(x), ay = std::fabs(y);
  double scale = std::fmax(ax, ay);
  if (scale == 0) return std::signbit(x) ? std::copysign(180.0, y) : std::copysign(0.0, y);
  if (std::isinf(scale)) {
    const double ix = std::isinf(ax) ? 1 : 0, iy = std::isinf(ay) ? 1 : 0;
    return angle_of(std::copysign(iy, y), std::copysign(ix, x));
  }
  // Scaled by a power of two, so that the squares neither overflow nor vanish.
  const int exponent = -std::ilogb(scale);
  const double sx = std::ldexp(ax, exponent), sy = std::ldexp(ay, exponent);
  double angle = sy <= sx ? angle_in_octant(sy, sx) : 90 - angle_in_octant(sx, sy);
  if (std::signbit(x)) angle = 180 - angle;
  return std::copysign(angle, y);
}

/// The nearest whole degree if `maps_back` says that it is the answer.
template <class F>
double snapped(double angle, F maps_back) {
  const double whole = std::round(angle);
  return maps_back(whole) ? whole : angle;
}

}  // namespace

double asin_deg(double x) {
  if (!(std::fabs(x) <= 1)) return std::numeric_limits<double>::quiet_NaN();
  return snapped(angle_of(x, std::sqrt((1 - x) * (1 + x))),
                 [x](double whole) { return sin_deg(whole) == x; });
}

double acos_deg(double x) {
  if (!(std::fabs(x) <= 1)) return std::numeric_limits<double>::quiet_NaN();
  return snapped(angle_of(std::sqrt((1 - x) * (1 + x)), x),
                 [x](double whole) { return cos_deg(whole) == x; });
}

double atan_deg(double x) {
  if (std::isnan(x)) return x;
  return snapped(angle_of(x, 1), [x](double whole) { return tan_deg(whole) == x; });
}

double atan2_deg(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return std::numeric_limits<double>::quiet_NaN();
  const double angle = angle_of(y, x);
  return snapped(angle, [angle](double whole) { return std::fabs(whole - angle) < 3e-14; });
}

}  // namespace csgrun
