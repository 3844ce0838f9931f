// The exact arithmetic against GMP: signs in every tier, zeros among them, and correct rounding.
#include <algorithm>
#include <array>
#include <cmath>

#include <gmpxx.h>
#include <gtest/gtest.h>

#include "engine/exact/predicates.h"
#include "engine/exact/rounding.h"
#include "tests/support/gmp_bridge.h"
#include "tests/support/seeded.h"

namespace csgrun::arithmetic_test {
namespace {

using test::gmp_side;
using test::Random;
using test::to_gmp;

Int128 random_bits(Random& random, int bits) {
  if (bits <= 0) return 0;
  UInt128 v = static_cast<UInt128>(random.bits()) << 64 | random.bits();
  v >>= 128 - bits;
  return random.bits() & 1 ? -static_cast<Int128>(v) : static_cast<Int128>(v);
}

Plane random_plane(Random& random, int normal, int offset) {
  Plane p;
  while (p.a == 0 && p.b == 0 && p.c == 0) {
    p = {random_bits(random, normal), random_bits(random, normal), random_bits(random, normal), 0};
  }
  p.d = random_bits(random, offset);
  return p;
}

bool meet_in_a_point(const Plane& p, const Plane& q, const Plane& r) {
  const mpz_class det = to_gmp(p.a) * (to_gmp(q.b) * to_gmp(r.c) - to_gmp(q.c) * to_gmp(r.b)) -
                        to_gmp(p.b) * (to_gmp(q.a) * to_gmp(r.c) - to_gmp(q.c) * to_gmp(r.a)) +
                        to_gmp(p.c) * (to_gmp(q.a) * to_gmp(r.b) - to_gmp(q.b) * to_gmp(r.a));
  return det != 0;
}

// Planes through grid points and beside them, by one unit or by many, in every tier that holds the
// value.
TEST(ExactSide, OfGridPointsAgreesWithGmp) {
  Random random(20260102);
  std::array<int, 6> seen{};
  for (int i = 0; i < 60000; ++i) {
    const auto coordinate = [&] {
      const int64_t limit = int64_t{1} << random.integer(0, 30);
      return random.integer(-limit, limit);
    };
    const std::array<int64_t, 3> at{coordinate(), coordinate(), coordinate()};
    Plane s = random_plane(random, static_cast<int>(random.integer(1, widths::kMaxNormal - 40)), 1);
    const int shift = random.integer(0, 1) ? static_cast<int>(random.integer(0, 80)) : 0;
    s.d = -(s.a * at[0] + s.b * at[1] + s.c * at[2]) + (Int128{1} << shift) * random.integer(-1, 1);
    if (i % 4 == 0) s = random_plane(random, widths::kMaxNormal - 1, widths::kMaxOffset - 1);
    const Point point = grid_point(at[0], at[1], at[2]);
    const int expected = gmp_side(s, to_gmp(point)), tier = exact_tier(s, point);
    for (int wider = tier; wider < 6; ++wider) ASSERT_EQ(exact_side(s, at, wider), expected);
    ++seen[static_cast<size_t>(tier)];
  }
  for (size_t t = 0; t < 3; ++t) EXPECT_GT(seen[t], 1000);
}

// Planes of all widths that occur, from boxes to sheared frames; a third of the planes pass through
// the point by construction (combinations of planes through it), so that their sign is zero.
TEST(ExactSide, AgreesWithGmpOnAMillionSignsInEveryTier) {
  Random random(20260101);
  constexpr std::array<std::array<int, 2>, 9> kWidths{
      {{1, 8},
       {4, 14},
       {8, 30},
       {12, 40},
       {20, 50},
       {28, 60},
       {40, 72},
       {57, 84},
       {widths::kMaxNormal - 4, widths::kMaxOffset - 6}}};
  std::array<uint64_t, 6> tiers{};
  uint64_t zeros = 0, total = 0;
  constexpr int kPlanesPerPoint = 6;
  while (total < 1'020'000) {
    const auto& width = kWidths[random.bits() % kWidths.size()];
    const Plane p = random_plane(random, width[0], width[1]);
    const Plane q = random_plane(random, width[0], width[1]);
    const Plane r = random_plane(random, width[0], width[1]);
    if (!meet_in_a_point(p, q, r)) continue;
    const Point point = intersect(p, q, r);
    const auto exact = to_gmp(point);
    for (int k = 0; k < kPlanesPerPoint; ++k) {
      Plane s;
      if (k % 2 == 0) {
        // Through the point: a small combination of the three, within the allowed widths.
        const int64_t u = random.integer(-3, 3), v = random.integer(-3, 3),
                      w = random.integer(-3, 3);
        s = {p.a * u + q.a * v + r.a * w, p.b * u + q.b * v + r.b * w, p.c * u + q.c * v + r.c * w,
             p.d * u + q.d * v + r.d * w};
        if (s.a == 0 && s.b == 0 && s.c == 0) s = p;
      } else {
        const auto& other = kWidths[random.bits() % kWidths.size()];
        s = random_plane(random, other[0], other[1]);
      }
      const int expected = gmp_side(s, exact);
      const int tier = exact_tier(s, point);
      ASSERT_EQ(exact_side(s, point), expected);
      for (int wider = tier + 1; wider < 6; ++wider)
        ASSERT_EQ(exact_side(s, point, wider), expected);
      const std::array<double, 4> approximate{static_cast<double>(s.a), static_cast<double>(s.b),
                                              static_cast<double>(s.c), static_cast<double>(s.d)};
      const int filtered = filter_side(approximate, rounded(point));
      ASSERT_TRUE(filtered == 0 || filtered == expected);
      ++tiers[tier];
      ++total;
      zeros += expected == 0;
    }
  }
  std::printf("%llu signs, %llu of them zero; by tier:", static_cast<unsigned long long>(total),
              static_cast<unsigned long long>(zeros));
  for (const uint64_t t : tiers) std::printf(" %llu", static_cast<unsigned long long>(t));
  std::printf("\n");
  EXPECT_GE(total, 1'000'000u);
  EXPECT_GE(zeros * 3, total);
  for (const uint64_t t : tiers) EXPECT_GT(t, 1000u);
}

TEST(Intersect, IsWhereThreePlanesMeet) {
  Random random(7);
  for (int i = 0; i < 20'000; ++i) {
    const int normal = static_cast<int>(random.integer(1, widths::kMaxNormal));
    const int offset = static_cast<int>(random.integer(1, widths::kMaxOffset));
    const Plane p = random_plane(random, normal, offset), q = random_plane(random, normal, offset),
                r = random_plane(random, normal, offset);
    if (!meet_in_a_point(p, q, r)) continue;
    const Point point = intersect(p, q, r);
    const auto exact = to_gmp(point);
    ASSERT_GT(exact.w, 0);
    for (const Plane& s : {p, q, r}) ASSERT_EQ(gmp_side(s, exact), 0);
    ASSERT_EQ(point.w_bits, static_cast<int>(mpz_sizeinbase(exact.w.get_mpz_t(), 2)));
  }
}

// How wide the arithmetic must be follows from the widths of all three planes: one that is wide, or
// far away, among narrow ones; and sums of widths around those that machine integers hold.
TEST(Intersect, IsCramersRuleForPlanesOfAnyWidths) {
  Random random(8);
  size_t narrow = 0, middle = 0, wide = 0;
  for (int i = 0; i < 40'000; ++i) {
    std::array<Plane, 3> planes;
    const int most = i % 3 == 0 ? widths::kMaxNormal : 66;
    std::array<int, 3> normals{};
    for (int& n : normals) n = static_cast<int>(random.integer(1, most));
    for (size_t k = 0; k < 3; ++k) {
      const int border = i % 2 == 0 ? 128 : 192;
      const int others = normals[(k + 1) % 3] + normals[(k + 2) % 3];
      const int offset =
          static_cast<int>(random.integer(0, 2) == 0 ? border + random.integer(-8, 8) - others
                                                     : random.integer(1, widths::kMaxOffset));
      planes[k] = random_plane(random, normals[k], std::clamp(offset, 1, widths::kMaxOffset));
    }
    const Plane &p = planes[0], &q = planes[1], &r = planes[2];
    if (!meet_in_a_point(p, q, r)) continue;
    const auto determinant = [](const std::array<mpz_class, 3>& u,
                                const std::array<mpz_class, 3>& v,
                                const std::array<mpz_class, 3>& w) {
      return mpz_class(u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
                       u[2] * (v[0] * w[1] - v[1] * w[0]));
    };
    const auto column = [&](Int128 Plane::*of) {
      return std::array<mpz_class, 3>{to_gmp(p.*of), to_gmp(q.*of), to_gmp(r.*of)};
    };
    const auto a = column(&Plane::a), b = column(&Plane::b), c = column(&Plane::c),
               d = column(&Plane::d);
    const mpz_class w = determinant(a, b, c), x = -determinant(d, b, c), y = -determinant(a, d, c),
                    z = -determinant(a, b, d);
    const Point point = intersect(p, q, r);
    const auto exact = to_gmp(point);
    ASSERT_GT(exact.w, 0);
    ASSERT_EQ(exact.x * w, x * exact.w) << "case " << i;
    ASSERT_EQ(exact.y * w, y * exact.w) << "case " << i;
    ASSERT_EQ(exact.z * w, z * exact.w) << "case " << i;
    const auto bits = [](const mpz_class& v) {
      return v == 0 ? 0 : static_cast<int>(mpz_sizeinbase(v.get_mpz_t(), 2));
    };
    ASSERT_EQ(point.w_bits, bits(exact.w));
    ASSERT_EQ(point.xyz_bits, std::max({bits(exact.x), bits(exact.y), bits(exact.z)}));
    const int widest = std::max(point.w_bits, point.xyz_bits);
    ++(widest < 127 ? narrow : widest < 192 ? middle : wide);
  }
  EXPECT_GT(narrow, 1000u);
  EXPECT_GT(middle, 1000u);
  EXPECT_GT(wide, 1000u);
}

/// That no double is nearer to a fraction than `got`.
void expect_nearest(double got, const mpz_class& numerator, const mpz_class& denominator) {
  mpq_class value(numerator, denominator);
  value.canonicalize();
  const mpq_class error = abs(mpq_class(got) - value);
  for (const double other : {std::nextafter(got, -HUGE_VAL), std::nextafter(got, HUGE_VAL)}) {
    ASSERT_LE(error, abs(mpq_class(other) - value));
  }
}

// Coordinates of many bits over few and of few over many, and of just as many as the quick way
// takes.
TEST(Rounding, OfPointsOfAnyWidths) {
  Random random(14);
  for (int i = 0; i < 4'000; ++i) {
    const auto number = [&](int bits) {
      Int<kPointLimbs> v;
      for (auto& limb : v.limb) limb = random.bits();
      mpz_class exact = abs(to_gmp(v)) % (mpz_class(1) << (bits - 1));
      exact += mpz_class(1) << (bits - 1);
      return random.bits() & 1 ? mpz_class(-exact) : exact;
    };
    const auto width = [&](int most) {
      return static_cast<int>(i % 2 ? random.integer(1, most) : random.integer(253, 258));
    };
    Point p;
    p.x = test::from_gmp<kPointLimbs>(number(width(widths::kMaxPointXyz)));
    p.y = test::from_gmp<kPointLimbs>(number(width(widths::kMaxPointXyz)));
    p.z = test::from_gmp<kPointLimbs>(number(width(widths::kMaxPointXyz)));
    p.w = test::from_gmp<kPointLimbs>(number(width(widths::kMaxPointW)));
    normalise(p);
    const auto exact = to_gmp(p);
    const std::array<double, 3> got = rounded(p);
    ASSERT_NO_FATAL_FAILURE(expect_nearest(got[0], exact.x, exact.w)) << "case " << i;
    ASSERT_NO_FATAL_FAILURE(expect_nearest(got[1], exact.y, exact.w)) << "case " << i;
    ASSERT_NO_FATAL_FAILURE(expect_nearest(got[2], exact.z, exact.w)) << "case " << i;
  }
}

TEST(Rounding, IsToTheNearestDouble) {
  Random random(11);
  for (int i = 0; i < 60'000; ++i) {
    mpz_class numerator, denominator;
    if (i % 3 == 0) {
      // A tie, or a tie missed by one part in 2^200.
      const mpz_class odd = 2 * mpz_class(static_cast<unsigned long>(random.bits() >> 12)) + 1;
      denominator = mpz_class(static_cast<unsigned long>(random.bits() | 1)) << 140;
      numerator = ((odd | (mpz_class(1) << 53)) * denominator) + random.integer(-1, 1);
      numerator = numerator % (mpz_class(1) << 500);
    } else {
      numerator = to_gmp(random_bits(random, static_cast<int>(random.integer(1, 127))));
      numerator *= to_gmp(random_bits(random, static_cast<int>(random.integer(1, 127))));
      numerator *= to_gmp(random_bits(random, static_cast<int>(random.integer(1, 127))));
      denominator = abs(to_gmp(random_bits(random, static_cast<int>(random.integer(1, 127)))));
      denominator *= abs(to_gmp(random_bits(random, static_cast<int>(random.integer(1, 127)))));
    }
    if (denominator == 0) continue;
    if (random.bits() & 1) numerator = -numerator;
    mpq_class value(numerator, denominator);
    value.canonicalize();
    const double got = round_to_double(test::from_gmp<kQuotientLimbs>(numerator),
                                       test::from_gmp<kQuotientLimbs>(denominator));
    // No other double is nearer; in a tie the last bit is even.
    const mpq_class error = abs(mpq_class(got) - value);
    for (const double other : {std::nextafter(got, -HUGE_VAL), std::nextafter(got, HUGE_VAL)}) {
      const mpq_class distance = abs(mpq_class(other) - value);
      ASSERT_LE(error, distance);
      if (error == distance && error != 0) {
        int exponent;
        const double mantissa = std::ldexp(std::fabs(std::frexp(got, &exponent)), 53);
        ASSERT_EQ(std::fmod(mantissa, 2), 0);
      }
    }
    const float single = round_to_float(test::from_gmp<kQuotientLimbs>(numerator),
                                        test::from_gmp<kQuotientLimbs>(denominator), -300);
    const mpq_class scaled = value / mpq_class(mpz_class(1) << 300);
    if (std::isfinite(single)) {
      const mpq_class off = abs(mpq_class(single) - scaled);
      for (const float other :
           {std::nextafterf(single, -HUGE_VALF), std::nextafterf(single, HUGE_VALF)}) {
        if (std::isfinite(other)) {
          ASSERT_LE(off, abs(mpq_class(other) - scaled));
        }
      }
    }
  }
}

// The quick way for narrower numbers: near ties, of all sizes, and scaled out of the normal range.
TEST(Rounding, IsTheSameForNarrowNumbers) {
  Random random(12);
  const auto positive = [&](int bits) {
    return mpz_class(abs(to_gmp(random_bits(random, bits))) + 1);
  };
  for (int i = 0; i < 60'000; ++i) {
    const mpz_class denominator = positive(static_cast<int>(random.integer(1, 120))) *
                                  positive(static_cast<int>(random.integer(1, 120)));
    mpz_class numerator = positive(static_cast<int>(random.integer(1, 120))) *
                          positive(static_cast<int>(random.integer(1, 120)));
    if (i % 2 == 0) {
      const mpz_class odd = 2 * mpz_class(static_cast<unsigned long>(random.bits() >> 11)) + 1;
      const mpz_class small = positive(static_cast<int>(random.integer(1, 120)));
      numerator = odd * small + random.integer(-1, 1);
      if (i % 4 == 0) numerator *= denominator / small + 1;
      numerator %= mpz_class(1) << 250;
    }
    if (random.bits() & 1) numerator = -numerator;
    const int exponent = static_cast<int>(random.integer(0, 3) == 0 ? random.integer(-1200, 700)
                                                                    : random.integer(-40, 40));
    const double expected = round_to_double(test::from_gmp<kQuotientLimbs>(numerator),
                                            test::from_gmp<kQuotientLimbs>(denominator), exponent);
    ASSERT_EQ(
        round_to_double(test::from_gmp<4>(numerator), test::from_gmp<4>(denominator), exponent),
        expected)
        << numerator << " / " << denominator << " * 2^" << exponent;
  }
  EXPECT_EQ(round_to_double(Int<4>(0), Int<4>(7)), 0);
}

TEST(FixedInt, MultipliesAddsAndShiftsAsGmpDoes) {
  Random random(13);
  const mpz_class modulus = mpz_class(1) << 256;
  const auto wrap = [&](mpz_class v) {
    v %= modulus;
    if (v < 0) v += modulus;
    if (v >= modulus / 2) v -= modulus;
    return v;
  };
  for (int i = 0; i < 50'000; ++i) {
    Int<3> a;
    Int<2> b;
    for (auto& l : a.limb) l = random.bits() >> (random.bits() % 64);
    for (auto& l : b.limb) l = random.bits() >> (random.bits() % 64);
    if (random.bits() & 1) a = -a;
    if (random.bits() & 1) b = -b;
    const mpz_class x = to_gmp(a), y = to_gmp(b);
    ASSERT_EQ(to_gmp(multiply<5>(a, b)), x * y);
    ASSERT_EQ(to_gmp(multiply<4>(a, b)), wrap(x * y));
    ASSERT_EQ(to_gmp(multiply<7>(a, b)), x * y);
    const Int<4> u = Int<4>::from(a), v = Int<4>::from(b);
    ASSERT_EQ(to_gmp(u + v), x + y);
    ASSERT_EQ(to_gmp(u - v), x - y);
    Int<4> updated = u;
    ASSERT_EQ(to_gmp(updated += v), x + y);
    ASSERT_EQ(to_gmp(updated -= v), x);
    ASSERT_EQ(compare(u, v), x < y ? -1 : x > y ? 1 : 0);
    const int shift = static_cast<int>(random.bits() % 256);
    ASSERT_EQ(to_gmp(u.shifted_left(shift)), wrap(x << shift));
    ASSERT_EQ(u.bit_width(), x == 0 ? 0 : static_cast<int>(mpz_sizeinbase(x.get_mpz_t(), 2)));
  }
}

/// The limbs as they are, without a sign.
template <int N>
mpz_class unsigned_value(const Int<N>& v) {
  mpz_class r;
  mpz_import(r.get_mpz_t(), N, -1, 8, 0, 0, v.limb.data());
  return r;
}

// Of limbs that are full, empty or anything, so that what is carried runs through several.
template <int N>
void check_carries(Random& random) {
  const mpz_class modulus = mpz_class(1) << 64 * N;
  const auto wrap = [&](const mpz_class& v) -> mpz_class { return (v + modulus) % modulus; };
  int negative = 0;
  for (int i = 0; i < 5000; ++i) {
    Int<N> a, b;
    for (Int<N>* v : {&a, &b}) {
      for (uint64_t& l : v->limb) {
        const uint64_t kind = random.bits() % 4;
        l = kind == 0 ? 0 : kind == 1 ? ~uint64_t{0} : kind == 2 ? 1 : random.bits();
      }
    }
    const mpz_class x = unsigned_value(a), y = unsigned_value(b);
    ASSERT_EQ(unsigned_value(a + b), wrap(x + y));
    ASSERT_EQ(unsigned_value(a - b), wrap(x - y));
    ASSERT_EQ(unsigned_value(-a), wrap(-x));
    ASSERT_EQ(unsigned_value(a.magnitude()), x >= modulus / 2 ? mpz_class(modulus - x) : x);
    negative += a.negative();
  }
  EXPECT_GT(negative, 1000);
}

TEST(FixedInt, CarriesThroughAllLimbs) {
  Random random(29);
  check_carries<1>(random);
  check_carries<2>(random);
  check_carries<3>(random);
  check_carries<4>(random);
  check_carries<6>(random);
  check_carries<8>(random);
}

TEST(FixedInt, SingleBitsAndTheirSums) {
  for (int bit = 0; bit < 4 * 64 - 1; ++bit) {
    const Int<4> one = Int<4>(1).shifted_left(bit);
    for (const Int<4>& v : {one, -one, one - Int<4>(1), one + one}) {
      const mpz_class exact = to_gmp(v);
      ASSERT_EQ(v.is_zero(), exact == 0);
      ASSERT_EQ(v.sign(), sgn(exact));
      ASSERT_EQ(v.negative(), exact < 0);
      ASSERT_EQ(compare(v, one), sgn(mpz_class(exact - to_gmp(one))));
      ASSERT_EQ(v == one, exact == to_gmp(one));
    }
    ASSERT_EQ(to_double(one), std::ldexp(1, bit));
    ASSERT_EQ(to_double(-one), -std::ldexp(1, bit));
  }
}

TEST(FixedInt, IsADoubleWithinAUnitInTheLastPlace) {
  Random random(23);
  for (int i = 0; i < 20'000; ++i) {
    Int<6> v;
    const int limbs = static_cast<int>(random.integer(1, 6));
    for (int k = 0; k < limbs; ++k) v.limb[k] = random.bits() >> (random.bits() % 64);
    if (random.bits() & 1) v = -v;
    const mpq_class exact(to_gmp(v));
    const double got = to_double(v);
    ASSERT_LE(abs(mpq_class(got) - exact), abs(exact) / mpq_class(mpz_class(1) << 52));
  }
}

// Coordinates -1, 0 and 1 as fractions of all sizes, so that equal ones have different digits.
TEST(PointOrder, IsByExactCoordinates) {
  Random random(19);
  std::array<int, 3> decided{};
  int equal = 0;
  const auto make = [&](int64_t scale) {
    Point p = grid_point(random.integer(-1, 1) * scale, random.integer(-1, 1) * scale,
                         random.integer(-1, 1) * scale);
    p.w = Int<kPointLimbs>(scale * (random.bits() & 1 ? 1 : -1));
    normalise(p);
    return p;
  };
  for (int i = 0; i < 5'000; ++i) {
    const int64_t big = random.integer(1, int64_t{1} << 60);
    const Point p = make(big), q = make(random.bits() & 1 ? big - 1 + 2 * (big == 1) : 7);
    const auto a = to_gmp(p), b = to_gmp(q);
    ASSERT_GT(a.w, 0);
    const std::array<mpz_class, 3> difference{a.x * b.w - b.x * a.w, a.y * b.w - b.y * a.w,
                                              a.z * b.w - b.z * a.w};
    int expected = 0;
    for (int k = 0; k < 3; ++k) {
      const int order = sgn(difference[k]);
      ASSERT_EQ(compare_along(p, q, k), order);
      if (expected == 0 && order != 0) expected = order, ++decided[k];
    }
    equal += expected == 0;
    ASSERT_EQ(compare(p, q), expected);
    const auto bits = [](const mpz_class& v) {
      return v == 0 ? 0 : static_cast<int>(mpz_sizeinbase(v.get_mpz_t(), 2));
    };
    ASSERT_EQ(p.xyz_bits, std::max({bits(a.x), bits(a.y), bits(a.z)}));
    ASSERT_EQ(p.w_bits, bits(a.w));
  }
  for (const int n : decided) EXPECT_GT(n, 100);
  EXPECT_GT(equal, 50);
}

}  // namespace
}  // namespace csgrun::arithmetic_test
