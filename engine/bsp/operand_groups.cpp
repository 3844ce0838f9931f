#include "engine/bsp/operand_groups.h"

#include <algorithm>
#include <numeric>

namespace csgrun {
namespace {

constexpr uint32_t kNoOperand = ~0u;

GridBox clipped(GridBox box, const GridBox& other) {
  for (size_t k = 0; k < 3; ++k) {
    box.lo[k] = std::max(box.lo[k], other.lo[k]);
    box.hi[k] = std::min(box.hi[k], other.hi[k]);
  }
  return box;
}

GridBox joined(GridBox box, const GridBox& other) {
  if (box.empty() || other.empty()) return box.empty() ? other : box;
  for (size_t k = 0; k < 3; ++k) {
    box.lo[k] = std::min(box.lo[k], other.lo[k]);
    box.hi[k] = std::max(box.hi[k], other.hi[k]);
  }
  return box;
}

/// The children of a node that may stand in groups: those that are taken away are a union.
std::span<const uint32_t> groupable(const Expression& expression, const Expression::Node& node) {
  if (node.is_operand || node.op == BooleanOp::kSymmetricDifference) return {};
  const auto children = std::span(expression.children).subspan(node.first_child, node.child_count);
  return node.op == BooleanOp::kDifference ? children.subspan(1) : children;
}

/// The node with most of them.
const Expression::Node& widest(const Expression& expression) {
  return *std::max_element(expression.nodes.begin(), expression.nodes.end(),
                           [&](const Expression::Node& a, const Expression::Node& b) {
                             return groupable(expression, a).size() <
                                    groupable(expression, b).size();
                           });
}

/// A box around what an operator leaves of its children.
GridBox box_of(BooleanOp op, std::span<const uint32_t> children,
               const std::vector<GridBox>& of_nodes) {
  GridBox box = of_nodes[children[0]];
  for (const uint32_t child : children.subspan(1)) {
    const GridBox& other = of_nodes[child];
    switch (op) {
      case BooleanOp::kIntersection:
        box = clipped(box, other);
        break;
      case BooleanOp::kDifference:
        break;
      default:
        box = joined(box, other);
        break;
    }
  }
  return box;
}

/// The same of all nodes. They stand after their children.
std::vector<GridBox> boxes_of_nodes(const Expression& expression, std::span<const GridBox> boxes) {
  std::vector<GridBox> of_nodes;
  of_nodes.reserve(expression.nodes.size());
  const std::span all(expression.children);
  for (const Expression::Node& node : expression.nodes) {
    of_nodes.push_back(
        node.is_operand
            ? boxes[node.operand]
            : box_of(node.op, all.subspan(node.first_child, node.child_count), of_nodes));
  }
  return of_nodes;
}

/// What a difference takes from. REQUIRES: are_taken_away.
uint32_t first_child(const Expression& expression) {
  return expression.children[widest(expression).first_child];
}

/// Puts parts of one job into another one.
class JobPart {
 public:
  JobPart(const std::vector<Operand>& operands, const Expression& expression)
      : operands_(operands), expression_(expression), number_(operands.size(), kNoOperand) {}

  uint32_t add_operand(Operand operand) {
    job.operands.push_back(std::move(operand));
    Expression::Node node;
    node.operand = static_cast<uint32_t>(job.operands.size() - 1);
    return add(node);
  }

  uint32_t add_operator(BooleanOp op, std::span<const uint32_t> children) {
    Expression::Node node;
    node.is_operand = false;
    node.op = op;
    node.first_child = static_cast<uint32_t>(job.expression.children.size());
    node.child_count = static_cast<uint32_t>(children.size());
    job.expression.children.insert(job.expression.children.end(), children.begin(), children.end());
    return add(node);
  }

  /// A node and all below it. `replace(node)` may put something in the place of one.
  template <class Replace>
  uint32_t copy(uint32_t index, Replace&& replace) {
    const Expression::Node& node = expression_.nodes[index];
    if (const std::optional<uint32_t> other = replace(node)) return *other;
    if (!node.is_operand) {
      std::vector<uint32_t> children;
      for (uint32_t c = 0; c < node.child_count; ++c) {
        children.push_back(copy(expression_.children[node.first_child + c], replace));
      }
      return add_operator(node.op, children);
    }
    if (number_[node.operand] == kNoOperand) {
      number_[node.operand] = static_cast<uint32_t>(job.operands.size());
      job.operands.push_back(operands_[node.operand]);
    }
    Expression::Node copied;
    copied.operand = number_[node.operand];
    return add(copied);
  }
  uint32_t copy(uint32_t index) {
    return copy(index, [](const Expression::Node&) { return std::optional<uint32_t>(); });
  }

  GroupedJob job;

 private:
  uint32_t add(const Expression::Node& node) {
    job.expression.nodes.push_back(node);
    return static_cast<uint32_t>(job.expression.nodes.size() - 1);
  }

  const std::vector<Operand>& operands_;
  const Expression& expression_;
  std::vector<uint32_t> number_;
};

}  // namespace

bool can_be_grouped(const Expression& expression) {
  constexpr size_t kLeast = 3;
  return !expression.nodes.empty() && groupable(expression, widest(expression)).size() >= kLeast;
}

bool is_one_group(const Expression& expression) {
  constexpr size_t kMany = 8;  // fewer hide little of one another
  const Expression::Node& wide = widest(expression);
  return &wide != &expression.nodes.back() && groupable(expression, wide).size() >= kMany;
}

Groupable most_groupable(const Expression& expression) {
  const Expression::Node& wide = widest(expression);
  const auto children = groupable(expression, wide);
  const BooleanOp op = wide.op == BooleanOp::kDifference ? BooleanOp::kUnion : wide.op;
  if (is_one_group(expression)) return {op, children, children.size()};
  // Few groups of few: either is crowded, if it is, with less.
  constexpr size_t kMany = 16, kEach = 8;
  return {op, children, children.size() > kMany ? kEach : (children.size() + 1) / 2};
}

bool are_taken_away(const Expression& expression) {
  return widest(expression).op == BooleanOp::kDifference;
}

std::vector<GridBox> boxes_of_groups(const Expression& expression, GroupWay way,
                                     std::span<const GridBox> boxes) {
  const auto [op, children, size] = most_groupable(expression);
  const std::vector<GridBox> of_nodes = boxes_of_nodes(expression, boxes);
  std::vector<GridBox> groups;
  for (size_t first = 0; first < children.size(); first += size) {
    const size_t count = std::min(size, children.size() - first);
    groups.push_back(way == GroupWay::kWithFirst
                         ? of_nodes[first_child(expression)]
                         : box_of(op, children.subspan(first, count), of_nodes));
  }
  return groups;
}

Result<GroupedJob> evaluate_groups(const std::vector<Operand>& operands,
                                   const Expression& expression, GroupWay way,
                                   std::span<const GridBox> boxes, const EvaluateGroup& evaluate) {
  const Expression::Node& wide = widest(expression);
  const auto [op, children, size] = most_groupable(expression);
  const bool with_first = way == GroupWay::kWithFirst;
  const std::vector<GridBox> regions = boxes_of_groups(expression, way, boxes);
  std::vector<Operand> results;
  std::vector<size_t> starts;
  for (size_t first = 0; first < children.size(); first += size) {
    starts.push_back(first);
    const auto group = children.subspan(first, std::min(size, children.size() - first));
    results.emplace_back();
    if (group.size() == 1 && !with_first) continue;
    JobPart part(operands, expression);
    std::vector<uint32_t> copies;
    if (with_first) copies.push_back(part.copy(first_child(expression)));
    for (const uint32_t child : group) copies.push_back(part.copy(child));
    part.add_operator(with_first ? BooleanOp::kDifference : op, copies);
    auto result = evaluate(part.job.operands, part.job.expression, regions[first / size]);
    if (!result) return result.error();
    results.back().boundary = *result;
  }
  JobPart rest(operands, expression);
  // Not every compiler lets a function take a name of a structured binding as it is.
  const auto group_for =
      [&, children = children](const Expression::Node& node) -> std::optional<uint32_t> {
    if (&node != &wide) return std::nullopt;
    std::vector<uint32_t> grouped;
    if (wide.op == BooleanOp::kDifference && !with_first) {
      grouped.push_back(rest.copy(first_child(expression)));
    }
    for (size_t g = 0; g < results.size(); ++g) {
      grouped.push_back(results[g].boundary ? rest.add_operand(results[g])
                                            : rest.copy(children[starts[g]]));
    }
    if (grouped.size() == 1) return grouped[0];
    // Where they have boundary of the first child in common, or of what is taken away, the lowest
    // group that has it is of the operand that the difference would name.
    return rest.add_operator(with_first ? BooleanOp::kIntersection : wide.op, grouped);
  };
  rest.copy(static_cast<uint32_t>(expression.nodes.size() - 1), group_for);
  return std::move(rest.job);
}

}  // namespace csgrun
