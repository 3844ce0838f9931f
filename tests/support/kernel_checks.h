// What a result must satisfy, whatever made it: membership by brute force, and arrays that are a
// closed, oriented 2-manifold which fills the boundary's faces exactly.
#pragma once

#include <string>
#include <vector>

#include "tests/support/kernel_case.h"
#include "tests/support/oracle.h"

namespace csgrun::test {

/// How many cases: CSGRUN_CASES, or so many in an ordinary run.
int cases(int ordinary);

/// A point near something: a vertex, or between two of them, moved a little or a lot.
Query random_query(Random& random, const ExactSolid& s);

/// Asks both the result and the expression at points near features of either: empty, or a point
/// where they differ.
std::string disagreement(Random& random, const Tree& tree, const std::vector<Oracle>& leaves,
                         const BoundaryMesh& result, int points);

KernelOptions random_options(Random& random);

Tree random_tree(Random& random, int first, int last);

/// Empty when the arrays are a closed, oriented 2-manifold by index: every directed edge once and
/// its reverse once, and one fan of triangles around each vertex.
std::string fault_in(const Solid& solid);

/// The exact points of a solid that was presented with them, by Solid::point_of.
std::vector<Rational3> exact_points(const Solid& solid);

/// Empty when `solid`, made by test_context, presents `mesh`: closed by index, and its triangles,
/// at the exact points, all turn the same way as their face, add up to its area, and meet in common
/// corners and edges only.
std::string fault_in(const Solid& solid, const BoundaryMesh& mesh);

}  // namespace csgrun::test
