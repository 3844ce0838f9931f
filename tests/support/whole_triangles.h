// Triangles of whole numbers, for what looks at them in floats.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/base/vec3d.h"
#include "tests/support/seeded.h"

namespace csgrun::test {

using csgrun::cross;  // beside those of rational vectors
using csgrun::dot;
using csgrun::minus;
using Vec = Vec3d;  // whole numbers
using Triangle = std::array<Vec, 3>;

inline Vec edge(const Triangle& t, size_t i) { return minus(t[(i + 1) % 3], t[i]); }
inline Vec normal(const Triangle& t) { return cross(edge(t, 0), edge(t, 1)); }

/// The room between two triangles along a direction, times its length; negative where they overlap.
double gap(const Triangle& s, const Triangle& t, const Vec& way);

/// Exactly, for small coordinates: convex sets are apart when one of these directions parts them.
bool are_apart(const Triangle& s, const Triangle& t);

/// The most room that the slabs of s leave to t.
double most_room(const Triangle& s, const Triangle& t);

Triangle random_triangle(Random& random, int64_t reach);

/// One near another one: some are slivers nearly along a side of it, some of the same plane.
Triangle random_neighbour(const Triangle& own, Random& random, int64_t size);

Triangle scaled(Triangle t, double factor, const Vec& move);

/// Three times as large and moved, with a corner of another one that was treated so, or one inside
/// of it.
Triangle random_touching(const Triangle& own, Random& random, int64_t size, const Vec& move);

}  // namespace csgrun::test
