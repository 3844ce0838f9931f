#include "tests/support/fuzz/check.h"

#include <algorithm>
#include <cmath>

#include "engine/bsp/untouched.h"
#include "engine/mesh/leaf_check.h"
#include "engine/mesh/opposite_edges.h"
#include "tests/support/exact_measures.h"
#include "tests/support/fuzz/truth.h"
#include "tests/support/kernel_checks.h"
#include "tests/support/prepared_leaf.h"
#include "tests/support/reference/reference.h"

namespace csgrun::test {

FuzzEvaluator::FuzzEvaluator(const FuzzCase& c) : case_(c), options_(c.options) {
  options_.name_untouched = (case_.nest & kNamed) != 0;
}

BoundaryResult FuzzEvaluator::run() {
  source_ = 0;
  inner_ = 0;
  if (!(case_.nest & kInPieces)) {
    auto result = evaluate(case_.tree);
    if (result) *result = expanded(*result);
    return result;
  }
  auto pieces = pieces_of(case_.tree);
  if (!pieces) return pieces.error();
  return assemble_pieces(**pieces, false);
}

size_t FuzzEvaluator::named_count(const BoundaryMesh& mesh) {
  size_t count = 0;
  for (const UntouchedPart& part : mesh.parts) count += part.faces.size();
  return count;
}

BoundaryResult FuzzEvaluator::evaluate(const FuzzNode& n) {
  Parts parts;
  if (auto root = put(n, parts, true); !root) return root.error();
  auto result = evaluate_boolean(parts.operands, parts.expression, parts.region, options_, stats_);
  if (result) named_ += named_count(**result);
  return result;
}

Result<PiecesPtr> FuzzEvaluator::pieces_of(const FuzzNode& n) {
  if (n.leaf >= 0 || n.hull) {
    Parts parts;
    if (auto root = put(n, parts, true); !root) return root.error();
    return in_pieces(parts);
  }
  auto result = pieces_of(n.children[0]);
  for (size_t i = 1; result && i < n.children.size(); ++i) {
    Parts parts;  // all but the first operand
    const FuzzNode& child = n.children[i];
    if (child.leaf >= 0) {
      if (auto put_in = put(child, parts, true); !put_in) return put_in.error();
    } else {
      auto inner = evaluate(child);
      if (!inner) return inner.error();
      add_operand(parts, boundary_operand(*inner));
    }
    Expression binary;
    binary.nodes = {{true, n.op, 0, 0, 0}, {true, n.op, 1, 0, 0}, {false, n.op, 0, 0, 2}};
    binary.children = {0, 1};
    hold(parts.region, (*result)->tree.box());
    auto next = change_pieces(**result, parts.operands, binary, parts.region, options_, stats_);
    if (next && !*next) {
      auto before = assemble_pieces(**result, false);
      if (!before) return before.error();
      parts.operands.insert(parts.operands.begin(), boundary_operand(*before));
      auto boundary = evaluate_boolean(parts.operands, binary, parts.region, options_, stats_);
      if (!boundary) return boundary.error();
      Parts made;
      add_operand(made, boundary_operand(*boundary));
      next = in_pieces(made);
    }
    result = std::move(next);
  }
  return result;
}

Result<PiecesPtr> FuzzEvaluator::in_pieces(const Parts& parts) {
  auto pieces = evaluate_pieces(parts.operands, parts.expression, parts.region, options_, stats_);
  if (!pieces || *pieces) return pieces;
  auto boundary =
      evaluate_boolean(parts.operands, parts.expression, parts.region, options_, stats_);
  if (!boundary) return boundary.error();
  return evaluate_pieces({boundary_operand(*boundary)}, parts.expression, parts.region, options_,
                         stats_);
}

Operand FuzzEvaluator::boundary_operand(Boundary boundary) {
  Operand o;
  o.boundary = std::move(boundary);
  return o;
}

void FuzzEvaluator::hold(GridBox& box, const PieceBox& pieces) {
  if (pieces.lo[0] > pieces.hi[0]) return;
  hold(box, pieces.lo);
  hold(box, pieces.hi);
}

void FuzzEvaluator::hold(GridBox& box, const std::array<double, 3>& p) {
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = std::min(box.lo[k], static_cast<int64_t>(std::floor(p[k])) - 1);
    box.hi[k] = std::max(box.hi[k], static_cast<int64_t>(std::ceil(p[k])) + 1);
  }
}

uint32_t FuzzEvaluator::add_operand(Parts& parts, Operand operand) {
  if (operand.boundary) {
    for (const auto& p : operand.boundary->point_rounded) hold(parts.region, p);
    for (const UntouchedPart& part : operand.boundary->parts) {
      for (const uint32_t f : part.faces) {
        for (const uint32_t v : part.triangle(f)) hold(parts.region, part.rounded_point(v));
      }
    }
  } else {
    const ExactMap map(operand.frame);
    for (IVec3 q : operand.leaf->vertices) {
      for (int k = 0; k < 3; ++k) q[k] += operand.translation[k];
      const reference::Point x = map(q);
      const double w = x[3].get_d();
      hold(parts.region, std::array{x[0].get_d() / w, x[1].get_d() / w, x[2].get_d() / w});
    }
  }
  Expression::Node node;
  node.operand = static_cast<uint32_t>(parts.operands.size());
  parts.operands.push_back(std::move(operand));
  parts.expression.nodes.push_back(node);
  return static_cast<uint32_t>(parts.expression.nodes.size() - 1);
}

InsideRule FuzzEvaluator::inside_rule(FillRule fill) {
  switch (fill) {
    case FillRule::kPositive:
      return InsideRule::kPositive;
    case FillRule::kEvenOdd:
      return InsideRule::kEvenOdd;
    default:
      return InsideRule::kNonZero;
  }
}

InsideRule FuzzEvaluator::inside_rule(const OuterHull& hull) {
  if (hull.keep_voids) {
    return hull.orientation_sensitive ? InsideRule::kPositive : InsideRule::kNonZero;
  }
  return hull.orientation_sensitive ? InsideRule::kOrientedHull : InsideRule::kOuterHull;
}

Result<uint32_t> FuzzEvaluator::leaf(uint32_t index, const std::optional<OuterHull>& hull,
                                     Parts& parts) {
  const FuzzLeaf& l = case_.leaves[index];
  const auto geometry = std::make_shared<LeafGeometry>(geometry_of(l));
  std::vector<std::array<uint32_t, 2>> crossings;
  if (l.may_cross || hull || options_.name_untouched) {
    crossings = find_self_intersections(*geometry);
  }
  if (options_.name_untouched) {
    geometry->opposite = pair_edges(*geometry).opposite;
    const bool has_triangles = geometry->corners.size() == 3 * geometry->face_count();
    geometry->may_touch = !crossings.empty() || !l.keep_facets || !has_triangles;
  }
  Operand o = operand_of(geometry);
  if ((case_.nest & kPrepared) != 0 && !l.may_cross && !hull) o.leaf = as_prepared(geometry);
  o.translation = l.move;
  o.frame = case_.frames[l.frame];
  o.first_source = source_++;
  if (l.may_cross || hull) {
    const InsideRule rule = hull ? inside_rule(*hull) : inside_rule(l.fill);
    auto resolved = resolve_surface(o, crossings, rule, options_, stats_);
    if (!resolved) return resolved.error();
    named_ += named_count(**resolved);
    o = Operand();  // frame, translation and labels are the boundary's own
    o.boundary = *resolved;
  }
  return add_operand(parts, std::move(o));
}

Result<uint32_t> FuzzEvaluator::hull(const FuzzNode& n, Parts& parts) {
  const FuzzNode& child = n.children[0];
  if (child.leaf >= 0) return leaf(static_cast<uint32_t>(child.leaf), n.hull, parts);
  auto inner = evaluate(child);
  if (!inner) return inner.error();
  Operand o;
  o.boundary = *inner;
  if (!n.hull->keep_voids) {
    auto filled = resolve_surface(o, {}, inside_rule(*n.hull), options_, stats_);
    if (!filled) return filled.error();
    o.boundary = *filled;
  }
  return add_operand(parts, std::move(o));
}

Result<uint32_t> FuzzEvaluator::put(const FuzzNode& n, Parts& parts, bool root) {
  if (n.leaf >= 0) return leaf(static_cast<uint32_t>(n.leaf), std::nullopt, parts);
  if (n.hull) return hull(n, parts);
  if (!root && (case_.nest >> (inner_++ % 64) & 1)) {
    auto inner = evaluate(n);  // its labels are those of the whole tree
    if (!inner) return inner.error();
    return add_operand(parts, boundary_operand(*inner));
  }
  std::vector<uint32_t> children;
  for (const FuzzNode& c : n.children) {
    auto child = put(c, parts, false);
    if (!child) return child.error();
    children.push_back(*child);
  }
  Expression& e = parts.expression;
  e.nodes.push_back({false, n.op, 0, static_cast<uint32_t>(e.children.size()),
                     static_cast<uint32_t>(children.size())});
  e.children.insert(e.children.end(), children.begin(), children.end());
  return static_cast<uint32_t>(e.nodes.size() - 1);
}

FuzzOutcome check_case(const FuzzCase& c, bool forms) {
  FuzzOutcome outcome;
  FuzzEvaluator evaluator(c);
  const auto result = evaluator.run();
  // What the filter leaves to integers is zero but for a few in a million.
  for (const uint64_t count : evaluator.stats().sign_exact) outcome.meets_zero |= count > 0;
  if (!result) {
    outcome.failure = "error: " + result.error().message;
    return outcome;
  }
  outcome.named = evaluator.named();
  outcome.empty = (*result)->faces.empty();
  const Truth truth = truth_of(c);
  outcome.failure = truth.fault;
  if (!outcome.failure.empty()) return outcome;
  outcome.failure = reference::difference(truth.leaves, truth.tree, claim_of(**result));
  if (!outcome.failure.empty() || !forms) return outcome;
  outcome.failure = fault_in(**result);
  if (!outcome.failure.empty()) return outcome;
  const auto solid = present(**result, test_context());
  if (!solid) {
    outcome.failure = "presentation: " + solid.error().message;
    return outcome;
  }
  outcome.failure = fault_in(**solid, **result);
  if (!outcome.failure.empty()) return outcome;
  // Where contacts are looked for must not matter.
  BoundaryMesh anywhere = **result;
  anywhere.touches.clear();
  anywhere.may_touch = true;
  const auto same = present(anywhere, test_context());
  outcome.failure = same ? difference_between(**solid, **same) : same.error().message;
  if (!outcome.failure.empty()) outcome.failure = "contacts anywhere: " + outcome.failure;
  return outcome;
}

}  // namespace csgrun::test
