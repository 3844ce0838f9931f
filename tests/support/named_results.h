// Results that name untouched triangles of leaves, and the same results spelled out: what both are
// made from, and whether they are one value.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/support/kernel_case.h"

namespace csgrun::test {

/// A leaf whose facets are its triangles, of several loops each a closed surface.
std::shared_ptr<LeafGeometry> leaf_of_triangles(const std::vector<Loop>& loops);

void add_quad(std::vector<Loop>& loops, const IVec3& a, const IVec3& b, const IVec3& c,
              const IVec3& d, bool turned);

/// The surface of a box in n x n squares a side, each of two triangles.
std::vector<Loop> tiled_box(Random& random, const IVec3& lo, int64_t n, int64_t step);

/// A torus with bumps: nothing of it lies in one plane with anything else.
std::vector<Loop> bumpy_torus(Random& random, const IVec3& center, double size);

std::vector<Loop> operator+(std::vector<Loop> a, const std::vector<Loop>& b);

std::string difference_of_arrays(const Solid& a, const Solid& b);

/// Counts what was named, so that a test can tell whether it tested anything.
size_t named(const BoundaryMesh& mesh);

struct Pair {
  Boundary spelled, naming;
};

void expect_one_value(const Pair& pair, const std::string& what);

Pair evaluate_both(const Tree& tree, const std::vector<Operand>& operands);

/// An expression over the given leaves in this order; every node has two children.
Tree random_binary_tree(Random& random, int first, int count);

Operand placed(Leaf leaf, const IVec3& at);

}  // namespace csgrun::test
