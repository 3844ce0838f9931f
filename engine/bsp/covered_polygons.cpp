#include "engine/bsp/covered_polygons.h"

#include <algorithm>
#include <span>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/bsp/contact_table.h"
#include "engine/bsp/live_faces.h"

namespace csgrun {
namespace {

/// Per operand, a box beside which its surface bounds nothing, whatever it is. `bounds`: of nodes.
std::vector<PolygonBox> find_live_boxes(size_t operands, const Expression& expression,
                                        std::span<const PolygonBox> bounds) {
  const auto child = [&](const Expression::Node& node, uint32_t c) {
    return expression.children[node.first_child + c];
  };
  // From the root down; a node may have several parents.
  std::vector<PolygonBox> live(expression.nodes.size(), PolygonBox::none());
  std::vector<PolygonBox> of_operand(operands, PolygonBox::none());
  live.back() = PolygonBox::everywhere();
  for (size_t n = expression.nodes.size(); n-- > 0;) {
    const Expression::Node& node = expression.nodes[n];
    if (node.is_operand) {
      of_operand[node.operand].include(live[n]);
    }
    for (uint32_t c = 0; c < node.child_count; ++c) {
      PolygonBox box = live[n];
      if (node.op == BooleanOp::kIntersection) {
        box.clip(bounds[n]);
      } else if (node.op == BooleanOp::kDifference) {
        box.clip(bounds[child(node, 0)]);
      }
      live[child(node, c)].include(box);
    }
  }
  return of_operand;
}

/// Boxes around rounded corners are up to so many steps larger than the polygon, along any axis.
constexpr int32_t kWidened = 4;

/// Whether a polygon in one box is beside another one, but for its rim at most: they have nothing
/// in common, or part of a plane that the polygon goes across, or up to. `widened`: how much wider
/// the box may be than the polygon, which may be in that plane otherwise.
bool is_beside(const PolygonBox& box, const PolygonBox& other, int32_t widened) {
  if (other.holds(box)) return false;  // most are
  bool beside = false;
  for (size_t k = 0; k < 3; ++k) {
    const int32_t lo = std::max(box.lo[k], other.lo[k]), hi = std::min(box.hi[k], other.hi[k]);
    beside |= lo > hi || (lo == hi && int64_t{box.hi[k]} - box.lo[k] > widened);
  }
  return beside;
}

}  // namespace

PlainlyCovered find_plainly_covered(const Job& job, const Expression& expression) {
  PlainlyCovered found;
  const LiveFaces* const chosen = job.live_faces();
  found.is_open = chosen ? chosen->is_partial : std::vector<uint8_t>(job.operand_count(), 0);
  if (expression.nodes.empty()) return found;
  if (chosen) {
    found.dead = chosen->dead;
  } else {
    std::vector<PolygonBox> boxes;
    for (size_t o = 0; o < job.operand_count(); ++o) boxes.push_back(job.operand_box(o));
    found.dead = std::make_shared<DeadSpace>(job.operands(), expression, std::move(boxes));
  }
  const DeadSpace& dead = *found.dead;
  const std::vector<PolygonBox> live =
      find_live_boxes(job.operand_count(), expression, dead.node_boxes());
  const bool may_hide = job.operand_count() > 2;
  std::vector<uint8_t> is_covered(job.polygons().size(), 0), any(job.operand_count(), 0);
  std::vector<uint8_t> is_hidden(may_hide ? job.polygons().size() : 0, 0), any_hidden(any);
  for_each_alone(job.operand_count(), job.polygons().size() > kFewForThreads, [&](size_t operand) {
    const auto o = static_cast<uint32_t>(operand);
    const bool is_looked_at = chosen && chosen->is_looked_at[o] != 0;
    const bool may_be_held = may_hide && !is_looked_at && dead.may_hold_part(job.operand_box(o));
    if (!may_be_held && live[o].holds(job.operand_box(o))) return;
    const bool may_be_open = dead.may_be_open(o, job.polygon_start(o + 1) - job.polygon_start(o));
    const bool is_live = !live[o].is_empty();
    const int32_t widened = job.has_grid_vertices(o) ? 0 : kWidened;
    bool some = false, some_hidden = false;
    for (uint32_t p = job.polygon_start(o); p < job.polygon_start(o + 1); ++p) {
      const auto corners = job.corners(job.polygons()[p]);
      const auto at = [&](uint32_t i) -> const auto& { return job.rounded(corners[i]); };
      const bool is_held = may_be_held && dead.holds(job.boxes()[p], job.polygons()[p].count, at);
      is_covered[p] = is_held || !is_live || is_beside(job.boxes()[p], live[o], widened);
      if (is_held && may_be_open) is_hidden[p] = some_hidden = true;
      some |= is_covered[p] != 0;
    }
    any[o] = some;
    any_hidden[o] = some_hidden;
  });
  const auto has_some = [](const std::vector<uint8_t>& list) {
    return std::find(list.begin(), list.end(), 1) != list.end();
  };
  if (has_some(any)) found.polygons = std::move(is_covered);
  if (has_some(any_hidden)) found.hidden = std::move(is_hidden);
  for (size_t o = 0; o < any_hidden.size(); ++o) found.is_open[o] |= any_hidden[o];
  if (dead.inner_boxes().empty()) return found;
  found.meets_within.resize(job.operand_count());
  for (uint32_t o = 0; o < job.operand_count(); ++o) {
    const size_t faces = job.polygon_start(o + 1) - job.polygon_start(o);
    found.meets_within[o] =
        dead.inner_boxes().may_hold_part(o, job.operand_box(o)) && dead.may_be_open(o, faces);
    found.is_open[o] |= found.meets_within[o];
  }
  return found;
}

std::vector<uint8_t> find_covered(const Job& job, const PlainlyCovered& plainly,
                                  const ContactTable& contacts) {
  std::vector<uint8_t> is_covered(job.polygons().size(), 0);
  for_each_range(is_covered.size(), [&](size_t begin, size_t end) {
    std::vector<uint32_t> touched_by, crossed_by;
    for (auto p = static_cast<uint32_t>(begin); p < end; ++p) {
      if (contacts.of(p).empty()) continue;
      touched_by.clear();
      crossed_by.clear();
      for (const uint32_t i : contacts.of(p)) {
        const Contact& c = contacts[i];
        const uint32_t o = job.polygons()[c.p == p ? c.q : c.p].operand;
        if (!plainly.dead->is_remover(o) || !job.is_convex(o) || plainly.is_open[o]) continue;
        // What meets a convex body and is not within it goes to the front of a face that it meets.
        const bool leaves = c.is_coplanar || (c.p == p ? c.p_front : c.q_front);
        (leaves ? crossed_by : touched_by).push_back(o);
      }
      if (touched_by.empty()) continue;
      std::sort(crossed_by.begin(), crossed_by.end());
      is_covered[p] = std::any_of(touched_by.begin(), touched_by.end(), [&](uint32_t o) {
        return !std::binary_search(crossed_by.begin(), crossed_by.end(), o);
      });
    }
  });
  return is_covered;
}

}  // namespace csgrun
