// Our integers as GMP's, for comparison with an independent implementation.
#pragma once

#include <gmpxx.h>

#include "engine/exact/fixed_int.h"
#include "engine/exact/plane.h"
#include "engine/exact/point.h"

namespace csgrun::test {

template <int N>
mpz_class to_gmp(const Int<N>& v) {
  const Int<N> m = v.magnitude();
  mpz_class r;
  mpz_import(r.get_mpz_t(), N, -1, 8, 0, 0, m.limb.data());
  return v.negative() ? mpz_class(-r) : r;
}

inline mpz_class to_gmp(Int128 v) { return to_gmp(Int<2>::from_int128(v)); }

template <int N>
Int<N> from_gmp(const mpz_class& v) {
  Int<N> r;
  mpz_export(r.limb.data(), nullptr, -1, 8, 0, 0, v.get_mpz_t());
  return v < 0 ? -r : r;
}

inline Int128 int128_from_gmp(const mpz_class& v) {
  const Int<2> r = from_gmp<2>(v);
  return static_cast<Int128>(static_cast<UInt128>(r.limb[1]) << 64 | r.limb[0]);
}

struct GmpPoint {
  mpz_class x, y, z, w;
};

inline GmpPoint to_gmp(const Point& p) {
  return {to_gmp(p.x), to_gmp(p.y), to_gmp(p.z), to_gmp(p.w)};
}

inline int gmp_side(const Plane& s, const GmpPoint& p) {
  return sgn(
      mpz_class(to_gmp(s.a) * p.x + to_gmp(s.b) * p.y + to_gmp(s.c) * p.z + to_gmp(s.d) * p.w));
}

}  // namespace csgrun::test
