#include "engine/csg/scene_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace csgrun {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr MmBox kEmptyBox{{kEndless, kEndless, kEndless}, {-kEndless, -kEndless, -kEndless}};

bool is_empty(const MmBox& box) {
  return box.lo[0] > box.hi[0] || box.lo[1] > box.hi[1] || box.lo[2] > box.hi[2];
}

MmBox hull(const MmBox& a, const MmBox& b) {
  if (is_empty(a)) return b;
  if (is_empty(b)) return a;
  MmBox r;
  for (int i = 0; i < 3; ++i) {
    r.lo[i] = std::min(a.lo[i], b.lo[i]);
    r.hi[i] = std::max(a.hi[i], b.hi[i]);
  }
  return r;
}

MmBox meet(const MmBox& a, const MmBox& b) {
  MmBox r;
  for (int i = 0; i < 3; ++i) {
    r.lo[i] = std::max(a.lo[i], b.lo[i]);
    r.hi[i] = std::min(a.hi[i], b.hi[i]);
  }
  return is_empty(r) ? kEmptyBox : r;
}

double longest_side(const MmBox& box) {
  double result = 0;
  for (int i = 0; i < 3; ++i) result = std::max(result, box.hi[i] - box.lo[i]);
  return result;
}

double largest(const MmBox& box) {
  double result = 0;
  if (is_empty(box)) return result;
  for (int i = 0; i < 3; ++i) {
    result = std::max({result, std::fabs(box.lo[i]), std::fabs(box.hi[i])});
  }
  return result;
}

/// The image of a world box in local axes, widened for the rounding of doubles.
MmBox to_local(const MmBox& world, const std::array<Row, 3>& rows) {
  MmBox r;
  for (int i = 0; i < 3; ++i) {
    double middle = 0, radius = 0;
    for (int j = 0; j < 3; ++j) {
      middle += rows[i][j] * (world.lo[j] / 2 + world.hi[j] / 2);
      radius += std::fabs(rows[i][j]) * (world.hi[j] / 2 - world.lo[j] / 2);
    }
    radius += 1e-12 * (radius + std::fabs(middle));
    r.lo[i] = middle - radius;
    r.hi[i] = middle + radius;
  }
  return r;
}

/// Whether a leaf lies beside all of what sees it, in its local axes: boxes in the world may meet
/// where it does not reach.
bool is_beside(const MmBox& own, const MmBox& seen) {
  constexpr double kClear = 1e-6;  // of the size: more than the doubles of the way here are off
  for (int i = 0; i < 3; ++i) {
    const double clear = kClear * (seen.hi[i] - seen.lo[i]);
    if (own.lo[i] > seen.hi[i] + clear || own.hi[i] < seen.lo[i] - clear) return true;
  }
  return false;
}

/// What of a leaf is needed that is seen from within `seen` alone, in its local axes. An end that
/// is far beyond is drawn near: nothing sees where it is. It is moved by a multiple of a power of
/// two, so that copies of a leaf mostly keep one shape. Ends that a grid holds anyway stay as they
/// are: far is what is so beside the largest result, which is as long as `least`. (What is seen may
/// be but a point, where a leaf touches.)
MmBox needed_of(const StepLeaf& leaf, const MmBox& seen, double least) {
  // Leaves in the world's axes may reach 2^13 times as far as what is seen.
  constexpr double kLongFramed = 8, kLongInWorld = 0x1p12;
  const double longest = leaf.framed ? kLongFramed : kLongInWorld;
  MmBox needed = leaf.own;
  for (int i = 0; i < 3; ++i) {
    const double lo = leaf.own.lo[i], hi = leaf.own.hi[i];
    const double size = std::max(least, seen.hi[i] - seen.lo[i]);
    if (!leaf.prismatic[i] || !(least > 0) || !(hi - lo > longest * size)) continue;
    int exponent = 0;
    std::frexp(size, &exponent);
    const double step = std::ldexp(1, exponent);
    const auto drawn = [&](double beyond) {  // but for a margin of the size of what is seen
      return beyond > size ? step * std::floor((beyond - size) / step) : 0;
    };
    needed.lo[i] = lo + drawn(seen.lo[i] - lo);
    needed.hi[i] = hi - drawn(hi - seen.hi[i]);
  }
  return needed;
}

}  // namespace

SceneReach scene_reach(const NormalForm& form, std::span<const uint32_t> order,
                       std::span<const uint32_t> roots, std::span<StepLeaf> leaves, ReachRoom& room,
                       const KnownReach* known) {
  const auto& nodes = form.nodes();
  std::vector<MmBox>&box = room.box, &reach = room.reach;
  std::vector<uint8_t>& whole = room.whole;
  box.resize(nodes.size());
  reach.resize(nodes.size());
  whole.resize(nodes.size());
  for (const uint32_t index : order) {
    box[index] = reach[index] = kEmptyBox;
    whole[index] = 0;
  }
  for (uint32_t index : order) {
    const NormalNode& node = nodes[index];
    if (known && index == known->index) {
      box[index] = known->box;
      continue;
    }
    if (node.kind == NormalNode::Kind::kLeaf) box[index] = leaves[index].world;
    if (node.kind == NormalNode::Kind::kHull) box[index] = box[node.first];
    if (node.kind != NormalNode::Kind::kOperator) continue;
    MmBox value = box[node.first];
    if (node.op != BooleanOp::kDifference) {
      for (uint32_t operand : node.rest) {
        value = node.op == BooleanOp::kIntersection ? meet(value, box[operand])
                                                    : hull(value, box[operand]);
      }
    }
    box[index] = value;
  }
  SceneReach result;
  double longest = 0;
  for (uint32_t root : roots) {
    reach[root] = box[root];
    if (!is_empty(box[root])) longest = std::max(longest, longest_side(box[root]));
    result.of_roots.push_back(box[root]);
  }
  for (size_t i = order.size(); i-- > 0;) {
    const uint32_t index = order[i];
    const NormalNode& node = nodes[index];
    if (known && index == known->index) {
      result.sees_known = whole[index] == 0 && reach[index] == known->box;
      result.reach = std::max(result.reach, known->reach);
      result.far = std::max(result.far, known->far);
    } else if (node.kind == NormalNode::Kind::kLeaf) {
      StepLeaf& leaf = leaves[index];
      const bool is_whole = whole[index] || leaf.whole;
      leaf.local = leaf.own;
      const MmBox visible = is_whole ? leaf.world : meet(leaf.world, reach[index]);
      leaf.seen = !is_empty(visible);
      if (!leaf.seen) continue;
      const MmBox seen = to_local(visible, leaf.rows);
      if (!is_whole) {
        leaf.seen = !is_beside(leaf.own, seen);
        if (!leaf.seen) continue;
        leaf.local = needed_of(leaf, seen, longest);
      }
      result.far = std::max(result.far, largest(leaf.local));
      if (leaf.framed) result.reach = std::max(result.reach, largest(leaf.local));
      result.reach = std::max({result.reach, largest(visible), largest(meet(leaf.local, seen))});
    } else if (node.kind == NormalNode::Kind::kHull) {
      whole[node.first] = 1;
    } else if (node.kind == NormalNode::Kind::kOperator) {
      const auto pass = [&](uint32_t operand) {
        whole[operand] |= whole[index];
        reach[operand] = hull(reach[operand], meet(reach[index], box[operand]));
      };
      pass(node.first);
      for (uint32_t operand : node.rest) pass(operand);
    }
  }
  return result;
}

}  // namespace csgrun
