// Boxes on their lattice against the same boxes cut cell by cell, and against what each cell of
// space is.
#include "engine/bsp/evaluate_boxes.h"

#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include "engine/bsp/box_lattice.h"
#include "engine/bsp/kernel.h"
#include "tests/support/boundary_compare.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"
#include "tests/support/random_trees.h"

namespace csgrun::evaluate_boxes_test {
namespace {

using test::RandomTree;

/// A random expression in which each operand stands once, by ascending numbers.
uint32_t add_node(test::Random& random, Expression& e, uint32_t first, uint32_t count) {
  Expression::Node node;
  if (count == 1) {
    node.operand = first;
  } else {
    node.is_operand = false;
    node.op = static_cast<BooleanOp>(random.integer(0, 2));
    std::vector<uint32_t> children;
    // Now and then an operand of before once more.
    if (!e.nodes.empty() && random.integer(0, 3) == 0) {
      children.push_back(
          static_cast<uint32_t>(random.integer(0, static_cast<int64_t>(e.nodes.size()) - 1)));
    }
    for (uint32_t o = first; o < first + count;) {
      const uint32_t left = first + count - o;
      uint32_t size = static_cast<uint32_t>(random.integer(1, left));
      if (size == count) --size;
      children.push_back(add_node(random, e, o, size));
      o += size;
    }
    node.first_child = static_cast<uint32_t>(e.children.size());
    node.child_count = static_cast<uint32_t>(children.size());
    e.children.insert(e.children.end(), children.begin(), children.end());
  }
  e.nodes.push_back(node);
  return static_cast<uint32_t>(e.nodes.size() - 1);
}

RandomTree random_boxes(test::Random& random, uint32_t count, int64_t size) {
  RandomTree tree;
  for (uint32_t o = 0; o < count; ++o) {
    IVec3 lo, hi;
    for (size_t k = 0; k < 3; ++k) {
      lo[k] = random.integer(-size, size - 1);
      hi[k] = random.integer(lo[k] + 1, size);
    }
    auto leaf = std::make_shared<LeafGeometry>(*test::box_leaf(lo, hi));
    // Sides of several kinds, so that labels tell which side of which operand was taken.
    std::vector<uint32_t> kinds(6);
    for (uint32_t& kind : kinds) kind = static_cast<uint32_t>(random.integer(0, 2));
    leaf->surface = kinds;
    Operand& operand = tree.operands.emplace_back();
    operand.leaf = leaf;
    operand.first_source = o;
    if (random.integer(0, 3) == 0) operand.appearance = 7;
    for (int64_t& t : operand.translation) t = random.integer(-1, 1);
  }
  add_node(random, tree.expression, 0, count);
  tree.region = test::TreeMaker::region_of(tree.operands);
  return tree;
}

bool is_inside(const RandomTree& tree, const IVec3& cell) {
  std::vector<bool> value;
  for (const Expression::Node& n : tree.expression.nodes) {
    if (n.is_operand) {
      const Operand& o = tree.operands[n.operand];
      bool inside = true;
      for (size_t k = 0; k < 3; ++k) {
        const auto& vertices = o.leaf->vertices;
        int64_t lo = vertices[0][k], hi = lo;
        for (const IVec3& v : vertices) lo = std::min(lo, v[k]), hi = std::max(hi, v[k]);
        const int64_t at = cell[k] - o.translation[k];
        inside = inside && lo <= at && at < hi;
      }
      value.push_back(inside);
      continue;
    }
    const auto child = [&](uint32_t c) { return value[tree.expression.children[c]]; };
    bool result = child(n.first_child);
    for (uint32_t c = n.first_child + 1; c < n.first_child + n.child_count; ++c) {
      if (n.op == BooleanOp::kUnion) result = result || child(c);
      if (n.op == BooleanOp::kIntersection) result = result && child(c);
      if (n.op == BooleanOp::kDifference) result = result && !child(c);
    }
    value.push_back(result);
  }
  return value.back();
}

/// Whether the surface around a grid point is in several pieces, or meets in an edge of four faces.
bool touches_itself(const RandomTree& tree, const IVec3& point) {
  const auto inside = [&](int x, int y, int z) {
    return is_inside(tree, {point[0] - (x < 0), point[1] - (y < 0), point[2] - (z < 0)});
  };
  // The twelve squares, by the two half-edges that bound them: 0, 1 along -x, +x, 2, 3 along y, ...
  std::vector<std::array<int, 2>> squares;
  for (int a = 0; a < 3; ++a) {
    for (int b = a + 1; b < 3; ++b) {
      const int normal = 3 - a - b;
      for (int s : {-1, 1}) {
        for (int t : {-1, 1}) {
          std::array<int, 3> at;
          at[a] = s, at[b] = t;
          at[normal] = -1;
          const bool below = inside(at[0], at[1], at[2]);
          at[normal] = 1;
          if (below != inside(at[0], at[1], at[2])) {
            squares.push_back({2 * a + (s > 0), 2 * b + (t > 0)});
          }
        }
      }
    }
  }
  std::array<int, 6> at_edge{};
  std::array<int, 6> piece;
  std::iota(piece.begin(), piece.end(), 0);
  for (const auto& [e, f] : squares) {
    ++at_edge[e], ++at_edge[f];
    const int from = piece[e], to = piece[f];
    for (int& p : piece) p = p == from ? to : p;
  }
  std::set<int> pieces;
  for (int e = 0; e < 6; ++e) {
    if (at_edge[e] > 2) return true;
    if (at_edge[e] > 0) pieces.insert(piece[e]);
  }
  return pieces.size() > 1;
}

std::shared_ptr<const BoundaryMesh> cell_by_cell(const RandomTree& tree) {
  KernelOptions options;
  options.whole_faces = false;
  EvaluateStats stats;
  const auto result = evaluate_boolean(tree.operands, tree.expression, tree.region, options, stats);
  EXPECT_TRUE(result) << result.error().message;
  return *result;
}

bool applies(const RandomTree& tree) {
  EvaluateStats stats;
  return evaluate_boxes(tree.operands, tree.expression, {}, stats).has_value();
}

TEST(EvaluateBoxes, GivesWhatCellsGive) {
  test::Random random(501);
  for (int i = 0; i < 400; ++i) {
    const auto tree =
        random_boxes(random, static_cast<uint32_t>(random.integer(1, 9)), random.integer(1, 8));
    EvaluateStats stats;
    const auto result = evaluate_boxes(tree.operands, tree.expression, {}, stats);
    ASSERT_TRUE(result && *result);
    ASSERT_EQ(test::first_difference(***result, *cell_by_cell(tree)), "") << "tree " << i;
  }
}

TEST(EvaluateBoxes, KnowsWhereItTouchesItself) {
  test::Random random(502);
  int touching = 0, apart = 0;
  for (int i = 0; i < 300; ++i) {
    const auto tree = random_boxes(random, static_cast<uint32_t>(random.integer(2, 8)), 2);
    EvaluateStats stats;
    const auto result = evaluate_boxes(tree.operands, tree.expression, {}, stats);
    ASSERT_TRUE(result && *result);
    const BoundaryMesh& mesh = ***result;
    ASSERT_EQ(mesh.may_touch, !mesh.touches.empty());
    bool any = false;
    for (int64_t x = -3; x <= 3; ++x) {
      for (int64_t y = -3; y <= 3; ++y) {
        for (int64_t z = -3; z <= 3; ++z) {
          if (!touches_itself(tree, {x, y, z})) continue;
          any = true;
          ASSERT_TRUE(std::any_of(mesh.touches.begin(), mesh.touches.end(),
                                  [&](const GridBox& b) {
                                    return b.lo[0] <= x && x <= b.hi[0] && b.lo[1] <= y &&
                                           y <= b.hi[1] && b.lo[2] <= z && z <= b.hi[2];
                                  }))
              << "tree " << i << " at " << x << ' ' << y << ' ' << z;
        }
      }
    }
    ASSERT_EQ(mesh.may_touch, any) << "tree " << i;
    ++(any ? touching : apart);
  }
  EXPECT_GT(touching, 20);
  EXPECT_GT(apart, 20);
}

// Many windows of cells: a row of boxes through a block, and all of it far from the origin.
TEST(EvaluateBoxes, LatticesOfManyWindows) {
  RandomTree tree;
  const auto add = [&](const IVec3& lo, const IVec3& hi) {
    tree.operands.emplace_back().leaf = test::box_leaf(lo, hi);
    tree.operands.back().first_source = static_cast<uint32_t>(tree.operands.size() - 1);
    tree.operands.back().translation = {-1000, 5000, 90000};
  };
  add({0, 0, 0}, {60, 60, 9});
  for (int64_t i = 0; i < 14; ++i) {
    for (int64_t j = 0; j < 14; ++j) {
      add({4 * i + 1, 4 * j + 1, -1},
          {4 * i + 3 + (i + j) % 3 / 2, 4 * j + 3, i % 3 == 0 ? 5 : 10});
    }
  }
  Expression::Node root;
  root.is_operand = false;
  root.op = BooleanOp::kDifference;
  for (uint32_t o = 0; o < tree.operands.size(); ++o) {
    tree.expression.nodes.emplace_back().operand = o;
    tree.expression.children.push_back(o);
  }
  root.child_count = static_cast<uint32_t>(tree.operands.size());
  tree.expression.nodes.push_back(root);
  tree.region = test::TreeMaker::region_of(tree.operands);
  EvaluateStats stats;
  const auto result = evaluate_boxes(tree.operands, tree.expression, {}, stats);
  ASSERT_TRUE(result && *result);
  EXPECT_EQ(test::first_difference(***result, *cell_by_cell(tree)), "");
  EXPECT_GT(stats.solved_cells, 100u);
  EXPECT_LE(stats.solved_cells, stats.surface_cells);
  EXPECT_LT(stats.surface_cells, stats.cells);
}

TEST(EvaluateBoxes, IsForBoxesOnly) {
  test::Random random(503);
  const auto tree = random_boxes(random, 3, 4);
  ASSERT_TRUE(applies(tree));
  const auto with_leaf = [&](test::Leaf leaf) {
    RandomTree other = tree;
    other.operands[1].leaf = std::move(leaf);
    return other;
  };
  const auto loops = test::box_loops({0, 0, 0}, {4, 4, 4});
  EXPECT_TRUE(applies(with_leaf(test::make_leaf(loops))));
  // Facets that are kept, a corner cut off, nothing at all, two labels in one side.
  EXPECT_FALSE(applies(with_leaf(test::make_leaf(loops, true))));
  EXPECT_FALSE(applies(with_leaf(test::make_leaf({{{0, 0, 0}, {0, 4, 0}, {4, 0, 0}},
                                                  {{0, 0, 0}, {4, 0, 0}, {0, 0, 4}},
                                                  {{0, 0, 0}, {0, 0, 4}, {0, 4, 0}},
                                                  {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}}}))));
  EXPECT_FALSE(applies(with_leaf(std::make_shared<LeafGeometry>())));
  auto halved = loops;
  halved[0] = {loops[0][0], loops[0][1], loops[0][2]};
  halved.push_back({loops[0][2], loops[0][3], loops[0][0]});
  auto leaf = std::make_shared<LeafGeometry>(*test::make_leaf(halved));
  EXPECT_TRUE(applies(with_leaf(leaf)));
  leaf = std::make_shared<LeafGeometry>(*leaf);
  leaf->surface = std::vector<uint32_t>{0, 0, 0, 0, 0, 0, 1};
  EXPECT_FALSE(applies(with_leaf(leaf)));
  RandomTree other = tree;
  other.operands[2].frame.is_identity = false;
  EXPECT_FALSE(applies(other));
  other = tree;
  other.operands[0].leaf = nullptr;
  other.operands[0].boundary = cell_by_cell(tree);
  EXPECT_FALSE(applies(other));
  other = tree;
  other.expression.nodes.back().op = BooleanOp::kSymmetricDifference;
  EXPECT_FALSE(applies(other));
  other.expression = {};
  EXPECT_FALSE(applies(other));
}

// Boxes that share no planes make n^3 cells of n boxes: that is left to others.
TEST(EvaluateBoxes, LatticesThatAreTooFineAreLeft) {
  const auto diagonal = [](int64_t count) {
    std::vector<Operand> operands;
    for (int64_t i = 0; i < count; ++i) {
      operands.emplace_back().leaf =
          test::box_leaf({4 * i, 4 * i, 4 * i}, {4 * i + 2, 4 * i + 2, 4 * i + 2});
    }
    return operands;
  };
  // (2 n)^3 cells: 2048 for each of 16 boxes.
  EXPECT_TRUE(make_lattice(diagonal(16)));
  EXPECT_FALSE(make_lattice(diagonal(17)));
}

TEST(EvaluateBoxes, CanBeCancelled) {
  test::Random random(504);
  const auto tree = random_boxes(random, 6, 8);
  const std::atomic<bool> cancel{true};
  KernelOptions options;
  options.cancel = &cancel;
  EvaluateStats stats;
  const auto result = evaluate_boxes(tree.operands, tree.expression, options, stats);
  ASSERT_TRUE(result);
  ASSERT_FALSE(*result);
  EXPECT_EQ(result->error().code, ErrorCode::kCancelled);
}

// A flag that is not set stops nothing.
TEST(EvaluateBoxes, AreNotCancelledByAFlagAlone) {
  test::Random random(505);
  const auto tree = random_boxes(random, 6, 8);
  const std::atomic<bool> cancel{false};
  KernelOptions options;
  options.cancel = &cancel;
  EvaluateStats stats;
  const auto result = evaluate_boxes(tree.operands, tree.expression, options, stats);
  ASSERT_TRUE(result && *result);
  EXPECT_EQ(test::first_difference(***result, *cell_by_cell(tree)), "");
}

// All ways to fill the eight cells around a point: the surface touches itself along an edge that
// only two opposite ones share, and in the point if it is all that two have in common.
TEST(EvaluateBoxes, TouchInEdgesAndCorners) {
  for (uint32_t filled = 1; filled < 256; ++filled) {
    RandomTree tree;
    const auto is_filled = [&](int c) { return (filled >> c & 1) != 0; };
    for (int c = 0; c < 8; ++c) {
      const IVec3 lo{c & 1, c >> 1 & 1, c >> 2};
      if (!is_filled(c)) continue;
      tree.operands.push_back(
          test::operand_of(test::box_leaf(lo, {lo[0] + 1, lo[1] + 1, lo[2] + 1})));
    }
    tree.expression =
        test::flat_expression(BooleanOp::kUnion, static_cast<uint32_t>(tree.operands.size()));
    bool touches = filled == 0x81 || filled == 0x42 || filled == 0x24 || filled == 0x18;
    touches |= (filled ^ 0xff) == 0x81 || (filled ^ 0xff) == 0x42 || (filled ^ 0xff) == 0x24 ||
               (filled ^ 0xff) == 0x18;
    for (int along = 0; along < 3; ++along) {
      const int s = 1 << (along + 1) % 3, t = 1 << (along + 2) % 3;
      for (const int c : {0, 1 << along}) {
        touches |= is_filled(c) == is_filled(c + s + t) && is_filled(c + s) == is_filled(c + t) &&
                   is_filled(c) != is_filled(c + s);
      }
    }
    EvaluateStats stats;
    const auto result = evaluate_boxes(tree.operands, tree.expression, {}, stats);
    ASSERT_TRUE(result && *result);
    EXPECT_EQ((**result)->may_touch, touches) << filled;
  }
}

// Cells in which several boxes have surface are counted.
TEST(EvaluateBoxes, CountTheirWork) {
  const auto work = [](const std::vector<Operand>& operands) {
    EvaluateStats stats;
    const auto expression =
        test::flat_expression(BooleanOp::kUnion, static_cast<uint32_t>(operands.size()));
    const auto result = evaluate_boxes(operands, expression, {}, stats);
    EXPECT_TRUE(result && *result);
    EXPECT_EQ(stats.solved_cells, stats.critical_cells);
    EXPECT_GE(stats.surface_cells, stats.solved_cells);
    EXPECT_GT(stats.surface_cells, 0u);
    EXPECT_GE(stats.cells, stats.surface_cells);
    EXPECT_LT(stats.cells, 1000u);
    return stats.solved_cells;
  };
  const Operand box = test::operand_of(test::box_leaf({0, 0, 0}, {4, 4, 4})),
                crossing = test::operand_of(test::box_leaf({2, 2, 2}, {9, 9, 9}));
  EXPECT_EQ(work({box}), 0u);
  const uint64_t several = work({box, crossing});
  EXPECT_GT(several, 0u);
  EXPECT_LT(several, 100u);
  std::vector<Operand> row;
  for (int64_t x = 0; x < 12; ++x) {
    row.push_back(test::operand_of(test::box_leaf({10 * x, 0, 0}, {10 * x + 1, 1, 1})));
  }
  EXPECT_LE(work(row), 8u);

  // Along each axis the planes of four boxes on a diagonal are 0 to 7, and a window has three:
  // the first one meets the second in the windows of planes 0 to 2, and the second the third in
  // those of 3 to 5. The second one is in 2 x 2 x 2 windows, two of which are these.
  EvaluateStats stats;
  std::vector<Operand> diagonal;
  for (int64_t at = 0; at < 40; at += 10) {
    diagonal.push_back(test::operand_of(test::box_leaf({at, at, at}, {at + 1, at + 1, at + 1})));
  }
  ASSERT_TRUE(evaluate_boxes(diagonal, test::flat_expression(BooleanOp::kUnion, 4), {}, stats));
  EXPECT_EQ(stats.surface_cells, 9u);
  EXPECT_EQ(stats.solved_cells, 2u);
  EXPECT_EQ(stats.critical_cells, 2u);
}

}  // namespace
}  // namespace csgrun::evaluate_boxes_test
