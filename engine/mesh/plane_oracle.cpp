#include "engine/mesh/plane_oracle.h"

#include <cmath>

namespace csgrun {

PlaneOracle::PlaneOracle(PointView& points, const PlaneTable& planes, PlaneId support,
                         size_t in_order)
    : points_(points), in_order_(in_order) {
  const Plane n = planes.oriented(support);
  const auto size = [](Int128 v) { return v < 0 ? -v : v; };
  const int axis = size(n.a) >= size(n.b) && size(n.a) >= size(n.c) ? 0
                   : size(n.b) >= size(n.c)                         ? 1
                                                                    : 2;
  u_ = (axis + 1) % 3;
  v_ = (axis + 2) % 3;
  const Int128 along = axis == 0 ? n.a : axis == 1 ? n.b : n.c;
  sign_ = along > 0 ? 1 : -1;
}

int PlaneOracle::orient(uint32_t a, uint32_t b, uint32_t c) const {
  const auto &p = points_.rounded(a), &q = points_.rounded(b), &r = points_.rounded(c);
  const double qu = q[u_] - p[u_], qv = q[v_] - p[v_], ru = r[u_] - p[u_], rv = r[v_] - p[v_];
  const double left = qu * rv, right = qv * ru;
  const double value = left - right;
  // Coordinates are off by u M each (u = 2^-53, M the largest of them), so differences by at most
  // 2 u M + u |difference|; with differences up to D the products are off by less than
  // 4 u M D + 4 u |product| each, and two more roundings.
  const double m = std::max({std::fabs(p[u_]), std::fabs(p[v_]), std::fabs(q[u_]), std::fabs(q[v_]),
                             std::fabs(r[u_]), std::fabs(r[v_])});
  const double d = std::max({std::fabs(qu), std::fabs(qv), std::fabs(ru), std::fabs(rv)});
  const double bound = 0x1p-49 * (m * d + std::fabs(left) + std::fabs(right));
  if (value > bound) return sign_;
  if (value < -bound) return -sign_;
  return exact_orient(a, b, c) * sign_;
}

int PlaneOracle::exact_orient(uint32_t a, uint32_t b, uint32_t c) const {
  // det [ua va wa; ub vb wb; uc vc wc], all w positive.
  const Point &p = points_.exact(a), &q = points_.exact(b), &r = points_.exact(c);
  const auto at = [](const Point& x, int axis) -> const Int<kPointLimbs>& {
    return axis == 0 ? x.x : axis == 1 ? x.y : x.z;
  };
  const auto determinant = [&]<int Minor, int Full>() {
    const auto minor = [&](const Point& x, const Point& y) {
      return multiply<Minor>(at(x, u_), at(y, v_)) - multiply<Minor>(at(x, v_), at(y, u_));
    };
    return (multiply<Full>(minor(q, r), p.w) + multiply<Full>(minor(r, p), q.w) +
            multiply<Full>(minor(p, q), r.w))
        .sign();
  };
  const int xyz = std::max({p.xyz_bits, q.xyz_bits, r.xyz_bits});
  const int w = std::max({p.w_bits, q.w_bits, r.w_bits});
  if (2 * xyz + 2 < 128 && 2 * xyz + w + 4 < 192) return determinant.template operator()<2, 3>();
  if (2 * xyz + 2 < 448 && 2 * xyz + w + 4 < 640) return determinant.template operator()<7, 10>();
  static_assert(2 * widths::kMaxPointXyz + 2 < 64 * 12 &&
                2 * widths::kMaxPointXyz + widths::kMaxPointW + 4 < 64 * 17);
  return determinant.template operator()<12, 17>();
}

int PlaneOracle::compare(uint32_t a, uint32_t b) const {
  // By x and y, two different points of the plane cannot agree in both. The numbers follow the
  // rounded coordinates: where those along x are equal, the exact ones may be the other way round.
  if (u_ == 0 && v_ == 1 && a < in_order_ && b < in_order_ &&
      points_.rounded(a)[0] != points_.rounded(b)[0]) {
    return a < b ? -1 : 1;
  }
  const int by_u = points_.compare_along(a, b, u_);
  return by_u ? by_u : points_.compare_along(a, b, v_);
}

}  // namespace csgrun
