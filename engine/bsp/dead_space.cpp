#include "engine/bsp/dead_space.h"

#include <array>
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

/// Finds the operands that decide what the root is where one is inside of them, and those that do
/// so where one is outside of them, from the root down.
class Deciders {
 public:
  explicit Deciders(const Expression& expression, size_t operands)
      : expression_(expression),
        decides_(operands, {0, 0}),
        seen_(expression.nodes.size(), {0, 0}) {
    const auto root = static_cast<uint32_t>(expression.nodes.size() - 1);
    visit(root, true);
    visit(root, false);
  }
  [[nodiscard]] bool decides(uint32_t operand, bool is_inside) const {
    return decides_[operand][is_inside] != 0;
  }

 private:
  /// Those that make a node full, or empty.
  void visit(uint32_t n, bool is_full) {
    if (std::exchange(seen_[n][is_full], 1) != 0) return;
    const Expression::Node& node = expression_.nodes[n];
    if (node.is_operand) {
      decides_[node.operand][is_full] = 1;
      return;
    }
    for (uint32_t c = 0; c < node.child_count; ++c) {
      const uint32_t child = expression_.children[node.first_child + c];
      if (node.op == BooleanOp::kUnion && is_full) visit(child, true);
      if (node.op == BooleanOp::kIntersection && !is_full) visit(child, false);
      if (node.op == BooleanOp::kDifference && !is_full) visit(child, c > 0);
    }
  }

  const Expression& expression_;
  std::vector<std::array<uint8_t, 2>> decides_;  ///< per operand: outside, inside
  std::vector<std::array<uint8_t, 2>> seen_;     ///< per node
};

}  // namespace

DeadSpace::DeadSpace(const std::vector<Operand>& operands, const Expression& expression,
                     std::vector<PolygonBox> boxes)
    : removes_(operands.size(), 0), confines_(removes_), boxes_(std::move(boxes)) {
  if (expression.nodes.empty()) return;
  const Deciders deciders(expression, operands.size());
  std::vector<uint8_t> uses(operands.size(), 0);
  node_boxes_ = find_node_boxes(expression, boxes_);
  result_ = node_boxes_.back();
  for (uint32_t o = 0; o < operands.size(); ++o) {
    removes_[o] = operands[o].leaf && deciders.decides(o, true);
    confines_[o] = operands[o].leaf && deciders.decides(o, false);
    // On which side of an operand points are is asked of any.
    if (operands[o].leaf) uses[o] = OperandBalls::kSide;
    if (removes_[o]) uses[o] |= OperandBalls::kWithin;
    if (confines_[o]) uses[o] |= OperandBalls::kBeyond;
  }
  if (operands.size() <= 2) return;
  balls_ = OperandBalls(operands, boxes_, uses);
  std::vector<uint8_t> have_room(removes_);
  for (uint32_t o = 0; o < operands.size(); ++o) have_room[o] &= balls_.hides(o) ? 1 : 0;
  inner_boxes_ = InnerBoxes(operands, boxes_, have_room, result_);
}

}  // namespace csgrun
