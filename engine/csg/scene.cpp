#include "engine/csg/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "engine/csg/scene_builder.h"

namespace csgrun {

bool fits_grid(const GridBox& box) {
  for (int i = 0; i < 3; ++i) {
    if (box.lo[i] <= -kGridLimit || box.hi[i] >= kGridLimit) return false;
  }
  return true;
}

namespace {

std::string text(double x) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.4g", x);
  return digits;
}

/// The largest coordinate of a box.
double distance_of(const MmBox& box) {
  double far = 0;
  for (int i = 0; i < 3; ++i) far = std::max({far, std::fabs(box.lo[i]), std::fabs(box.hi[i])});
  return far;
}

/// But for the noise of doubles.
bool is_multiple_of(double x, double step) {
  constexpr double kNoise = 1e-6;
  return std::fabs(x / step - std::round(x / step)) < kNoise;
}

/// Which decimal step would hold a thickness that this one rounds; nothing if none does.
std::string decimal_advice(double thickness, double step, const SceneReach& reach) {
  constexpr int kDecimals = 6;
  for (int tens = kDecimals; tens >= 0; --tens) {
    const auto decimal = GridStep::parse("1e-" + std::to_string(tens));
    if (!decimal || !step_fits(*decimal, reach.reach, reach.far)) continue;
    if (is_multiple_of(thickness, step)) return {};
    if (!is_multiple_of(thickness, decimal->millimetres())) return {};
    return "; a grid of " + text(decimal->millimetres()) + " mm would hold it";
  }
  return {};
}

}  // namespace

uint32_t SceneBuilder::intern(const Frame& frame) {
  const auto [found, is_new] =
      frame_ids_.try_emplace(frame.matrix, static_cast<uint32_t>(scene_.frames.size()));
  if (is_new) scene_.frames.push_back(frame);
  return found->second;
}

/// Finds the frame of every leaf, from rows that are shared over the whole scene.
Status SceneBuilder::place_leaves() {
  const size_t count = context_.form.nodes().size();
  rounding_.resize(count);
  frame_of_.resize(count);
  step_leaves_.resize(count);
  std::vector<std::array<RowTable::Handle, 3>>& handles = context_.room.row_handles;
  handles.resize(count);
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
    for (int i = 0; i < 3; ++i) handles[index][i] = rows_.add(split, i);
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
      std::array<double, 3> scale = state.split.scale;
      double least = 1;  // rows of Rn^-1 span that, as the columns of Rn are unit vectors at most
      for (int i = 0; i < 3; ++i) {
        const RowTable::Represented represented = rows_.representative(handles[index][i]);
        leaf.rows[i] = represented.row;
        if (!represented.is_direction) continue;
        scale[i] = state.split.direction_scale[i];
        least /= state.split.lengths[i];
      }
      if (!known_frame || leaf.rows != rows_of_known) {
        rows_of_known = leaf.rows;
        known_frame = canonical_frame(
            {integer_row(leaf.rows[0]), integer_row(leaf.rows[1]), integer_row(leaf.rows[2])},
            least);
        number_of_known = known_frame->framed ? intern(known_frame->placement.frame) : 0;
      }
      const CanonicalFrame& canonical = *known_frame;
      framed = canonical.framed;
      if (framed) {
        frame_of_[index] = number_of_known;
        leaf.framed = frame_of_[index] != 0;
        rounding.permutation = canonical.placement.permutation;
        rounding.scale = scale;
        for (int i = 0; i < 3; ++i) {
          rounding.offset[i] = carry_translation(leaf.rows[i], node.map);
          leaf.own.lo[i] = rounding.scale[i] * facts.lo[i] + rounding.offset[i];
          leaf.own.hi[i] = rounding.scale[i] * facts.hi[i] + rounding.offset[i];
        }
        leaf.prismatic = facts.prismatic;
      }
    }
    if (!framed) {
      rounding.in_world = true;
      rounding.map = node.map;
      leaf.rows = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
      leaf.own = leaf.world;
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

/// The leaf that reaches farthest from the origin, as far as it counts; there is one.
uint32_t SceneBuilder::farthest_leaf() const {
  uint32_t farthest = 0;
  double distance = -1;
  for (const uint32_t index : order_) {
    if (normal(index).kind != NormalNode::Kind::kLeaf) continue;
    const StepLeaf& leaf = step_leaves_[index];
    if (!leaf.seen) continue;
    const double own = distance_of(leaf.local == leaf.own ? leaf.world : leaf.local);
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
bool SceneBuilder::has_far_parts(const SceneReach& reach, bool tell) const {
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
    if (!tell) return true;
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
    const bool is_near = far <= 2 * extent;
    context_.warnings.add(leaf == order_.end() ? SourceRef{} : normal(*leaf).leaf->where(),
                          "a part of " + text(extent) + " mm " +
                              (is_near ? "is too small: points"
                                       : "lies too far away for its size: " + text(far) +
                                             " mm from the origin points") +
                              " are rounded to " + text(step) + " mm" +
                              (is_near ? "" : "; model it near the origin"));
    return true;
  }
  return false;
}

/// A leaf that is thin for the grid of a very large scene loses of its thickness. Told of the first
/// whose step is more than 1e-3 of its shortest side.
bool SceneBuilder::has_thin_leaves(const SceneReach& reach, bool tell) const {
  constexpr double kCoarse = 1e-3;
  const double step = scene_.step.millimetres();
  for (const uint32_t index : order_) {
    if (normal(index).kind != NormalNode::Kind::kLeaf) continue;
    const MmBox& box = step_leaves_[index].local;
    int thinnest = 0;
    for (int i = 1; i < 3; ++i) {
      if (box.hi[i] - box.lo[i] < box.hi[thinnest] - box.lo[thinnest]) thinnest = i;
    }
    const double lo = box.lo[thinnest], hi = box.hi[thinnest], thickness = hi - lo;
    // What is thinner than half a step is likely to vanish, and that is told where it does.
    if (!(2 * thickness >= step) || step <= kCoarse * thickness) continue;
    const bool is_on_grid = is_multiple_of(lo, step) && is_multiple_of(hi, step);
    if (!step_leaves_[index].framed && is_on_grid) continue;
    if (!tell) return true;
    const NodePtr& leaf = normal(index).leaf;
    context_.warnings.add(leaf->where(),
                          "'" + leaf->mesh()->kind + "' is " + text(thickness) +
                              " mm thin: in a scene that reaches " + text(reach.reach) +
                              " mm from the origin points are rounded to " + text(step) + " mm" +
                              decimal_advice(thickness, step, reach));
    return true;
  }
  return false;
}

Status SceneBuilder::choose(const GridStep& step, const GridStep& least) {
  reach_ = scene_reach(context_.form, order_, roots_, step_leaves_, context_.room.reach);
  const SceneReach& reach = reach_;
  if (step.automatic()) {
    scene_.step = choose_step(reach.reach, reach.far);
    if (!least.automatic() && least.millimetres() > scene_.step.millimetres()) scene_.step = least;
    is_quiet_ = !has_far_parts(reach, true) && !has_thin_leaves(reach, true);
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

Result<Scene> SceneBuilder::build(const GridStep& step, const GridStep& least) {
  scene_.frames.push_back(world_frame());
  frame_ids_.emplace(world_frame().matrix, 0);
  if (Status status = place_leaves(); !status) return status.error();
  do {
    is_step_too_small_ = false;
    if (Status status = choose(step, least); !status) return status.error();
    if (Status status = make_nodes(); !status) return status.error();
    if (step.automatic() && !is_step_too_small_) count_repeated_far_leaves();
    // Each time some more leaves count as a whole.
  } while (is_step_too_small_);
  for (uint32_t root : roots_) scene_.roots.push_back(scene_index_[root]);
  return std::move(scene_);
}

/// Subtrees with far leaves stay in their parent's job, as often as they occur there. Where that
/// makes jobs of many times what the scene has, all its leaves count as a whole, if a step that is
/// somewhat coarser holds them.
void SceneBuilder::count_repeated_far_leaves() {
  constexpr size_t kMostTimes = 2, kFew = 16;
  constexpr double kMostCoarser = 64;
  const auto is_far = [](const Subtree& s) { return s.is_far || !fits_grid(s.box); };
  std::vector<double> size(scene_.nodes.size(), 1);  // of the job of a node, in leaves
  double largest = 0;
  for (size_t i = 0; i < size.size(); ++i) {
    const SceneNode& node = scene_.nodes[i];
    if (node.kind != SceneNode::Kind::kOperator) continue;
    const auto in_job = [&](uint32_t child) {
      return is_far(scene_.nodes[child].subtree) ? size[child] : 1;
    };
    size[i] = in_job(node.first);
    for (const uint32_t child : node.rest) size[i] += in_job(child);
    largest = std::max(largest, size[i]);
  }
  if (largest <= static_cast<double>(kMostTimes * size.size() + kFew)) return;
  const double step = choose_step(reach_.far, reach_.far).millimetres();
  if (step > kMostCoarser * scene_.step.millimetres()) return;
  for (const uint32_t index : order_) {
    if (normal(index).kind != NormalNode::Kind::kLeaf || step_leaves_[index].whole) continue;
    step_leaves_[index].whole = true;
    is_step_too_small_ = has_repeats_ = true;
  }
}

std::optional<Scene> SceneBuilder::go_on(const GridStep& step) {
  scene_.frames = std::move(start_->frames);
  frame_ids_ = std::move(start_->frame_ids);
  rows_ = std::move(start_->rows);
  // A row that is near two others would make frames that are known other ones.
  if (!place_leaves() || rows_.has_bridged()) return std::nullopt;
  reach_ =
      scene_reach(context_.form, order_, roots_, step_leaves_, context_.room.reach, &start_->reach);
  // What an intersection shows of its first operand is less than that shows by itself.
  if (!reach_.sees_known) return std::nullopt;
  scene_.step = step.automatic() ? choose_step(reach_.reach, reach_.far) : step;
  if (scene_.step != start_->step) return std::nullopt;
  const bool fits = step.automatic()
                        ? !has_far_parts(reach_, false) && !has_thin_leaves(reach_, false)
                        : step_fits(step, reach_.reach, reach_.far);
  if (!fits || !make_nodes() || is_step_too_small_) return std::nullopt;
  scene_.roots.push_back(scene_index_[roots_[0]]);
  scene_.is_partial = true;
  if (normal(roots_[0]).op == start_->op) {
    scene_.met_before = start_->met;
    scene_.met_count = start_->operand_count;
  }
  return std::move(scene_);
}

std::optional<SceneStart> SceneBuilder::start_of(const Scene& scene) {
  const SceneNode& root = scene.nodes[scene.roots[0]];
  if (roots_.size() != 1 || root.kind != SceneNode::Kind::kOperator || !is_quiet_ || has_repeats_ ||
      rows_.has_bridged()) {
    return std::nullopt;
  }
  SceneStart start;
  start.reach = {roots_[0], reach_.of_roots[0], reach_.reach, reach_.far};
  start.op = root.op;
  start.subtree = root.subtree;
  start.step = scene.step;
  start.frames = scene.frames;
  start.frame_ids = std::move(frame_ids_);
  start.rows = std::move(rows_);
  const OperandList list = scene.operands(scene.roots[0]);
  size_t next = 0;
  if (scene.met_before) {  // after those of the known first one
    start.met = start_->met;
    start.operand_count = start_->operand_count - 1;
    next = 1;
  } else {
    start.met = std::make_shared<OperandSet>();
    next = root.op == BooleanOp::kDifference ? 1 : 0;
  }
  const auto before = static_cast<uint32_t>(start.operand_count);
  for (size_t i = next; i < list.operands.size(); ++i) {
    start.met->try_emplace(scene.nodes[list.operands[i]].subtree.id,
                           before + static_cast<uint32_t>(i));
  }
  start.operand_count = before + list.operands.size();
  return start;
}

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

std::vector<uint32_t> Scene::leaves(uint32_t index, std::span<const uint32_t> numbers) const {
  struct Below {
    uint32_t node;
    uint64_t begin;  ///< the number of its first leaf
  };
  std::vector<uint32_t> result;
  std::vector<Below> stack{{index, 0}}, children;
  while (!stack.empty() && result.size() < numbers.size()) {
    const auto [top, begin] = stack.back();
    stack.pop_back();
    const SceneNode& node = nodes[top];
    if (numbers[result.size()] >= begin + node.subtree.slots) continue;
    if (node.kind == SceneNode::Kind::kLeaf) {
      result.push_back(top);
      continue;
    }
    children.clear();
    uint64_t next = begin;
    const auto add = [&](uint32_t child) {
      children.push_back({child, next});
      next += nodes[child].subtree.slots;
    };
    add(node.first);
    for (const uint32_t child : node.rest) add(child);
    stack.insert(stack.end(), children.rbegin(), children.rend());
  }
  return result;
}

Result<Scene> build_scene(SceneContext& context, std::span<const uint32_t> roots,
                          const GridStep& step, const GridStep& least, SceneStarts* starts) {
  const auto finish = [&](SceneBuilder& builder, Scene scene) {
    if (starts) starts->put(builder.start_of(scene));
    return scene;
  };
  if (starts && roots.size() == 1 && least.automatic()) {
    const NormalNode& root = context.form.nodes()[roots[0]];
    const bool is_operator = root.kind == NormalNode::Kind::kOperator;
    if (auto start = is_operator ? starts->take(root.first) : std::nullopt) {
      SceneBuilder builder(context, roots, &*start);
      if (auto scene = builder.go_on(step)) return finish(builder, *std::move(scene));
    }
  }
  SceneBuilder builder(context, roots, nullptr);
  auto scene = builder.build(step, least);
  if (!scene) return scene.error();
  return finish(builder, *std::move(scene));
}

}  // namespace csgrun
