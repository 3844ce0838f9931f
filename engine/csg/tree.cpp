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

NodePtr Node::empty(SourceRef where) {
  auto node = std::shared_ptr<Node>(new Node());
  node->where_ = std::move(where);
  return node;
}

NodePtr Node::leaf(std::shared_ptr<const PolygonMesh> mesh, SourceRef where) {
  auto node = std::shared_ptr<Node>(new Node());
  node->kind_ = NodeKind::kLeaf;
  node->mesh_ = std::move(mesh);
  node->where_ = std::move(where);
  return node;
}

NodePtr Node::transformed(const Affine& map, NodePtr child, SourceRef where) {
  auto node = std::shared_ptr<Node>(new Node());
  node->kind_ = NodeKind::kTransform;
  node->transform_ = std::make_unique<Affine>(map);
  node->children_.push_back(std::move(child));
  node->where_ = std::move(where);
  return node;
}

NodePtr Node::painted(const Appearance& appearance, NodePtr child, SourceRef where) {
  auto node = std::shared_ptr<Node>(new Node());
  node->kind_ = NodeKind::kAppearance;
  node->appearance_ = std::make_unique<Appearance>(appearance);
  node->children_.push_back(std::move(child));
  node->where_ = std::move(where);
  return node;
}

NodePtr Node::boolean(BooleanOp op, std::vector<NodePtr> operands, SourceRef where) {
  if (operands.empty()) return empty(std::move(where));
  auto node = std::shared_ptr<Node>(new Node());
  node->kind_ = NodeKind::kBoolean;
  node->op_ = op;
  node->children_ = std::move(operands);
  node->where_ = std::move(where);
  return node;
}

NodePtr Node::outer_hull(const OuterHull& options, NodePtr child, SourceRef where) {
  auto node = std::shared_ptr<Node>(new Node());
  node->kind_ = NodeKind::kOuterHull;
  node->outer_hull_ = options;
  node->children_.push_back(std::move(child));
  node->where_ = std::move(where);
  return node;
}

Node::~Node() {
  // Children that only this node holds are taken apart here, one after another, so that the stack
  // does not grow with the depth of the tree.
  std::vector<NodePtr> doomed = std::move(children_);
  while (!doomed.empty()) {
    NodePtr node = std::move(doomed.back());
    doomed.pop_back();
    if (!node || node.use_count() != 1) continue;
    // use_count() is a relaxed load; the fence orders it after the other owners' last reads.
    std::atomic_thread_fence(std::memory_order_acquire);
    auto& grandchildren = const_cast<Node&>(*node).children_;
    for (NodePtr& child : grandchildren) doomed.push_back(std::move(child));
    grandchildren.clear();
  }
}

}  // namespace csgrun
