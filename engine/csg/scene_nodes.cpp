// The nodes of a scene: leaves on the grid, and subtrees with their keys.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <csgrun/engine/validate.h>

#include "engine/bsp/kernel.h"
#include "engine/csg/leaf_rule.h"
#include "engine/csg/scene_builder.h"

namespace csgrun {
namespace {

/// A box from doubles in mm, widened so that it holds the quantised leaf in the world: rounding
/// moves a point by 1.51 steps at most along an axis (half a step along each of three unit
/// vectors), and the rounding of the frame's matrix by 9 2^-41 of the coordinate
/// (docs/numerics.md); longer vectors do so by their length, and by its square.
GridBox enclose(const LeafState& state, double step_mm, int64_t largest) {
  GridBox box;
  const double longest = state.split.longest_column;
  const double slack = 4 * longest + 0x1p-37 * longest * longest * static_cast<double>(largest);
  for (int i = 0; i < 3; ++i) {
    box.lo[i] = static_cast<int64_t>(std::floor(state.world_lo[i] / step_mm - slack));
    box.hi[i] = static_cast<int64_t>(std::ceil(state.world_hi[i] / step_mm + slack));
  }
  return box;
}

/// Whether a point set within the box can have volume.
bool is_solid(const GridBox& box) {
  return box.lo[0] < box.hi[0] && box.lo[1] < box.hi[1] && box.lo[2] < box.hi[2];
}

/// Whether a leaf is a box along the axes.
bool is_box(const LeafGeometry& leaf) {
  constexpr size_t kSides = 6, kCorners = 8;
  if (!leaf.convex || leaf.face_count() != kSides || leaf.vertices.size() != kCorners) return false;
  const GridBox box = box_of_points(leaf.vertices);
  return std::all_of(leaf.vertices.begin(), leaf.vertices.end(), [&](const IVec3& v) {
    bool is_corner = true;
    for (size_t k = 0; k < 3; ++k) is_corner &= v[k] == box.lo[k] || v[k] == box.hi[k];
    return is_corner;
  });
}

GridBox combine(BooleanOp op, const GridBox& a, const GridBox& b) {
  if (op == BooleanOp::kDifference) return a;
  GridBox r;
  const bool meet = op == BooleanOp::kIntersection;
  for (int i = 0; i < 3; ++i) {
    r.lo[i] = meet ? std::max(a.lo[i], b.lo[i]) : std::min(a.lo[i], b.lo[i]);
    r.hi[i] = meet ? std::min(a.hi[i], b.hi[i]) : std::max(a.hi[i], b.hi[i]);
  }
  return r;
}

/// Whether a node is a box along the axes of the world that nothing of a subtree is beyond. What
/// they have in common is the subtree then, also where they are flush: the first of several
/// operands that have surface somewhere gives it its label.
bool holds(const SceneNode& box, const Subtree& subtree) {
  if (box.kind != SceneNode::Kind::kLeaf || !box.subtree.is_of_boxes) return false;
  bool all = true;
  for (int i = 0; i < 3; ++i) {
    all &= box.subtree.box.lo[i] <= subtree.world.lo[i];
    all &= box.subtree.box.hi[i] >= subtree.world.hi[i];
  }
  return all;
}

GridBox permuted_box(const SignedPermutation& permutation, const GridBox& box,
                     const IVec3& origin) {
  const IVec3 a = permutation.apply(box.lo), b = permutation.apply(box.hi);
  GridBox r;
  for (int i = 0; i < 3; ++i) {
    r.lo[i] = std::min(a[i], b[i]) + origin[i];
    r.hi[i] = std::max(a[i], b[i]) + origin[i];
  }
  return r;
}

}  // namespace

/// Around a leaf where it stands in its frame.
GridBox SceneBuilder::placed_box(uint32_t index, const QuantisedLeaf& leaf) const {
  const SignedPermutation& permutation = rounding_[index].permutation;
  return permuted_box(permutation, leaf.prepared->box, permutation.apply(leaf.origin));
}

/// Makes the node of a leaf whose surface is not that of the solid it means.
Status SceneBuilder::resolve_leaf(uint32_t index, const QuantisedLeaf& leaf, SceneNode& result) {
  const NormalNode& node = normal(index);
  const PolygonMesh& mesh = *node.leaf->mesh();
  const InsideRule rule = rule_of(node);
  if (!fits_grid(placed_box(index, leaf))) {
    step_leaves_[index].whole = true;
    is_step_too_small_ = true;
    return std::monostate{};
  }
  auto boundary = context_.store.resolved(leaf, rule, context_.resolve);
  if (!boundary) {
    Error error = boundary.error();
    if (error.where.line == 0) error.where = node.leaf->where();
    return error;
  }
  if (!node.hull && !mesh.overlaps && context_.store.is_news(mesh, rule)) {
    context_.warnings.add(node.leaf->where(),
                          "'" + mesh.kind + "' " +
                              describe_tangle(leaf, rounding_[index], scene_.step) +
                              "; what is inside follows " + rule_text(rule));
  }
  if (is_empty(**boundary)) {
    context_.warnings.add(node.leaf->where(), "'" + mesh.kind + "' encloses nothing by " +
                                                  rule_text(rule) + " and is left out");
    return std::monostate{};
  }
  result.kind = SceneNode::Kind::kLeaf;
  result.boundary = *boundary;
  result.subtree.id.key = resolved_key(leaf, rule);
  result.subtree.box = bounding_box(**boundary);
  return std::monostate{};
}

Result<SceneNode> SceneBuilder::make_leaf(uint32_t index, const Quantiser& quantiser) {
  const NormalNode& node = normal(index);
  const PolygonMesh& mesh = *node.leaf->mesh();
  const auto fault = [&](ErrorCode code, const std::string& text) {
    return Error{code, "'" + mesh.kind + "' " + text, node.leaf->where()};
  };
  SceneNode result;
  if (mesh.face_count() == 0 && !mesh.hull_of_points) return result;
  LeafRounding& rounding = rounding_[index];
  rounding.lo = step_leaves_[index].local.lo;
  rounding.hi = step_leaves_[index].local.hi;
  const auto leaf = context_.store.quantise(index, node, rounding, quantiser);
  if (!leaf && !step_leaves_[index].seen) return result;
  if (!leaf) return fault(ErrorCode::kOutOfRange, "reaches too far from the origin for the grid");
  const SignedPermutation& permutation = rounding.permutation;
  Subtree& subtree = result.subtree;
  const PreparedLeaf::Status status = leaf->prepared->status;
  const bool is_placed =
      status == PreparedLeaf::Status::kTangled || status == PreparedLeaf::Status::kGood;
  // A leaf in a frame that any result can see counts as a whole when the step is chosen
  // (scene_reach). One that is beyond the grid is seen by none, and its planes have no room for the
  // frame (engine/exact/widths.h).
  if (is_placed && frame_of_[index] != 0 && !fits_grid(placed_box(index, *leaf))) return result;
  switch (status) {
    case PreparedLeaf::Status::kOpen: {
      const MeshReport report = check_mesh(mesh);
      return fault(
          ErrorCode::kInvalidMesh,
          "is not closed: " + (report.ok() ? "an edge lacks its neighbour" : report.text()));
    }
    case PreparedLeaf::Status::kFlat:
      context_.warnings.add(node.leaf->where(),
                            "'" + mesh.kind + "' encloses no volume on the grid and is left out");
      return result;
    case PreparedLeaf::Status::kTangled:
      if (Status made = resolve_leaf(index, *leaf, result); !made) return made.error();
      break;
    case PreparedLeaf::Status::kGood:
      // The hull of one shell is that shell.
      if (node.hull && !node.hull->keep_voids && !leaf->prepared->connected) {
        if (Status made = resolve_leaf(index, *leaf, result); !made) return made.error();
        break;
      }
      result.kind = SceneNode::Kind::kLeaf;
      result.geometry = context_.store.geometry(*leaf, permutation);
      subtree.id.key = leaf->key;
      subtree.box = leaf->prepared->box;
      break;
  }
  if (result.kind == SceneNode::Kind::kEmpty) return result;
  result.leaf = node.leaf;
  subtree.slots = 1;
  subtree.id.frame = frame_of_[index];
  subtree.id.permutation = permutation;
  subtree.id.origin = permutation.apply(leaf->origin);
  subtree.id.paint = leaf->paint;
  subtree.box = permuted_box(permutation, subtree.box, subtree.id.origin);
  subtree.is_far = !fits_grid(subtree.box);
  if (subtree.id.frame == 0) {
    subtree.world = subtree.box;
    subtree.is_of_boxes = result.geometry && is_box(*result.geometry);
  } else {
    int64_t largest = 0;
    for (int i = 0; i < 3; ++i) {
      largest = std::max({largest, -subtree.box.lo[i], subtree.box.hi[i]});
    }
    const LeafState& state = context_.store.state(index, node);
    subtree.world = enclose(state, quantiser.step_mm(), largest);
  }
  return result;
}

void SceneBuilder::put_placed(KeyBuilder& builder, const Identity& id) const {
  const SignedPermutation back = id.permutation.inverse();
  for (const auto& row : back.apply_to_frame(scene_.frames[id.frame]).matrix) builder.numbers(row);
  builder.numbers(back.apply(id.origin)).numbers(id.key);
}

/// One appearance for all stays outside the key; otherwise the key says whose is which.
void SceneBuilder::put_paints(KeyBuilder& builder, const Identity& a, const Identity& b,
                              Identity& result) const {
  if (a.paint == b.paint && a.paint != kUnpainted) {
    result.paint = a.paint;
    builder.number('=');
    return;
  }
  result.paint = kUnpainted;
  for (const Identity* id : {&a, &b}) {
    if (id->paint == kUnpainted) {
      builder.number('-');
    } else {
      builder.number('#').numbers(context_.appearances.key(id->paint));
    }
  }
}

Subtree SceneBuilder::fold(BooleanOp op, const Subtree& prefix, const Subtree& operand) const {
  Subtree result;
  const Identity &a = prefix.id, &b = operand.id;
  if (a.frame == b.frame) {
    KeyBuilder builder("fold");
    builder.number(op).numbers(a.key).numbers(b.key);
    const SignedPermutation back = a.permutation.inverse();
    const SignedPermutation relative = SignedPermutation::compose(back, b.permutation);
    IVec3 offset;
    for (int i = 0; i < 3; ++i) offset[i] = b.origin[i] - a.origin[i];
    builder.numbers(relative.axis).numbers(relative.sign).numbers(back.apply(offset));
    result.id = a;
    put_paints(builder, a, b, result.id);
    result.id.key = builder.key();
    result.box = combine(op, prefix.box, operand.box);
    result.is_of_one_frame = prefix.is_of_one_frame && operand.is_of_one_frame;
  } else {
    KeyBuilder builder("mixed");
    builder.number(op);
    put_placed(builder, a);
    put_placed(builder, b);
    put_paints(builder, a, b, result.id);
    result.id.key = builder.key();
    result.box = combine(op, prefix.world, operand.world);
    result.is_of_one_frame = false;
  }
  result.world = combine(op, prefix.world, operand.world);
  result.is_of_boxes = prefix.is_of_boxes && operand.is_of_boxes;
  result.slots = prefix.slots + operand.slots;
  result.is_far = prefix.is_far || operand.is_far;
  return result;
}

SceneNode SceneBuilder::make_operator(const NormalNode& node) {
  SceneNode result;
  result.op = node.op;
  const auto is_empty = [&](uint32_t i) { return scene_.nodes[i].kind == SceneNode::Kind::kEmpty; };
  bool has_first = false;
  uint32_t first = scene_index_[node.first];
  if (!is_empty(first)) {
    has_first = true;
  } else if (node.op == BooleanOp::kIntersection || node.op == BooleanOp::kDifference) {
    return result;
  }
  Subtree value = has_first ? scene_.nodes[first].subtree : Subtree{};
  for (uint32_t normal_operand : node.rest) {
    const uint32_t operand = scene_index_[normal_operand];
    if (is_empty(operand)) {
      if (node.op == BooleanOp::kIntersection) return SceneNode{};
      continue;
    }
    if (!has_first) {
      has_first = true;
      first = operand;
      value = scene_.nodes[operand].subtree;
      continue;
    }
    if (node.op == BooleanOp::kIntersection && holds(scene_.nodes[operand], value)) continue;
    value = fold(node.op, value, scene_.nodes[operand].subtree);
    // Boxes that do not overlap enclose nothing in common.
    if (!is_solid(value.box) || !is_solid(value.world)) return SceneNode{};
    result.rest.push_back(operand);
    result.prefixes.push_back(value);
  }
  if (!has_first) return SceneNode{};
  result.kind = SceneNode::Kind::kOperator;
  result.first = first;
  result.subtree = value;
  return result;
}

/// The hull stands where its solid stands, and no further out.
SceneNode SceneBuilder::make_hull(const NormalNode& node) const {
  SceneNode result;
  const uint32_t first = scene_index_[node.first];
  if (scene_.nodes[first].kind == SceneNode::Kind::kEmpty) return result;
  result.kind = SceneNode::Kind::kHull;
  result.first = first;
  result.subtree = scene_.nodes[first].subtree;
  result.subtree.id.key = KeyBuilder("hull").numbers(result.subtree.id.key).key();
  return result;
}

Status SceneBuilder::make_nodes() {
  scene_.nodes.clear();
  scene_index_.resize(context_.form.nodes().size());
  for (const uint32_t index : order_) scene_index_[index] = 0;
  scene_.nodes.reserve(order_.size() + 1);
  scene_.nodes.push_back(SceneNode{});
  const Quantiser quantiser(scene_.step);
  size_t polled = 0;
  for (uint32_t index : order_) {
    const NormalNode& node = normal(index);
    if (node.kind == NormalNode::Kind::kEmpty) continue;
    if (start_ && index == start_->reach.index) {
      scene_index_[index] = static_cast<uint32_t>(scene_.nodes.size());
      SceneNode& known = scene_.nodes.emplace_back();
      known.kind = SceneNode::Kind::kKnown;
      known.subtree = start_->subtree;
      continue;
    }
    if (++polled % 64 == 0 && context_.cancelled()) {
      return Error{ErrorCode::kCancelled, "cancelled", {}};
    }
    SceneNode made;
    if (node.kind == NormalNode::Kind::kLeaf) {
      auto leaf = make_leaf(index, quantiser);
      if (!leaf) return leaf.error();
      made = std::move(*leaf);
    } else if (node.kind == NormalNode::Kind::kHull) {
      made = make_hull(node);
    } else {
      made = make_operator(node);
      if (made.kind == SceneNode::Kind::kOperator && made.rest.empty()) {
        scene_index_[index] = made.first;  // one operand was left
        continue;
      }
    }
    if (made.kind == SceneNode::Kind::kEmpty) continue;
    if (made.subtree.slots >= UINT32_MAX) {
      return Error{ErrorCode::kLimit,
                   "the model has more than 4e9 leaves, with those of parts that are used again",
                   {}};
    }
    scene_index_[index] = static_cast<uint32_t>(scene_.nodes.size());
    scene_.nodes.push_back(std::move(made));
  }
  return std::monostate{};
}

}  // namespace csgrun
