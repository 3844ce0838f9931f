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
std::vector<Rational3> clipped(const std::vector<Rational3>& polygon, const Rational3& n,
                               const mpq_class& d, bool equal);

/// The corners of what two triangles have in common.
std::set<Rational3> common_points(const RationalTriangle& s, const RationalTriangle& t);

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
