// Do the triangles of a solid meet in common corners and edges only? By rational arithmetic on all
// pairs: what two triangles have in common is clipped out of one of them.
#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <csgrun/engine/solid.h>

#include "tests/support/exact_solid.h"

namespace csgrun::test {

using RationalTriangle = std::array<Rational3, 3>;

/// The part of a convex polygon where n . x is at least (or, if `equal`, exactly) d; points may
/// repeat.
inline std::vector<Rational3> clipped(const std::vector<Rational3>& polygon, const Rational3& n,
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

/// The corners of what two triangles have in common.
inline std::set<Rational3> common_points(const RationalTriangle& s, const RationalTriangle& t) {
  const Rational3 n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  std::vector<Rational3> part = clipped({s[0], s[1], s[2]}, n, dot(n, t[0]), true);
  for (int k = 0; k < 3 && !part.empty(); ++k) {
    const Rational3 inward = cross(n, minus(t[(k + 1) % 3], t[k]));
    part = clipped(part, inward, dot(inward, t[k]), false);
  }
  return {part.begin(), part.end()};
}

/// Empty when any two triangles have at most corners and edges of both in common, by coordinates.
/// `at` gives a vertex' exact point. O(n^2) box tests.
template <class At>
std::string fault_in_contacts(const Solid& solid, At&& at) {
  struct Boxed {
    RationalTriangle corner;
    std::array<double, 3> lo, hi;  // of the rounded positions: rounding is monotone
  };
  std::vector<Boxed> all;
  for (const auto& t : solid.triangles) {
    Boxed b{{at(t[0]), at(t[1]), at(t[2])}, {}, {}};
    for (int k = 0; k < 3; ++k) {
      const double x = solid.positions[t[0]][k], y = solid.positions[t[1]][k],
                   z = solid.positions[t[2]][k];
      b.lo[k] = std::min({x, y, z}), b.hi[k] = std::max({x, y, z});
    }
    all.push_back(std::move(b));
  }
  for (size_t i = 0; i < all.size(); ++i) {
    for (size_t j = i + 1; j < all.size(); ++j) {
      const Boxed &s = all[i], &t = all[j];
      bool apart = false;
      for (int k = 0; k < 3; ++k) apart |= s.hi[k] < t.lo[k] || t.hi[k] < s.lo[k];
      if (apart) continue;
      const std::set<Rational3> common = common_points(s.corner, t.corner);
      const auto has = [](const RationalTriangle& c, const Rational3& p) {
        return std::find(c.begin(), c.end(), p) != c.end();
      };
      const bool shared = std::all_of(common.begin(), common.end(), [&](const Rational3& p) {
        return has(s.corner, p) && has(t.corner, p);
      });
      if (!shared || common.size() > 2) {
        const Rational3& p = *common.begin();
        return "two triangles meet near " + std::to_string(p[0].get_d()) + " " +
               std::to_string(p[1].get_d()) + " " + std::to_string(p[2].get_d());
      }
    }
  }
  return "";
}

}  // namespace csgrun::test
