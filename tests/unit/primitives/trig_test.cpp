// The oracle is Boost.Multiprecision with 100 decimal digits, and its own conversion to double.
#include <cmath>
#include <limits>
#include <random>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

#include <csgrun/primitives/trig.h>

namespace csgrun::trig_test {
namespace {

using Big = boost::multiprecision::cpp_bin_float_100;

/// sin or cos of degrees, rounded once. The reduction modulo 360 is exact: fmod of doubles is.
double oracle(double degrees, bool cosine) {
  const double reduced = std::fmod(degrees, 360.0);
  const Big radians = Big(reduced) * boost::math::constants::pi<Big>() / 180;
  Big value = cosine ? Big(cos(radians)) : Big(sin(radians));
  if (std::fmod(reduced, 30.0) == 0) {  // where the value is a multiple of 1/2, Big is a hair off
    const Big twice = value * 2;
    if (abs(twice - round(twice)) < Big("1e-90")) value = round(twice) / 2;
  }
  return value.convert_to<double>();
}

void expect_both(double degrees) {
  const double s = oracle(degrees, false), c = oracle(degrees, true);
  ASSERT_EQ(sin_deg(degrees), s) << std::hexfloat << degrees;
  ASSERT_EQ(cos_deg(degrees), c) << std::hexfloat << degrees;
}

TEST(Trig, SpecialAnglesAreExact) {
  EXPECT_EQ(sin_deg(30), 0.5);
  EXPECT_EQ(cos_deg(60), 0.5);
  EXPECT_EQ(cos_deg(90), 0.0);
  EXPECT_EQ(sin_deg(180), 0.0);
  EXPECT_EQ(cos_deg(180), -1.0);
  EXPECT_EQ(sin_deg(45), std::sqrt(0.5));
  EXPECT_EQ(cos_deg(45), std::sqrt(0.5));
  EXPECT_EQ(cos_deg(30), std::sqrt(0.75));
  EXPECT_EQ(sin_deg(-300), std::sqrt(0.75));
  EXPECT_EQ(tan_deg(45), 1.0);
  EXPECT_EQ(tan_deg(-135), 1.0);
  EXPECT_EQ(sin_deg(360e15), 0.0);
  EXPECT_FALSE(std::signbit(cos_deg(270)));
  EXPECT_FALSE(std::signbit(sin_deg(-180)));
}

TEST(Trig, NonFiniteIsNan) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const double x : {inf, -inf, std::nan("")}) {
    EXPECT_TRUE(std::isnan(sin_deg(x)));
    EXPECT_TRUE(std::isnan(cos_deg(x)));
  }
}

TEST(Trig, WholeAndFractionalDegreesAreCorrectlyRounded) {
  for (int i = -720; i <= 720; ++i) expect_both(i);
  for (int n = 3; n <= 100; ++n) {
    for (int k = 0; k < n; ++k) expect_both(360.0 * k / n);
  }
}

TEST(Trig, RandomAnglesAreCorrectlyRounded) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> turn(-400, 400), exponent(-1080, 60);
  for (int i = 0; i < 60000; ++i) expect_both(turn(random));
  for (int i = 0; i < 20000; ++i) {
    // Tiny ones reach into the subnormal numbers.
    const double x = std::ldexp(std::fabs(turn(random)), static_cast<int>(exponent(random)));
    expect_both(x);
  }
  for (int multiple = 0; multiple <= 360; multiple += 15) {
    for (int ulps = -3; ulps <= 3; ++ulps) {
      double x = multiple;
      for (int k = 0; k < std::abs(ulps); ++k) x = std::nextafter(x, ulps < 0 ? -1e9 : 1e9);
      expect_both(x);
    }
  }
}

TEST(Trig, InversesAreWithinFourUlpsAndWholeWhereExact) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  const Big degrees = 180 / boost::math::constants::pi<Big>();
  auto near = [](double got, const Big& want) {
    const double w = want.convert_to<double>();
    const double ulp = std::nextafter(std::fabs(w), 1e300) - std::fabs(w);
    return std::fabs(got - w) <= 4 * ulp;
  };
  for (int i = 0; i < 3000; ++i) {
    const double x = unit(random), y = unit(random) * std::ldexp(1.0, i % 40 - 20);
    ASSERT_TRUE(near(asin_deg(x), asin(Big(x)) * degrees)) << x;
    ASSERT_TRUE(near(acos_deg(x), acos(Big(x)) * degrees)) << x;
    ASSERT_TRUE(near(atan_deg(y), atan(Big(y)) * degrees)) << y;
    ASSERT_TRUE(near(atan2_deg(y, x), atan2(Big(y), Big(x)) * degrees)) << y << ' ' << x;
  }
  for (int a = -90; a <= 90; ++a) {
    EXPECT_EQ(asin_deg(sin_deg(a)), a);
    EXPECT_EQ(atan_deg(tan_deg(a)), a);
  }
  for (int a = 0; a <= 180; ++a) EXPECT_EQ(acos_deg(cos_deg(a)), a);
  for (int a = -179; a <= 180; ++a) EXPECT_EQ(atan2_deg(sin_deg(a), cos_deg(a)), a);
  EXPECT_EQ(atan2_deg(1, -1), 135);
  EXPECT_TRUE(std::isnan(asin_deg(1.5)));
}

}  // namespace
}  // namespace csgrun::trig_test
