#include "engine/csg/far_summands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>

#include "engine/csg/tree_nodes.h"

namespace csgrun {
namespace {

/// Whether a solid reaches so far beyond what is seen of it that its grid is another one.
bool reaches_beyond(const PointBox& box, const PointBox& seen) {
  constexpr double kTimes = 16;
  const double size = seen.size();
  if (!is_far(box) || !(size > 0) || !std::isfinite(size)) return false;
  const PointBox around{seen.lo - kTimes * size, seen.hi + kTimes * size};
  return !around.holds(box);
}

/// A box around what is seen, farther out by a quarter of its size, so that neither doubles nor
/// rounding to a grid matter; at multiples of a power of two, which grids have.
NodePtr box_around(const PointBox& seen, const SourceRef& where) {
  const double beyond = seen.size() / 4;
  int exponent = 0;
  std::frexp(beyond, &exponent);
  const double unit = std::ldexp(1, exponent);
  glm::dvec3 lo, hi;
  for (int k = 0; k < 3; ++k) {
    lo[k] = unit * std::floor((seen.lo[k] - beyond) / unit);
    hi[k] = unit * std::ceil((seen.hi[k] + beyond) / unit);
  }
  auto mesh = std::make_shared<PolygonMesh>();
  for (unsigned i = 0; i < 8; ++i) {
    mesh->points.emplace_back((i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y,
                              (i & 4) != 0 ? hi.z : lo.z);
  }
  using Side = std::array<uint32_t, 4>;
  for (const Side& side : {Side{0, 2, 3, 1}, Side{4, 5, 7, 6}, Side{0, 1, 5, 4}, Side{2, 6, 7, 3},
                           Side{0, 4, 6, 2}, Side{1, 3, 7, 5}}) {
    mesh->add_face(side);
  }
  mesh->convex = true;
  mesh->kind = "minkowski";
  return Node::leaf(std::move(mesh), where);
}

PointBox opposite(const PointBox& box) {
  return box.is_nothing() ? box : PointBox{-box.hi, -box.lo};
}

/// Whether there is some room inside for certain: flat leaves, and hulls that are flat, are
/// summands and nothing to a Boolean.
bool is_solid(const Node& node, const SolidBounds& bounds) {
  const PointBox& full = bounds.full;
  return node.kind() == NodeKind::kBoolean ||
         (full.lo.x < full.hi.x && full.lo.y < full.hi.y && full.lo.z < full.hi.z);
}

/// A node with other children.
NodePtr remade(const Node& node, std::vector<NodePtr> children) {
  switch (node.kind()) {
    case NodeKind::kTransform:
      return Node::transformed(node.transform(), std::move(children[0]), node.where());
    case NodeKind::kAppearance:
      return Node::painted(node.appearance(), std::move(children[0]), node.where());
    case NodeKind::kOuterHull:
      return Node::outer_hull(node.outer_hull(), std::move(children[0]), node.where());
    case NodeKind::kBoolean:
      return node.same_solid() ? std::move(children[0])
                               : Node::boolean(node.op(), std::move(children), node.where());
    default:
      break;
  }
  switch (node.construction()) {
    case Construction::kMinkowskiSum:
      return Node::minkowski_sum(std::move(children), node.where());
    case Construction::kResize:
      return Node::resized(node.resize(), std::move(children[0]), node.where());
    case Construction::kConvexHull:
      break;
  }
  return Node::convex_hull(std::move(children), node.where());
}

/// Whether a sum is distributed over what is below a node.
bool has_members(const Node& node) {
  return node.kind() == NodeKind::kTransform || node.kind() == NodeKind::kAppearance ||
         node.same_solid() || (node.kind() == NodeKind::kBoolean && node.op() == BooleanOp::kUnion);
}

}  // namespace

size_t FarSummands::PlaceHash::operator()(const Place& place) const {
  size_t h = std::hash<NodePtr>()(place.node) + (place.is_summand ? 1 : 0);
  for (const glm::dvec3& p : {place.seen.lo, place.seen.hi}) {
    for (int k = 0; k < 3; ++k) h = h * 0x9e3779b97f4a7c15 + std::hash<double>()(p[k]);
  }
  return h;
}

bool FarSummands::may_be_cut(const Place& place) const {
  const SolidBounds& bounds = bounds_.of(place.node);
  return bounds.has_far_sum || (place.is_summand && reaches_beyond(bounds.box, place.seen));
}

FarSummands::Place FarSummands::child(const Place& place, size_t index) const {
  const Node& node = *place.node;
  const std::span<const NodePtr> children = evaluated_children(node);
  const NodePtr& below = children[index];
  const PointBox& own = bounds_.of(below).box;
  switch (node.kind()) {
    case NodeKind::kTransform:
      return {below, common(own, original(node.transform(), place.seen)), place.is_summand};
    case NodeKind::kAppearance:
      return {below, place.seen, place.is_summand};
    case NodeKind::kBoolean: {
      const PointBox& result = bounds_.of(place.node).box;
      const bool is_difference = node.op() == BooleanOp::kDifference;
      const bool is_narrowed = is_difference || node.op() == BooleanOp::kIntersection;
      // That what is taken away leaves no more than its hole is not seen in the boxes of operands
      // (csg/scene_step), by which the ends of far leaves are drawn near.
      const bool is_hidden = is_difference && index == 0 && result != own;
      return {below, common(own, is_narrowed ? common(result, place.seen) : place.seen),
              is_hidden || (has_members(node) && place.is_summand)};
    }
    case NodeKind::kConstruction: {
      if (!is_minkowski_sum(node) || children.size() == 1) break;
      // Empty operands do not count: any of the others may move a point, or none.
      PointBox around = place.seen;
      for (size_t k = 0; k < children.size(); ++k) {
        if (k == index) continue;
        around.include(sum(around, opposite(bounds_.of(children[k]).box)));
      }
      return {below, common(own, around), true};
    }
    default:
      break;
  }
  return {below, own, false};  // all of what a hull is of is seen
}

NodePtr FarSummands::make(const Place& place, std::vector<NodePtr> children) const {
  const Node& node = *place.node;
  const std::span<const NodePtr> before = evaluated_children(node);
  NodePtr result = place.node;
  if (!std::equal(before.begin(), before.end(), children.begin(), children.end())) {
    result = remade(node, std::move(children));
  }
  const SolidBounds& bounds = bounds_.of(place.node);
  if (!place.is_summand || has_members(node) || !is_solid(node, bounds) ||
      !reaches_beyond(bounds.box, place.seen)) {
    return result;
  }
  return Node::boolean(BooleanOp::kIntersection,
                       {std::move(result), box_around(place.seen, node.where())}, node.where());
}

NodePtr FarSummands::cut(const NodePtr& root) {
  if (!root || !root->has_sums()) return root;
  const SolidBounds& bounds = bounds_.find(root);
  if (!bounds.has_far_sum) return root;
  const Place at_root{root, bounds.box, false};
  std::vector<Place> stack{at_root};
  while (!stack.empty()) {
    const Place place = stack.back();
    const size_t before = stack.size();
    std::vector<NodePtr> children;
    const std::span<const NodePtr> old = evaluated_children(*place.node);
    for (size_t k = 0; k < old.size() && !made_.contains(place); ++k) {
      Place below = child(place, k);
      if (!old[k] || !may_be_cut(below)) {
        children.push_back(old[k]);
      } else if (const auto found = made_.find(below); found != made_.end()) {
        children.push_back(found->second);
      } else {
        stack.push_back(std::move(below));
      }
    }
    if (stack.size() > before) continue;
    if (!made_.contains(place)) made_.emplace(place, make(place, std::move(children)));
    stack.pop_back();
  }
  return made_.at(at_root);
}

void FarSummands::clear() {
  bounds_.clear();
  made_.clear();
}

}  // namespace csgrun
