#include "tests/support/gmp_bridge.h"

namespace csgrun::test {

mpz_class to_gmp(Int128 v) { return to_gmp(Int<2>::from_int128(v)); }

GmpPoint to_gmp(const Point& p) { return {to_gmp(p.x), to_gmp(p.y), to_gmp(p.z), to_gmp(p.w)}; }

int gmp_side(const Plane& s, const GmpPoint& p) {
  return sgn(
      mpz_class(to_gmp(s.a) * p.x + to_gmp(s.b) * p.y + to_gmp(s.c) * p.z + to_gmp(s.d) * p.w));
}

}  // namespace csgrun::test
