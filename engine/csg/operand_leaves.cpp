#include "engine/csg/operand_leaves.h"

#include <array>
#include <cstring>
#include <set>
#include <utility>

#include "engine/csg/frames.h"

namespace csgrun {
namespace {

/// What was seen under which transform: shared subtrees are walked once for each.
class Seen {
 public:
  bool is_new(const PlacedNode& placed) {
    std::array<double, 12> entries;
    size_t k = 0;
    for (const auto& row : placed.map.m) {
      for (const double x : row) entries[k++] = x + 0.0;
    }
    return known_.insert({placed.node.get(), entries}).second;
  }

 private:
  std::set<std::pair<const Node*, std::array<double, 12>>> known_;
};

/// Steps through transforms, appearances, operators of one operand, and differences that are leaves
/// but for rounding.
void unwrap(PlacedNode& placed) {
  while (true) {
    const Node& node = *placed.node;
    if (node.kind() == NodeKind::kTransform) {
      placed.map = Affine::compose(placed.map, node.transform());
    } else if (node.kind() == NodeKind::kAppearance) {
      if (placed.paint == nullptr) placed.paint = &node.appearance();
    } else if (node.rounded_leaf()) {
      placed.node = NodePtr(node.rounded_leaf());
      continue;
    } else if (node.kind() != NodeKind::kBoolean || node.children().size() != 1) {
      return;
    }
    placed.node = NodePtr(node.children()[0]);
  }
}

}  // namespace

NodePtr PlacedNode::tree() const {
  NodePtr result = map == Affine{} ? node : Node::transformed(map, node, node->where());
  if (paint != nullptr) result = Node::painted(*paint, std::move(result), node->where());
  return result;
}

std::vector<PlacedNode> union_members(const std::vector<NodePtr>& operands) {
  std::vector<PlacedNode> members, stack;
  for (size_t i = operands.size(); i-- > 0;) stack.push_back({operands[i], {}, nullptr});
  Seen seen;
  while (!stack.empty()) {
    PlacedNode top = std::move(stack.back());
    stack.pop_back();
    unwrap(top);
    if (top.node->kind() == NodeKind::kEmpty || !seen.is_new(top)) continue;
    if (top.node->kind() != NodeKind::kBoolean || top.node->op() != BooleanOp::kUnion) {
      members.push_back(std::move(top));
      continue;
    }
    const auto& children = top.node->children();
    for (size_t i = children.size(); i-- > 0;) stack.push_back({children[i], top.map, top.paint});
  }
  return members;
}

std::optional<CommonTurn> common_turn(const std::vector<PlacedNode>& members) {
  std::vector<PlacedNode> stack(members.rbegin(), members.rend());
  Seen seen;
  RowTable table;
  std::optional<Frame> common;
  LinearSplit first;
  Affine first_map;
  while (!stack.empty()) {
    PlacedNode top = std::move(stack.back());
    stack.pop_back();
    unwrap(top);
    if (!seen.is_new(top)) continue;
    if (top.node->kind() != NodeKind::kLeaf) {
      const auto& children = top.node->children();
      for (size_t i = children.size(); i-- > 0;) stack.push_back({children[i], top.map, nullptr});
      continue;
    }
    const LinearSplit split = split_linear(top.map);
    if (!split.framed) return std::nullopt;
    std::array<std::array<int64_t, 3>, 3> rows;
    for (int i = 0; i < 3; ++i)
      rows[i] = integer_row(table.representative(table.add(split.rows[i])));
    const CanonicalFrame canonical = canonical_frame(rows);
    if (!canonical.framed || canonical.placement.frame.is_identity) return std::nullopt;
    if (!common) {
      common = canonical.placement.frame;
      first = split;
      first_map = top.map;
    } else if (common->matrix != canonical.placement.frame.matrix) {
      return std::nullopt;
    }
  }
  if (!common) return std::nullopt;
  CommonTurn turn;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      turn.forth.m[i][j] = first_map.m[i][j] / first.scale[j];
      turn.back.m[i][j] = first.rows[i][j];
    }
  }
  return turn;
}

const Appearance* first_appearance(const PlacedNode& member) {
  PlacedNode at = member;
  while (true) {
    unwrap(at);
    if (at.paint != nullptr) return at.paint;
    if (at.node->children().empty()) break;
    at.node = NodePtr(at.node->children()[0]);
  }
  if (at.node->kind() != NodeKind::kLeaf) return nullptr;
  const PolygonMesh& mesh = *at.node->mesh();
  if (mesh.appearances.empty()) return nullptr;
  return &mesh.appearances[mesh.appearance_of.empty() ? 0 : mesh.appearance_of[0]];
}

}  // namespace csgrun
