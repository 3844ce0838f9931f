// One case of the fuzzer of expressions: leaves on a tiny grid, frames, a tree of Booleans and
// hulls, and how the kernel is told to evaluate it. It can be written as text and read again.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include <csgrun/engine/csg_tree.h>

#include "tests/support/kernel_case.h"

namespace csgrun::test {

struct FuzzLeaf {
  std::vector<Loop> faces;  ///< convex, planar, counter-clockwise from outside
  FillRule fill = FillRule::kNonZero;
  bool may_cross = false;  ///< otherwise it does not cross itself
  bool keep_facets = false;
  uint32_t appearance = 0;
  IVec3 move{0, 0, 0};  ///< within its frame
  uint32_t frame = 0;
};

/// A leaf, a Boolean, or the outer hull of its only child.
struct FuzzNode {
  int leaf = -1;
  BooleanOp op = BooleanOp::kUnion;
  std::optional<OuterHull> hull;
  std::vector<FuzzNode> children;

  [[nodiscard]] size_t node_count() const;
  [[nodiscard]] size_t leaf_count() const;
};

/// Of FuzzCase::nest: operands are taken one after another, each result being in pieces.
constexpr uint64_t kInPieces = uint64_t{1} << 63;
/// The same: what nothing touched of leaves of triangles is named in results, not spelled out.
constexpr uint64_t kNamed = uint64_t{1} << 62;
/// The same: leaves are as the engine prepares them, and know much of their surfaces.
constexpr uint64_t kPrepared = uint64_t{1} << 61;

struct FuzzCase {
  std::vector<Frame> frames{Frame()};  ///< the first is the world
  std::vector<FuzzLeaf> leaves;        ///< each is mentioned once, in order
  FuzzNode tree;
  KernelOptions options;
  uint64_t nest = 0;  ///< bit i: the i-th inner node is materialised on its own; more: see above
};

LeafGeometry geometry_of(const FuzzLeaf& leaf);

void write(std::ostream& out, const FuzzNode& n);

std::string text(const FuzzCase& c);

std::optional<FuzzCase> read_fuzz_case(const std::string& given);

}  // namespace csgrun::test
