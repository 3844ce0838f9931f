#include "engine/bsp/pruned_expression.h"

#include <algorithm>
#include <cassert>

namespace csgrun {

ExpressionFolder::Value ExpressionFolder::operand(uint32_t o) {
  result_.nodes_.push_back({Kind::kOperand, false, o, 0, 0});
  return {false, false, static_cast<uint32_t>(result_.nodes_.size() - 1)};
}

ExpressionFolder::Value ExpressionFolder::make(Kind kind, bool complement,
                                               const std::vector<Value>& children) {
  assert(children.size() > 1 || kind != Kind::kDifference);
  if (children.size() == 1 && !complement) return children[0];
  Node n{kind, complement, 0, static_cast<uint32_t>(result_.children_.size()),
         static_cast<uint32_t>(children.size())};
  for (const Value& c : children) result_.children_.push_back(c.node);
  result_.nodes_.push_back(n);
  return {false, false, static_cast<uint32_t>(result_.nodes_.size() - 1)};
}

ExpressionFolder::Value ExpressionFolder::combine(Kind kind, bool complement,
                                                  std::vector<Value>& children) {
  const auto is_constant = [](bool full) {
    return [full](const Value& v) { return v.constant && v.full == full; };
  };
  if (kind == Kind::kXor) {
    for (const Value& v : children) complement ^= v.full;  // nothing else is
    std::erase_if(children, [](const Value& v) { return v.constant; });
    if (children.empty()) return constant(complement);
    // One child left: the complement of a union of one.
    return make(children.size() == 1 ? Kind::kUnion : Kind::kXor, complement, children);
  }
  if (kind == Kind::kDifference) {
    if (children.empty() || is_constant(false)(children[0])) return constant(complement);
    const Value first = children[0];
    children.erase(children.begin());
    if (std::any_of(children.begin(), children.end(), is_constant(true))) {
      return constant(complement);
    }
    std::erase_if(children, is_constant(false));
    if (first.constant) {  // everything less the union of the rest
      if (children.empty()) return constant(!complement);
      return make(Kind::kUnion, !complement, children);
    }
    if (children.empty()) {
      children.push_back(first);
      return make(Kind::kUnion, complement, children);
    }
    children.insert(children.begin(), first);
    return make(Kind::kDifference, complement, children);
  }
  const bool deciding = kind == Kind::kUnion;
  if (std::any_of(children.begin(), children.end(), is_constant(deciding))) {
    return constant(deciding != complement);
  }
  std::erase_if(children, is_constant(!deciding));
  if (children.empty()) return constant(deciding == complement);
  return make(kind, complement, children);
}

PrunedExpression ExpressionFolder::finish(const Value& root) {
  if (root.constant) {
    PrunedExpression r;
    r.form_ = root.full ? Form::kFull : Form::kEmpty;
    return r;
  }
  // Keep what the root needs, in order; folding may have left nodes behind.
  const auto& nodes = result_.nodes_;
  std::vector<uint8_t> needed(nodes.size(), 0);
  std::vector<uint32_t> place(nodes.size(), 0);
  needed[root.node] = 1;
  for (size_t i = nodes.size(); i-- > 0;) {
    if (!needed[i]) continue;
    for (uint32_t c = 0; c < nodes[i].child_count; ++c) {
      needed[result_.children_[nodes[i].first_child + c]] = 1;
    }
  }
  PrunedExpression r;
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (!needed[i]) continue;
    Node n = nodes[i];
    const uint32_t first = n.first_child;
    n.first_child = static_cast<uint32_t>(r.children_.size());
    for (uint32_t c = 0; c < n.child_count; ++c) {
      r.children_.push_back(place[result_.children_[first + c]]);
    }
    place[i] = static_cast<uint32_t>(r.nodes_.size());
    r.nodes_.push_back(n);
  }
  const Node& last = r.nodes_.back();
  if (last.kind == Kind::kOperand) {
    r.form_ = Form::kOperand;
  } else if (last.child_count == 1 && r.nodes_.size() == 2) {
    assert(last.complement && last.kind == Kind::kUnion);  // else it would be its child
    r.form_ = Form::kComplement;
    r.nodes_.back().operand = r.nodes_.front().operand;
  } else {
    r.form_ = Form::kGeneral;
  }
  return r;
}

PrunedExpression::PrunedExpression(const Expression& expression) {
  if (expression.nodes.empty()) return;
  ExpressionFolder folder;
  std::vector<ExpressionFolder::Value> values(expression.nodes.size()), children;
  for (size_t i = 0; i < expression.nodes.size(); ++i) {
    const Expression::Node& n = expression.nodes[i];
    if (n.is_operand) {
      values[i] = folder.operand(n.operand);
      continue;
    }
    children.clear();
    for (uint32_t c = 0; c < n.child_count; ++c) {
      assert(expression.children[n.first_child + c] < i);
      children.push_back(values[expression.children[n.first_child + c]]);
    }
    const auto kind = [&] {
      switch (n.op) {
        case BooleanOp::kUnion:
          return Kind::kUnion;
        case BooleanOp::kIntersection:
          return Kind::kIntersection;
        case BooleanOp::kDifference:
          return Kind::kDifference;
        default:
          return Kind::kXor;
      }
    }();
    values[i] = folder.combine(kind, false, children);
  }
  *this = folder.finish(values.back());
}

}  // namespace csgrun
