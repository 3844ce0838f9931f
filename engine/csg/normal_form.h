// The normal form of a CSG tree: transforms and appearances folded into leaves, nested unions,
// intersections and differences flattened, no-ops removed, equal subtrees shared.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include <csgrun/engine/csg_tree.h>

#include "engine/csg/appearance_table.h"

namespace csgrun {

constexpr uint32_t kUnpainted = UINT32_MAX;

/// A node of the normal form. Nodes stand in one array, children before their parents.
struct NormalNode {
  enum class Kind : uint8_t { kEmpty, kLeaf, kOperator, kHull };
  Kind kind = Kind::kEmpty;

  /// Of a leaf: it stands for the hull of its surface, which may cross itself.
  std::optional<OuterHull> hull;
  NodePtr leaf;                 ///< its mesh and where it was made
  Affine map;                   ///< total transform of the leaf
  uint32_t paint = kUnpainted;  ///< appearance id that covers the leaf's own
  SourceRef bent_by;            ///< the most nearly singular transform above the leaf

  /// The operands are those of `first`, when that is an operator of the same kind, else `first`
  /// itself, then `rest`: so a chain that grows by one operand shares all it had. Every operator is
  /// a left fold of binary ones. A hull has `first` only: all places are filled that cannot be
  /// reached from outside of that solid. It is a barrier: no flattening goes through it.
  BooleanOp op = BooleanOp::kUnion;
  uint32_t first = 0;
  std::vector<uint32_t> rest;
};

/// Builds normal forms. It remembers what it has built, so that a tree that grew by a few nodes
/// since the last call costs those nodes. Uses constant stack for trees of any depth. Operands of
/// symmetric differences keep their nesting on the right, as the attribute of a coplanar overlap is
/// that of the lowest operand.
class NormalForm {
 public:
  explicit NormalForm(AppearanceTable& appearances);

  /// The index of the root's normal form. Errors: kInvalidArgument for a transform that is not
  /// finite, kInternal for a null child.
  Result<uint32_t> add(const NodePtr& root);

  [[nodiscard]] const std::vector<NormalNode>& nodes() const { return nodes_; }
  /// The operands of an operator, with those of its prefix.
  [[nodiscard]] std::vector<uint32_t> operands(uint32_t index) const;
  /// Every node that `roots` reach, each once, in tree order (parents after children, operands left
  /// to right). What one of them, `closed`, stands over is not listed for its sake.
  [[nodiscard]] std::vector<uint32_t> reachable(std::span<const uint32_t> roots,
                                                uint32_t closed = UINT32_MAX) const;
  /// Forgets everything.
  void clear();

 private:
  struct Item;
  struct Cluster;
  struct Memo {
    const Node* node = nullptr;
    Affine map;
    uint32_t paint = kUnpainted;
    bool operator==(const Memo&) const = default;
  };
  struct MemoHash {
    size_t operator()(const Memo& memo) const;
  };

  Status unwrap(Item& item) const;
  uint32_t leaf(const Item& item);
  Result<uint32_t> hulled_leaf(const Item& item);
  [[nodiscard]] bool takes_all(const Cluster& difference, uint32_t value) const;
  void collect(Cluster& cluster, uint32_t value) const;
  uint32_t finish(Cluster& cluster);
  bool absorbs(Cluster& cluster, const Item& item) const;

  AppearanceTable& appearances_;
  std::vector<NormalNode> nodes_;  // the first is the empty one
  std::unordered_map<Memo, uint32_t, MemoHash> memo_;
  std::vector<NodePtr> alive_;  // keys of memo_ stay valid
  /// Of reachable(), by index: twice the number of the call that was there last, or one more.
  mutable std::vector<uint64_t> visits_;
  mutable uint64_t calls_ = 0;
};

}  // namespace csgrun
