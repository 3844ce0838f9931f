// Fractions as text, against GMP.
#include "engine/mesh/rational_text.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

namespace csgrun::testing::rational_text_test {
namespace {

Natural to_natural(const mpz_class& value) {
  Natural limbs;
  for (mpz_class rest = value; rest != 0; rest >>= 64) {
    const mpz_class low = rest & mpz_class("18446744073709551615");
    limbs.push_back(mpz_get_ui(low.get_mpz_t()));
  }
  return limbs;
}

TEST(RationalText, AgreesWithGmp) {
  gmp_randclass random(gmp_randinit_mt);
  random.seed(1);
  int reduced = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const mpz_class common = random.get_z_bits(trial % 7 * 20) + 1;
    const mpz_class above = random.get_z_bits(1 + trial % 400) * common;
    const mpz_class below = (random.get_z_bits(1 + trial % 300) + 1) * common;
    const int exponent = trial % 401 - 200;
    const bool negative = trial % 3 == 0 && above != 0;
    const std::string text =
        rational_text({negative, to_natural(above)}, to_natural(below), exponent);
    mpq_class expected(negative ? mpz_class(-above) : above, below);
    expected.canonicalize();
    if (exponent > 0) expected *= mpq_class(mpz_class(1) << exponent);
    if (exponent < 0) expected /= mpq_class(mpz_class(1) << -exponent);
    EXPECT_EQ(text, expected.get_str()) << "trial " << trial;
    reduced += expected.get_den() == 1 ? 1 : 0;
  }
  EXPECT_GT(reduced, 5);  // to whole numbers
}

TEST(RationalText, Zero) {
  EXPECT_EQ(rational_text({}, natural(7), -3), "0");
  EXPECT_EQ(rational_text({true, natural(14)}, natural(7), -1), "-1");
  EXPECT_EQ(rational_text({false, natural(UInt128{10'000'000'000'000'000'000u})}, natural(1), 0),
            "10000000000000000000");
}

}  // namespace
}  // namespace csgrun::testing::rational_text_test
