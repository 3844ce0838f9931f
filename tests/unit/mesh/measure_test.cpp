#include "engine/mesh/measure.h"

#include <bit>
#include <cmath>
#include <random>

#include <gmpxx.h>
#include <gtest/gtest.h>

#include "engine/mesh/fixed_sums.h"
#include "engine/mesh/natural.h"
#include "engine/mesh/residues.h"

namespace csgrun::test::measure_test {
namespace {

using Triangles = std::vector<std::array<uint32_t, 3>>;

template <int N>
mpz_class big(const Int<N>& v) {
  const Int<N> m = v.magnitude();
  mpz_class r;
  mpz_import(r.get_mpz_t(), N, -1, 8, 0, 0, m.limb.data());
  return v.negative() ? mpz_class(-r) : r;
}

template <int N>
Int<N> fixed(const mpz_class& v) {
  Int<N> r;
  size_t count = 0;
  const mpz_class magnitude = abs(v);
  mpz_export(r.limb.data(), &count, -1, 8, 0, 0, magnitude.get_mpz_t());
  return v < 0 ? -r : r;
}

/// Nearest double, ties to even, by comparing with the middle of two neighbours.
double nearest(const mpq_class& q) {
  if (q == 0) return 0;
  const double toward_zero = q.get_d();
  const double beyond = std::nextafter(toward_zero, q > 0 ? INFINITY : -INFINITY);
  const mpq_class middle = (mpq_class(toward_zero) + mpq_class(beyond)) / 2;
  if (q == middle) return std::bit_cast<uint64_t>(toward_zero) & 1 ? beyond : toward_zero;
  return abs(q) > abs(middle) ? beyond : toward_zero;
}

Point rational_point(const std::array<mpq_class, 3>& p, const mpz_class& factor = 1) {
  mpz_class w = factor;
  for (const auto& c : p) w *= c.get_den();
  Point r;
  r.x = fixed<kPointLimbs>(mpz_class(p[0] * w));
  r.y = fixed<kPointLimbs>(mpz_class(p[1] * w));
  r.z = fixed<kPointLimbs>(mpz_class(p[2] * w));
  r.w = fixed<kPointLimbs>(w);
  return r;
}

struct Expected {
  mpq_class volume;
  std::array<mpq_class, 3> centroid;
  double area = 0;
};

Expected truth(const std::vector<Point>& points, const Triangles& triangles, const GridStep& step) {
  mpq_class scale(mpz_class(static_cast<long>(step.numerator)),
                  mpz_class(static_cast<long>(step.denominator)));
  scale.canonicalize();
  mpz_class two_power = 1;
  two_power <<= static_cast<unsigned long>(std::abs(step.exponent));
  scale *= step.exponent >= 0 ? mpq_class(two_power) : 1 / mpq_class(two_power);
  const auto at = [&](uint32_t v, int k) {
    const Point& p = points[v];
    mpq_class q(big(k == 0 ? p.x : k == 1 ? p.y : p.z), big(p.w));
    q.canonicalize();
    return mpq_class(q * scale);
  };
  Expected e;
  mpq_class six = 0;
  mpf_class area(0, 512);
  for (const auto& t : triangles) {
    std::array<std::array<mpq_class, 3>, 3> p;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) p[i][k] = at(t[i], k);
    }
    mpq_class determinant = 0, squares = 0;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      determinant += p[0][k] * (p[1][i] * p[2][j] - p[1][j] * p[2][i]);
      const mpq_class cross =
          (p[1][i] - p[0][i]) * (p[2][j] - p[0][j]) - (p[1][j] - p[0][j]) * (p[2][i] - p[0][i]);
      squares += cross * cross;
    }
    six += determinant;
    for (int k = 0; k < 3; ++k) e.centroid[k] += determinant * (p[0][k] + p[1][k] + p[2][k]);
    area += sqrt(mpf_class(squares, 512)) / 2;
  }
  e.volume = six / 6;
  for (auto& c : e.centroid) c = six == 0 ? mpq_class(0) : mpq_class(c / (4 * six));
  e.area = area.get_d();
  return e;
}

void check(const std::vector<Point>& points, const Triangles& triangles, const GridStep& step) {
  const auto got = measure_mesh(
      points.size(), [&](uint32_t v) { return points[v]; }, triangles, step);
  ASSERT_TRUE(got) << got.error().message;
  const Expected expected = truth(points, triangles, step);
  EXPECT_EQ(got->volume, nearest(expected.volume));
  for (int k = 0; k < 3; ++k) EXPECT_EQ(got->centroid[k], nearest(expected.centroid[k])) << k;
  EXPECT_GE(got->area, std::nextafter(expected.area, 0));
  EXPECT_LE(got->area, std::nextafter(expected.area, INFINITY));
  const auto volume = measure_mesh(
      points.size(), [&](uint32_t v) { return points[v]; }, triangles, step, Wanted::kVolume);
  ASSERT_TRUE(volume) << volume.error().message;
  EXPECT_EQ(volume->volume, got->volume);
  const auto both = measure_mesh(
      points.size(), [&](uint32_t v) { return points[v]; }, triangles, step,
      Wanted::kVolumeAndArea);
  ASSERT_TRUE(both) << both.error().message;
  EXPECT_EQ(both->volume, got->volume);
  EXPECT_EQ(both->area, got->area);
}

/// An octahedron-like closed surface over six points: +x, -x, +y, -y, +z, -z.
const Triangles kOctahedron{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                            {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};

/// A box from its corners' coordinates.
void box(const std::array<mpq_class, 3>& lo, const std::array<mpq_class, 3>& hi,
         std::vector<Point>& points, Triangles& triangles) {
  const auto base = static_cast<uint32_t>(points.size());
  for (int i = 0; i < 8; ++i) {
    points.push_back(
        rational_point({i & 1 ? hi[0] : lo[0], i & 2 ? hi[1] : lo[1], i & 4 ? hi[2] : lo[2]}));
  }
  const std::array<std::array<uint32_t, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}};
  for (const auto& f : faces) {
    triangles.push_back({base + f[0], base + f[1], base + f[2]});
    triangles.push_back({base + f[0], base + f[2], base + f[3]});
  }
}

const GridStep kSteps[] = {{1, 1, 0}, {1, 1000000, 3}, {1, 1000, 0}, {127, 5000, -7}, {1, 1, -20}};

TEST(Measure, Nothing) {
  const auto got = measure_mesh(0, [](uint32_t) { return Point(); }, {}, {1, 1, 0});
  ASSERT_TRUE(got);
  EXPECT_EQ(got->volume, 0);
  EXPECT_EQ(got->area, 0);
}

TEST(Measure, GridBoxes) {
  std::mt19937_64 random(4);
  for (int round = 0; round < 200; ++round) {
    std::vector<Point> points;
    Triangles triangles;
    std::array<mpq_class, 3> lo, hi;
    for (int k = 0; k < 3; ++k) {
      const int bits = 1 + static_cast<int>(random() % 27);
      lo[k] = static_cast<long>(random() >> (64 - bits)) - (1l << (bits - 1));
      hi[k] = lo[k] + 1 + static_cast<long>(random() >> (64 - bits));
    }
    box(lo, hi, points, triangles);
    check(points, triangles, kSteps[round % 5]);
  }
}

TEST(Measure, RandomRationalPoints) {
  gmp_randclass random(gmp_randinit_default);
  random.seed(17);
  for (int round = 0; round < 400; ++round) {
    std::vector<Point> points;
    const mpz_class away = random.get_z_bits(26);
    for (int v = 0; v < 6; ++v) {
      std::array<mpq_class, 3> p;
      for (int k = 0; k < 3; ++k) {
        // Denominators up to 90 bits each, a common factor up to 22: w of up to 292 bits.
        const mpz_class den = random.get_z_bits(1 + (round * 7 + v) % 90) + 1;
        mpq_class small(random.get_z_range(den * 1000), den);
        small.canonicalize();
        p[k] = away + small;
        if (k == v / 2) p[k] += v % 2 ? -(1 << (round % 20)) : 1 << (round % 20);
      }
      points.push_back(rational_point(p, random.get_z_bits(22) + 1));
    }
    check(points, kOctahedron, kSteps[round % 5]);
    if (HasFailure()) FAIL() << "round " << round;
  }
}

TEST(Measure, ManyTriangles) {
  // A dented torus off the grid.
  gmp_randclass random(gmp_randinit_default);
  random.seed(23);
  const uint32_t n = 24, m = 18;
  std::vector<Point> points;
  Triangles triangles;
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t j = 0; j < m; ++j) {
      const double u = 2 * M_PI * i / n, v = 2 * M_PI * j / m, r = 3e6 + 1e6 * std::cos(v);
      std::array<mpq_class, 3> p{std::floor(r * std::cos(u)), std::floor(r * std::sin(u)),
                                 std::floor(1e6 * std::sin(v))};
      for (auto& c : p) c += mpq_class(random.get_z_bits(60), random.get_z_bits(40) + 1);
      for (auto& c : p) c.canonicalize();
      points.push_back(rational_point(p));
      const auto at = [&](uint32_t a, uint32_t b) { return (a % n) * m + b % m; };
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  check(points, triangles, {1, 1000000, 3});
}

TEST(Measure, InsideOutIsNegative) {
  std::vector<Point> points;
  Triangles triangles;
  box({mpq_class(1, 3), 0, 5}, {mpq_class(4, 7), mpq_class(11, 13), 9}, points, triangles);
  for (auto& t : triangles) std::swap(t[0], t[1]);
  check(points, triangles, {1, 1000, 0});
}

TEST(Measure, ExactMiddleOfTwoDoubles) {
  // Volumes of 54 bits, the last one set, from corners that are not on any binary grid.
  const long a = (1l << 27) + 1;
  for (const long b : {(1l << 26) + 1, (1l << 26) + 3, (1l << 26) - 1, (1l << 26) + 11}) {
    std::vector<Point> points;
    Triangles triangles;
    box({0, 0, 0}, {mpq_class(a, 3), mpq_class(b, 7), 21}, points, triangles);
    ASSERT_EQ(mpz_sizeinbase(mpz_class(mpz_class(a) * b).get_mpz_t(), 2), b < (1l << 26) ? 53 : 54);
    for (const int exponent : {0, -30, 5}) check(points, triangles, {1, 1, exponent});
  }
}

TEST(Measure, CentroidOnZero) {
  std::vector<Point> points;
  const mpq_class x(1, 3), y(100, 7), z(12345, 11);
  points.push_back(rational_point({x, 0, 0}));
  points.push_back(rational_point({-x, 0, 0}));
  points.push_back(rational_point({0, y, 0}));
  points.push_back(rational_point({0, -y, 0}));
  points.push_back(rational_point({0, 0, z}));
  points.push_back(rational_point({0, 0, -z}));
  check(points, kOctahedron, {1, 1000, 0});
}

TEST(Measure, VolumeOfZero) {
  // Flat, off the grid: every result but the area is zero.
  std::vector<Point> points;
  for (int v = 0; v < 6; ++v) {
    points.push_back(rational_point({mpq_class(v * v, 3), mpq_class(5 - v, 7), mpq_class(1, 3)}));
  }
  check(points, kOctahedron, {1, 1, 0});
}

TEST(Measure, TinyBesideHuge) {
  // A speck far from the origin and one whose volume is small against its extent.
  std::vector<Point> points;
  Triangles triangles;
  const mpq_class tiny(1, 1000003);
  box({100000000, -100000000, 3}, {100000000 + tiny, -100000000 + tiny, 3 + tiny}, points,
      triangles);
  check(points, triangles, {1, 1000000, 3});
  points.clear(), triangles.clear();
  box({mpq_class(-100000001, 3), 0, 0}, {mpq_class(100000001, 3), tiny, tiny}, points, triangles);
  check(points, triangles, {1, 1000000, 3});
}

TEST(Measure, RefusesWhatIsOutOfRange) {
  std::vector<Point> points;
  Triangles triangles;
  box({0, 0, 0}, {mpq_class(1l << 45), 1, 1}, points, triangles);
  const auto get = [&](uint32_t v) { return points[v]; };
  EXPECT_FALSE(measure_mesh(points.size(), get, triangles, {1, 1, 0}));
  EXPECT_FALSE(measure_mesh(3, get, triangles, {1, 1, 0}));
}

TEST(Natural, QuotientsAgreeWithGmp) {
  gmp_randclass random(gmp_randinit_default);
  random.seed(5);
  const auto to_natural = [](const mpz_class& v) { return natural(fixed<16>(v)); };
  for (int round = 0; round < 20000; ++round) {
    mpz_class n = random.get_z_bits(1 + round % 700), d = random.get_z_bits(1 + round % 311) + 1;
    if (round % 3 == 0) {
      // Next to the middle of two doubles, or on it.
      n = ((random.get_z_bits(53) | (mpz_class(1) << 53) | 1) * d << (round % 150)) + round % 5 - 2;
    }
    if (round % 7 == 0) d = (d << 128) - 1;  // quotient digits that are guessed too large
    const int exponent = round % 90 - 45;
    mpq_class q(n, d);
    q.canonicalize();
    const mpq_class power(mpz_class(1) << static_cast<unsigned>(std::abs(exponent)));
    q *= exponent >= 0 ? power : mpq_class(1 / power);
    ASSERT_EQ(round_quotient(to_natural(n), to_natural(d), exponent), nearest(q)) << round;
  }
  EXPECT_EQ(round_quotient(natural(1), natural(3), -1075), 0);
  EXPECT_EQ(round_quotient(natural(2), natural(3), -1074), 0x1p-1074);
  EXPECT_EQ(round_quotient(natural(1), natural(1), 1100), INFINITY);
}

TEST(PrimeField, AgreesWithGmp) {
  gmp_randclass random(gmp_randinit_default);
  random.seed(8);
  for (const unsigned k : {1u, 31u, 45u, 229u, 259u}) {
    const uint64_t p = (1ull << 61) - k;
    const mpz_class prime = (mpz_class(1) << 61) - k;
    ASSERT_NE(mpz_probab_prime_p(prime.get_mpz_t(), 40), 0);
    const PrimeField field(p);
    for (int round = 0; round < 200; ++round) {
      const mpz_class v = random.get_z_bits(380) * (round % 2 ? 1 : -1);
      mpz_class r;
      mpz_fdiv_r(r.get_mpz_t(), v.get_mpz_t(), prime.get_mpz_t());
      const uint64_t got = field.residue(fixed<6>(v));
      ASSERT_EQ(got, r.get_ui());
      if (got == 0) continue;
      ASSERT_EQ(field.multiply(got, field.inverse(got)), 1u);
    }
    EXPECT_EQ(field.multiply(field.power_of_two(-77), field.power_of_two(77)), 1u);
    EXPECT_EQ(field.add(field.residue(int64_t{-5}), 5), 0u);
  }
}

/// A number of so many bits, often with long runs of ones or zeros.
mpz_class number_of_bits(std::mt19937_64& random, unsigned bits) {
  mpz_class v = 1;
  while (mpz_sizeinbase(v.get_mpz_t(), 2) < bits) {
    const unsigned run = 1 + random() % 40;
    const int kind = static_cast<int>(random() % 3);
    for (unsigned i = 0; i < run && mpz_sizeinbase(v.get_mpz_t(), 2) < bits; ++i) {
      v = 2 * v + (kind == 2 ? static_cast<int>(random() % 2) : kind);
    }
  }
  return v;
}

TEST(FixedPoint, IsTheQuotientCutTo64Bits) {
  std::mt19937_64 random(7);
  int whole_ones = 0;
  for (int i = 0; i < 60000; ++i) {
    const unsigned w_bits = 1 + random() % (i % 2 == 0 ? 200 : 330);
    const mpz_class w = number_of_bits(random, w_bits);
    mpz_class x = number_of_bits(random, 1 + random() % (w_bits + kCoordinateBits - 2));
    switch (random() % 4) {
      case 0:  // a whole number, or next to one
        x -= x % w;
        x += static_cast<int>(random() % 3) - 1;
        break;
      case 1:  // next to a digit of the fraction
        x = (w * (number_of_bits(random, 60)) >> 64) + static_cast<int>(random() % 3) - 1;
        break;
      default:
        break;
    }
    if (random() % 2) x = -x;
    Int<2> result;
    bool cut = false;
    const FixedQuotients<1> over_w(fixed<kPointLimbs>(w));
    ASSERT_TRUE(over_w.divide(fixed<kPointLimbs>(x), result, cut));
    mpz_class expected, rest;
    mpz_fdiv_qr(expected.get_mpz_t(), rest.get_mpz_t(), mpz_class(x << 64).get_mpz_t(),
                w.get_mpz_t());
    ASSERT_EQ(big(result), expected) << x << " / " << w;
    ASSERT_EQ(cut, rest != 0) << x << " / " << w;
    whole_ones += !cut;
  }
  EXPECT_GT(whole_ones, 1000);
}

TEST(FixedPoint, IsNotOfFarPoints) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 2000; ++i) {
    const mpz_class w = number_of_bits(random, 1 + random() % 330);
    const mpz_class limit = w << (kCoordinateBits - 1);
    const FixedQuotients<1> over_w(fixed<kPointLimbs>(w));
    Int<2> result;
    bool cut = false;
    EXPECT_TRUE(over_w.divide(fixed<kPointLimbs>(limit - 1), result, cut));
    for (const mpz_class& x :
         std::initializer_list<mpz_class>{limit, -limit, limit + w, limit << 12}) {
      EXPECT_FALSE(over_w.divide(fixed<kPointLimbs>(x), result, cut)) << x << " / " << w;
    }
  }
}

}  // namespace
}  // namespace csgrun::test::measure_test
