// Expressions over leaves for tests of the kernel: evaluation flat or through materialised
// subtrees, and comparison of results as canonical values.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/kernel.h"
#include "engine/mesh/present.h"
#include "tests/support/random_solids.h"

namespace csgrun::test {

/// A Boolean expression; leaves are numbered as in the list of operands given with it.
struct Tree {
  int leaf = -1;
  BooleanOp op = BooleanOp::kUnion;
  std::vector<Tree> children;

  [[nodiscard]] uint32_t leaf_count() const;
  /// Truth at a point from the truths of the leaves.
  [[nodiscard]] bool inside(const std::vector<bool>& of_leaf) const;
  [[nodiscard]] std::string text() const;
};

Tree leaf(int i);
Tree join(std::vector<Tree> c);
Tree meet(std::vector<Tree> c);
Tree less(std::vector<Tree> c);
Tree differ(std::vector<Tree> c);

/// One node over the first `count` operands.
Expression flat_expression(BooleanOp op, uint32_t count);

using Boundary = std::shared_ptr<const BoundaryMesh>;
using BoundaryResult = Result<Boundary>;

Operand operand_of(Leaf leaf);

/// A box of whole steps around all operands.
GridBox region_of(const std::vector<Operand>& operands);

/// Which subtrees are evaluated on their own first; never asked for leaves or the root.
using Materialise = std::function<bool(const Tree&)>;

BoundaryResult evaluate(const Tree& tree, const std::vector<Operand>& leaves,
                        const KernelOptions& options = {}, const Materialise& nest = {});

inline std::string text(const Error& e) { return e.message; }

/// Empty when two boundaries are the same value: points, planes and sides of faces, labels, loops.
/// Which plane names an edge, and which three name a point, is not part of the value.
std::string difference_between(const BoundaryMesh& a, const BoundaryMesh& b,
                               bool compare_labels = true);

/// Steps of 1 mm; as many appearances and sources as a test may name. Points come as fractions,
/// too.
PresentContext test_context();

/// Empty when two presented solids have equal arrays.
std::string difference_between(const Solid& a, const Solid& b);

}  // namespace csgrun::test
