// Boolean expressions that shrink: operands that are constant in a cell are folded away.
//
// Everything is a linear pass over an array in which children stand before their parents, so depth
// costs no stack.
#pragma once

#include <cassert>
#include <cstdint>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

/// Truth of "inside", possibly not known yet.
enum class Inside : uint8_t { kNo = 0, kYes = 1, kUnknown = 2 };

class PrunedExpression {
 public:
  /// What is left of an expression.
  enum class Form : uint8_t { kEmpty, kFull, kOperand, kComplement, kGeneral };

  PrunedExpression() = default;
  explicit PrunedExpression(const Expression& expression);

  [[nodiscard]] Form form() const { return form_; }
  /// For kOperand and kComplement: the one operand left.
  [[nodiscard]] uint32_t single() const { return nodes_.back().operand; }

  /// Replaces operands by constants: `value(operand)` is kUnknown for those that stay.
  template <class Value>
  [[nodiscard]] PrunedExpression fold(Value&& value) const;

  /// Whether the solid contains the point, from what is known of the operands.
  template <class Value>
  [[nodiscard]] Inside evaluate(Value&& value, std::vector<Inside>& scratch) const;

  /// The operand whose surface a boundary point belongs to, and whether the point is boundary at
  /// all: at each node the lowest child that has boundary there, where a child has boundary if its
  /// values in front and behind differ. kNoOperand when the root has none. `front(operand)` and
  /// `back(operand)` must be known.
  static constexpr uint32_t kNoOperand = ~0u;
  struct Boundary {
    bool front = false, back = false;
    uint32_t operand = kNoOperand;
  };
  template <class Front, class Back>
  [[nodiscard]] Boundary boundary(Front&& front, Back&& back, std::vector<Boundary>& scratch) const;

  /// The same for 64 points at once, a bit each: leaves in `words` what each node contains, the
  /// root last. `value(operand)` is a word. REQUIRES: not kEmpty or kFull.
  template <class Value>
  void evaluate_words(Value&& value, std::vector<uint64_t>& words) const;
  /// For words that evaluate_words has left: calls emit(operand, points) with those of the points
  /// `asked` whose neighbour, `shift` bits on, is on the other side of the boundary, by the operand
  /// that boundary() would name. REQUIRES: no symmetric difference.
  template <class Emit>
  void split_boundary(const std::vector<uint64_t>& words, int shift, uint64_t asked,
                      std::vector<uint64_t>& scratch, Emit&& emit) const;

  /// Calls f(operand) for each operand mentioned (repeatedly if it occurs repeatedly).
  template <class F>
  void each_operand(F&& f) const {
    for (const Node& n : nodes_) {
      if (n.kind == Kind::kOperand) f(n.operand);
    }
  }

 private:
  enum class Kind : uint8_t { kOperand, kUnion, kIntersection, kDifference, kXor };
  struct Node {
    Kind kind = Kind::kOperand;
    /// kUnion: the complement of the union; kXor: the complement of the symmetric difference.
    bool complement = false;
    uint32_t operand = 0;
    uint32_t first_child = 0, child_count = 0;
  };

  std::vector<Node> nodes_;
  std::vector<uint32_t> children_;
  Form form_ = Form::kEmpty;

  friend class ExpressionFolder;
};

/// Builds a folded copy node by node.
class ExpressionFolder {
 public:
  using Node = PrunedExpression::Node;
  using Kind = PrunedExpression::Kind;
  using Form = PrunedExpression::Form;

  /// A subexpression: a constant or a node of the result.
  struct Value {
    bool constant = true, full = false;
    uint32_t node = 0;
  };

  Value operand(uint32_t o);
  static Value constant(bool full) { return {true, full, 0}; }
  /// Combines children; the list is used up.
  Value combine(Kind kind, bool complement, std::vector<Value>& children);
  [[nodiscard]] PrunedExpression finish(const Value& root);

 private:
  Value make(Kind kind, bool complement, const std::vector<Value>& children);
  PrunedExpression result_;
};

template <class ValueOf>
PrunedExpression PrunedExpression::fold(ValueOf&& value) const {
  ExpressionFolder folder;
  if (form_ == Form::kEmpty || form_ == Form::kFull) return *this;
  std::vector<ExpressionFolder::Value> values(nodes_.size()), children;
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const Node& n = nodes_[i];
    if (n.kind == Kind::kOperand) {
      const Inside v = value(n.operand);
      values[i] = v == Inside::kUnknown ? folder.operand(n.operand)
                                        : ExpressionFolder::constant(v == Inside::kYes);
      continue;
    }
    children.clear();
    for (uint32_t c = 0; c < n.child_count; ++c) {
      children.push_back(values[children_[n.first_child + c]]);
    }
    values[i] = folder.combine(n.kind, n.complement, children);
  }
  return folder.finish(values.back());
}

template <class ValueOf>
Inside PrunedExpression::evaluate(ValueOf&& value, std::vector<Inside>& scratch) const {
  if (form_ == Form::kEmpty) return Inside::kNo;
  if (form_ == Form::kFull) return Inside::kYes;
  scratch.resize(nodes_.size());
  const auto negate = [](Inside v) {
    return v == Inside::kUnknown ? v : v == Inside::kYes ? Inside::kNo : Inside::kYes;
  };
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const Node& n = nodes_[i];
    if (n.kind == Kind::kOperand) {
      scratch[i] = value(n.operand);
      continue;
    }
    const uint32_t* child = children_.data() + n.first_child;
    // The value that decides alone, and the value when nothing decides.
    Inside result = Inside::kNo;
    if (n.kind == Kind::kXor) {
      for (uint32_t c = 0; c < n.child_count; ++c) {
        const Inside v = scratch[child[c]];
        result = v == Inside::kUnknown ? v : v == Inside::kYes ? negate(result) : result;
      }
    } else {
      const bool all = n.kind == Kind::kIntersection;
      const Inside deciding = all ? Inside::kNo : Inside::kYes;
      const bool difference = n.kind == Kind::kDifference;
      result = negate(deciding);
      for (uint32_t c = difference ? 1 : 0; c < n.child_count; ++c) {
        const Inside v = scratch[child[c]];
        if (v == deciding) {
          result = deciding;
          break;
        }
        if (v == Inside::kUnknown) result = v;
      }
      if (difference) {
        const Inside first = scratch[child[0]], rest = negate(result);
        result = first == Inside::kNo || rest == Inside::kNo     ? Inside::kNo
                 : first == Inside::kYes && rest == Inside::kYes ? Inside::kYes
                                                                 : Inside::kUnknown;
      }
    }
    scratch[i] = n.complement ? negate(result) : result;
  }
  return scratch.back();
}

template <class ValueOf>
void PrunedExpression::evaluate_words(ValueOf&& value, std::vector<uint64_t>& words) const {
  words.resize(nodes_.size());
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const Node& n = nodes_[i];
    if (n.kind == Kind::kOperand) {
      words[i] = value(n.operand);
      continue;
    }
    const uint32_t* child = children_.data() + n.first_child;
    uint64_t word = words[child[0]];
    for (uint32_t c = 1; c < n.child_count; ++c) {
      const uint64_t next = words[child[c]];
      switch (n.kind) {
        case Kind::kUnion:
          word |= next;
          break;
        case Kind::kIntersection:
          word &= next;
          break;
        default:
          assert(n.kind == Kind::kDifference);
          word &= ~next;
          break;
      }
    }
    words[i] = n.complement ? ~word : word;
  }
}

template <class Emit>
void PrunedExpression::split_boundary(const std::vector<uint64_t>& words, int shift, uint64_t asked,
                                      std::vector<uint64_t>& scratch, Emit&& emit) const {
  const auto boundary_of = [&](size_t node) { return words[node] ^ (words[node] >> shift); };
  scratch.assign(nodes_.size(), 0);
  scratch.back() = asked & boundary_of(nodes_.size() - 1);
  for (size_t i = nodes_.size(); i-- > 0;) {
    const Node& n = nodes_[i];
    uint64_t rest = scratch[i];
    if (n.kind == Kind::kOperand) {
      if (rest != 0) emit(n.operand, rest);
      continue;
    }
    // The lowest child that has boundary there gives it; it may be that of other nodes, too.
    for (uint32_t c = 0; c < n.child_count; ++c) {
      const uint32_t child = children_[n.first_child + c];
      const uint64_t taken = rest & boundary_of(child);
      scratch[child] |= taken;
      rest &= ~taken;
    }
  }
}

template <class Front, class Back>
PrunedExpression::Boundary PrunedExpression::boundary(Front&& front, Back&& back,
                                                      std::vector<Boundary>& scratch) const {
  if (form_ == Form::kEmpty || form_ == Form::kFull) return {};
  scratch.resize(nodes_.size());
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const Node& n = nodes_[i];
    Boundary& r = scratch[i];
    if (n.kind == Kind::kOperand) {
      r = {front(n.operand), back(n.operand), n.operand};
    } else {
      const uint32_t* child = children_.data() + n.first_child;
      r = scratch[child[0]];
      for (uint32_t c = 1; c < n.child_count; ++c) {
        const Boundary& b = scratch[child[c]];
        // A symmetric difference is a left fold of binary ones: what came before counts only where
        // it still has boundary. (In the others a child's boundary cannot vanish and come back.)
        if (r.front == r.back) r.operand = kNoOperand;
        if (r.operand == kNoOperand) r.operand = b.operand;
        switch (n.kind) {
          case Kind::kUnion:
            r.front = r.front || b.front, r.back = r.back || b.back;
            break;
          case Kind::kIntersection:
            r.front = r.front && b.front, r.back = r.back && b.back;
            break;
          case Kind::kDifference:
            r.front = r.front && !b.front, r.back = r.back && !b.back;
            break;
          default:
            r.front = r.front != b.front, r.back = r.back != b.back;
            break;
        }
      }
      if (n.complement) r.front = !r.front, r.back = !r.back;
    }
    if (r.front == r.back) r.operand = kNoOperand;
  }
  return scratch.back();
}

}  // namespace csgrun
