#include "engine/bsp/sparse_boundary.h"

#include <algorithm>
#include <functional>

namespace csgrun {

SparseBoundary::SparseBoundary(const Expression& expression) : expression_(expression) {
  const std::vector<Expression::Node>& nodes = expression_.nodes;
  parent_starts_.assign(nodes.size() + 1, 0);
  is_full_.assign(nodes.size(), 0);
  full_children_.assign(nodes.size(), 0);
  changed_.resize(nodes.size());
  uint32_t operands = 0;
  for (uint32_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n].is_operand) {
      operands = std::max(operands, nodes[n].operand + 1);
      continue;
    }
    for (uint32_t c = 0; c < nodes[n].child_count; ++c) {
      const uint32_t child = expression_.children[nodes[n].first_child + c];
      ++parent_starts_[child + 1];
      full_children_[n] += is_full_[child];
    }
    is_full_[n] = combine(n).front;
  }
  for (size_t n = 0; n < nodes.size(); ++n) parent_starts_[n + 1] += parent_starts_[n];
  parents_.resize(parent_starts_.back());
  std::vector<uint32_t> next = parent_starts_;
  for (uint32_t n = 0; n < nodes.size(); ++n) {
    for (uint32_t c = 0; c < nodes[n].child_count; ++c) {
      parents_[next[expression_.children[nodes[n].first_child + c]]++] = {n, c};
    }
  }
  leaf_starts_.assign(operands + 1, 0);
  for (const Expression::Node& n : nodes) {
    if (n.is_operand) ++leaf_starts_[n.operand + 1];
  }
  for (uint32_t o = 0; o < operands; ++o) leaf_starts_[o + 1] += leaf_starts_[o];
  leaves_.resize(leaf_starts_.back());
  next = leaf_starts_;
  for (uint32_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n].is_operand) leaves_[next[nodes[n].operand]++] = n;
  }
}

PrunedExpression::Boundary SparseBoundary::evaluate(std::span<const Sides> given) {
  if (expression_.nodes.empty()) return {};
  root_ = {is_full_.back() != 0, is_full_.back() != 0, PrunedExpression::kNoOperand};
  for (const Sides& s : given) {
    if (s.operand + 1 >= leaf_starts_.size()) continue;
    for (uint32_t i = leaf_starts_[s.operand]; i < leaf_starts_[s.operand + 1]; ++i) {
      note(leaves_[i],
           {s.front, s.back, s.front != s.back ? s.operand : PrunedExpression::kNoOperand});
    }
  }
  // Children stand before their parents: the lowest node has all its children known.
  while (!queue_.empty()) {
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    const uint32_t node = queue_.back();
    queue_.pop_back();
    std::sort(changed_[node].begin(), changed_[node].end(),
              [](const Child& a, const Child& b) { return a.place < b.place; });
    const Boundary value = combine(node);
    changed_[node].clear();
    note(node, value);
  }
  return root_;
}

/// Tells a node's parents that the node is not what it was when everything was outside.
void SparseBoundary::note(uint32_t node, const Boundary& value) {
  const bool was = is_full_[node] != 0;
  if (value.front == was && value.back == was) return;
  if (node + 1 == expression_.nodes.size()) {
    root_ = value;
    return;
  }
  for (uint32_t i = parent_starts_[node]; i < parent_starts_[node + 1]; ++i) {
    const auto& [parent, place] = parents_[i];
    if (changed_[parent].empty()) {
      queue_.push_back(parent);
      std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
    }
    changed_[parent].push_back({place, value, was});
  }
}

/// The value of an inner node; its children are as they were but for those in `changed_`.
PrunedExpression::Boundary SparseBoundary::combine(uint32_t node) {
  const Expression::Node& n = expression_.nodes[node];
  const std::vector<Child>& changed = changed_[node];
  uint32_t full = full_children_[node];  // of the others
  for (const Child& c : changed) full -= c.was;
  const auto others = n.child_count - static_cast<uint32_t>(changed.size());
  Boundary r;
  const auto first_with_boundary = [&] {
    for (const Child& c : changed) {
      if (c.value.operand != PrunedExpression::kNoOperand) return c.value.operand;
    }
    return PrunedExpression::kNoOperand;
  };
  switch (n.op) {
    case BooleanOp::kUnion:
      r.front = r.back = full > 0;
      for (const Child& c : changed) r.front |= c.value.front, r.back |= c.value.back;
      r.operand = first_with_boundary();
      break;
    case BooleanOp::kIntersection:
      r.front = r.back = full == others;
      for (const Child& c : changed) r.front &= c.value.front, r.back &= c.value.back;
      r.operand = first_with_boundary();
      break;
    case BooleanOp::kDifference: {
      if (n.child_count == 0) break;
      const bool first_changed = !changed.empty() && changed[0].place == 0;
      const bool was = is_full_[expression_.children[n.first_child]] != 0;
      Boundary first{was, was};
      if (first_changed) {
        first = changed[0].value;
      } else {
        full -= was;
      }
      bool front = full > 0, back = full > 0;
      for (size_t c = first_changed ? 1 : 0; c < changed.size(); ++c) {
        front |= changed[c].value.front, back |= changed[c].value.back;
      }
      r.front = first.front && !front;
      r.back = first.back && !back;
      r.operand = first_with_boundary();
      break;
    }
    default:
      // A fold of binary ones: what came before counts only where it still has boundary.
      for (const Child& c : changed) {
        if (r.front == r.back) r.operand = c.value.operand;
        r.front ^= c.value.front, r.back ^= c.value.back;
      }
      r.front ^= full & 1, r.back ^= full & 1;
      break;
  }
  if (r.front == r.back) r.operand = PrunedExpression::kNoOperand;
  return r;
}

}  // namespace csgrun
