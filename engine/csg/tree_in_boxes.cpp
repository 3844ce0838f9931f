#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include <glm/common.hpp>

#include <csgrun/engine/tree_in_boxes.h>

#include "engine/bsp/packed_boxes.h"
#include "engine/csg/mesh_shells.h"
#include "engine/csg/point_box.h"
#include "engine/csg/tree_nodes.h"

namespace csgrun {
namespace {

/// The tree that is evaluated in the place of a node.
const NodePtr& meant(const NodePtr& node) {
  const NodePtr* at = &node;
  while ((*at)->same_solid()) at = &(*at)->same_solid();
  return *at;
}

bool is_boolean(const NodePtr& node, BooleanOp op) {
  return node->kind() == NodeKind::kBoolean && node->op() == op;
}

PointBox image_around(const Affine& map, const PointBox& box) { return widened(image(map, box)); }

/// Things with boxes, and which of them meet one.
class BoxList {
 public:
  explicit BoxList(std::vector<PointBox> boxes) : boxes_(std::move(boxes)) {
    if (boxes_.size() <= kFew) return;
    std::vector<FloatBox> rounded;
    for (const PointBox& box : boxes_) rounded.push_back(float_box(box));
    packed_.emplace(rounded);
  }

  /// Ascending.
  [[nodiscard]] std::vector<uint32_t> meeting(const PointBox& box) const {
    std::vector<uint32_t> found;
    const auto look = [&](uint32_t i) {
      if (boxes_[i].meets(box)) found.push_back(i);
    };
    if (packed_) {
      packed_->visit_all(float_box(box), [&](uint32_t place) {
        if (place < boxes_.size()) look(packed_->order()[place]);
      });
      std::sort(found.begin(), found.end());
    } else {
      for (uint32_t i = 0; i < boxes_.size(); ++i) look(i);
    }
    return found;
  }

 private:
  static constexpr size_t kFew = 16;

  /// Rounding is monotone, so boxes that meet still do.
  static FloatBox float_box(const PointBox& box) {
    constexpr double kMost = std::numeric_limits<float>::max();
    FloatBox result{};
    for (int i = 0; i < 3; ++i) {
      result.lo[i] = static_cast<float>(std::clamp(box.lo[i], -kMost, kMost));
      result.hi[i] = static_cast<float>(std::clamp(box.hi[i], -kMost, kMost));
    }
    return result;
  }

  std::vector<PointBox> boxes_;
  std::optional<PackedBoxes> packed_;
};

}  // namespace

struct TreeInBoxes::Impl {
  /// What is known of a node, in its own axes.
  struct Facts {
    PointBox box = PointBox::nothing();
    double size = 0;  ///< faces of leaves, as often as they occur
  };
  /// The operands of a Boolean and of those of its kind that are operands of it, as one list.
  struct Operands {
    std::vector<NodePtr> nodes;
    BoxList boxes;
  };
  struct Shells {
    MeshShells shells;
    BoxList boxes;
    explicit Shells(const std::shared_ptr<const PolygonMesh>& mesh)
        : shells(mesh), boxes(shells.boxes()) {}
  };
  struct Part {
    NodePtr tree;  ///< null: nothing
    double size = 0;
  };

  void examine(const NodePtr& root);
  [[nodiscard]] Facts facts_of(const Node& node) const;
  [[nodiscard]] const Facts& of(const NodePtr& node) const { return facts.at(meant(node).get()); }
  [[nodiscard]] static std::vector<NodePtr> flattened(const Node& node);
  const Operands* operands_of(const NodePtr& node);
  Part within(const NodePtr& given, const PointBox& box, int depth);
  Part leaf_within(const NodePtr& leaf, const PointBox& box, double size);
  Part boolean_within(const NodePtr& node, const PointBox& box, int depth, double size);

  NodePtr root;
  std::unordered_map<const Node*, Facts> facts;
  std::unordered_map<const Node*, Operands> lists;
  size_t listed = 0;  ///< how many operands all lists have
  std::unordered_map<const PolygonMesh*, Shells> shells;
};

/// Facts of all nodes, from below, on a stack of its own.
void TreeInBoxes::Impl::examine(const NodePtr& tree) {
  std::vector<const Node*> stack{tree.get()};
  while (!stack.empty()) {
    const Node* const node = stack.back();
    const size_t before = stack.size();
    if (!facts.contains(node)) {
      for (const NodePtr& child : evaluated_children(*node)) {
        if (!facts.contains(child.get())) stack.push_back(child.get());
      }
      if (stack.size() > before) continue;
      facts.emplace(node, facts_of(*node));
    }
    stack.pop_back();
  }
}

TreeInBoxes::Impl::Facts TreeInBoxes::Impl::facts_of(const Node& node) const {
  Facts result;
  const auto children = evaluated_children(node);
  for (const NodePtr& child : children) result.size += facts.at(child.get()).size;
  const auto box = [&](size_t i) -> const PointBox& { return facts.at(children[i].get()).box; };
  const auto include_all = [&] {
    for (size_t i = 0; i < children.size(); ++i) result.box.include(box(i));
  };
  if (node.same_solid()) return facts.at(node.same_solid().get());
  switch (node.kind()) {
    case NodeKind::kEmpty:
      break;
    case NodeKind::kLeaf: {
      const PolygonMesh& mesh = *node.mesh();
      result.box = box_of(mesh);
      result.size = static_cast<double>(mesh.hull_of_points ? mesh.points.size()  //
                                                            : mesh.face_count());
      break;
    }
    case NodeKind::kTransform:
      result.box = image_around(node.transform(), box(0));
      break;
    case NodeKind::kBoolean:
      if (node.op() == BooleanOp::kDifference) {
        result.box = box(0);
      } else if (node.op() == BooleanOp::kIntersection) {
        result.box = box(0);
        for (size_t i = 1; i < children.size(); ++i) {
          result.box.lo = glm::max(result.box.lo, box(i).lo);
          result.box.hi = glm::min(result.box.hi, box(i).hi);
        }
        if (result.box.is_nothing()) result.box = PointBox::nothing();
      } else {
        include_all();
      }
      break;
    case NodeKind::kConstruction:
      if (node.construction() != Construction::kConvexHull) {
        result.box = PointBox::everything();
        break;
      }
      include_all();
      break;
    default:
      include_all();
  }
  return result;
}

/// Unions and intersections are associative; differences are lists of what is taken away.
std::vector<NodePtr> TreeInBoxes::Impl::flattened(const Node& node) {
  std::vector<NodePtr> result;
  const BooleanOp op = node.op();
  if (op == BooleanOp::kSymmetricDifference) return node.children();
  if (op == BooleanOp::kDifference) {
    std::vector<const Node*> chain{&node};
    while (is_boolean(meant(chain.back()->children()[0]), op)) {
      chain.push_back(meant(chain.back()->children()[0]).get());
    }
    result.push_back(chain.back()->children()[0]);
    for (size_t i = chain.size(); i-- > 0;) {
      const auto& children = chain[i]->children();
      result.insert(result.end(), children.begin() + 1, children.end());
    }
    return result;
  }
  // A shared operand a second time adds nothing.
  std::unordered_set<const Node*> opened;
  std::vector<NodePtr> stack(node.children().rbegin(), node.children().rend());
  while (!stack.empty()) {
    const NodePtr top = std::move(stack.back());
    stack.pop_back();
    if (!is_boolean(meant(top), op)) {
      result.push_back(top);
    } else if (opened.insert(meant(top).get()).second) {
      const auto& children = meant(top)->children();
      stack.insert(stack.end(), children.rbegin(), children.rend());
    }
  }
  return result;
}

/// Null where the lists would be more than there is room for: of a union of all that came before
/// another each is a list.
const TreeInBoxes::Impl::Operands* TreeInBoxes::Impl::operands_of(const NodePtr& node) {
  constexpr size_t kMostListed = 4u << 20;
  if (const auto known = lists.find(node.get()); known != lists.end()) return &known->second;
  if (listed > kMostListed) return nullptr;
  std::vector<NodePtr> nodes = flattened(*node);
  listed += nodes.size();
  std::vector<PointBox> boxes;
  for (const NodePtr& operand : nodes) boxes.push_back(of(operand).box);
  return &lists.emplace(node.get(), Operands{std::move(nodes), BoxList(std::move(boxes))})
              .first->second;
}

TreeInBoxes::Impl::Part TreeInBoxes::Impl::leaf_within(const NodePtr& leaf, const PointBox& box,
                                                       double size) {
  const std::shared_ptr<const PolygonMesh>& mesh = leaf->mesh();
  if (mesh->hull_of_points || mesh->convex) return {leaf, size};
  const auto known = shells.try_emplace(mesh.get(), mesh).first;
  const MeshShells& all = known->second.shells;
  const std::vector<uint32_t> some = known->second.boxes.meeting(box);
  if (some.empty()) return {};
  if (some.size() == all.boxes().size()) return {leaf, size};
  size_t faces = 0;
  for (const uint32_t shell : some) faces += all.face_count(shell);
  return {Node::leaf(all.mesh_of(some), leaf->where()), static_cast<double>(faces)};
}

TreeInBoxes::Impl::Part TreeInBoxes::Impl::boolean_within(const NodePtr& node, const PointBox& box,
                                                          int depth, double size) {
  const Operands* const list = operands_of(node);
  if (list == nullptr) return {node, size};
  const BooleanOp op = node->op();
  const bool needs_all = op == BooleanOp::kIntersection;
  Part result;
  std::vector<NodePtr> kept;
  bool is_changed = false;
  size_t next = 0;  // of the list
  for (const uint32_t i : list->boxes.meeting(box)) {
    const NodePtr& operand = list->nodes[i];
    const Part part = within(operand, box, depth + 1);
    const bool is_first_gone = op == BooleanOp::kDifference && next == 0 && (i > 0 || !part.tree);
    if (is_first_gone || (needs_all && (i > next || !part.tree))) return {};
    is_changed |= i > next || part.tree != operand;
    next = i + 1;
    if (!part.tree) continue;
    kept.push_back(part.tree);
    result.size += part.size;
  }
  if (kept.empty() || (needs_all && next < list->nodes.size())) return {};
  if (!is_changed && next == list->nodes.size()) return {node, size};
  result.tree = kept.size() == 1 ? kept[0] : Node::boolean(op, std::move(kept), node->where());
  return result;
}

/// What of a node there is in a box, both in the axes of the node.
TreeInBoxes::Impl::Part TreeInBoxes::Impl::within(const NodePtr& given, const PointBox& box,
                                                  int depth) {
  constexpr int kDeepest = 500;  // what is deeper stays whole
  const NodePtr& node = meant(given);
  const Facts& known = of(node);
  if (!known.box.meets(box)) return {};
  if (box.holds(known.box) || depth > kDeepest) return {given, known.size};
  const bool is_transform = node->kind() == NodeKind::kTransform;
  switch (node->kind()) {
    case NodeKind::kLeaf:
      return leaf_within(node, box, known.size);
    case NodeKind::kBoolean:
      return boolean_within(node, box, depth, known.size);
    case NodeKind::kTransform:
    case NodeKind::kAppearance:
      break;
    default:
      return {given, known.size};
  }
  const NodePtr& child = node->children()[0];
  Part part = within(child, is_transform ? original(node->transform(), box) : box, depth + 1);
  if (!part.tree) return part;
  if (part.tree == child) return {given, known.size};
  part.tree = is_transform
                  ? Node::transformed(node->transform(), std::move(part.tree), node->where())
                  : Node::painted(node->appearance(), std::move(part.tree), node->where());
  return part;
}

TreeInBoxes::TreeInBoxes(NodePtr tree) : impl_(std::make_unique<Impl>()) {
  impl_->root = std::move(tree);
}
TreeInBoxes::~TreeInBoxes() = default;

NodePtr TreeInBoxes::within(const glm::dvec3& low, const glm::dvec3& high) {
  constexpr double kSmall = 1.0 / 16;
  if (impl_->facts.empty()) impl_->examine(impl_->root);
  Impl::Part part = impl_->within(impl_->root, {low, high}, 0);
  if (!part.tree) part.tree = Node::empty(impl_->root->where());
  return part.size <= kSmall * impl_->of(impl_->root).size ? part.tree : nullptr;
}

}  // namespace csgrun
