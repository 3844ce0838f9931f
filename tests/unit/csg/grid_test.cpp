// The grid: which step a scene gets, and the exactness of rounding to it.
#include "engine/csg/grid.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace csgrun::grid_test {
namespace {

TEST(Grid, StepByReach) {
  struct Case {
    double reach;
    int g;
  };
  // The least g with reach < 2^27 2^g nm: 2^27 nm are 134.217728 mm.
  for (const Case& c :
       {Case{1, -6}, Case{2.09, -6}, Case{2.1, -3}, Case{16.7, -3}, Case{16.8, 0}, Case{134.2, 0},
        Case{134.3, 3}, Case{1073, 3}, Case{1074, 4}, Case{2147, 4}, Case{2148, 5}, Case{4294, 5},
        Case{4295, 6}, Case{8589, 6}, Case{0.2, -9}, Case{0.001, -15}, Case{2e30, 96}}) {
    const GridStep step = choose_step(c.reach, c.reach);
    EXPECT_EQ(step.millimetres(), std::ldexp(1e-6, c.g)) << c.reach;
  }
  EXPECT_EQ(choose_step(1, 1).millimetres(), 1.5625e-08);
}

TEST(Grid, StepsOfLargeModelsAreDecimal) {
  struct Case {
    double reach, step;
  };
  for (const Case& c :
       {Case{8590, 1e-4}, Case{13421, 1e-4}, Case{13422, 1e-3}, Case{1e5, 1e-3}, Case{1.4e5, 1e-2},
        Case{1e7, 0.1}, Case{1e8, 1}, Case{1e9, 10}, Case{1e28, 1e20}, Case{1e30, 1e22}}) {
    EXPECT_EQ(choose_step(c.reach, c.reach).millimetres(), c.step) << c.reach;
  }
  // Each is coarser than the one before.
  double last = 0;
  for (double reach = 1e-60; reach < 1e60; reach *= 1.7) {
    const double step = choose_step(reach, reach).millimetres();
    EXPECT_GE(step, last) << reach;
    EXPECT_LT(reach, step * 0x1p27);
    EXPECT_GT(reach, step * 0x1p27 / 20) << reach;
    last = step;
  }
}

TEST(Grid, FarLeavesDoNotCoarsenTheStepUntilFortyBits) {
  EXPECT_EQ(choose_step(1, 17000).millimetres(), std::ldexp(1e-6, -6));
  EXPECT_EQ(choose_step(1, 18000).millimetres(), std::ldexp(1e-6, -3));
}

TEST(Grid, ParsesExactNumbers) {
  struct Case {
    const char* text;
    double mm;
  };
  for (const Case& c : {Case{"0.001", 0.001}, Case{"1e-3mm", 0.001}, Case{"1e-3 mm", 0.001},
                        Case{"2^-20mm", 0x1p-20}, Case{"2^3", 8}, Case{"1", 1}, Case{"0.5", 0.5},
                        Case{"25.4e-3", 0.0254}, Case{".01", 0.01}, Case{"1.50000", 1.5},
                        Case{"0.0000152587890625", 0x1p-16}, Case{"1E+2", 100}}) {
    const auto step = GridStep::parse(c.text);
    ASSERT_TRUE(step.has_value()) << c.text;
    EXPECT_EQ(step->millimetres(), c.mm) << c.text;
    EXPECT_FALSE(step->automatic());
  }
  for (const char* text :
       {"", "mm", "0", "-1", "0.0", "abc", "1e", "1.2.3", "2^", "2^-2000", "nan", "inf", "1e400",
        "1e-400", "1,5", "123456789012345678901", "0x10", " 1"}) {
    const auto step = GridStep::parse(text);
    ASSERT_FALSE(step.has_value()) << text;
    EXPECT_EQ(step.error().code, ErrorCode::kInvalidArgument);
  }
  // The same number by different spellings is the same step.
  const auto a = GridStep::parse("0.25"), b = GridStep::parse("2^-2mm");
  EXPECT_EQ(a->numerator, b->numerator);
  EXPECT_EQ(a->denominator, b->denominator);
  EXPECT_EQ(a->exponent, b->exponent);
}

TEST(Quantise, EqualDecimalsMeet) {
  for (int g : {-9, -6, -3, 0, 3, 4, 5}) {
    const Quantiser q(nanometre_step(g));
    EXPECT_EQ(q(0.1 + 0.2), q(0.3)) << g;
    EXPECT_EQ(q(1.1 * 10), q(11.0)) << g;
    double sum = 0;
    for (int i = 0; i < 10; ++i) sum += 0.1;
    EXPECT_EQ(q(sum), q(1.0)) << g;
  }
}

TEST(Quantise, DecimalsAreOnTheGrid) {
  const Quantiser q(nanometre_step(3));  // 0.001 mm = 125 steps
  for (int i = -100000; i <= 100000; i += 37) {
    EXPECT_EQ(q(i / 1000.0), int64_t{125} * i);
    EXPECT_EQ(q(i * 0.001), int64_t{125} * i);
  }
}

TEST(Quantise, TiesGoUpWhateverTheNoise) {
  const Quantiser q(nanometre_step(0));
  for (int i = -5000; i < 5000; ++i) {
    const double tie = (i + 0.5) * 1e-6 + 100;  // of the size of a part, so the noise is real
    for (double x : {std::nextafter(tie, -1e9), tie, std::nextafter(tie, 1e9)}) {
      EXPECT_EQ(q(x), 100000000 + i + 1);
    }
    EXPECT_EQ(q((i + 0.5) * 1e-6), i + 1);
  }
}

TEST(Quantise, IsInvariantUnderTranslationByWholeSteps) {
  std::mt19937_64 random(1);
  const Quantiser q(*GridStep::parse("2^-10"));
  std::uniform_int_distribution<int64_t> fraction(-(int64_t{1} << 30), int64_t{1} << 30);
  for (int i = 0; i < 10000; ++i) {
    const double x = std::ldexp(static_cast<double>(fraction(random)), -30);
    EXPECT_EQ(*q(x + 3), *q(x) + 3 * 1024);
    EXPECT_EQ(*q(x - 3), *q(x) - 3 * 1024);
  }
}

// The truth: floor((4096 x / step + 2049) / 4096) with x / step in long double, where it is far
// enough from a whole number for that to be decided.
TEST(Quantise, AgreesWithExtendedPrecision) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-60, 9);
  int decided = 0;
  for (const GridStep& step :
       {nanometre_step(-6), nanometre_step(0), nanometre_step(4), *GridStep::parse("0.0254"),
        *GridStep::parse("2^-20"), *GridStep::parse("0.003"), *GridStep::parse("7e-5")}) {
    const Quantiser q(step);
    for (int i = 0; i < 20000; ++i) {
      const double x = std::ldexp(mantissa(random), exponent(random));
      const long double scaled =
          ldexpl(static_cast<long double>(x) * step.denominator / step.numerator, -step.exponent) +
          0.5L + 0x1p-12L;
      const long double whole = floorl(scaled);
      if (fabsl(scaled) > 0x1p40L || scaled - whole < 1e-6L || scaled - whole > 1 - 1e-6L) continue;
      ++decided;
      ASSERT_EQ(q(x), static_cast<int64_t>(whole)) << x;
    }
  }
  EXPECT_GT(decided, 80000);
}

// The truth: q <= x / step + 2049 / 4096 < q + 1, in whole numbers.
TEST(Quantise, NeighboursOfWhereTheRoundingTurns) {
  using Int128 = __int128;
  std::mt19937_64 random(3);
  size_t below = 0, above = 0;
  for (const GridStep& step : {nanometre_step(0), nanometre_step(4), *GridStep::parse("0.0254"),
                               *GridStep::parse("2^-20"), *GridStep::parse("0.003")}) {
    const Quantiser q(step);
    for (int i = 0; i < 20000; ++i) {
      const auto turn =
          static_cast<int64_t>(random() >> (38 + random() % 20)) * (random() % 2 == 0 ? 1 : -1);
      const auto place = static_cast<double>(
          ldexpl((static_cast<long double>(turn) - 2049.0L / 4096) * step.numerator /
                     static_cast<long double>(step.denominator),
                 step.exponent));
      double x = place;
      for (int ulps = static_cast<int>(random() % 5); ulps > 0; --ulps) {
        x = std::nextafter(x, random() % 2 == 0 ? HUGE_VAL : -HUGE_VAL);
      }
      const auto rounded = q(x);
      ASSERT_TRUE(rounded.has_value());
      int exponent = 0;
      const auto m = static_cast<int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
      const int shift = step.exponent + 53 - exponent;  // x / step = m den / num / 2^shift
      ASSERT_TRUE(shift >= 0 && shift < 70);
      const Int128 value = Int128{4096} * m * step.denominator;
      const Int128 unit = Int128{step.numerator} << shift;
      ASSERT_LE((Int128{4096} * *rounded - 2049) * unit, value) << x;
      ASSERT_GT((Int128{4096} * (*rounded + 1) - 2049) * unit, value) << x;
      below += *rounded == turn - 1;
      above += *rounded == turn;
    }
  }
  EXPECT_EQ(below + above, 100000u);
  EXPECT_GT(below, 20000u);
  EXPECT_GT(above, 20000u);
}

TEST(Quantise, TinyAndHugeNumbers) {
  const Quantiser q(nanometre_step(0));
  EXPECT_EQ(q(0.0), 0);
  EXPECT_EQ(q(-0.0), 0);
  EXPECT_EQ(q(5e-324), 0);
  EXPECT_EQ(q(-5e-324), 0);
  EXPECT_EQ(q(1e-200), 0);
  EXPECT_EQ(q(-1e-30), 0);
  EXPECT_EQ(q(1e300), std::nullopt);
  EXPECT_EQ(q(NAN), std::nullopt);
  EXPECT_EQ(q(-INFINITY), std::nullopt);
  EXPECT_EQ(q(1000000.0), 1000000000000);
}

}  // namespace
}  // namespace csgrun::grid_test
