#include "engine/exact/point.h"

#include <algorithm>
#include <cassert>

#include "engine/exact/rounding.h"

namespace csgrun {
namespace {

using Coordinate = Int<kPointLimbs>;

/// Cramer's rule with R limbs for the results and C for the 2x2 minors of the normals.
template <int NormalLimbs, int C, int R>
Point cramer(const Plane& p, const Plane& q, const Plane& r) {
  using Normal = Int<NormalLimbs>;
  const auto normal = [](Int128 v) { return Normal::from_int128(v); };
  const auto minor = [](const Normal& a, const Normal& b, const Normal& c, const Normal& d) {
    return multiply<C>(a, d) - multiply<C>(b, c);
  };
  const Normal pa = normal(p.a), pb = normal(p.b), pc = normal(p.c);
  const Normal qa = normal(q.a), qb = normal(q.b), qc = normal(q.c);
  const Normal ra = normal(r.a), rb = normal(r.b), rc = normal(r.c);
  // qr = q.n x r.n, and cyclic.
  const Int<C> qr_x = minor(qb, qc, rb, rc), qr_y = minor(qc, qa, rc, ra),
               qr_z = minor(qa, qb, ra, rb);
  const Int<C> rp_x = minor(rb, rc, pb, pc), rp_y = minor(rc, ra, pc, pa),
               rp_z = minor(ra, rb, pa, pb);
  const Int<C> pq_x = minor(pb, pc, qb, qc), pq_y = minor(pc, pa, qc, qa),
               pq_z = minor(pa, pb, qa, qb);
  const Int<2> pd = Int<2>::from_int128(p.d), qd = Int<2>::from_int128(q.d),
               rd = Int<2>::from_int128(r.d);
  const auto combine = [&](const Int<C>& qr, const Int<C>& rp, const Int<C>& pq) {
    return -(multiply<R>(qr, pd) + multiply<R>(rp, qd) + multiply<R>(pq, rd));
  };
  Point result;
  const Int<R> w = multiply<R>(qr_x, pa) + multiply<R>(qr_y, pb) + multiply<R>(qr_z, pc);
  assert(!w.is_zero());
  const bool turn = w.negative();
  const auto store = [turn](const Int<R>& v) { return Coordinate::from(turn ? -v : v); };
  result.x = store(combine(qr_x, rp_x, pq_x));
  result.y = store(combine(qr_y, rp_y, pq_y));
  result.z = store(combine(qr_z, rp_z, pq_z));
  result.w = store(w);
  return result;
}

/// The same where machine integers of 64 bits hold the normals and 128 bits the results, modulo
/// which sums are taken.
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
  Point result;
  // 62 bits of normal: minors of 126 bits fit two limbs, and all fits four.
  static_assert(widths::point_xyz(62, widths::kMaxOffset) < 256 && widths::point_w(62) < 256);
  if (std::max({n0, n1, n2}) > 62) {
    static_assert(widths::kMaxPointXyz < 64 * kPointLimbs);
    result = cramer<2, 4, kPointLimbs>(p, q, r);
  } else if (needed < 192) {
    result = cramer<1, 2, 3>(p, q, r);
  } else {
    result = cramer<1, 2, 4>(p, q, r);
  }
  measure(result);
  return result;
}

std::array<double, 3> rounded(const Point& p) {
  const auto quotients = [&]<int N>() -> std::array<double, 3> {
    const auto w = Int<N>::from(p.w);
    return {round_to_double(Int<N>::from(p.x), w), round_to_double(Int<N>::from(p.y), w),
            round_to_double(Int<N>::from(p.z), w)};
  };
  if (std::max(p.xyz_bits, p.w_bits) < 256) return quotients.template operator()<4>();
  return quotients.template operator()<kQuotientLimbs>();
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
