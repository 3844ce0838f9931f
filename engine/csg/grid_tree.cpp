#include "engine/csg/grid_tree.h"

#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/csg/frames.h"
#include "engine/csg/grid_solid.h"
#include "engine/csg/leaf_rule.h"
#include "engine/csg/quantise.h"

namespace csgrun {
namespace {

/// How the points of what stands under a map are rounded in its frame; nothing if it has none.
struct FramedRounding {
  LeafRounding rounding;
  bool in_world;  ///< the frame is that of the world
};
std::optional<FramedRounding> framed_rounding(const Affine& map) {
  const LinearSplit split = split_linear(map);
  if (!split.framed) return std::nullopt;
  RowTable table;  // it knows the unit rows by their noise
  std::array<Row, 3> rows;
  std::array<std::array<int64_t, 3>, 3> whole;
  for (int i = 0; i < 3; ++i) {
    rows[i] = table.representative(table.add(split.rows[i]));
    whole[i] = integer_row(rows[i]);
  }
  const CanonicalFrame canonical = canonical_frame(whole);
  if (!canonical.framed) return std::nullopt;
  FramedRounding result;
  result.in_world = canonical.placement.frame.is_identity;
  result.rounding.permutation = canonical.placement.permutation;
  result.rounding.scale = split.scale;
  for (int i = 0; i < 3; ++i) result.rounding.offset[i] = carry_translation(rows[i], map);
  return result;
}

NodePtr leaf_on_grid(const NormalNode& node, LeafStore& store, const GridStep& step) {
  const auto framed = framed_rounding(node.map);
  std::optional<std::vector<IVec3>> points;
  if (framed && framed->in_world) {
    points = round_points(*node.leaf->mesh(), framed->rounding, Quantiser(step));
  }
  if (!points) return Node::transformed(node.map, node.leaf, node.leaf->where());
  auto mesh = std::make_shared<PolygonMesh>(*node.leaf->mesh());
  mesh->points = to_millimetres(*points, step);
  // What there is to say of its surface is said of the leaf that the user has made.
  store.facts(mesh);
  store.is_news(*mesh, rule_of(node));
  Affine turn;
  const SignedPermutation& permutation = framed->rounding.permutation;
  for (int i = 0; i < 3; ++i) {
    turn.m[i] = {0, 0, 0, 0};
    turn.m[i][permutation.axis[i]] = permutation.sign[i];
  }
  return Node::transformed(turn, Node::leaf(std::move(mesh), node.leaf->where()),
                           node.leaf->where());
}

}  // namespace

NodePtr tree_on_grid(const NormalForm& form, LeafStore& store, const AppearanceTable& appearances,
                     uint32_t root, const GridStep& step) {
  const std::vector<uint32_t> order = form.reachable(std::span(&root, 1));
  std::unordered_map<uint32_t, NodePtr> made;
  for (const uint32_t index : order) {
    const NormalNode& node = form.nodes()[index];
    NodePtr& result = made[index];
    switch (node.kind) {
      case NormalNode::Kind::kEmpty:
        result = Node::empty();
        break;
      case NormalNode::Kind::kLeaf:
        result = leaf_on_grid(node, store, step);
        if (node.hull) result = Node::outer_hull(*node.hull, result, node.leaf->where());
        if (node.paint != kUnpainted) {
          result = Node::painted(appearances.values()[node.paint], result, node.leaf->where());
        }
        break;
      case NormalNode::Kind::kHull:
        // Not of the surface of a leaf, should there be no more below it.
        result = Node::outer_hull({}, Node::boolean(BooleanOp::kUnion, {made.at(node.first)}));
        break;
      case NormalNode::Kind::kOperator: {
        // Its prefix is a node of its own, which the normal form will take apart again.
        std::vector<NodePtr> operands{made.at(node.first)};
        for (const uint32_t operand : node.rest) operands.push_back(made.at(operand));
        result = Node::boolean(node.op, std::move(operands));
        break;
      }
    }
  }
  return made.at(root);
}

Affine by_whole_steps(const Affine& map, const GridStep& step) {
  const auto framed = framed_rounding(map);
  if (!framed) return map;
  const SignedPermutation& permutation = framed->rounding.permutation;
  const std::array<double, 3> turned = permutation.apply(framed->rounding.offset);
  const Quantiser quantiser(step);
  IVec3 steps;
  for (int i = 0; i < 3; ++i) {
    const auto rounded = quantiser(turned[i]);
    if (!rounded) return map;
    steps[i] = *rounded;
  }
  const glm::dvec3 mm = to_millimetres({permutation.inverse().apply(steps)}, step)[0];
  // In the axes of the leaf, whose unit vectors are the columns of the map but for their lengths.
  Affine result = map;
  for (int i = 0; i < 3; ++i) {
    result.m[i][3] = 0;
    for (int j = 0; j < 3; ++j) {
      result.m[i][3] += map.m[i][j] / framed->rounding.scale[j] * mm[j];
    }
  }
  return result;
}

}  // namespace csgrun
