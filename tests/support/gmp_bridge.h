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

mpz_class to_gmp(Int128 v);

template <int N>
Int<N> from_gmp(const mpz_class& v) {
  Int<N> r;
  mpz_export(r.limb.data(), nullptr, -1, 8, 0, 0, v.get_mpz_t());
  return v < 0 ? -r : r;
}

struct GmpPoint {
  mpz_class x, y, z, w;
};

GmpPoint to_gmp(const Point& p);

int gmp_side(const Plane& s, const GmpPoint& p);

}  // namespace csgrun::test
