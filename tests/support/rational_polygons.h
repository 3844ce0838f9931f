// Polygons in rationals: what they bound, cover and meet. The truth about cells of an octree.
#pragma once

#include <vector>

#include "tests/support/exact_solid.h"

namespace csgrun::test {

/// 2^-bits.
mpq_class tiny(int bits);

/// a + times b.
Rational3 sum(const Rational3& a, const Rational3& b, const mpq_class& times);

/// The winding number of a closed surface around a point; no edge of it lies in front of the point,
/// seen along x.
int winding_around(const ExactSolid& surface, const Rational3& q);

/// Normal times twice the area.
Rational3 area_of(const std::vector<Rational3>& polygon);

/// Whether a point of the plane of a convex polygon lies inside.
bool covers(const std::vector<Rational3>& polygon, const Rational3& p);

/// Whether a convex polygon meets the box [lo, hi], by clipping it.
bool meets(std::vector<Rational3> polygon, const Rational3& lo, const Rational3& hi);

}  // namespace csgrun::test
