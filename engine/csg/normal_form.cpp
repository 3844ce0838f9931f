#include "engine/csg/normal_form.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_set>

#include "engine/csg/hash_affine.h"
#include "engine/csg/is_finite.h"

namespace csgrun {
namespace {

constexpr uint32_t kEmptyIndex = 0;

/// |det| of the linear part with its columns scaled to unit length: 1 for rotations, 0 for flat
/// maps.
double squareness(const Affine& a) {
  const auto& m = a.m;
  double product = 1;
  for (int j = 0; j < 3; ++j) product *= std::hypot(m[0][j], m[1][j], m[2][j]);
  const double det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                     m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                     m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return product > 0 ? std::fabs(det) / product : 0;
}

/// Whether a node is a leaf under nothing but transforms and appearances.
bool is_mesh(const Node* node) {
  while (node != nullptr &&
         (node->kind() == NodeKind::kTransform || node->kind() == NodeKind::kAppearance)) {
    node = node->children()[0].get();
  }
  return node != nullptr && node->kind() == NodeKind::kLeaf;
}

}  // namespace

/// A node of the tree under all that was met above it.
struct NormalForm::Item {
  const NodePtr* node = nullptr;  // lives in its parent, or is the caller's root
  Affine map;
  uint32_t paint = kUnpainted;
  bool is_shared = false;  ///< it, or what stands over it alone, is used elsewhere, too
  const SourceRef* bent_by = nullptr;
  double bent = 2;  // squareness of the transform that `bent_by` names

  [[nodiscard]] Memo memo() const { return {node->get(), map, paint}; }
  [[nodiscard]] Item child(size_t i) const {
    Item r = *this;
    r.node = &(*node)->children()[i];
    return r;
  }
};

/// One operator of the normal form, or a hull, while its operands are gathered.
struct NormalForm::Cluster {
  BooleanOp op;
  bool is_hull;
  Item item;
  std::vector<Item> pending;  // last is next
  bool has_first = false, is_empty = false;
  uint32_t first = kEmptyIndex;
  std::vector<uint32_t> rest;
  std::unordered_set<uint32_t> members;
  std::unordered_set<Memo, MemoHash> absorbed;

  explicit Cluster(const Item& start)
      : op((*start.node)->op()),
        is_hull((*start.node)->kind() == NodeKind::kOuterHull),
        item(start) {
    open(start);
  }
  void open(const Item& boolean) {
    for (size_t i = (*boolean.node)->children().size(); i-- > 0;) {
      pending.push_back(boolean.child(i));
    }
  }
};

size_t NormalForm::MemoHash::operator()(const Memo& memo) const {
  const uint64_t h = reinterpret_cast<uintptr_t>(memo.node) ^ (uint64_t{memo.paint} << 32);
  return hash_affine(h, memo.map);
}

NormalForm::NormalForm(AppearanceTable& appearances) : appearances_(appearances) { clear(); }

void NormalForm::clear() {
  nodes_.assign(1, NormalNode{});
  memo_.clear();
  alive_.clear();
}

/// Folds transforms and appearances, and steps through operators of one operand.
Status NormalForm::unwrap(Item& item) const {
  item.is_shared = false;
  while (true) {
    item.is_shared |= item.node->use_count() > 1;
    if (!*item.node) return Error{ErrorCode::kInternal, "a node of the tree is missing", {}};
    const Node& node = **item.node;
    switch (node.kind()) {
      case NodeKind::kTransform: {
        item.map = Affine::compose(item.map, node.transform());
        if (!is_finite(item.map)) {
          return Error{ErrorCode::kInvalidArgument, "a transform is not finite", node.where()};
        }
        const double square = squareness(node.transform());
        if (square < item.bent) {
          item.bent = square;
          item.bent_by = &node.where();
        }
        break;
      }
      case NodeKind::kAppearance:
        if (!is_in_range(node.appearance())) {
          return Error{ErrorCode::kInvalidArgument,
                       "a colour or material is out of range: each number of it is from 0 to 1",
                       node.where()};
        }
        if (item.paint == kUnpainted) item.paint = appearances_.intern(node.appearance());
        break;
      case NodeKind::kBoolean:
        if (node.same_solid()) {
          item.node = &node.same_solid();
          continue;
        }
        if (node.children().size() != 1) return std::monostate{};
        break;
      case NodeKind::kOuterHull:
        // A solid has no voids but those that it has; only a mesh can be wound otherwise.
        if (!node.outer_hull().keep_voids || is_mesh(node.children()[0].get())) {
          return std::monostate{};
        }
        break;
      case NodeKind::kConstruction:
        return Error{ErrorCode::kInternal, "a construction was not made before", node.where()};
      default:
        return std::monostate{};
    }
    item.node = &node.children()[0];
  }
}

uint32_t NormalForm::leaf(const Item& item) {
  const auto [found, is_new] = memo_.try_emplace(item.memo(), static_cast<uint32_t>(nodes_.size()));
  if (is_new) {
    NormalNode node;
    node.kind = NormalNode::Kind::kLeaf;
    node.leaf = *item.node;
    node.map = item.map;
    node.paint = item.paint;
    if (item.bent_by) node.bent_by = *item.bent_by;
    nodes_.push_back(std::move(node));
  }
  return found->second;
}

Result<uint32_t> NormalForm::hulled_leaf(const Item& item) {
  if (const auto known = memo_.find(item.memo()); known != memo_.end()) return known->second;
  Item inner = item.child(0);
  if (Status status = unwrap(inner); !status) return status.error();
  const auto number = static_cast<uint32_t>(nodes_.size());
  memo_.emplace(item.memo(), number);
  alive_.push_back(*item.node);
  NormalNode node;
  node.kind = NormalNode::Kind::kLeaf;
  node.hull = (*item.node)->outer_hull();
  node.leaf = *inner.node;
  node.map = inner.map;
  node.paint = inner.paint;
  if (inner.bent_by) node.bent_by = *inner.bent_by;
  nodes_.push_back(std::move(node));
  return number;
}

/// Whether the operands of `item`, an operator, may stand in the place of it.
bool NormalForm::absorbs(Cluster& cluster, const Item& item) const {
  const Node& node = **item.node;
  if (cluster.is_hull || node.kind() != NodeKind::kBoolean || node.op() != cluster.op) return false;
  const bool is_associative =
      cluster.op == BooleanOp::kUnion || cluster.op == BooleanOp::kIntersection;
  return is_associative || !cluster.has_first;
}

/// Whether a value holds all that a difference has left so far, as far as is plain: it is what the
/// difference takes from, a union of that and others, or that less no more than was taken.
bool NormalForm::takes_all(const Cluster& difference, uint32_t value) const {
  if (value == difference.first) return true;
  const NormalNode& node = nodes_[value];
  if (node.kind != NormalNode::Kind::kOperator) return false;
  const auto all = operands(value);
  if (node.op == BooleanOp::kUnion)
    return std::find(all.begin(), all.end(), difference.first) != all.end();
  return node.op == BooleanOp::kDifference && all[0] == difference.first &&
         std::all_of(all.begin() + 1, all.end(),
                     [&](uint32_t taken) { return difference.members.contains(taken); });
}

void NormalForm::collect(Cluster& cluster, uint32_t value) const {
  const bool is_empty = value == kEmptyIndex;
  if (cluster.is_hull) {
    cluster.has_first = !is_empty;
    cluster.first = value;
    return;
  }
  switch (cluster.op) {
    case BooleanOp::kIntersection:
      cluster.is_empty |= is_empty;
      break;
    case BooleanOp::kDifference:
      cluster.is_empty |= is_empty && !cluster.has_first;
      break;
    default:
      break;
  }
  if (is_empty || cluster.is_empty) return;
  if (!cluster.has_first) {
    cluster.has_first = true;
    cluster.first = value;
    if (cluster.op != BooleanOp::kDifference) cluster.members.insert(value);
    return;
  }
  const bool is_associative =
      cluster.op == BooleanOp::kUnion || cluster.op == BooleanOp::kIntersection;
  // What is taken away from itself is nothing, also within a union; no surface need be held against
  // itself for that.
  if (cluster.op == BooleanOp::kDifference && takes_all(cluster, value)) {
    cluster.is_empty = true;
    return;
  }
  const auto append = [&](uint32_t operand) {
    // A second time the same operand changes nothing, except in a symmetric difference.
    if (cluster.op != BooleanOp::kSymmetricDifference && !cluster.members.insert(operand).second) {
      return;
    }
    cluster.rest.push_back(operand);
  };
  const NormalNode& node = nodes_[value];
  if (is_associative && node.kind == NormalNode::Kind::kOperator && node.op == cluster.op) {
    for (uint32_t operand : operands(value)) append(operand);
  } else {
    append(value);
  }
}

uint32_t NormalForm::finish(Cluster& cluster) {
  uint32_t value = kEmptyIndex;
  if (cluster.has_first && !cluster.is_empty) {
    value = cluster.first;
    if (cluster.is_hull && nodes_[value].kind != NormalNode::Kind::kHull) {
      value = static_cast<uint32_t>(nodes_.size());
      NormalNode node;
      node.kind = NormalNode::Kind::kHull;
      node.first = cluster.first;
      nodes_.push_back(std::move(node));
    } else if (!cluster.rest.empty()) {
      value = static_cast<uint32_t>(nodes_.size());
      NormalNode node;
      node.kind = NormalNode::Kind::kOperator;
      node.op = cluster.op;
      node.first = cluster.first;
      node.rest = std::move(cluster.rest);
      nodes_.push_back(std::move(node));
    }
  }
  memo_.emplace(cluster.item.memo(), value);
  alive_.push_back(*cluster.item.node);
  return value;
}

Result<uint32_t> NormalForm::add(const NodePtr& root) {
  std::vector<Cluster> clusters;
  Item item;
  item.node = &root;
  while (true) {
    if (Status status = unwrap(item); !status) return status.error();
    const Node& node = **item.node;
    std::optional<uint32_t> value;
    if (node.kind() == NodeKind::kEmpty) {
      value = kEmptyIndex;
    } else if (node.kind() == NodeKind::kLeaf) {
      if (!node.mesh()) return Error{ErrorCode::kInternal, "a leaf of the tree has no mesh", {}};
      value = leaf(item);
    } else if (node.kind() == NodeKind::kOuterHull && is_mesh(node.children()[0].get())) {
      auto hulled = hulled_leaf(item);
      if (!hulled) return hulled.error();
      value = *hulled;
    } else if (const auto found = memo_.find(item.memo()); found != memo_.end()) {
      value = found->second;
    } else if (!clusters.empty() && absorbs(clusters.back(), item)) {
      // A shared operand that was opened before adds nothing to a union or an intersection, and
      // opening it each time would take exponential time in trees such as s = s + s.
      Cluster& cluster = clusters.back();
      if (cluster.op == BooleanOp::kSymmetricDifference || !item.is_shared ||
          cluster.absorbed.insert(item.memo()).second) {
        cluster.open(item);
      }
    } else {
      clusters.emplace_back(item);
    }
    // Hand values up until there is an operand to look at.
    while (true) {
      if (clusters.empty()) return *value;
      Cluster& cluster = clusters.back();
      if (value) collect(cluster, *value);
      value.reset();
      if (!cluster.pending.empty() && !cluster.is_empty) {
        item = cluster.pending.back();
        cluster.pending.pop_back();
        break;
      }
      value = finish(cluster);
      clusters.pop_back();
    }
  }
}

std::vector<uint32_t> NormalForm::operands(uint32_t index) const {
  // The chain of prefixes runs backwards.
  std::vector<uint32_t> chain{index};
  const BooleanOp op = nodes_[index].op;
  uint32_t first = nodes_[index].first;
  while (nodes_[first].kind == NormalNode::Kind::kOperator && nodes_[first].op == op) {
    chain.push_back(first);
    first = nodes_[first].first;
  }
  std::vector<uint32_t> result{first};
  for (size_t i = chain.size(); i-- > 0;) {
    const auto& rest = nodes_[chain[i]].rest;
    result.insert(result.end(), rest.begin(), rest.end());
  }
  return result;
}

std::vector<uint32_t> NormalForm::reachable(std::span<const uint32_t> roots,
                                            uint32_t closed) const {
  std::vector<uint32_t> order;
  // The form may be far larger than what is reached.
  visits_.resize(nodes_.size(), 0);
  const uint64_t opened = 2 * ++calls_, listed = opened + 1;
  const auto is_new = [&](uint32_t index) { return visits_[index] < opened; };
  std::vector<uint32_t> stack(roots.rbegin(), roots.rend());
  while (!stack.empty()) {
    const uint32_t index = stack.back();
    const NormalNode& node = nodes_[index];
    if (is_new(index) && index != closed &&
        (node.kind == NormalNode::Kind::kOperator || node.kind == NormalNode::Kind::kHull)) {
      visits_[index] = opened;
      for (size_t i = node.rest.size(); i-- > 0;) {
        if (is_new(node.rest[i])) stack.push_back(node.rest[i]);
      }
      if (is_new(node.first)) stack.push_back(node.first);
      continue;
    }
    stack.pop_back();
    if (visits_[index] == listed) continue;
    visits_[index] = listed;
    order.push_back(index);
  }
  return order;
}

}  // namespace csgrun
