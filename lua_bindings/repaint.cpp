#include "lua_bindings/repaint.h"

#include <map>
#include <utility>
#include <vector>

namespace csgrun {
namespace {

using Change = std::function<Appearance(const Appearance&)>;

NodePtr repaint_leaf(const NodePtr& leaf, const Change& change) {
  const PolygonMesh& mesh = *leaf->mesh();
  if (mesh.appearance_of.empty()) {
    return Node::painted(change(Appearance{}), leaf, leaf->where());
  }
  auto copy = std::make_shared<PolygonMesh>(mesh);
  for (Appearance& appearance : copy->appearances) appearance = change(appearance);
  return Node::leaf(std::move(copy), leaf->where());
}

/// Whether the colours below a node are those of its children, so that it can be made anew of them.
bool is_transparent(const Node& node) {
  return node.kind() == NodeKind::kTransform || node.kind() == NodeKind::kBoolean;
}

/// The tree that is evaluated, or hulls are made of, in the place of a node; mostly none.
const NodePtr& stand_in(const Node& node) {
  return node.same_solid() ? node.same_solid() : node.rounded_leaf();
}

/// `children`: with its stand-in, if there is one, last.
NodePtr with_children(const Node& node, std::vector<NodePtr> children) {
  if (node.kind() == NodeKind::kTransform) {
    return Node::transformed(node.transform(), std::move(children[0]), node.where());
  }
  if (stand_in(node)) {
    NodePtr last = std::move(children.back());
    children.pop_back();
    return node.same_solid()
               ? Node::intersection_as(std::move(children), std::move(last), node.where())
               : Node::difference_as(std::move(children), std::move(last), node.where());
  }
  return Node::boolean(node.op(), std::move(children), node.where());
}

}  // namespace

NodePtr repaint(const NodePtr& root, const Change& change) {
  std::map<const Node*, NodePtr> done;  // only looked up, never walked through
  std::vector<NodePtr> pending{root};
  while (!pending.empty()) {
    const NodePtr node = pending.back();
    if (done.contains(node.get())) {
      pending.pop_back();
      continue;
    }
    if (is_transparent(*node)) {
      std::vector<NodePtr> below = node->children(), children;
      if (stand_in(*node)) below.push_back(stand_in(*node));
      for (const NodePtr& child : below) {
        const auto known = done.find(child.get());
        if (known == done.end()) {
          pending.push_back(child);
        } else {
          children.push_back(known->second);
        }
      }
      if (children.size() < below.size()) continue;
      done[node.get()] = with_children(*node, std::move(children));
    } else if (node->kind() == NodeKind::kAppearance) {
      done[node.get()] =
          Node::painted(change(node->appearance()), node->children()[0], node->where());
    } else if (node->kind() == NodeKind::kLeaf) {
      done[node.get()] = repaint_leaf(node, change);
    } else if (node->kind() == NodeKind::kEmpty) {
      done[node.get()] = node;
    } else {
      done[node.get()] = Node::painted(change(first_appearance(node)), node, node->where());
    }
    pending.pop_back();
  }
  return done.at(root.get());
}

Appearance first_appearance(const NodePtr& root) {
  const Node* node = root.get();
  while (node->kind() != NodeKind::kLeaf) {
    if (node->kind() == NodeKind::kAppearance) return node->appearance();
    if (node->children().empty()) return {};
    node = node->children()[0].get();
  }
  const PolygonMesh& mesh = *node->mesh();
  return mesh.appearance_of.empty() ? Appearance{} : mesh.appearances[mesh.appearance_of[0]];
}

}  // namespace csgrun
