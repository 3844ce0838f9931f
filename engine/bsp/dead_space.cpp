#include "engine/bsp/dead_space.h"

#include <utility>

namespace csgrun {
namespace {

std::vector<PolygonBox> find_node_boxes(const Expression& expression,
                                        const std::vector<PolygonBox>& boxes) {
  std::vector<PolygonBox> of_node(expression.nodes.size(), PolygonBox::none());
  // From the operands up.
  for (size_t n = 0; n < expression.nodes.size(); ++n) {
    const Expression::Node& node = expression.nodes[n];
    if (node.is_operand) of_node[n] = boxes[node.operand];  // and there are no children
    if (node.op == BooleanOp::kIntersection) of_node[n] = PolygonBox::everywhere();
    for (uint32_t c = 0; c < node.child_count; ++c) {
      const PolygonBox& child = of_node[expression.children[node.first_child + c]];
      if (node.op == BooleanOp::kIntersection) {
        of_node[n].clip(child);
      } else if (c == 0 || node.op != BooleanOp::kDifference) {
        of_node[n].include(child);
      }
    }
  }
  return of_node;
}

}  // namespace

std::vector<uint8_t> find_removers(const std::vector<Operand>& operands,
                                   const Expression& expression) {
  std::vector<uint8_t> removes(operands.size(), 0);
  if (expression.nodes.empty()) return removes;
  const Expression::Node& root = expression.nodes.back();
  const bool is_union = root.op == BooleanOp::kUnion;
  if (!is_union && root.op != BooleanOp::kDifference) return removes;
  for (uint32_t c = is_union ? 0 : 1; c < root.child_count; ++c) {
    const Expression::Node& child = expression.nodes[expression.children[root.first_child + c]];
    if (!child.is_operand) continue;
    const auto& leaf = operands[child.operand].leaf;
    if (leaf && leaf->convex) removes[child.operand] = 1;
  }
  return removes;
}

DeadSpace::DeadSpace(const std::vector<Operand>& operands, const Expression& expression,
                     std::vector<PolygonBox> boxes)
    : removes_(find_removers(operands, expression)), boxes_(std::move(boxes)) {
  if (expression.nodes.empty()) return;
  node_boxes_ = find_node_boxes(expression, boxes_);
  result_ = node_boxes_.back();
  if (operands.size() > 2) balls_ = OperandBalls(operands, boxes_, removes_);
}

}  // namespace csgrun
