#include "tests/support/kernel_case.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tests/support/exact_solid.h"

namespace csgrun::test {

uint32_t Tree::leaf_count() const {
  if (leaf >= 0) return 1;
  uint32_t n = 0;
  for (const Tree& c : children) n += c.leaf_count();
  return n;
}

bool Tree::inside(const std::vector<bool>& of_leaf) const {
  if (leaf >= 0) return of_leaf[static_cast<size_t>(leaf)];
  bool r = children[0].inside(of_leaf);
  for (size_t i = 1; i < children.size(); ++i) {
    const bool v = children[i].inside(of_leaf);
    switch (op) {
      case BooleanOp::kUnion:
        r = r || v;
        break;
      case BooleanOp::kIntersection:
        r = r && v;
        break;
      case BooleanOp::kDifference:
        r = r && !v;
        break;
      case BooleanOp::kSymmetricDifference:
        r = r != v;
        break;
    }
  }
  return r;
}

std::string Tree::text() const {
  if (leaf >= 0) return std::string(1, static_cast<char>('A' + leaf));
  std::string r = "(";
  for (size_t i = 0; i < children.size(); ++i) {
    constexpr const char* kSigns[] = {" + ", " * ", " - ", " ^ "};
    if (i) r += kSigns[static_cast<int>(op)];
    r += children[i].text();
  }
  return r + ")";
}

Tree leaf(int i) { return {i, BooleanOp::kUnion, {}}; }

Tree join(std::vector<Tree> c) { return {-1, BooleanOp::kUnion, std::move(c)}; }

Tree meet(std::vector<Tree> c) { return {-1, BooleanOp::kIntersection, std::move(c)}; }

Tree less(std::vector<Tree> c) { return {-1, BooleanOp::kDifference, std::move(c)}; }

Tree differ(std::vector<Tree> c) { return {-1, BooleanOp::kSymmetricDifference, std::move(c)}; }

Expression flat_expression(BooleanOp op, uint32_t count) {
  Expression expression;
  for (uint32_t o = 0; o < count; ++o) {
    Expression::Node node;
    node.operand = o;
    expression.nodes.push_back(node);
    expression.children.push_back(o);
  }
  Expression::Node root;
  root.is_operand = false;
  root.op = op;
  root.child_count = count;
  expression.nodes.push_back(root);
  return expression;
}

Operand operand_of(Leaf leaf) {
  Operand o;
  o.leaf = std::move(leaf);
  return o;
}

GridBox region_of(const std::vector<Operand>& operands) {
  GridBox box;
  bool any = false;
  for (const Operand& o : operands) {
    for (const Rational3& p : exact_solid(o).points) {
      for (int k = 0; k < 3; ++k) {
        const double c = p[k].get_d();
        const auto lo = static_cast<int64_t>(std::floor(c)) - 1;
        const auto hi = static_cast<int64_t>(std::ceil(c)) + 1;
        box.lo[k] = any ? std::min(box.lo[k], lo) : lo;
        box.hi[k] = any ? std::max(box.hi[k], hi) : hi;
      }
      any = true;
    }
  }
  return box;
}

namespace {

class TreeEvaluator {
 public:
  TreeEvaluator(const std::vector<Operand>& leaves, KernelOptions options, Materialise materialise)
      : leaves_(leaves), options_(std::move(options)), materialise_(std::move(materialise)) {}

  BoundaryResult run(const Tree& tree) {
    std::vector<Operand> operands;
    Expression expression;
    uint32_t source = 0;
    std::optional<Error> error;
    build(tree, true, operands, expression, source, error);
    if (error) return *error;
    EvaluateStats stats;
    return evaluate_boolean(operands, expression, region_of(operands), options_, stats);
  }

 private:
  uint32_t build(const Tree& t, bool root, std::vector<Operand>& operands, Expression& expression,
                 uint32_t& source, std::optional<Error>& error) {
    Expression::Node node;
    if (t.leaf >= 0) {
      node.operand = static_cast<uint32_t>(operands.size());
      operands.push_back(leaves_[static_cast<size_t>(t.leaf)]);
      operands.back().first_source = source++;
    } else if (!root && materialise_ && materialise_(t)) {
      auto inner = TreeEvaluator(leaves_, options_, materialise_).run(t);
      if (!inner) {
        error = inner.error();
        return 0;
      }
      node.operand = static_cast<uint32_t>(operands.size());
      Operand o;
      o.boundary = *inner;
      o.first_source = source;
      operands.push_back(o);
      source += t.leaf_count();
    } else {
      std::vector<uint32_t> children;
      for (const Tree& c : t.children) {
        children.push_back(build(c, false, operands, expression, source, error));
      }
      node.is_operand = false;
      node.op = t.op;
      node.first_child = static_cast<uint32_t>(expression.children.size());
      node.child_count = static_cast<uint32_t>(children.size());
      expression.children.insert(expression.children.end(), children.begin(), children.end());
    }
    expression.nodes.push_back(node);
    return static_cast<uint32_t>(expression.nodes.size() - 1);
  }

  const std::vector<Operand>& leaves_;
  KernelOptions options_;
  Materialise materialise_;
};

}  // namespace

BoundaryResult evaluate(const Tree& tree, const std::vector<Operand>& leaves,
                        const KernelOptions& options, const Materialise& nest) {
  return TreeEvaluator(leaves, options, nest).run(tree);
}

std::string difference_between(const BoundaryMesh& a, const BoundaryMesh& b, bool compare_labels) {
  if (a.point_rounded != b.point_rounded) {
    return "different points: " + std::to_string(a.point_rounded.size()) + " and " +
           std::to_string(b.point_rounded.size());
  }
  if (a.faces.size() != b.faces.size()) {
    return "different faces: " + std::to_string(a.faces.size()) + " and " +
           std::to_string(b.faces.size());
  }
  if (a.loop_starts != b.loop_starts) return "different loops";
  for (size_t f = 0; f < a.faces.size(); ++f) {
    const auto &x = a.faces[f], &y = b.faces[f];
    const auto at = " (face " + std::to_string(f) + ")";
    const Plane p =
        x.plane.flipped() ? a.planes[x.plane.index()].reversed() : a.planes[x.plane.index()];
    const Plane q =
        y.plane.flipped() ? b.planes[y.plane.index()].reversed() : b.planes[y.plane.index()];
    if (!(p == q)) return "different planes" + at;
    if (x.first_loop != y.first_loop || x.loop_count != y.loop_count) return "different loops" + at;
    if (compare_labels && !(x.label == y.label)) return "different labels" + at;
    if (compare_labels && (x.whole != y.whole || x.complete != y.complete)) {
      return "a face is whole in one only" + at;
    }
  }
  for (size_t c = 0; c < a.corners.size(); ++c) {
    if (a.corners[c].point != b.corners[c].point) return "different corners";
  }
  return "";
}

PresentContext test_context() {
  PresentContext context;
  context.step.numerator = 1;
  context.appearances.resize(4);
  for (size_t i = 0; i < context.appearances.size(); ++i) {
    context.appearances[i].red = 0.25f * static_cast<float>(i);
    context.appearances[i].is_default = false;
  }
  context.exact_points = true;
  return context;
}

std::string difference_between(const Solid& a, const Solid& b) {
  if (a.positions != b.positions) return "different positions";
  if (a.positions_f32 != b.positions_f32) return "different single-precision positions";
  if (a.point_of != b.point_of) return "different points of vertices";
  if (a.triangles != b.triangles) return "different triangles";
  if (a.triangle_face != b.triangle_face) return "different faces of triangles";
  if (a.loop_starts != b.loop_starts || a.loop_vertices != b.loop_vertices)
    return "different loops";
  if (a.canonical_hash != b.canonical_hash) return "different hashes";
  if (a.faces.size() != b.faces.size()) return "different faces";
  for (size_t f = 0; f < a.faces.size(); ++f) {
    const auto &x = a.faces[f], &y = b.faces[f];
    if (x.first_loop != y.first_loop || x.loop_count != y.loop_count ||
        x.appearance != y.appearance || x.surface != y.surface || x.source != y.source) {
      return "different face " + std::to_string(f);
    }
  }
  return "";
}

}  // namespace csgrun::test
