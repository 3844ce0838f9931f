#include "engine/csg/constructions.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <variant>

#include <glm/common.hpp>

#include "engine/csg/flat_summands.h"
#include "engine/csg/frames.h"
#include "engine/csg/grid_solid.h"
#include "engine/csg/hash_affine.h"
#include "engine/csg/is_finite.h"
#include "engine/csg/minkowski.h"
#include "engine/csg/operand_leaves.h"
#include "engine/csg/tree_nodes.h"
#include "engine/csg/whole_steps.h"

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

/// The surface of a sum as a leaf.
NodePtr surface_leaf(const SumSurface& surface, const Appearance* appearance, const GridStep& step,
                     const SourceRef& where) {
  auto mesh = std::make_shared<PolygonMesh>();
  mesh->points = to_millimetres(surface.points, step);
  for (size_t f = 0; f + 1 < surface.face_starts.size(); ++f) {
    mesh->add_face(
        std::span(surface.corners)
            .subspan(surface.face_starts[f], surface.face_starts[f + 1] - surface.face_starts[f]));
  }
  if (appearance != nullptr) {
    mesh->appearances.push_back(*appearance);
    mesh->appearance_of.assign(mesh->face_count(), 0);
  }
  mesh->overlaps = true;
  mesh->kind = "minkowski";
  return Node::leaf(std::move(mesh), where);
}

/// A solid as a summand over its corners on the grid. Where they were rounded it may cross itself,
/// and is what the fill rule makes of it.
Summand rounded_summand(const Solid& solid, const GridSolid& on_grid, const GridStep& step,
                        const SourceRef& where) {
  auto mesh = std::make_shared<PolygonMesh>(patch_mesh(solid, on_grid, step));
  mesh->kind = "minkowski";
  return solid_summand(*mesh, on_grid.points, Node::leaf(mesh, where));
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

/// A map as what scales along the axes, and then turns and moves. All of it goes inside if it is so
/// nearly singular that there is no frame for it.
struct PartedMap {
  Affine inside, outside;
};
PartedMap parted(const Affine& map) {
  const LinearSplit split = split_linear(map);
  PartedMap result;
  if (!split.framed) {
    result.inside = map;
    return result;
  }
  result.outside = map;
  for (int j = 0; j < 3; ++j) {
    result.inside.m[j][j] = split.scale[j];
    for (int i = 0; i < 3; ++i) result.outside.m[i][j] /= split.scale[j];
  }
  return result;
}

Affine turned_forth(const Affine& map, const std::optional<CommonTurn>& turn) {
  return turn ? Affine::compose(map, turn->forth) : map;
}

bool is_resizing(const Node& node) {
  return node.kind() == NodeKind::kConstruction && node.construction() == Construction::kResize;
}

}  // namespace

/// A node that is to be made at a place.
struct Constructions::Task {
  NodePtr node;
  Place place;
  GridStep inner;                      ///< the least step for what a construction is made of
  const SourceRef* bent_by = nullptr;  ///< of the transforms above it, the most nearly singular one
  double bent = 2;

  Task(const NodePtr& at, const Affine& map, const GridStep& least)
      : node(at), place{at.get(), map, least}, inner(least) {}
  [[nodiscard]] NodePtr under(const Affine& map, NodePtr tree) const {
    if (!tree || map == Affine{}) return tree;
    return Node::transformed(map, std::move(tree), bent_by != nullptr ? *bent_by : node->where());
  }
};

size_t Constructions::PlaceHash::operator()(const Place& place) const {
  const uint64_t h = reinterpret_cast<uintptr_t>(place.node) ^
                     static_cast<uint64_t>(place.least.exponent) << 48 ^
                     static_cast<uint64_t>(place.least.numerator);
  return hash_affine(h, place.map);
}

Result<Constructions::Outcome> Constructions::make_hull(const Task& task,
                                                        const std::vector<NodePtr>& operands,
                                                        Made& made) {
  const Node& node = *task.node;
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
    auto parts = evaluate_(others, false, task.inner);
    if (!parts) return parts.error();
    const double step_mm = parts->step.millimetres();
    if (step_mm > made.finest_mm) return Outcome{parts->step};
    made.finest_mm = step_mm;
    size_t rounded = 0;
    for (const SolidPtr& solid : parts->solids) {
      auto corners = grid_solid(*solid, parts->step);
      if (!corners) return corners.error();
      rounded += corners->rounded;
      points.insert(points.end(), solid->positions.begin(), solid->positions.end());
    }
    if (rounded > 0) made.note = "hull: " + rounding_note(rounded, parts->step);
  }
  if (points.empty()) {
    made.node = Node::empty(node.where());
    return Outcome{};
  }
  made.node = task.under(turned_forth(parted(task.place.map).outside, turn),
                         hull_leaf(std::move(points), appearance, "hull", node.where()));
  return Outcome{};
}

Result<Constructions::Outcome> Constructions::make_sum(const Task& task,
                                                       const std::vector<NodePtr>& operands,
                                                       Made& made) {
  const Node& node = *task.node;
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
  made.node = Node::empty(node.where());
  if (trees.empty()) return Outcome{};
  const size_t notes = warnings_.count();
  auto parts = evaluate_(trees, true, task.inner);
  if (!parts) return parts.error();
  const double step_mm = parts->step.millimetres();
  if (step_mm > made.finest_mm) return Outcome{parts->step};

  std::vector<std::vector<Summand>> summands;
  std::vector<size_t> of_operand;  // by entry of `summands`
  const Appearance* appearance = nullptr;
  size_t rounded = 0;
  for (size_t i = 0, at = 0; i < unions.size(); ++i) {
    std::vector<Summand> list;
    for (size_t k = 0; k < unions[i].size(); ++k, ++at) {
      if (parts->solids[at]->empty()) {
        if (all[at].node->kind() != NodeKind::kLeaf) continue;
        auto flat = flat_summands(all[at], parts->step);
        if (!flat) return flat.error();
        if (flat->empty()) continue;
        if (appearance == nullptr) appearance = first_appearance(all[at]);
        list.insert(list.end(), std::make_move_iterator(flat->begin()),
                    std::make_move_iterator(flat->end()));
        // It is not left out after all.
        const Node& leaf = *all[at].node;
        warnings_.take_back(notes, leaf.where(), "'" + leaf.mesh()->kind + "' ");
        continue;
      }
      if (appearance == nullptr) appearance = first_appearance(all[at]);
      auto solid = grid_solid(*parts->solids[at], parts->step);
      if (!solid) return solid.error();
      if (all[at].node->kind() != NodeKind::kLeaf) rounded += solid->rounded;
      if (parts->is_convex[at] != 0) {
        list.push_back(convex_summand(std::move(solid->points)));
      } else {
        Summand solid_part = rounded_summand(*parts->solids[at], *solid, parts->step, node.where());
        if (solid_part.boundary.face_count() > 0) list.push_back(std::move(solid_part));
      }
    }
    if (list.empty()) continue;
    summands.push_back(std::move(list));
    of_operand.push_back(i);
  }
  if (summands.empty()) return Outcome{};
  const Affine outside = parted(task.place.map).outside;
  if (summands.size() == 1) {
    made.node =
        task.under(std::isfinite(made.finest_mm) ? by_whole_steps(outside, parts->step) : outside,
                   operands[of_operand[0]]);
    return Outcome{};
  }
  made.finest_mm = step_mm;
  if (rounded > 0) made.note = "minkowski or offset: " + rounding_note(rounded, parts->step);
  auto sum = minkowski_sum(std::move(summands), parts->step);
  if (!sum) return sum.error();
  std::vector<NodePtr> pieces;
  for (SumPart& part : *sum) {
    if (const auto* points = std::get_if<std::vector<IVec3>>(&part)) {
      pieces.push_back(
          hull_leaf(to_millimetres(*points, parts->step), appearance, "minkowski", node.where()));
    } else if (const auto* surface = std::get_if<SumSurface>(&part)) {
      pieces.push_back(surface_leaf(*surface, appearance, parts->step, node.where()));
    } else {
      pieces.push_back(std::get<NodePtr>(part));
    }
  }
  NodePtr result = Node::boolean(BooleanOp::kUnion, std::move(pieces), node.where());
  result = task.under(by_whole_steps(turned_forth(outside, turn), parts->step), std::move(result));
  // Pieces that are an operand may have colours of their own, which others of its faces have not.
  if (appearance != nullptr) result = Node::painted(*appearance, std::move(result), node.where());
  made.node = std::move(result);
  return Outcome{};
}

/// The lengths of the bounding box of a solid; all 0 when it is empty. A union of leaves is not
/// evaluated: it may be so long that its width is nothing on a grid that holds it.
Result<Constructions::Outcome> Constructions::measure(const Task& task, const NodePtr& operand,
                                                      double finest_mm) {
  const std::vector<PlacedNode> members = union_members({operand});
  std::vector<glm::dvec3> points;
  if (std::all_of(members.begin(), members.end(), has_own_points)) {
    for (const PlacedNode& member : members) append_points(member, points);
  } else {
    auto parts = evaluate_({operand}, false, task.inner);
    if (!parts) return parts.error();
    if (parts->step.millimetres() > finest_mm) return Outcome{parts->step};
    points = parts->solids[0]->positions;
  }
  std::array<glm::dvec3, 2> box{};
  if (!points.empty()) box = {points[0], points[0]};
  for (const glm::dvec3& p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      return Error{ErrorCode::kInvalidArgument, "a transform is not finite", task.node->where()};
    }
    box = {glm::min(box[0], p), glm::max(box[1], p)};
  }
  // Kept from here on: what fails before the node is made leaves no entry for another node that
  // takes its place in memory.
  alive_.push_back(task.node);
  std::optional<Affine>& map = resizing_[task.node.get()];
  const glm::dvec3 length = box[1] - box[0];
  if (!(std::min({length.x, length.y, length.z}) > 0)) return Outcome{};
  const Resize& resize = task.node->resize();
  std::array<double, 3> factor{1, 1, 1};
  int largest = 0;
  for (int i = 0; i < 3; ++i) {
    if (resize.size[i] > 0) factor[i] = resize.size[i] / length[i];
    if (resize.size[i] > resize.size[largest]) largest = i;
  }
  map.emplace();
  for (int i = 0; i < 3; ++i) {
    map->m[i][i] = resize.size[i] > 0 || !resize.automatic[i] ? factor[i] : factor[largest];
  }
  return Outcome{};
}

/// What the children of a node are to be made under.
Result<Constructions::Below> Constructions::below(const Task& task) const {
  const Node& node = *task.node;
  const Place& place = task.place;
  if (node.kind() == NodeKind::kTransform) {
    const Affine map = Affine::compose(place.map, node.transform());
    if (is_finite(map)) return Below{map, place.least};
    return Error{ErrorCode::kInvalidArgument, "a transform is not finite", node.where()};
  }
  if (is_resizing(node)) {
    const auto known = resizing_.find(&node);
    // Its lengths are those that it has by itself.
    if (known == resizing_.end()) return Below{Affine{}, task.inner};
    return Below{Affine::compose(place.map, known->second.value_or(Affine{})), place.least};
  }
  if (node.kind() != NodeKind::kConstruction ||
      (is_minkowski_sum(node) && node.children().size() == 1)) {
    return Below{place.map, place.least};
  }
  return Below{parted(place.map).inside, task.inner};
}

/// Makes a node of its children. Not done, but with a step, when these must be made again on a grid
/// of this step.
Result<Constructions::Outcome> Constructions::make(const Task& task, std::vector<NodePtr> children,
                                                   Made& made) {
  const Node& node = *task.node;
  switch (node.kind()) {
    case NodeKind::kAppearance:
      made.node = Node::painted(node.appearance(), std::move(children[0]), node.where());
      return Outcome{};
    case NodeKind::kOuterHull:
      made.node = Node::outer_hull(node.outer_hull(), std::move(children[0]), node.where());
      return Outcome{};
    case NodeKind::kBoolean:
      if (node.same_solid()) {
        made.node = std::move(children[0]);
        return Outcome{};
      }
      made.node = Node::boolean(node.op(), std::move(children), node.where());
      return Outcome{};
    case NodeKind::kConstruction:
      break;
    default:  // a transform is in its child
      made.node = std::move(children[0]);
      return Outcome{};
  }
  if (is_resizing(node)) {
    made.node = resizing_.at(&node) ? std::move(children[0]) : Node::empty(node.where());
    return Outcome{};
  }
  if (!is_minkowski_sum(node)) return make_hull(task, children, made);
  if (children.size() > 1) return make_sum(task, children, made);
  made.node = std::move(children[0]);
  return Outcome{};
}

/// Makes the node of a task if all is there that it needs; else puts that on the stack, above it.
Result<bool> Constructions::advance(std::vector<Task>& stack) {
  const Task task = stack.back();
  const Node& node = *task.node;
  const bool is_measuring = is_resizing(node) && !resizing_.contains(&node);
  const auto under = below(task);
  if (!under) return under.error();
  const size_t before = stack.size();
  std::vector<NodePtr> children;
  Made made{nullptr, std::numeric_limits<double>::infinity(), {}, node.where(), {}};
  const std::span<const NodePtr> operands = evaluated_children(node);
  for (const NodePtr& child : operands) {
    Task next(child, under->map, under->least);
    next.bent_by = task.bent_by;
    next.bent = task.bent;
    if (node.kind() == NodeKind::kTransform) {
      const double square = std::fabs(split_linear(node.transform()).determinant);
      if (square < next.bent) next.bent = square, next.bent_by = &node.where();
    }
    if (!child || !child->has_constructions()) {
      children.push_back(next.under(under->map, child));
    } else if (const auto found = made_.find(next.place); found != made_.end()) {
      children.push_back(found->second.node);
      made.finest_mm = std::min(made.finest_mm, found->second.finest_mm);
      made.below.push_back(&found->second);
    } else {
      stack.push_back(std::move(next));
    }
  }
  if (stack.size() > before) {
    std::reverse(stack.begin() + static_cast<std::ptrdiff_t>(before), stack.end());
    return false;
  }
  auto outcome = is_measuring ? measure(task, children[0], made.finest_mm)
                              : make(task, std::move(children), made);
  if (!outcome) {
    Error error = outcome.error();
    if (error.where.line == 0) error.where = node.where();
    return error;
  }
  if (is_measuring || outcome->again) {
    if (outcome->again) stack.back().inner = *outcome->again;
    return false;
  }
  alive_.push_back(task.node);
  made_.emplace(task.place, std::move(made));
  return true;
}

Result<Constructions::Expanded> Constructions::expand(const NodePtr& tree, const GridStep& least) {
  if (!tree || !tree->has_constructions()) {
    return Expanded{tree, std::numeric_limits<double>::infinity()};
  }
  const NodePtr root = summands_.cut(tree);
  std::vector<Task> stack{Task(root, Affine{}, least)};
  while (!stack.empty()) {
    if (!made_.contains(stack.back().place)) {
      const auto is_made = advance(stack);
      if (!is_made) return is_made.error();
      if (!*is_made) continue;
    }
    stack.pop_back();
  }
  const Made& made = made_.at({root.get(), Affine{}, least});
  return Expanded{made.node, made.finest_mm};
}

void Constructions::tell(const NodePtr& tree, const GridStep& least) {
  const auto found = made_.find({summands_.cut(tree).get(), Affine{}, least});
  std::vector<Made*> stack;
  if (found != made_.end()) stack.push_back(&found->second);
  while (!stack.empty()) {
    Made& made = *stack.back();
    stack.pop_back();
    if (std::exchange(made.is_told, true)) continue;
    if (!made.note.empty()) warnings_.add(made.where, made.note);
    stack.insert(stack.end(), made.below.rbegin(), made.below.rend());
  }
}

void Constructions::clear() {
  made_.clear();
  resizing_.clear();
  summands_.clear();
  alive_.clear();
}

}  // namespace csgrun
