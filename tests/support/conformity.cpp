#include "tests/support/conformity.h"

namespace csgrun::test {

std::vector<Rational3> clipped(const std::vector<Rational3>& polygon, const Rational3& n,
                               const mpq_class& d, bool equal) {
  std::vector<Rational3> kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Rational3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const mpq_class s = dot(n, p) - d, t = dot(n, q) - d;
    if (s == 0 || (s > 0 && !equal)) kept.push_back(p);
    if (s * t < 0) {
      const mpq_class r = s / (s - t);
      Rational3 x;
      for (int k = 0; k < 3; ++k) x[k] = p[k] + r * (q[k] - p[k]);
      kept.push_back(x);
    }
  }
  return kept;
}

std::set<Rational3> common_points(const RationalTriangle& s, const RationalTriangle& t) {
  const Rational3 n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  std::vector<Rational3> part = clipped({s[0], s[1], s[2]}, n, dot(n, t[0]), true);
  for (int k = 0; k < 3 && !part.empty(); ++k) {
    const Rational3 inward = cross(n, minus(t[(k + 1) % 3], t[k]));
    part = clipped(part, inward, dot(inward, t[k]), false);
  }
  return {part.begin(), part.end()};
}

}  // namespace csgrun::test
