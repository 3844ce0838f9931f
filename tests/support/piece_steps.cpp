#include "tests/support/piece_steps.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/kernel_case.h"

namespace csgrun::test {

Expression continued(Expression e, BooleanOp op, uint32_t first, uint32_t count, bool root_last) {
  Expression::Node root;
  root.is_operand = false;
  root.op = op;
  root.first_child = static_cast<uint32_t>(e.children.size());
  root.child_count = count + 1;
  const auto before = static_cast<uint32_t>(e.nodes.size()) - 1;
  if (!root_last) e.children.push_back(before);
  for (uint32_t o = first; o < first + count; ++o) {
    e.children.push_back(static_cast<uint32_t>(e.nodes.size()));
    e.nodes.emplace_back().operand = o;
  }
  if (root_last) e.children.push_back(before);
  e.nodes.push_back(root);
  return e;
}

Expression step_of(BooleanOp op, uint32_t others, bool version_last) {
  Expression e = flat_expression(op, others + 1);
  if (version_last) std::rotate(e.children.begin(), e.children.begin() + 1, e.children.end());
  return e;
}

void check_names(const ResultPieces& pieces) {
  PieceStore& store = *pieces.store;
  const auto check_corner = [&](uint32_t point) {
    EXPECT_TRUE(store.is_on_grid(point) || store.point_planes(point)[0] != PieceStore::kNoNumber);
  };
  pieces.tree.each([](const PieceBox&) { return true; },
                   [&](uint32_t p) {
                     if (store.is_group(p)) return;
                     for (const uint32_t c : store.corners(p)) check_corner(c);
                     if (store.is_region(p)) {
                       const PieceStore::Region& region = store.region(p);
                       for (uint32_t i = 0; i < region.cell_count; ++i) {
                         check_corner(store.corners()[region.first_cell + i]);
                       }
                     }
                     if (store.map(store.piece(p).operand).is_identity()) return;
                     if (store.piece(p).is_whole) return;
                     EXPECT_TRUE(store.piece(p).support.valid());
                     for (const uint32_t plane : store.edges(p)) {
                       EXPECT_NE(plane, PieceStore::kNoNumber);
                     }
                   });
}

}  // namespace csgrun::test
