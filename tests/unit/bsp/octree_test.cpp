// The octree of a Boolean at its borders: nothing to look at, a stop, boxes that hold nothing.
#include "engine/bsp/octree.h"

#include <atomic>

#include <gtest/gtest.h>

#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun {
namespace {

Octree octree_of(const std::vector<Operand>& operands, const GridBox& region,
                 const KernelOptions& options) {
  Expression expression;
  for (uint32_t o = 0; o < operands.size(); ++o) {
    Expression::Node node;
    node.operand = o;
    expression.nodes.push_back(node);
    expression.children.push_back(o);
  }
  Expression::Node root;
  root.is_operand = false;
  root.op = BooleanOp::kUnion;
  root.child_count = static_cast<uint32_t>(operands.size());
  expression.nodes.push_back(root);
  Job job(operands);
  return build_octree(job, expression, region, options);
}

TEST(Octree, OfAnEmptyRegionHasNoCells) {
  const std::vector<Operand> operands{test::operand_of(test::box_leaf({0, 0, 0}, {4, 4, 4})),
                                      test::operand_of(test::box_leaf({2, 2, 2}, {6, 6, 6}))};
  EXPECT_EQ(octree_of(operands, test::region_of(operands), {}).cells, 1u);
  const Octree none = octree_of(operands, {}, {});
  EXPECT_EQ(none.cells, 0u);
  EXPECT_TRUE(none.critical.empty());
}

TEST(Octree, IsNotDividedOnceCancelled) {
  const std::vector<Operand> operands{test::operand_of(test::box_leaf({0, 0, 0}, {40, 40, 40})),
                                      test::operand_of(test::box_leaf({20, 20, 20}, {60, 60, 60}))};
  const GridBox region = test::region_of(operands);
  KernelOptions options;
  options.cell_limit = 1;
  const uint64_t cells = octree_of(operands, region, options).cells;
  EXPECT_GT(cells, 1u);
  std::atomic<bool> cancel = false;
  options.cancel = &cancel;
  EXPECT_EQ(octree_of(operands, region, options).cells, cells);
  cancel = true;
  EXPECT_EQ(octree_of(operands, region, options).cells, 1u);
}

TEST(GridBox, IsEmptyWhereAnAxisIs) {
  EXPECT_TRUE(GridBox{}.empty());
  for (size_t k = 0; k < 3; ++k) {
    GridBox box{{1, 2, 3}, {4, 5, 6}};
    EXPECT_FALSE(box.empty());
    box.hi[k] = box.lo[k];
    EXPECT_FALSE(box.empty());
    box.hi[k] = box.lo[k] - 1;
    EXPECT_TRUE(box.empty());
  }
}

}  // namespace
}  // namespace csgrun
