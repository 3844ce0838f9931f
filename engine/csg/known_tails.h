// Unions and intersections that somebody looked at, for others that put something before them:
// new + part has the operands of the part last.
#pragma once

#include <algorithm>
#include <list>
#include <vector>

#include "engine/csg/scene.h"

namespace csgrun {

/// The last few of them.
class KnownTails {
 public:
  struct Tail {
    size_t first = 0;  ///< the operand of the list with which it begins
    Subtree value;
  };

  /// Notes a node of a scene, if it is one.
  void note(const Scene& scene, uint32_t node) {
    const SceneNode& operation = scene.nodes[node];
    if (!is_associative(operation) || operation.subtree.id.frame != 0) return;
    constexpr size_t kMost = 8;
    Entry entry{operation.op, operation.subtree, {}};
    for (const uint32_t operand : scene.operands(node).operands) {
      entry.operands.push_back(placed(scene, operand));
    }
    entries_.remove_if([&](const Entry& e) { return e.value.id == entry.value.id; });
    entries_.push_front(std::move(entry));
    if (entries_.size() > kMost) entries_.pop_back();
  }

  /// The longest tail of a node's operands that was noted, where it was, less than all of them;
  /// `list`: its operands. None: first is 0.
  [[nodiscard]] Tail find(const Scene& scene, uint32_t node, const OperandList& list) const {
    Tail found;
    if (!is_associative(scene.nodes[node])) return found;
    for (const Entry& entry : entries_) {
      const size_t count = entry.operands.size();
      if (entry.op != scene.nodes[node].op || count >= list.operands.size()) continue;
      const size_t first = list.operands.size() - count;
      if (found.first != 0 && first >= found.first) continue;
      const bool is_there =
          std::equal(entry.operands.begin(), entry.operands.end(),
                     list.operands.begin() + static_cast<long>(first),
                     [&](const Placed& a, uint32_t b) { return a == placed(scene, b); });
      if (is_there) found = {first, entry.value};
    }
    return found;
  }

  void clear() { entries_.clear(); }

 private:
  /// An operand, and its frame, whose number differs from scene to scene.
  struct Placed {
    Identity id;
    Frame frame;
    bool operator==(const Placed&) const = default;
  };
  struct Entry {
    BooleanOp op;
    Subtree value;
    std::vector<Placed> operands;
  };

  static bool is_associative(const SceneNode& node) {
    return node.kind == SceneNode::Kind::kOperator &&
           (node.op == BooleanOp::kUnion || node.op == BooleanOp::kIntersection);
  }
  static Placed placed(const Scene& scene, uint32_t node) {
    Placed result{scene.nodes[node].subtree.id, scene.frames[scene.nodes[node].subtree.id.frame]};
    result.id.frame = 0;
    return result;
  }

  std::list<Entry> entries_;
};

}  // namespace csgrun
