// The operands of a job and the expression over them, from the operators of a scene.
#include <unordered_set>
#include <utility>

#include "engine/bsp/untouched.h"
#include "engine/csg/scene_jobs.h"
#include "engine/mesh/face_normal.h"

namespace csgrun {

/// An operator whose operands are being put into a job.
struct SceneJobs::OpenOperator {
  BooleanOp op;
  OperandList list;
  size_t next = 0, count = 0;
  KnownTails::Tail tail;           // the operands from its first on are one, unless that is 0
  std::vector<uint32_t> children;  // expression nodes
  const Scene* scene = nullptr;    // if its known operands were met before
  std::unordered_set<Identity, IdentityHash> met;

  /// Whether a solid was an operand before. A second time it changes nothing, except in a symmetric
  /// difference, and coincident surfaces are what dividing cells tells apart least of all.
  bool repeats(const Subtree& operand, size_t index) {
    if (op == BooleanOp::kSymmetricDifference) return false;
    if (op == BooleanOp::kDifference && index == 0) return false;
    if (scene) {
      const auto found = scene->met_before->find(operand.id);
      if (found != scene->met_before->end() && found->second < scene->met_count) return true;
    }
    return !met.insert(operand.id).second;
  }
};

uint32_t SceneJobs::put(Parts& parts, Operand operand, const Subtree& subtree) const {
  operand.first_source = static_cast<uint32_t>(parts.sources);
  parts.sources += subtree.slots;
  Expression::Node node;
  node.operand = static_cast<uint32_t>(parts.operands.size());
  parts.operands.push_back(std::move(operand));
  parts.keys.push_back(subtree.id.key);
  parts.expression.nodes.push_back(node);
  return static_cast<uint32_t>(parts.expression.nodes.size() - 1);
}

uint32_t SceneJobs::put_leaf(Parts& parts, const SceneNode& node, uint32_t job_frame) const {
  parts.is_too_far |= !fits_grid(node.subtree.box.moved(parts.moved));
  return put(parts, place_leaf(node, job_frame, parts.moved), node.subtree);
}

Result<uint32_t> SceneJobs::put_placed(Parts& parts, const Subtree& subtree, uint32_t job_frame) {
  parts.is_too_far |= !fits_grid(subtree.box.moved(parts.moved));
  auto operand = place(subtree.moved(parts.moved), job_frame);
  if (!operand) return operand.error();
  return put(parts, *std::move(operand), subtree);
}

/// The local axes x of what was resolved and the frame's axes y: y = P x + o, so P^-1 y = x + P^-1
/// o.
Operand SceneJobs::place_leaf(const SceneNode& node, uint32_t job_frame, const IVec3& moved) const {
  const Identity id = node.subtree.moved(moved).id;
  Operand operand;
  if (id.frame != job_frame) operand.frame = scene_.frames[id.frame];
  if (node.boundary) {
    const SignedPermutation back = id.permutation.inverse();
    operand.boundary = node.boundary;
    operand.translation = back.apply(id.origin);
    operand.frame = back.apply_to_frame(operand.frame);
  } else {
    operand.leaf = node.geometry;
    operand.translation = id.origin;
  }
  if (id.paint != kUnpainted) operand.appearance = id.paint;
  return operand;
}

/// The stored axes x and the subtree's axes y are both images of the reference: x = P1 r + o1,
/// y = P2 r + o2. So Q y = x + t with Q = P1 P2^-1 and t = Q o2 - o1.
Result<Operand> SceneJobs::place_as_kept(const Subtree& subtree, uint32_t job_frame) {
  const StoredBoundary& stored = use(subtree.id.key);
  auto boundary = boundary_of(subtree.id.key);
  if (!boundary) return boundary.error();
  const SignedPermutation turn =
      SignedPermutation::compose(stored.id.permutation, subtree.id.permutation.inverse());
  const IVec3 turned = turn.apply(subtree.id.origin);
  Operand operand;
  operand.boundary = *boundary;
  for (int i = 0; i < 3; ++i) operand.translation[i] = turned[i] - stored.id.origin[i];
  const Frame base = subtree.id.frame == job_frame ? Frame{} : scene_.frames[subtree.id.frame];
  operand.frame = turn.apply_to_frame(base);
  if (subtree.id.paint != stored.id.paint) operand.appearance = subtree.id.paint;
  return operand;
}

/// As a job takes it.
Result<Operand> SceneJobs::place(const Subtree& subtree, uint32_t job_frame) {
  auto operand = place_as_kept(subtree, job_frame);
  if (operand && !can_stand_named(*operand)) {
    operand->boundary = spelled(subtree.id.key, operand->boundary);
  }
  return operand;
}

/// Puts the value of a known subtree into a job: in pieces, where it comes first, or is a known
/// tail, and stands as it was evaluated. Returns the number of its node.
Result<uint32_t> SceneJobs::put_known(Parts& parts, const Subtree& value, uint32_t job_frame,
                                      bool is_tail) {
  const StoredBoundary& stored = use(value.id.key);
  const IVec3 moved = difference(stored.id.origin, value.id.origin);
  const bool may_be_first = parts.operands.empty() && may_be_in_pieces() &&
                            (parts.may_be_moved || moved == IVec3{0, 0, 0});
  const bool may_be_last = is_tail && !parts.in_pieces && moved == parts.moved;
  if (value.id.frame == job_frame && is_only_moved(value, stored) &&
      (may_be_first || may_be_last)) {
    parts.moved = moved;
    parts.in_pieces = pieces_of_result(value.id.key);
    parts.pieces_at = static_cast<uint32_t>(parts.operands.size());
    return put(parts, Operand(), value);
  }
  results_.at(value.id.key).is_fresh = true;  // place() is the same use
  return put_placed(parts, value, job_frame);
}

/// Starts on the first `count` operands of a node, from the longest prefix that is known.
Result<SceneJobs::OpenOperator> SceneJobs::open(uint32_t node, size_t count, bool is_target,
                                                uint32_t job_frame, Parts& parts) {
  OpenOperator result{scene_.nodes[node].op, scene_.operands(node), 0, count, {}, {}, nullptr, {}};
  if (is_target && count == result.list.operands.size()) {
    result.tail = known_tail(node, result.list);
  }
  if (scene_.met_before && node == scene_.roots[0]) result.scene = &scene_;
  for (size_t prefix = is_target ? count - 1 : count; prefix >= 2; --prefix) {
    const Subtree& value = *result.list.values[prefix - 1];
    if (!may_use_known(value)) continue;
    auto known = put_known(parts, value, job_frame);
    if (!known) return known.error();
    result.children.push_back(*known);
    result.next = prefix;
    for (size_t i = 0; i < prefix; ++i) {
      result.repeats(scene_.nodes[result.list.operands[i]].subtree, i);
    }
    break;
  }
  return result;
}

Result<SceneJobs::Parts> SceneJobs::build(uint32_t node, size_t count, uint32_t job_frame,
                                          bool may_be_moved) {
  Parts parts;
  parts.may_be_moved = may_be_moved;
  std::vector<OpenOperator> stack;
  const auto start = [&](uint32_t at, size_t operands, bool is_target) -> Status {
    auto opened = open(at, operands, is_target, job_frame, parts);
    if (!opened) return opened.error();
    stack.push_back(*std::move(opened));
    return std::monostate{};
  };
  if (Status status = start(node, count, true); !status) return status.error();
  while (true) {
    OpenOperator& top = stack.back();
    if (top.next < top.count) {
      if (top.tail.first > 0 && top.next == top.tail.first) {
        auto known = put_known(parts, top.tail.value, job_frame, true);
        if (!known) return known.error();
        top.children.push_back(*known);
        top.next = top.count;
        continue;
      }
      const size_t index = top.next++;
      const uint32_t operand = top.list.operands[index];
      const SceneNode& child = scene_.nodes[operand];
      if (top.repeats(child.subtree, index)) {
        parts.sources += child.subtree.slots;
        continue;
      }
      if (child.kind == SceneNode::Kind::kLeaf) {
        top.children.push_back(put_leaf(parts, child, job_frame));
      } else if (child.kind == SceneNode::Kind::kKnown) {
        auto known = put_known(parts, child.subtree, job_frame);
        if (!known) return known.error();
        top.children.push_back(*known);
      } else if (is_hull(operand)) {
        auto hull = put_placed(parts, child.subtree, job_frame);
        if (!hull) return hull.error();
        top.children.push_back(*hull);
      } else {
        const size_t all = scene_.operands(operand).operands.size();
        if (Status status = start(operand, all, false); !status) return status.error();
      }
      continue;
    }
    uint32_t value = top.children[0];
    if (top.children.size() > 1) {
      Expression& expression = parts.expression;
      Expression::Node made;
      made.is_operand = false;
      made.op = top.op;
      made.first_child = static_cast<uint32_t>(expression.children.size());
      made.child_count = static_cast<uint32_t>(top.children.size());
      expression.children.insert(expression.children.end(), top.children.begin(),
                                 top.children.end());
      value = static_cast<uint32_t>(expression.nodes.size());
      expression.nodes.push_back(made);
      ++parts.operators;
    }
    stack.pop_back();
    if (stack.empty()) return parts;
    stack.back().children.push_back(value);
  }
}

}  // namespace csgrun
