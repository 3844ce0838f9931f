#include "engine/bsp/apart_operands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "engine/base/none.h"
#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/frame_map.h"
#include "engine/bsp/union_find.h"

namespace csgrun {
namespace {

/// What an operand is, wherever it stands.
const void* solid_of(const Operand& operand) {
  if (operand.leaf) return operand.leaf.get();
  return operand.boundary.get();
}

/// Boxes around operands, in the world.
class OperandBoxes {
 public:
  GridBox of(const Operand& operand) {
    const auto [known, is_new] = own_.try_emplace(solid_of(operand));
    if (is_new) {
      known->second =
          operand.leaf ? box_of_points(operand.leaf->vertices) : bounding_box(*operand.boundary);
    }
    if (known->second.empty()) return {};
    const GridBox here = known->second.moved(operand.translation);
    return operand.frame.is_identity ? here : image(here, FrameMap(operand.frame));
  }

 private:
  static GridBox image(const GridBox& from, const FrameMap& map) {
    GridBox box;
    for (unsigned i = 0; i < 8; ++i) {
      IVec3 corner;
      for (size_t k = 0; k < 3; ++k) corner[k] = (i >> k & 1) != 0 ? from.hi[k] : from.lo[k];
      const std::array<double, 3> p = rounded(map.point(corner));
      for (size_t k = 0; k < 3; ++k) {
        const auto lo = static_cast<int64_t>(std::floor(p[k])) - 1;
        const auto hi = static_cast<int64_t>(std::ceil(p[k])) + 1;
        box.lo[k] = i == 0 ? lo : std::min(box.lo[k], lo);
        box.hi[k] = i == 0 ? hi : std::max(box.hi[k], hi);
      }
    }
    return box;
  }

  std::unordered_map<const void*, GridBox> own_;
};

bool meet(const GridBox& a, const GridBox& b) {
  bool all = true;
  for (size_t k = 0; k < 3; ++k) all &= a.lo[k] <= b.hi[k] && b.lo[k] <= a.hi[k];
  return all;
}

/// That along which boxes are shortest, all together, beside the box around them.
size_t axis_of_least_overlap(const std::vector<GridBox>& boxes) {
  std::array<double, 3> overlap{};
  for (size_t k = 0; k < 3; ++k) {
    double sum = 0, lo = HUGE_VAL, hi = -HUGE_VAL;
    for (const GridBox& box : boxes) {
      if (box.empty()) continue;
      const auto from = static_cast<double>(box.lo[k]), to = static_cast<double>(box.hi[k]);
      sum += to - from;
      lo = std::min(lo, from);
      hi = std::max(hi, to);
    }
    overlap[k] = sum / (hi - lo + 1);
  }
  return static_cast<size_t>(std::min_element(overlap.begin(), overlap.end()) - overlap.begin());
}

/// Operands whose boxes hang together.
struct Cluster {
  std::vector<uint32_t> operands;  // ascending
  GridBox box;
};

/// In the order of their first operands; without operands that are empty.
std::vector<Cluster> find_clusters(const std::vector<Operand>& operands) {
  OperandBoxes box_of;
  std::vector<GridBox> boxes;
  boxes.reserve(operands.size());
  for (const Operand& operand : operands) boxes.push_back(box_of.of(operand));
  std::vector<uint32_t> order(operands.size());
  std::iota(order.begin(), order.end(), 0);
  std::erase_if(order, [&](uint32_t o) { return boxes[o].empty(); });
  const size_t axis = axis_of_least_overlap(boxes);
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return boxes[a].lo[axis] < boxes[b].lo[axis]; });
  UnionFind joined(operands.size());
  for (size_t i = 0; i < order.size(); ++i) {
    const GridBox& box = boxes[order[i]];
    for (size_t j = i + 1; j < order.size() && boxes[order[j]].lo[axis] <= box.hi[axis]; ++j) {
      if (meet(box, boxes[order[j]])) joined.join(order[i], order[j]);
    }
  }
  std::vector<Cluster> clusters;
  std::vector<uint32_t> number(operands.size(), kNone);
  for (uint32_t o = 0; o < operands.size(); ++o) {
    if (boxes[o].empty()) continue;
    uint32_t& cluster = number[joined.find(o)];
    if (cluster == kNone) {
      cluster = static_cast<uint32_t>(clusters.size());
      clusters.push_back({{}, boxes[o]});
    }
    Cluster& own = clusters[cluster];
    own.operands.push_back(o);
    for (size_t k = 0; k < 3; ++k) {
      own.box.lo[k] = std::min(own.box.lo[k], boxes[o].lo[k]);
      own.box.hi[k] = std::max(own.box.hi[k], boxes[o].hi[k]);
    }
  }
  return clusters;
}

/// Whether an operand may be put into a result as it stands. (Faces of several appearances may
/// become one by painting, and points are as they are in the world's axes.)
bool is_movable(const Operand& operand) {
  if (!operand.boundary || !operand.frame.is_identity) return false;
  if (operand.appearance && !only_appearance(*operand.boundary)) return false;
  const auto& parts = operand.boundary->parts;
  // Whole steps are none in a frame.
  return operand.translation == IVec3{0, 0, 0} ||
         std::all_of(parts.begin(), parts.end(),
                     [](const UntouchedPart& part) { return part.map.is_identity(); });
}

/// What is left of an expression where all but some of its operands are empty.
class Reducer {
 public:
  explicit Reducer(const Expression& from) : from_(from), made_(from.nodes.size()) {}

  /// Numbers the operands anew that are not empty, and returns the old numbers of those that
  /// matter. Nothing is left if there are none.
  std::vector<uint32_t> run(const std::vector<uint8_t>& is_empty, Expression& to) {
    std::vector<uint32_t> operands;
    to = {};
    for (size_t i = 0; i < from_.nodes.size(); ++i) {
      const Expression::Node& node = from_.nodes[i];
      made_[i] = kNone;
      if (!node.is_operand) {
        made_[i] = add_operator(node, to);
      } else if (is_empty[node.operand] == 0) {
        made_[i] = static_cast<uint32_t>(to.nodes.size());
        to.nodes.emplace_back().operand = static_cast<uint32_t>(operands.size());
        operands.push_back(node.operand);
      }
    }
    if (made_.back() == kNone) return {};
    drop_unused(made_.back(), to, operands);
    return operands;
  }

 private:
  uint32_t add_operator(const Expression::Node& node, Expression& to) {
    children_.clear();
    for (uint32_t c = 0; c < node.child_count; ++c) {
      const uint32_t child = made_[from_.children[node.first_child + c]];
      if (child != kNone) {
        children_.push_back(child);
      } else if (node.op == BooleanOp::kIntersection ||
                 (node.op == BooleanOp::kDifference && c == 0)) {
        return kNone;
      }
    }
    if (children_.size() < 2) return children_.empty() ? kNone : children_[0];
    Expression::Node& made = to.nodes.emplace_back();
    made.is_operand = false;
    made.op = node.op;
    made.first_child = static_cast<uint32_t>(to.children.size());
    made.child_count = static_cast<uint32_t>(children_.size());
    to.children.insert(to.children.end(), children_.begin(), children_.end());
    return static_cast<uint32_t>(to.nodes.size() - 1);
  }

  /// Leaves what is below the root, which comes last then.
  static void drop_unused(uint32_t root, Expression& to, std::vector<uint32_t>& operands) {
    std::vector<uint32_t> number(root + 1, kNone);
    number[root] = 0;
    for (uint32_t i = root + 1; i-- > 0;) {
      const Expression::Node& node = to.nodes[i];
      if (number[i] == kNone || node.is_operand) continue;
      for (uint32_t c = 0; c < node.child_count; ++c) number[to.children[node.first_child + c]] = 0;
    }
    Expression used;
    std::vector<uint32_t> used_operands;
    for (uint32_t i = 0; i <= root; ++i) {
      if (number[i] == kNone) continue;
      number[i] = static_cast<uint32_t>(used.nodes.size());
      Expression::Node node = to.nodes[i];
      if (node.is_operand) {
        used_operands.push_back(operands[node.operand]);
        node.operand = static_cast<uint32_t>(used_operands.size() - 1);
      } else {
        const auto first = static_cast<uint32_t>(used.children.size());
        for (uint32_t c = 0; c < node.child_count; ++c) {
          used.children.push_back(number[to.children[node.first_child + c]]);
        }
        node.first_child = first;
      }
      used.nodes.push_back(node);
    }
    to = std::move(used);
    operands = std::move(used_operands);
  }

  const Expression& from_;
  std::vector<uint32_t> made_;  ///< of each node, or kNone if it is empty
  std::vector<uint32_t> children_;
};

bool is_same(const Expression& a, const Expression& b) {
  return a.children == b.children &&
         std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(),
                    [](const Expression::Node& p, const Expression::Node& q) {
                      return p.is_operand == q.is_operand && p.op == q.op &&
                             p.operand == q.operand && p.first_child == q.first_child &&
                             p.child_count == q.child_count;
                    });
}

IVec3 difference(const IVec3& a, const IVec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// Whether operands are others that are moved, and count their sources from elsewhere.
bool is_same_elsewhere(const std::vector<Operand>& a, const std::vector<Operand>& b) {
  if (a.size() != b.size()) return false;
  const auto is_same = [&](const Operand& p, const Operand& q) {
    return solid_of(p) == solid_of(q) && p.frame.is_identity && q.frame.is_identity &&
           p.appearance == q.appearance &&
           difference(q.translation, p.translation) ==
               difference(b[0].translation, a[0].translation) &&
           q.first_source - p.first_source == b[0].first_source - a[0].first_source;
  };
  return std::equal(a.begin(), a.end(), b.begin(), is_same);
}

/// Whether there is anything that may stand apart, by a short look.
bool may_find_apart(const std::vector<Operand>& operands) {
  std::unordered_set<const void*> met;
  return std::any_of(operands.begin(), operands.end(), [&](const Operand& operand) {
    return operand.boundary || !met.insert(solid_of(operand)).second;
  });
}

/// Whether each operand stands in the expression, once.
bool is_each_once(const Expression& expression, size_t operands) {
  std::vector<uint8_t> count(operands, 0);
  for (const Expression::Node& node : expression.nodes) {
    if (node.is_operand && count[node.operand]++ != 0) return false;
  }
  return std::all_of(count.begin(), count.end(), [](uint8_t n) { return n == 1; });
}

class ApartFinder {
 public:
  ApartFinder(const std::vector<Operand>& operands, const Expression& expression)
      : operands_(operands), reducer_(expression), is_empty_(operands.size(), 1) {}

  std::optional<ApartOperands> run(const std::vector<Cluster>& clusters) {
    for (const Cluster& cluster : clusters) take(cluster);
    for (Several& several : several_) {
      if (several.repeated.places.size() > 1) {
        is_any_apart_ = true;
        result_.repeated.push_back(std::move(several.repeated));
      } else {
        add_to_rest(*several.cluster);
      }
    }
    if (!is_any_apart_) return std::nullopt;
    is_no_rest_.resize(operands_.size(), 1);
    for (const uint32_t o : reducer_.run(is_no_rest_, result_.expression)) {
      result_.others.push_back(operands_[o]);
    }
    return std::move(result_);
  }

 private:
  struct Several {
    ApartOperands::Repeated repeated;
    const Cluster* cluster;  ///< the first of them
  };

  void take(const Cluster& cluster) {
    const bool is_alone = cluster.operands.size() == 1;
    if (is_alone && !is_movable(operands_[cluster.operands[0]])) {
      add_to_rest(cluster);
      return;
    }
    for (const uint32_t o : cluster.operands) is_empty_[o] = 0;
    Expression own;
    std::vector<Operand> left;
    for (const uint32_t o : reducer_.run(is_empty_, own)) left.push_back(operands_[o]);
    for (const uint32_t o : cluster.operands) is_empty_[o] = 1;
    if (left.empty() || is_alone) {  // nothing of it is in the result, or all
      is_any_apart_ = true;
      result_.kept.insert(result_.kept.end(), left.begin(), left.end());
      return;
    }
    std::vector<uint32_t>& alike = alike_[{solid_of(left[0]), left.size()}];
    for (const uint32_t i : alike) {
      ApartOperands::Repeated& known = several_[i].repeated;
      if (!is_same_elsewhere(known.operands, left) || !is_same(known.expression, own)) continue;
      known.places.push_back({difference(left[0].translation, known.operands[0].translation),
                              left[0].first_source - known.operands[0].first_source});
      return;
    }
    alike.push_back(static_cast<uint32_t>(several_.size()));
    several_.push_back(
        {{std::move(left), std::move(own), cluster.box, {{{0, 0, 0}, 0}}}, &cluster});
  }

  void add_to_rest(const Cluster& cluster) {
    is_no_rest_.resize(operands_.size(), 1);
    for (const uint32_t o : cluster.operands) is_no_rest_[o] = 0;
  }

  const std::vector<Operand>& operands_;
  Reducer reducer_;
  std::vector<uint8_t> is_empty_, is_no_rest_;
  std::vector<Several> several_;
  std::map<std::pair<const void*, size_t>, std::vector<uint32_t>> alike_;  ///< of `several_`
  ApartOperands result_;
  bool is_any_apart_ = false;
};

}  // namespace

std::optional<ApartOperands> find_apart(const std::vector<Operand>& operands,
                                        const Expression& expression) {
  if (operands.size() < 2 || !may_find_apart(operands) ||
      !is_each_once(expression, operands.size())) {
    return std::nullopt;
  }
  const std::vector<Cluster> clusters = find_clusters(operands);
  constexpr size_t kMostWork = size_t{1} << 26;  // each cluster goes through the expression
  if (clusters.size() < 2 || clusters.size() > kMostWork / expression.nodes.size()) {
    return std::nullopt;
  }
  return ApartFinder(operands, expression).run(clusters);
}

}  // namespace csgrun
