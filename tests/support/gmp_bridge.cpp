#include "tests/support/gmp_bridge.h"

namespace csgrun::test {

mpz_class to_gmp(Int128 v) { return to_gmp(Int<2>::from_int128(v)); }

Int128 int128_from_gmp(const mpz_class& v) {
  const Int<2> r = from_gmp<2>(v);
  return static_cast<Int128>(static_cast<UInt128>(r.limb[1]) << 64 | r.limb[0]);
}

GmpPoint to_gmp(const Point& p) { return {to_gmp(p.x), to_gmp(p.y), to_gmp(p.z), to_gmp(p.w)}; }

int gmp_side(const Plane& s, const GmpPoint& p) {
  return sgn(
      mpz_class(to_gmp(s.a) * p.x + to_gmp(s.b) * p.y + to_gmp(s.c) * p.z + to_gmp(s.d) * p.w));
}

}  // namespace csgrun::test
