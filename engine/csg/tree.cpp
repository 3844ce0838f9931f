#include <algorithm>
#include <atomic>
#include <utility>

#include <csgrun/engine/csg_tree.h>

namespace csgrun {

Affine Affine::compose(const Affine& outer, const Affine& inner) {
  Affine r;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) {
      double sum = outer.m[i][0] * inner.m[0][j] + outer.m[i][1] * inner.m[1][j] +
                   outer.m[i][2] * inner.m[2][j];
      if (j == 3) sum += outer.m[i][3];
      r.m[i][j] = sum;
    }
  }
  return r;
}

glm::dvec3 Affine::apply(const glm::dvec3& p) const {
  glm::dvec3 r;
  for (int i = 0; i < 3; ++i) r[i] = m[i][0] * p.x + m[i][1] * p.y + m[i][2] * p.z + m[i][3];
  return r;
}

std::shared_ptr<Node> Node::made(NodeKind kind, std::vector<NodePtr> children, SourceRef where) {
  auto node = std::shared_ptr<Node>(new Node());
  node->kind_ = kind;
  node->has_constructions_ = kind == NodeKind::kConstruction ||
                             std::any_of(children.begin(), children.end(), [](const NodePtr& c) {
                               return c && c->has_constructions_;
                             });
  node->has_sums_ = std::any_of(children.begin(), children.end(),
                                [](const NodePtr& c) { return c && c->has_sums_; });
  node->children_ = std::move(children);
  node->where_ = std::move(where);
  return node;
}

NodePtr Node::empty(SourceRef where) { return made(NodeKind::kEmpty, {}, std::move(where)); }

NodePtr Node::leaf(std::shared_ptr<const PolygonMesh> mesh, SourceRef where) {
  auto node = made(NodeKind::kLeaf, {}, std::move(where));
  node->mesh_ = std::move(mesh);
  return node;
}

NodePtr Node::transformed(const Affine& map, NodePtr child, SourceRef where) {
  auto node = made(NodeKind::kTransform, {std::move(child)}, std::move(where));
  node->transform_ = std::make_unique<Affine>(map);
  return node;
}

NodePtr Node::painted(const Appearance& appearance, NodePtr child, SourceRef where) {
  auto node = made(NodeKind::kAppearance, {std::move(child)}, std::move(where));
  node->appearance_ = std::make_unique<Appearance>(appearance);
  return node;
}

NodePtr Node::boolean(BooleanOp op, std::vector<NodePtr> operands, SourceRef where) {
  if (operands.empty()) return empty(std::move(where));
  auto node = made(NodeKind::kBoolean, std::move(operands), std::move(where));
  node->op_ = op;
  return node;
}

NodePtr Node::intersection_as(std::vector<NodePtr> operands, NodePtr same, SourceRef where) {
  auto node = made(NodeKind::kBoolean, std::move(operands), std::move(where));
  node->op_ = BooleanOp::kIntersection;
  node->has_constructions_ = same->has_constructions();
  node->has_sums_ = same->has_sums();
  node->same_solid_ = std::move(same);
  return node;
}

NodePtr Node::difference_as(std::vector<NodePtr> operands, NodePtr leaf, SourceRef where) {
  auto node = made(NodeKind::kBoolean, std::move(operands), std::move(where));
  node->op_ = BooleanOp::kDifference;
  node->rounded_leaf_ = std::move(leaf);
  return node;
}

NodePtr Node::outer_hull(const OuterHull& options, NodePtr child, SourceRef where) {
  auto node = made(NodeKind::kOuterHull, {std::move(child)}, std::move(where));
  node->outer_hull_ = options;
  return node;
}

NodePtr Node::convex_hull(std::vector<NodePtr> operands, SourceRef where) {
  if (operands.empty()) return empty(std::move(where));
  return made(NodeKind::kConstruction, std::move(operands), std::move(where));
}

NodePtr Node::minkowski_sum(std::vector<NodePtr> operands, SourceRef where) {
  if (operands.empty()) return empty(std::move(where));
  auto node = made(NodeKind::kConstruction, std::move(operands), std::move(where));
  node->construction_ = Construction::kMinkowskiSum;
  node->has_sums_ = true;
  return node;
}

NodePtr Node::resized(const Resize& resize, NodePtr child, SourceRef where) {
  auto node = made(NodeKind::kConstruction, {std::move(child)}, std::move(where));
  node->construction_ = Construction::kResize;
  node->resize_ = std::make_unique<Resize>(resize);
  return node;
}

Node::~Node() {
  // Children that only this node holds are taken apart here, one after another, so that the stack
  // does not grow with the depth of the tree.
  std::vector<NodePtr> doomed = std::move(children_);
  if (same_solid_) doomed.push_back(std::move(same_solid_));
  while (!doomed.empty()) {
    NodePtr node = std::move(doomed.back());
    doomed.pop_back();
    if (!node || node.use_count() != 1) continue;
    // use_count() is a relaxed load; the fence orders it after the other owners' last reads.
    std::atomic_thread_fence(std::memory_order_acquire);
    auto& last = const_cast<Node&>(*node);
    for (NodePtr& child : last.children_) doomed.push_back(std::move(child));
    last.children_.clear();
    if (last.same_solid_) doomed.push_back(std::move(last.same_solid_));
  }
}

}  // namespace csgrun
