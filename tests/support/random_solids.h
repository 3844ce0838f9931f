// Random closed polyhedra on a small grid, so that everything meets everything: shared planes,
// edges and vertices, touching and nested parts are the rule. All satisfy the invariants of
// LeafGeometry; none crosses itself.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/bsp/operand.h"
#include "tests/support/seeded.h"

namespace csgrun::test {

using Loop = std::vector<IVec3>;
using Leaf = std::shared_ptr<const LeafGeometry>;

inline IVec3 sub(const IVec3& a, const IVec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline IVec3 cross_of(const IVec3& a, const IVec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline int64_t dot_of(const IVec3& a, const IVec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// A leaf of convex loops, counter-clockwise from outside. `keep_facets`: each face is a facet of
/// its own, as in an import.
Leaf make_leaf(const std::vector<Loop>& faces, bool keep_facets = false, uint32_t surface = 0,
               uint32_t appearance = 0);

std::vector<Loop> loops_of(const LeafGeometry& leaf);

std::vector<Loop> box_loops(const IVec3& lo, const IVec3& hi);
/// A box with a corner in the middle of its edge upwards from `lo`, at which no face turns.
/// REQUIRES: an even height.
std::vector<Loop> box_with_middle(const IVec3& lo, const IVec3& hi);
/// The loops with the middle of each edge as a corner, which is in line with its neighbours.
/// REQUIRES: even coordinates.
std::vector<Loop> with_middles(std::vector<Loop> loops);

Leaf box_leaf(const IVec3& lo, const IVec3& hi);

/// An integer affine map of the loops; a mirror turns them round.
struct GridMap {
  std::array<IVec3, 3> rows{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  IVec3 move{0, 0, 0};
};
std::vector<Loop> mapped(std::vector<Loop> loops, const GridMap& map);

using Point2 = std::array<int64_t, 2>;
inline int64_t turn2(const Point2& a, const Point2& b, const Point2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}
bool on_segment2(const Point2& a, const Point2& b, const Point2& p);
bool segments_meet2(const Point2& a, const Point2& b, const Point2& c, const Point2& d);

bool is_simple(const std::vector<Point2>& p);

/// Counter-clockwise, 3 to 8 corners in {0..size}^2; 180 degree corners occur.
std::vector<Point2> random_polygon(Random& random, int64_t size = 5);

/// Triangles of a simple polygon, by cutting off ears of positive area.
std::vector<std::array<Point2, 3>> triangles_of(std::vector<Point2> p);

std::vector<Loop> prism_loops(const std::vector<Point2>& base, int64_t z0, int64_t z1);

/// A cone over a polygon in the plane z = `z`; closed by the polygon or by a second cone.
std::vector<Loop> cone_loops(const std::vector<Point2>& base, int64_t z, const IVec3& apex,
                             const std::optional<IVec3>& below);

/// The convex hull of a few points by trying all planes; empty when they are coplanar.
std::vector<Loop> hull_loops(const std::vector<IVec3>& points);

int64_t six_volumes(const std::vector<Loop>& loops);

void turn_over(std::vector<Loop>& loops);

/// The boundary of a random set of tetrahedra of a triangulated grid: any genus, cavities, parts
/// that touch in edges and vertices.
std::vector<Loop> complex_loops(Random& random, int64_t size = 5);

/// Loops of a random solid with vertices in {0..size}^3, size at least 3.
std::vector<Loop> random_loops(Random& random, int64_t size = 5);

/// A tent over a polygon that has corners in the middle of its edges: the walls have one of two
/// tips, and those beside such a corner may not lie in one plane. Empty where they cross.
std::vector<Loop> tent_loops(Random& random, int64_t size);

/// Some are as the engine prepares them.
Leaf random_leaf(Random& random);

/// An integer map whose entries have up to `bits` bits, not singular.
GridMap random_map(Random& random, int bits);

}  // namespace csgrun::test
