#include "engine/bsp/label_order.h"

#include <algorithm>
#include <span>

namespace csgrun {
namespace {

std::span<const uint32_t> children_of(const Expression& expression, size_t n) {
  const Expression::Node& node = expression.nodes[n];
  return std::span(expression.children).subspan(node.first_child, node.child_count);
}

/// Whether every node, but for the root, stands below one other node once.
bool is_tree(const Expression& expression) {
  std::vector<uint8_t> has_parent(expression.nodes.size(), 0);
  for (size_t n = 0; n < expression.nodes.size(); ++n) {
    for (const uint32_t child : children_of(expression, n)) {
      if (has_parent[child] != 0) return false;
      has_parent[child] = 1;
    }
  }
  const auto roots = std::count(has_parent.begin(), has_parent.end(), 0);
  return roots == 1;
}

}  // namespace

LabelOrder::LabelOrder(const Expression& expression, size_t operands) : places_(operands) {
  if (!is_tree(expression)) return;
  const std::vector<Expression::Node>& nodes = expression.nodes;
  // Children stand before their parents.
  std::vector<uint32_t> below(nodes.size(), 0), start(nodes.size(), 0);
  for (size_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n].is_operand) below[n] = 1;
    for (const uint32_t child : children_of(expression, n)) below[n] += below[child];
  }
  std::vector<uint8_t> is_placed(operands, 0), is_twice(operands, 0);
  const auto place = [&](uint32_t operand, const Place& at) {
    is_twice[operand] |= is_placed[operand];
    is_placed[operand] = 1;
    places_[operand] = at;
  };
  if (nodes.back().is_operand) place(nodes.back().operand, {0, 0});
  for (size_t n = nodes.size(); n-- > 0;) {
    const bool names_first = nodes[n].op != BooleanOp::kSymmetricDifference;
    uint32_t next = start[n];
    for (const uint32_t child : children_of(expression, n)) {
      start[child] = next;
      if (nodes[child].is_operand) {
        place(nodes[child].operand, {next, names_first ? start[n] + below[n] : 0});
      }
      next += below[child];
    }
  }
  for (size_t o = 0; o < operands; ++o) {
    if (is_twice[o] != 0) places_[o] = {};
  }
}

}  // namespace csgrun
