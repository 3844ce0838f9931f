#include "tests/support/reference/solids.h"

namespace csgrun::reference {

void reduce(Point& p) {
  mpz_class common = 0;
  for (const auto& c : p) common = gcd(common, c);
  if (p[3] < 0) common = -common;
  if (common == 1) return;
  for (auto& c : p) mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), common.get_mpz_t());
}

std::string plane_of(const std::vector<Point>& points, const Face& face, Plane& plane, bool& down) {
  // The area vector: sum of (p - o) x (q - o) over the edges, as one integer vector times a factor.
  const Point& o = points[face.loops[0][0]];
  std::array<mpq_class, 3> normal{0, 0, 0};
  const auto from = [&](uint32_t i) {
    std::array<mpq_class, 3> r;
    for (int k = 0; k < 3; ++k) {
      r[k] = mpq_class(points[i][k] * o[3] - o[k] * points[i][3], points[i][3]);
      r[k].canonicalize();
    }
    return r;
  };
  for (const auto& loop : face.loops) {
    std::array<mpq_class, 3> p = from(loop.back());
    for (const uint32_t i : loop) {
      const std::array<mpq_class, 3> q = from(i);
      for (int k = 0; k < 3; ++k) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        normal[k] += p[u] * q[v] - p[v] * q[u];
      }
      p = q;
    }
  }
  mpz_class common = o[3];
  for (const auto& n : normal) common *= n.get_den();
  plane.c[3] = 0;
  for (int k = 0; k < 3; ++k) {
    plane.c[k] = mpq_class(normal[k] * common).get_num();
    plane.c[3] -= plane.c[k] * o[k];
  }
  for (int k = 0; k < 3; ++k) plane.c[k] *= o[3];
  plane.axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (abs(plane.c[k]) > abs(plane.c[plane.axis])) plane.axis = k;
  }
  if (plane.c[plane.axis] == 0) return "a face without area";
  down = plane.c[plane.axis] < 0;
  mpz_class divisor = 0;
  for (const auto& c : plane.c) divisor = gcd(divisor, c);
  if (down) divisor = -divisor;
  for (auto& c : plane.c) c /= divisor;
  for (const auto& loop : face.loops) {
    for (const uint32_t i : loop) {
      const Point& p = points[i];
      if (plane.c[0] * p[0] + plane.c[1] * p[1] + plane.c[2] * p[2] + plane.c[3] * p[3] != 0) {
        return "a face that is not planar";
      }
    }
  }
  return "";
}

}  // namespace csgrun::reference
