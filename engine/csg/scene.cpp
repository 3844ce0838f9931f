#include "engine/csg/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "engine/bsp/kernel.h"
#include "engine/csg/leaf_rule.h"

namespace csgrun {
namespace {

/// A box from doubles in mm, widened so that it holds the quantised leaf in the world: rounding
/// moves a point by 1.51 steps at most along an axis (half a step along each of three unit
/// vectors), and the rounding of the frame's matrix by 9 2^-41 of the coordinate
/// (docs/numerics.md).
GridBox enclose(const LeafState& state, double step_mm, int64_t largest) {
  GridBox box;
  const double slack = 4 + 0x1p-37 * static_cast<double>(largest);
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

std::string text(double x) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.4g", x);
  return digits;
}

}  // namespace

bool fits_grid(const GridBox& box) {
  for (int i = 0; i < 3; ++i) {
    if (box.lo[i] <= -kGridLimit || box.hi[i] >= kGridLimit) return false;
  }
  return true;
}

namespace {

/// The largest coordinate of a box.
double distance_of(const MmBox& box) {
  double far = 0;
  for (int i = 0; i < 3; ++i) far = std::max({far, std::fabs(box.lo[i]), std::fabs(box.hi[i])});
  return far;
}

class Builder {
 public:
  Builder(SceneContext& context, std::span<const uint32_t> roots)
      : context_(context),
        roots_(roots),
        order_(context.form.reachable(roots)),
        rounding_(context.room.rounding),
        frame_of_(context.room.frame_of),
        step_leaves_(context.room.step_leaves) {}

  Result<Scene> build(const GridStep& step, const GridStep& least);

 private:
  Status place_leaves();
  Status choose(const GridStep& step, const GridStep& least);
  [[nodiscard]] uint32_t farthest_leaf() const;
  [[nodiscard]] bool warns_of_far_parts(const SceneReach& reach) const;
  void warn_of_thin_leaves(const SceneReach& reach) const;
  Result<SceneNode> make_leaf(uint32_t index, const Quantiser& quantiser);
  Status resolve_leaf(uint32_t index, const QuantisedLeaf& leaf, SceneNode& result);
  Status make_nodes();
  SceneNode make_hull(const NormalNode& node) const;
  SceneNode make_operator(const NormalNode& node);
  Subtree fold(BooleanOp op, const Subtree& prefix, const Subtree& operand) const;
  void put_paints(KeyBuilder& builder, const Identity& a, const Identity& b,
                  Identity& result) const;
  void put_placed(KeyBuilder& builder, const Identity& id) const;
  uint32_t intern(const Frame& frame);
  const NormalNode& normal(uint32_t index) const { return context_.form.nodes()[index]; }

  SceneContext& context_;
  std::span<const uint32_t> roots_;
  std::vector<uint32_t> order_;  // of normal nodes, children first
  Scene scene_;
  std::map<std::array<std::array<int64_t, 3>, 3>, uint32_t> frame_ids_;
  std::vector<uint32_t> scene_index_;  // by normal index
  // By normal index; those of nodes that are in order_ are set.
  std::vector<LeafRounding>& rounding_;
  std::vector<uint32_t>& frame_of_;
  std::vector<StepLeaf>& step_leaves_;
  /// Set when a leaf that must be resolved reaches too far: it is needed as a whole.
  bool is_step_too_small_ = false;
};

uint32_t Builder::intern(const Frame& frame) {
  const auto [found, is_new] =
      frame_ids_.try_emplace(frame.matrix, static_cast<uint32_t>(scene_.frames.size()));
  if (is_new) scene_.frames.push_back(frame);
  return found->second;
}

/// Finds the frame of every leaf, from rows that are shared over the whole scene.
Status Builder::place_leaves() {
  const size_t count = context_.form.nodes().size();
  rounding_.resize(count);
  frame_of_.resize(count);
  step_leaves_.resize(count);
  RowTable table;
  std::vector<std::array<uint32_t, 3>> handles(count);
  size_t polled = 0;
  for (uint32_t index : order_) {
    const NormalNode& node = normal(index);
    if (node.kind != NormalNode::Kind::kLeaf) continue;
    if (++polled % 256 == 0 && context_.cancelled()) {
      return Error{ErrorCode::kCancelled, "cancelled", {}};
    }
    const MeshFacts& facts = context_.store.facts(node.leaf->mesh());
    if (facts.error) {
      Error error = *facts.error;
      error.where = node.leaf->where();
      return error;
    }
    const LinearSplit& split = context_.store.state(index, node).split;
    if (!split.framed) continue;
    for (int i = 0; i < 3; ++i) handles[index][i] = table.add(split.rows[i]);
  }
  // Most leaves have the rows of the one before.
  std::optional<CanonicalFrame> known_frame;
  std::array<Row, 3> rows_of_known{};
  uint32_t number_of_known = 0;
  for (uint32_t index : order_) {
    const NormalNode& node = normal(index);
    if (node.kind != NormalNode::Kind::kLeaf) continue;
    const LeafState& state = context_.store.state(index, node);
    const MeshFacts& facts = context_.store.facts(node.leaf->mesh());
    LeafRounding& rounding = rounding_[index] = {};
    StepLeaf& leaf = step_leaves_[index] = {};
    frame_of_[index] = 0;
    leaf.world = {state.world_lo, state.world_hi};
    bool framed = state.split.framed;
    if (framed) {
      for (int i = 0; i < 3; ++i) leaf.rows[i] = table.representative(handles[index][i]);
      if (!known_frame || leaf.rows != rows_of_known) {
        rows_of_known = leaf.rows;
        known_frame = canonical_frame(
            {integer_row(leaf.rows[0]), integer_row(leaf.rows[1]), integer_row(leaf.rows[2])});
        number_of_known = known_frame->framed ? intern(known_frame->placement.frame) : 0;
      }
      const CanonicalFrame& canonical = *known_frame;
      framed = canonical.framed;
      if (framed) {
        frame_of_[index] = number_of_known;
        leaf.framed = frame_of_[index] != 0;
        rounding.permutation = canonical.placement.permutation;
        rounding.scale = state.split.scale;
        for (int i = 0; i < 3; ++i) {
          rounding.offset[i] = carry_translation(leaf.rows[i], node.map);
          leaf.local.lo[i] = rounding.scale[i] * facts.lo[i] + rounding.offset[i];
          leaf.local.hi[i] = rounding.scale[i] * facts.hi[i] + rounding.offset[i];
        }
      }
    }
    if (!framed) {
      rounding.in_world = true;
      rounding.map = node.map;
      leaf.rows = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
      leaf.local = leaf.world;
      if (state.split.determinant != 0) {
        context_.warnings.add(
            node.bent_by.line > 0 ? node.bent_by : node.leaf->where(),
            "the transform is nearly singular; the vertices of '" + node.leaf->mesh()->kind +
                "' are rounded in the world, and faces that were coplanar may not stay so");
      }
    }
  }
  return std::monostate{};
}

/// The leaf that reaches farthest from the origin; there is one.
uint32_t Builder::farthest_leaf() const {
  uint32_t farthest = 0;
  double distance = -1;
  for (const uint32_t index : order_) {
    if (normal(index).kind != NormalNode::Kind::kLeaf) continue;
    const double own = distance_of(step_leaves_[index].world);
    if (own <= distance) continue;
    farthest = index;
    distance = own;
  }
  return farthest;
}

/// A small part that lies far away is on a grid for the distance, not for the part: when a step is
/// more than 1e-4 of its size, its sides are visibly wrong, and it may be gone. Told of the first;
/// where it is another leaf that makes the grid coarse, such as a tool that is far too large, of
/// that one.
bool Builder::warns_of_far_parts(const SceneReach& reach) const {
  constexpr double kCoarse = 1e-4;
  const double step = scene_.step.millimetres();
  const auto inside = [](const MmBox& a, const MmBox& b) {
    bool is_inside = true;
    for (int i = 0; i < 3; ++i) is_inside &= a.lo[i] >= b.lo[i] && a.hi[i] <= b.hi[i];
    return is_inside;
  };
  for (const MmBox& box : reach.of_roots) {
    const double far = distance_of(box);
    double extent = 0;
    for (int i = 0; i < 3; ++i) extent = std::max(extent, box.hi[i] - box.lo[i]);
    if (!(extent > 0) || step <= kCoarse * extent) continue;
    if (choose_step(far, far).millimetres() <= kCoarse * extent) {
      const uint32_t index = farthest_leaf();
      const NodePtr& leaf = normal(index).leaf;
      context_.warnings.add(
          leaf->where(),
          "'" + leaf->mesh()->kind + "' reaches " + text(distance_of(step_leaves_[index].world)) +
              " mm from the origin: beside it points of a part of " + text(extent) +
              " mm are rounded to " + text(step) + " mm; make it smaller, or move it nearer");
      return true;
    }
    const auto leaf = std::find_if(order_.begin(), order_.end(), [&](uint32_t index) {
      return normal(index).kind == NormalNode::Kind::kLeaf &&
             inside(step_leaves_[index].world, box);
    });
    context_.warnings.add(leaf == order_.end() ? SourceRef{} : normal(*leaf).leaf->where(),
                          "a part of " + text(extent) + " mm lies too far away for its size: " +
                              text(far) + " mm from the origin points are rounded to " +
                              text(step) + " mm; model it near the origin");
    return true;
  }
  return false;
}

/// A leaf that is thin for the grid of a very large scene loses of its thickness. Told of the first
/// whose step is more than 1e-2 of its shortest side.
void Builder::warn_of_thin_leaves(const SceneReach& reach) const {
  constexpr double kCoarse = 1e-2;
  const double step = scene_.step.millimetres();
  for (const uint32_t index : order_) {
    if (normal(index).kind != NormalNode::Kind::kLeaf) continue;
    const MmBox& box = step_leaves_[index].local;
    double thickness = box.hi[0] - box.lo[0];
    for (int i = 1; i < 3; ++i) thickness = std::min(thickness, box.hi[i] - box.lo[i]);
    // What is thinner than half a step is likely to vanish, and that is told where it does.
    if (!(2 * thickness >= step) || step <= kCoarse * thickness) continue;
    const NodePtr& leaf = normal(index).leaf;
    context_.warnings.add(leaf->where(),
                          "'" + leaf->mesh()->kind + "' is " + text(thickness) +
                              " mm thin: in a scene that reaches " + text(reach.reach) +
                              " mm from the origin points are rounded to " + text(step) + " mm");
    return;
  }
}

Status Builder::choose(const GridStep& step, const GridStep& least) {
  const SceneReach reach = scene_reach(context_.form, order_, roots_, step_leaves_);
  if (step.automatic()) {
    scene_.step = choose_step(reach.reach, reach.far);
    if (!least.automatic() && least.millimetres() > scene_.step.millimetres()) scene_.step = least;
    if (!warns_of_far_parts(reach)) warn_of_thin_leaves(reach);
    return std::monostate{};
  }
  scene_.step = step;
  if (step_fits(step, reach.reach, reach.far)) return std::monostate{};
  const auto all_digits = [](double x) {
    std::string digits = std::to_string(x);
    return digits.size() > 24 ? std::string("more than 1e17") : digits;
  };
  return Error{ErrorCode::kOutOfRange,
               "the model reaches " + all_digits(std::max(reach.reach, reach.far)) +
                   " mm from the origin, too far for the grid step that was asked for; leave the "
                   "step to the program or ask for a larger one",
               {}};
}

/// Makes the node of a leaf whose surface is not that of the solid it means.
Status Builder::resolve_leaf(uint32_t index, const QuantisedLeaf& leaf, SceneNode& result) {
  const NormalNode& node = normal(index);
  const PolygonMesh& mesh = *node.leaf->mesh();
  const InsideRule rule = rule_of(node);
  const SignedPermutation& permutation = rounding_[index].permutation;
  if (!fits_grid(permuted_box(permutation, leaf.prepared->box, permutation.apply(leaf.origin)))) {
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

Result<SceneNode> Builder::make_leaf(uint32_t index, const Quantiser& quantiser) {
  const NormalNode& node = normal(index);
  const PolygonMesh& mesh = *node.leaf->mesh();
  const auto fault = [&](ErrorCode code, const std::string& text) {
    return Error{code, "'" + mesh.kind + "' " + text, node.leaf->where()};
  };
  SceneNode result;
  if (mesh.face_count() == 0 && !mesh.hull_of_points) return result;
  const LeafRounding& rounding = rounding_[index];
  const auto leaf = context_.store.quantise(index, node, rounding, quantiser);
  if (!leaf) return fault(ErrorCode::kOutOfRange, "reaches too far from the origin for the grid");
  const SignedPermutation& permutation = rounding.permutation;
  Subtree& subtree = result.subtree;
  switch (leaf->prepared->status) {
    case PreparedLeaf::Status::kOpen:
      return fault(ErrorCode::kInvalidMesh, "is not closed: an edge lacks its neighbour");
    case PreparedLeaf::Status::kFlat:
      context_.warnings.add(node.leaf->where(),
                            "'" + mesh.kind + "' encloses no volume on the grid and is left out");
      return result;
    case PreparedLeaf::Status::kTangled:
      if (Status status = resolve_leaf(index, *leaf, result); !status) return status.error();
      break;
    case PreparedLeaf::Status::kGood:
      // The hull of one shell is that shell.
      if (node.hull && !node.hull->keep_voids && !leaf->prepared->connected) {
        if (Status status = resolve_leaf(index, *leaf, result); !status) return status.error();
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

void Builder::put_placed(KeyBuilder& builder, const Identity& id) const {
  const SignedPermutation back = id.permutation.inverse();
  for (const auto& row : back.apply_to_frame(scene_.frames[id.frame]).matrix) builder.numbers(row);
  builder.numbers(back.apply(id.origin)).numbers(id.key);
}

/// One appearance for all stays outside the key; otherwise the key says whose is which.
void Builder::put_paints(KeyBuilder& builder, const Identity& a, const Identity& b,
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

Subtree Builder::fold(BooleanOp op, const Subtree& prefix, const Subtree& operand) const {
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
  } else {
    KeyBuilder builder("mixed");
    builder.number(op);
    put_placed(builder, a);
    put_placed(builder, b);
    put_paints(builder, a, b, result.id);
    result.id.key = builder.key();
    result.box = combine(op, prefix.world, operand.world);
  }
  result.world = combine(op, prefix.world, operand.world);
  result.slots = prefix.slots + operand.slots;
  result.is_far = prefix.is_far || operand.is_far;
  return result;
}

SceneNode Builder::make_operator(const NormalNode& node) {
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
SceneNode Builder::make_hull(const NormalNode& node) const {
  SceneNode result;
  const uint32_t first = scene_index_[node.first];
  if (scene_.nodes[first].kind == SceneNode::Kind::kEmpty) return result;
  result.kind = SceneNode::Kind::kHull;
  result.first = first;
  result.subtree = scene_.nodes[first].subtree;
  result.subtree.id.key = KeyBuilder("hull").numbers(result.subtree.id.key).key();
  return result;
}

Result<Scene> Builder::build(const GridStep& step, const GridStep& least) {
  scene_.frames.push_back(world_frame());
  frame_ids_.emplace(world_frame().matrix, 0);
  if (Status status = place_leaves(); !status) return status.error();
  do {
    is_step_too_small_ = false;
    if (Status status = choose(step, least); !status) return status.error();
    if (Status status = make_nodes(); !status) return status.error();
    // Each time some more leaves count as a whole.
  } while (is_step_too_small_);
  for (uint32_t root : roots_) scene_.roots.push_back(scene_index_[root]);
  return std::move(scene_);
}

Status Builder::make_nodes() {
  scene_.nodes.clear();
  scene_index_.assign(context_.form.nodes().size(), 0);
  scene_.nodes.reserve(order_.size() + 1);
  scene_.nodes.push_back(SceneNode{});
  const Quantiser quantiser(scene_.step);
  size_t polled = 0;
  for (uint32_t index : order_) {
    const NormalNode& node = normal(index);
    if (node.kind == NormalNode::Kind::kEmpty) continue;
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
      return Error{ErrorCode::kLimit, "the model has more than 4e9 leaves", {}};
    }
    scene_index_[index] = static_cast<uint32_t>(scene_.nodes.size());
    scene_.nodes.push_back(std::move(made));
  }
  return std::monostate{};
}

}  // namespace

OperandList Scene::operands(uint32_t index) const {
  std::vector<uint32_t> chain{index};
  const BooleanOp op = nodes[index].op;
  uint32_t first = nodes[index].first;
  const bool is_hull = nodes[index].kind == SceneNode::Kind::kHull;
  while (!is_hull && nodes[first].kind == SceneNode::Kind::kOperator && nodes[first].op == op) {
    chain.push_back(first);
    first = nodes[first].first;
  }
  OperandList list;
  list.operands.push_back(first);
  list.values.push_back(&nodes[first].subtree);
  for (size_t i = chain.size(); i-- > 0;) {
    const SceneNode& node = nodes[chain[i]];
    for (size_t r = 0; r < node.rest.size(); ++r) {
      list.operands.push_back(node.rest[r]);
      list.values.push_back(&node.prefixes[r]);
    }
  }
  return list;
}

std::vector<uint32_t> Scene::leaves(uint32_t index) const {
  std::vector<uint32_t> result, stack{index};
  while (!stack.empty()) {
    const uint32_t top = stack.back();
    stack.pop_back();
    const SceneNode& node = nodes[top];
    if (node.kind == SceneNode::Kind::kLeaf) result.push_back(top);
    if (node.kind == SceneNode::Kind::kEmpty || node.kind == SceneNode::Kind::kLeaf) continue;
    stack.insert(stack.end(), node.rest.rbegin(), node.rest.rend());
    stack.push_back(node.first);
  }
  return result;
}

Result<Scene> build_scene(SceneContext& context, std::span<const uint32_t> roots,
                          const GridStep& step, const GridStep& least) {
  return Builder(context, roots).build(step, least);
}

}  // namespace csgrun
