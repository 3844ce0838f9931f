// Pairs of polygons against rationals: the part of each on the line of both planes.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/bsp/pair_test.h"
#include "tests/support/exact_solid.h"

namespace csgrun::test {

using Corners = std::vector<Rational3>;

Rational3 normal_of(const Corners& c);

/// The part of a polygon in the plane of another one, along d.
using Interval = std::optional<std::pair<mpq_class, mpq_class>>;
Interval interval_of(const Corners& c, const Corners& plane, const Rational3& d);

/// How many corners of a polygon are in front of another one's plane and behind it, and which are
/// on it.
struct Sides {
  int front = 0, back = 0;
  std::vector<size_t> on;
};
Sides sides_of(const Corners& c, const Corners& plane);

/// The part of a polygon that is in another one of its plane, with its rim: no corners if there is
/// none, equal ones if it is a point.
Corners common_part(Corners c, const Corners& other);

Corners corners_of(const Job& job, uint32_t polygon);

mpq_class place_of(Job& job, const Contact& c, const Contact::End& end, const Rational3& d);

struct Seen {
  int apart = 0, plain = 0, touching = 0, coplanar = 0, unsure = 0;
  int flat_apart = 0, flat_corner = 0;  ///< pairs in one plane
};

/// A pair in one plane.
void check_flat_pair(const Job& job, const PairTest& test, Meeting met, const Contact& contact,
                     bool is_exact, Seen& seen);

/// Of all vertices.
std::vector<uint32_t> numbers_of_vertices(const Job& job, CellGeometry& geometry);

/// With planes every other pair is told where vertices are equal.
void check_pairs(const std::vector<Operand>& operands, bool with_planes, Seen& seen);

}  // namespace csgrun::test
