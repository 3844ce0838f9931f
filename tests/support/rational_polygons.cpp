#include "tests/support/rational_polygons.h"

#include <algorithm>

namespace csgrun::test {

mpq_class tiny(int bits) { return {mpz_class(1), mpz_class(1) << bits}; }

Rational3 sum(const Rational3& a, const Rational3& b, const mpq_class& times) {
  return {a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2]};
}

int winding_around(const ExactSolid& surface, const Rational3& q) {
  int winding = 0;
  for (const auto& face : surface.faces) {
    const auto& loop = face.loops[0];
    // Most faces are plainly beside it.
    const auto all = [&](const auto& holds) {
      return std::all_of(loop.begin(), loop.end(),
                         [&](uint32_t v) { return holds(surface.points[v]); });
    };
    if (all([&](const Rational3& p) { return p[1] < q[1]; }) ||
        all([&](const Rational3& p) { return p[1] > q[1]; }) ||
        all([&](const Rational3& p) { return p[2] < q[2]; }) ||
        all([&](const Rational3& p) { return p[2] > q[2]; }) ||
        all([&](const Rational3& p) { return p[0] < q[0]; })) {
      continue;
    }
    for (size_t i = 1; i + 1 < loop.size(); ++i) {
      const Rational3 a = minus(surface.points[loop[0]], q), b = minus(surface.points[loop[i]], q),
                      c = minus(surface.points[loop[i + 1]], q);
      const auto turn = [](const Rational3& u, const Rational3& v) {
        return sgn(mpq_class(u[1] * v[2] - u[2] * v[1]));
      };
      const int side = turn(a, b);
      if (side == 0 || side != turn(b, c) || side != turn(c, a)) continue;
      // The triangle is ahead along x, not behind.
      const int volume = sgn(dot(a, cross(b, c)));
      if (volume == side) winding += side;
    }
  }
  return winding;
}

Rational3 area_of(const std::vector<Rational3>& polygon) {
  Rational3 area{0, 0, 0};
  for (size_t i = 1; i + 1 < polygon.size(); ++i) {
    area = sum(area, cross(minus(polygon[i], polygon[0]), minus(polygon[i + 1], polygon[0])), 1);
  }
  return area;
}

bool covers(const std::vector<Rational3>& polygon, const Rational3& p) {
  const Rational3 n = area_of(polygon);
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Rational3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (dot(n, cross(minus(b, a), minus(p, a))) < 0) return false;
  }
  return true;
}

bool meets(std::vector<Rational3> polygon, const Rational3& lo, const Rational3& hi) {
  for (int k = 0; k < 3; ++k) {
    for (int upper = 0; upper < 2; ++upper) {
      const auto depth = [&](const Rational3& p) -> mpq_class {
        return upper ? mpq_class(hi[k] - p[k]) : mpq_class(p[k] - lo[k]);
      };
      std::vector<Rational3> rest;
      for (size_t i = 0; i < polygon.size(); ++i) {
        const Rational3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const mpq_class s = depth(p), t = depth(q);
        if (s >= 0) rest.push_back(p);
        if (s * t < 0) {
          Rational3 x;
          for (int j = 0; j < 3; ++j) x[j] = p[j] + (q[j] - p[j]) * s / (s - t);
          rest.push_back(x);
        }
      }
      polygon = rest;
    }
  }
  return !polygon.empty();
}

}  // namespace csgrun::test
