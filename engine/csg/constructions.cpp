#include "engine/csg/constructions.h"

#include <algorithm>
#include <memory>
#include <utility>

#include <glm/common.hpp>

#include "engine/csg/grid_solid.h"
#include "engine/csg/minkowski.h"
#include "engine/csg/operand_leaves.h"

namespace csgrun {
namespace {

/// The hull of points as a leaf.
NodePtr hull_leaf(std::vector<glm::dvec3> points, const Appearance* appearance, const char* kind,
                  const SourceRef& where) {
  auto mesh = std::make_shared<PolygonMesh>();
  mesh->points = std::move(points);
  mesh->hull_of_points = true;
  mesh->kind = kind;
  if (appearance != nullptr) mesh->appearances.push_back(*appearance);
  return Node::leaf(std::move(mesh), where);
}

/// Whether the corners of a member are its mesh's points.
bool has_own_points(const PlacedNode& member) {
  return member.node->kind() == NodeKind::kLeaf && member.node->mesh()->fill == FillRule::kNonZero;
}

void append_points(const PlacedNode& member, std::vector<glm::dvec3>& points) {
  const PolygonMesh& mesh = *member.node->mesh();
  std::vector<uint8_t> is_used(mesh.points.size(), mesh.hull_of_points ? 1 : 0);
  for (const uint32_t corner : mesh.corners) {
    if (corner < is_used.size()) is_used[corner] = 1;
  }
  for (size_t p = 0; p < is_used.size(); ++p) {
    if (is_used[p] != 0) points.push_back(member.map.apply(mesh.points[p]));
  }
}

void turn_back(std::vector<PlacedNode>& members, const std::optional<CommonTurn>& turn) {
  if (!turn) return;
  for (PlacedNode& member : members) member.map = Affine::compose(turn->back, member.map);
}

NodePtr turned_forth(NodePtr node, const std::optional<CommonTurn>& turn, const SourceRef& where) {
  return turn ? Node::transformed(turn->forth, std::move(node), where) : node;
}

}  // namespace

Result<NodePtr> Constructions::make_hull(const Node& node, const std::vector<NodePtr>& operands) {
  std::vector<PlacedNode> members = union_members(operands);
  const std::optional<CommonTurn> turn = common_turn(members);
  turn_back(members, turn);
  std::vector<glm::dvec3> points;
  std::vector<NodePtr> others;
  const Appearance* appearance = nullptr;
  for (const PlacedNode& member : members) {
    if (appearance == nullptr) appearance = first_appearance(member);
    if (has_own_points(member)) {
      append_points(member, points);
    } else {
      others.push_back(member.tree());
    }
  }
  if (!others.empty()) {
    auto parts = evaluate_(others, false);
    if (!parts) return parts.error();
    size_t rounded = 0;
    for (const SolidPtr& solid : parts->solids) {
      auto corners = grid_solid(*solid, parts->step, false);
      if (!corners) return corners.error();
      rounded += corners->rounded;
      points.insert(points.end(), solid->positions.begin(), solid->positions.end());
    }
    if (rounded > 0) warnings_.add(node.where(), "hull: " + rounding_note(rounded, parts->step));
  }
  if (points.empty()) return Node::empty(node.where());
  return turned_forth(hull_leaf(std::move(points), appearance, "hull", node.where()), turn,
                      node.where());
}

Result<NodePtr> Constructions::make_sum(const Node& node, const std::vector<NodePtr>& operands) {
  std::vector<std::vector<PlacedNode>> unions;
  std::vector<PlacedNode> all;
  for (const NodePtr& operand : operands) {
    unions.push_back(union_members({operand}));
    all.insert(all.end(), unions.back().begin(), unions.back().end());
  }
  const std::optional<CommonTurn> turn = common_turn(all);
  turn_back(all, turn);
  std::vector<NodePtr> trees;
  for (const PlacedNode& member : all) trees.push_back(member.tree());
  if (trees.empty()) return Node::empty(node.where());
  auto parts = evaluate_(trees, true);
  if (!parts) return parts.error();

  std::vector<std::vector<Summand>> summands;
  std::vector<size_t> of_operand;  // by entry of `summands`
  const Appearance* appearance = nullptr;
  size_t rounded = 0;
  for (size_t i = 0, at = 0; i < unions.size(); ++i) {
    std::vector<Summand> list;
    for (size_t k = 0; k < unions[i].size(); ++k, ++at) {
      if (parts->solids[at]->empty()) continue;
      if (appearance == nullptr) appearance = first_appearance(all[at]);
      Summand summand;
      summand.is_convex = parts->is_convex[at] != 0;
      auto solid = grid_solid(*parts->solids[at], parts->step, !summand.is_convex);
      if (!solid) return solid.error();
      summand.solid = *std::move(solid);
      summand.node = trees[at];
      if (all[at].node->kind() != NodeKind::kLeaf) rounded += summand.solid.rounded;
      list.push_back(std::move(summand));
    }
    if (list.empty()) continue;
    summands.push_back(std::move(list));
    of_operand.push_back(i);
  }
  if (summands.empty()) return Node::empty(node.where());
  if (summands.size() == 1) return NodePtr(operands[of_operand[0]]);
  if (rounded > 0) {
    warnings_.add(node.where(), "minkowski: " + rounding_note(rounded, parts->step));
  }
  // Sums of convex solids are convex, and what is not makes many pieces: these come last.
  std::stable_partition(summands.begin(), summands.end(), [](const std::vector<Summand>& list) {
    return list.size() == 1 && list[0].is_convex;
  });
  std::vector<Summand> sum = std::move(summands[0]);
  for (size_t i = 1; i < summands.size(); ++i) {
    auto next = minkowski_sum(sum, summands[i], parts->step);
    if (!next) return next.error();
    sum = *std::move(next);
  }
  std::vector<NodePtr> pieces;
  for (Summand& summand : sum) {
    if (!summand.is_convex) {
      pieces.push_back(std::move(summand.node));
      continue;
    }
    pieces.push_back(hull_leaf(to_millimetres(summand.solid.points, parts->step), appearance,
                               "minkowski", node.where()));
  }
  NodePtr result = Node::boolean(BooleanOp::kUnion, std::move(pieces), node.where());
  result = turned_forth(std::move(result), turn, node.where());
  // Pieces that are an operand may have colours of their own, which others of its faces have not.
  return appearance != nullptr ? Node::painted(*appearance, std::move(result), node.where())
                               : result;
}

/// The lengths of the bounding box of a solid; all 0 when it is empty. A union of leaves is not
/// evaluated: it may be so long that its width is nothing on a grid that holds it.
Result<std::array<double, 3>> Constructions::lengths(const NodePtr& operand) {
  const std::vector<PlacedNode> members = union_members({operand});
  std::vector<glm::dvec3> points;
  if (std::all_of(members.begin(), members.end(), has_own_points)) {
    for (const PlacedNode& member : members) append_points(member, points);
  } else {
    auto parts = evaluate_({operand}, false);
    if (!parts) return parts.error();
    points = parts->solids[0]->positions;
  }
  std::array<glm::dvec3, 2> box{};
  if (!points.empty()) box = {points[0], points[0]};
  for (const glm::dvec3& p : points) box = {glm::min(box[0], p), glm::max(box[1], p)};
  return std::array<double, 3>{box[1].x - box[0].x, box[1].y - box[0].y, box[1].z - box[0].z};
}

Result<NodePtr> Constructions::make_resized(const Node& node, const NodePtr& operand) {
  const auto length = lengths(operand);
  if (!length) return length.error();
  if (*std::min_element(length->begin(), length->end()) <= 0) return Node::empty(node.where());
  const Resize& resize = node.resize();
  std::array<double, 3> factor{1, 1, 1};
  int largest = 0;
  for (int i = 0; i < 3; ++i) {
    if (resize.size[i] > 0) factor[i] = resize.size[i] / (*length)[i];
    if (resize.size[i] > resize.size[largest]) largest = i;
  }
  Affine map;
  for (int i = 0; i < 3; ++i) {
    map.m[i][i] = resize.size[i] > 0 || !resize.automatic[i] ? factor[i] : factor[largest];
  }
  return Node::transformed(map, operand, node.where());
}

Result<NodePtr> Constructions::make(const Node& node, const std::vector<NodePtr>& operands) {
  switch (node.construction()) {
    case Construction::kConvexHull:
      return make_hull(node, operands);
    case Construction::kMinkowskiSum:
      return make_sum(node, operands);
    default:
      return make_resized(node, operands[0]);
  }
}

/// A node over other children.
Result<NodePtr> Constructions::rebuilt(const Node& node, std::vector<NodePtr> children) {
  switch (node.kind()) {
    case NodeKind::kTransform:
      return Node::transformed(node.transform(), std::move(children[0]), node.where());
    case NodeKind::kAppearance:
      return Node::painted(node.appearance(), std::move(children[0]), node.where());
    case NodeKind::kOuterHull:
      return Node::outer_hull(node.outer_hull(), std::move(children[0]), node.where());
    case NodeKind::kBoolean:
      return Node::boolean(node.op(), std::move(children), node.where());
    default:
      break;
  }
  auto made = make(node, children);
  if (made || made.error().where.line > 0) return made;
  Error error = made.error();
  error.where = node.where();
  return error;
}

Result<NodePtr> Constructions::expand(const NodePtr& root) {
  if (!root || !root->has_constructions()) return NodePtr(root);
  std::vector<const NodePtr*> stack{&root};
  while (!stack.empty()) {
    const NodePtr& node = *stack.back();
    if (made_.contains(node.get())) {
      stack.pop_back();
      continue;
    }
    const size_t before = stack.size();
    std::vector<NodePtr> children;
    for (const NodePtr& child : node->children()) {
      if (!child || !child->has_constructions()) {
        children.push_back(child);
      } else if (const auto found = made_.find(child.get()); found != made_.end()) {
        children.push_back(found->second);
      } else {
        stack.push_back(&child);
      }
    }
    if (stack.size() > before) {
      std::reverse(stack.begin() + static_cast<std::ptrdiff_t>(before), stack.end());
      continue;
    }
    auto made = rebuilt(*node, std::move(children));
    if (!made) return made.error();
    alive_.push_back(node);
    made_.emplace(node.get(), *std::move(made));
    stack.pop_back();
  }
  return NodePtr(made_.at(root.get()));
}

void Constructions::clear() {
  made_.clear();
  alive_.clear();
}

}  // namespace csgrun
