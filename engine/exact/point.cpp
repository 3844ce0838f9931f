#include "engine/exact/point.h"

#include <algorithm>
#include <cassert>

#include "engine/exact/rounding.h"

namespace csgrun {
namespace {

using Coordinate = Int<kPointLimbs>;

/// A whole number modulo 2^192 or 2^256, by the size of `High`, in two's complement. Signs are as
/// good as random: nothing here branches on them.
template <class High>
struct Wide {
  UInt128 low = 0;
  High high = 0;

  void add_product(Int128 a, Int128 b) {
    const auto ua = static_cast<UInt128>(a), ub = static_cast<UInt128>(b);
    const auto a0 = static_cast<uint64_t>(ua), a1 = static_cast<uint64_t>(ua >> 64),
               b0 = static_cast<uint64_t>(ub), b1 = static_cast<uint64_t>(ub >> 64);
    const UInt128 p00 = UInt128{a0} * b0, p01 = UInt128{a0} * b1, p10 = UInt128{a1} * b0;
    const UInt128 middle = (p00 >> 64) + static_cast<uint64_t>(p01) + static_cast<uint64_t>(p10);
    const UInt128 product = (middle << 64) | static_cast<uint64_t>(p00);
    // As unsigned numbers negative ones read 2^128 too large.
    const High excess = (static_cast<High>(ub) & static_cast<High>(a >> 127)) +
                        (static_cast<High>(ua) & static_cast<High>(b >> 127));
    low += product;
    high += static_cast<High>(a1) * b1 + static_cast<High>(p01 >> 64) +
            static_cast<High>(p10 >> 64) + static_cast<High>(middle >> 64) - excess +
            static_cast<High>(low < product);
  }
  /// 0, or all bits, of a negative one.
  [[nodiscard]] High sign() const { return -(high >> (8 * sizeof(High) - 1)); }
  /// Turned over where `mask` is all bits, not where it is 0.
  [[nodiscard]] Wide turned(High mask) const {
    const UInt128 one = mask & 1, all = -one, turned_low = (low ^ all) + one;
    return {turned_low, (high ^ mask) + (static_cast<High>(one) & (turned_low == 0))};
  }
  [[nodiscard]] Coordinate coordinate() const {
    Coordinate c(-static_cast<int64_t>(sign() & 1));
    c.limb[0] = static_cast<uint64_t>(low);
    c.limb[1] = static_cast<uint64_t>(low >> 64);
    c.limb[2] = static_cast<uint64_t>(high);
    if constexpr (sizeof(High) > sizeof(uint64_t)) c.limb[3] = static_cast<uint64_t>(high >> 64);
    return c;
  }
  /// Of one that is not negative.
  [[nodiscard]] int width() const {
    return high != 0 ? 128 + width_of_magnitude(high) : width_of_magnitude(low);
  }
};

/// The same where machine integers of 64 bits hold the normals, of 62 bits at most, so that minors
/// of 126 bits fit 128, and where `High` and 128 bits hold the results.
template <class High>
Point cramer(const Plane& p, const Plane& q, const Plane& r) {
  struct Cross {
    Int128 x, y, z;
  };
  const auto minor = [](Int128 a, Int128 b, Int128 c, Int128 d) {
    const auto narrow = [](Int128 v) { return static_cast<Int128>(static_cast<int64_t>(v)); };
    return narrow(a) * narrow(d) - narrow(b) * narrow(c);
  };
  const auto cross = [&](const Plane& u, const Plane& v) {
    return Cross{minor(u.b, u.c, v.b, v.c), minor(u.c, u.a, v.c, v.a), minor(u.a, u.b, v.a, v.b)};
  };
  const Cross qr = cross(q, r), rp = cross(r, p), pq = cross(p, q);
  const auto sum = [](Int128 a, Int128 u, Int128 b, Int128 v, Int128 c, Int128 t) {
    Wide<High> all;
    all.add_product(a, u);
    all.add_product(b, v);
    all.add_product(c, t);
    return all;
  };
  const Wide<High> w = sum(qr.x, p.a, qr.y, p.b, qr.z, p.c);
  assert(w.low != 0 || w.high != 0);
  const High turn = w.sign();
  const auto combine = [&](Int128 a, Int128 b, Int128 c) {
    return sum(a, p.d, b, q.d, c, r.d).turned(~turn);
  };
  const Wide<High> x = combine(qr.x, rp.x, pq.x), y = combine(qr.y, rp.y, pq.y),
                   z = combine(qr.z, rp.z, pq.z), whole = w.turned(turn);
  Wide<High> any;
  for (const Wide<High>& c : {x, y, z}) {
    const Wide<High> size = c.turned(c.sign());
    any.low |= size.low;
    any.high |= size.high;
  }
  return {x.coordinate(),     y.coordinate(), z.coordinate(),
          whole.coordinate(), any.width(),    whole.width()};
}

/// A whole number modulo 2^384, in two's complement.
struct Wide384 {
  std::array<UInt128, 3> part{};  ///< least significant first

  /// Adds a product of a 256-bit number, in halves, and a 128-bit one, that fits 384 bits.
  void add_product(const Wide<UInt128>& a, Int128 b) {
    Wide<UInt128> low, high;
    low.add_product(static_cast<Int128>(a.low), b);
    // A lower half that reads negative reads 2^128 too small.
    low.high += static_cast<UInt128>(b) & -(a.low >> 127);
    high.add_product(static_cast<Int128>(a.high), b);
    const UInt128 sign = low.sign();
    part[0] += low.low;
    UInt128 carry = part[0] < low.low;
    const UInt128 second = low.high + carry;  // no overflow: |low| < 2^255
    part[1] += second;
    carry = part[1] < second;
    part[1] += high.low;
    carry += part[1] < high.low;
    // A negative lower product goes on to the left; if the carry into `second` made it 0 from
    // all bits set, it has gone on there, too.
    const UInt128 lost = second < low.high;
    part[2] += high.high + sign + carry + lost;
  }
  [[nodiscard]] Coordinate coordinate() const {
    Coordinate c;
    for (size_t k = 0; k < 3; ++k) {
      c.limb[2 * k] = static_cast<uint64_t>(part[k]);
      c.limb[2 * k + 1] = static_cast<uint64_t>(part[k] >> 64);
    }
    return c;
  }
};

/// Cramer's rule for planes of any width.
Point cramer_wide(const Plane& p, const Plane& q, const Plane& r) {
  static_assert(2 * widths::kMaxNormal + 1 < 255 && widths::kMaxOffset < 127);
  using Minor = Wide<UInt128>;
  struct Cross {
    Minor x, y, z;
  };
  const auto minor = [](Int128 a, Int128 b, Int128 c, Int128 d) {
    Minor m;
    m.add_product(a, d);
    m.add_product(-b, c);
    return m;
  };
  const auto cross = [&](const Plane& u, const Plane& v) {
    return Cross{minor(u.b, u.c, v.b, v.c), minor(u.c, u.a, v.c, v.a), minor(u.a, u.b, v.a, v.b)};
  };
  const Cross qr = cross(q, r), rp = cross(r, p), pq = cross(p, q);
  const auto sum = [](const Minor& a, Int128 u, const Minor& b, Int128 v, const Minor& c,
                      Int128 t) {
    Wide384 all;
    all.add_product(a, u);
    all.add_product(b, v);
    all.add_product(c, t);
    return all.coordinate();
  };
  Point result;
  result.w = sum(qr.x, p.a, qr.y, p.b, qr.z, p.c);
  assert(!result.w.is_zero());
  result.x = sum(qr.x, -p.d, rp.x, -q.d, pq.x, -r.d);
  result.y = sum(qr.y, -p.d, rp.y, -q.d, pq.y, -r.d);
  result.z = sum(qr.z, -p.d, rp.z, -q.d, pq.z, -r.d);
  normalise(result);
  return result;
}

/// The same where machine integers of 128 bits hold the results, modulo which sums are taken.
Point cramer_narrow(const Plane& p, const Plane& q, const Plane& r) {
  struct Normal {
    int64_t a, b, c;
  };
  struct Cross {
    UInt128 x, y, z;
  };
  const auto normal = [](const Plane& s) {
    return Normal{static_cast<int64_t>(s.a), static_cast<int64_t>(s.b), static_cast<int64_t>(s.c)};
  };
  const auto minor = [](int64_t a, int64_t b, int64_t c, int64_t d) {
    return static_cast<UInt128>(static_cast<Int128>(a) * d - static_cast<Int128>(b) * c);
  };
  const auto cross = [&minor](const Normal& u, const Normal& v) {
    return Cross{minor(u.b, u.c, v.b, v.c), minor(u.c, u.a, v.c, v.a), minor(u.a, u.b, v.a, v.b)};
  };
  const auto times = [](UInt128 u, Int128 v) { return u * static_cast<UInt128>(v); };
  const Normal pn = normal(p), qn = normal(q), rn = normal(r);
  const Cross qr = cross(qn, rn), rp = cross(rn, pn), pq = cross(pn, qn);
  const auto w = static_cast<Int128>(times(qr.x, p.a) + times(qr.y, p.b) + times(qr.z, p.c));
  assert(w != 0);
  const auto combine = [&](UInt128 a, UInt128 b, UInt128 c) {
    const auto sum = static_cast<Int128>(times(a, p.d) + times(b, q.d) + times(c, r.d));
    return w < 0 ? sum : -sum;
  };
  const Int128 x = combine(qr.x, rp.x, pq.x), y = combine(qr.y, rp.y, pq.y),
               z = combine(qr.z, rp.z, pq.z), whole = w < 0 ? -w : w;
  Point result;
  result.x = Coordinate::from_int128(x);
  result.y = Coordinate::from_int128(y);
  result.z = Coordinate::from_int128(z);
  result.w = Coordinate::from_int128(whole);
  result.xyz_bits = bit_width(x, y, z);
  result.w_bits = bit_width(whole);
  return result;
}

void measure(Point& p) {
  p.xyz_bits = std::max({p.x.bit_width(), p.y.bit_width(), p.z.bit_width()});
  p.w_bits = p.w.bit_width();
}

constexpr int kWideLimbs = 2 * kPointLimbs;

}  // namespace

Point grid_point(int64_t x, int64_t y, int64_t z) {
  Point p;
  p.x = x, p.y = y, p.z = z, p.w = 1;
  measure(p);
  return p;
}

void normalise(Point& p) {
  if (p.w.negative()) p.x = -p.x, p.y = -p.y, p.z = -p.z, p.w = -p.w;
  measure(p);
}

Point intersect(const Plane& p, const Plane& q, const Plane& r) {
  const auto normal_bits = [](const Plane& s) { return bit_width(s.a, s.b, s.c); };
  const int n0 = normal_bits(p), n1 = normal_bits(q), n2 = normal_bits(r);
  const int xyz =
      std::max({n0 + n1 + bit_width(r.d), n0 + n2 + bit_width(q.d), n1 + n2 + bit_width(p.d)}) +
      widths::point_xyz(0, 0);
  const int needed = std::max(xyz, n0 + n1 + n2 + widths::point_w(0));
  if (std::max({n0, n1, n2}) <= 62 && needed < 128) return cramer_narrow(p, q, r);
  static_assert(widths::kMaxPointXyz < 64 * kPointLimbs);
  if (std::max({n0, n1, n2}) > 62) return cramer_wide(p, q, r);
  static_assert(widths::point_xyz(62, widths::kMaxOffset) < 256 && widths::point_w(62) < 256);
  return needed < 192 ? cramer<uint64_t>(p, q, r) : cramer<UInt128>(p, q, r);
}

std::array<double, 3> rounded(const Point& p) {
  if (std::max(p.xyz_bits, p.w_bits) < 256) {
    const NarrowQuotients over_w(Int<4>::from(p.w));
    return {over_w.to_double(Int<4>::from(p.x)), over_w.to_double(Int<4>::from(p.y)),
            over_w.to_double(Int<4>::from(p.z))};
  }
  const auto quotient = [w = Int<kQuotientLimbs>::from(p.w)](const Coordinate& c) {
    return round_to_double(Int<kQuotientLimbs>::from(c), w);
  };
  return {quotient(p.x), quotient(p.y), quotient(p.z)};
}

int compare_along(const Point& p, const Point& q, int axis) {
  const Coordinate& a = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
  const Coordinate& b = axis == 0 ? q.x : axis == 1 ? q.y : q.z;
  if (p.w == q.w) return compare(a, b);
  return compare(multiply<kWideLimbs>(a, q.w), multiply<kWideLimbs>(b, p.w));
}

int compare(const Point& p, const Point& q) {
  for (int axis = 0; axis < 3; ++axis) {
    if (const int order = compare_along(p, q, axis)) return order;
  }
  return 0;
}

}  // namespace csgrun
