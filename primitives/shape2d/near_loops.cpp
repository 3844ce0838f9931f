#include "primitives/shape2d/near_loops.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <span>
#include <tuple>
#include <utility>

#include "primitives/shape2d/sweep2d.h"

namespace csgrun {
namespace {

using Loops = std::vector<Shape2D::Loop>;

/// With fewer loops it is not worth the while.
constexpr size_t kFewLoops = 8;

/// An arrangement moves what it cuts by fewer steps: by less than one in each round, after two
/// where it was cut at a near end.
constexpr int64_t kMostMoved = 2 * kRoundsBeforeSnapping;

/// A closed box, in mm.
struct Box2D {
  glm::dvec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};

  void include(const Shape2D::Loop& loop) {
    for (const glm::dvec2& p : loop) low = min(low, p), high = max(high, p);
  }
  [[nodiscard]] bool meets(const Box2D& b) const {
    return low.x <= b.high.x && low.y <= b.high.y && b.low.x <= high.x && b.low.y <= high.y;
  }

 private:
  static glm::dvec2 min(const glm::dvec2& a, const glm::dvec2& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y)};
  }
  static glm::dvec2 max(const glm::dvec2& a, const glm::dvec2& b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y)};
  }
};

/// Whether two points are both so far on one side of a line that it would not reach them.
bool are_beyond(const Segment2D& line, const Point2D& p, const Point2D& q) {
  const Point2D way = line.b - line.a;
  const int128 to_p = cross(way, p - line.a), to_q = cross(way, q - line.a);
  const int128 reach =
      kMostMoved * (static_cast<int128>(std::abs(way.x)) + static_cast<int128>(std::abs(way.y)));
  return (to_p > reach && to_q > reach) || (to_p < -reach && to_q < -reach);
}

/// Whether a segment that was cut, and so moved a little, may have come to meet a loop.
bool may_reach(const Segment2D& cut, const GridLoop& loop) {
  const auto [low, high] = std::minmax(cut.a.y, cut.b.y);
  for (size_t i = 0; i < loop.size(); ++i) {
    const Point2D &p = loop[i], &q = loop[i + 1 < loop.size() ? i + 1 : 0];
    if (std::max(p.x, q.x) < cut.a.x - kMostMoved || std::min(p.x, q.x) > cut.b.x + kMostMoved ||
        std::max(p.y, q.y) < low - kMostMoved || std::min(p.y, q.y) > high + kMostMoved) {
      continue;
    }
    if (!are_beyond(cut, p, q) && !are_beyond({p, q}, cut.a, cut.b)) return true;
  }
  return false;
}

/// Whether an arrangement has a segment as it was.
bool is_in(const std::vector<Segment2D>& arrangement, const Segment2D& s) {
  const auto before = [](const Segment2D& x, const Segment2D& y) {
    return std::tie(x.a, x.b) < std::tie(y.a, y.b);
  };
  return std::binary_search(arrangement.begin(), arrangement.end(), s, before);
}

size_t base_of(const GridBoolean& boolean) {
  if (boolean.op == BooleanOp::kDifference) return 0;
  const auto most = std::max_element(
      boolean.shapes.begin(), boolean.shapes.end(),
      [](const Shape2D& a, const Shape2D& b) { return a.loops().size() < b.loops().size(); });
  return static_cast<size_t>(most - boolean.shapes.begin());
}

/// A loop each, whether it is far from the box. A group of loops that touch one another is near or
/// far as a whole: it may be put together in another way when one of them is cut.
std::vector<uint8_t> find_far(const Loops& loops, std::span<const uint32_t> group_of,
                              const Box2D& box) {
  std::vector<uint8_t> is_near(loops.size(), 0);  // of groups
  for (size_t l = 0; l < loops.size(); ++l) {
    Box2D own;
    own.include(loops[l]);
    is_near[group_of[l]] |= box.meets(own) ? 1 : 0;
  }
  std::vector<uint8_t> is_far(loops.size());
  for (size_t l = 0; l < loops.size(); ++l) is_far[l] = is_near[group_of[l]] == 0 ? 1 : 0;
  return is_far;
}

/// Whether an edge of the base that the arrangement has cut may have come to meet a far loop.
bool may_meet_far(const Grid2D& grid, const std::vector<Segment2D>& segments,
                  const std::vector<Segment2D>& arrangement, const Loops& far) {
  return std::any_of(segments.begin(), segments.end(), [&](const Segment2D& s) {
    if (s.first == 0 || is_in(arrangement, s)) return false;
    return std::any_of(far.begin(), far.end(), [&](const Shape2D::Loop& loop) {
      return may_reach(s, snap_loop(grid, loop));
    });
  });
}

/// Has regions speak of the far loops of a shape, too, after their own. The outer loop of a far
/// hole is a far one, or the only other one there is, or it has to be found.
void add_far(const Grid2D& grid, const Shape2D& shape, std::span<const uint32_t> group_of,
             const std::vector<uint32_t>& far, GridRegions& regions) {
  const std::vector<uint32_t> before = Shape2DFactory::outer_of(shape);
  const auto first_far = static_cast<uint32_t>(regions.loops.size());
  std::vector<uint32_t> number(before.size(), kNoSegment);  // of the far ones
  for (uint32_t i = 0; i < far.size(); ++i) number[far[i]] = first_far + i;
  uint32_t outer = 0, outers = 0;
  for (uint32_t l = 0; l < first_far; ++l) {
    if (regions.outer_of[l] == l) outer = l, ++outers;
  }
  bool is_found = true;
  for (const uint32_t l : far) {
    const uint32_t far_outer = number[before[l]];
    regions.group_of.push_back(number[group_of[l]]);
    regions.outer_of.push_back(far_outer != kNoSegment ? far_outer : outer);
    is_found = is_found && (far_outer != kNoSegment || outers == 1);
  }
  if (is_found) return;
  std::vector<GridLoop> all = regions.loops;
  for (const uint32_t l : far) all.push_back(snap_loop(grid, shape.loops()[l]));
  regions.outer_of = find_outer_loops(all);
}

}  // namespace

// No far loop, away from the box of the other shapes, holds a near one: it would hold its whole
// group, and its box would meet that box, too. So near loops alone give the winding numbers in that
// box and beside themselves, and what is beside far loops is as it was. But an edge that is cut
// moves, all along, by the rounding of the point where it is cut.
std::optional<Shape2D> boolean_of_near_loops(const GridBoolean& boolean) {
  const size_t base = base_of(boolean);
  const Shape2D& shape = boolean.shapes[base];
  const Grid2D& grid = boolean.grid;
  const Loops& loops = shape.loops();
  const std::span<const uint32_t> group_of = Shape2DFactory::group_of(shape, grid);
  if (loops.size() < kFewLoops || group_of.empty()) return std::nullopt;
  Box2D box;
  std::vector<Segment2D> segments;
  uint32_t operand = kFirstOperand;  // which the base is
  for (size_t s = 0; s < boolean.shapes.size(); ++s) {
    if (s == base) continue;
    ++operand;
    for (const Shape2D::Loop& loop : boolean.shapes[s].loops()) {
      box.include(loop);
      add_outline(snap_loop(grid, loop), operand, segments);
    }
  }
  const glm::dvec2 moved(kMostMoved / grid.steps_per_mm());
  box.low -= moved, box.high += moved;
  const std::vector<uint8_t> is_far = find_far(loops, group_of, box);
  std::vector<uint32_t> far;
  Loops far_loops;
  for (uint32_t l = 0; l < loops.size(); ++l) {
    if (is_far[l] == 0) {
      add_outline(snap_loop(grid, loops[l]), kFirstOperand, segments);
      continue;
    }
    far.push_back(l);
    far_loops.push_back(loops[l]);
  }
  if (far.empty()) return std::nullopt;
  const auto arrangement = arrange_without_snapping(segments);
  if (!arrangement || may_meet_far(grid, segments, *arrangement, far_loops)) return std::nullopt;
  GridRegions regions = extract_regions(*arrangement, boolean.inside);
  if (boolean.op == BooleanOp::kIntersection) return Shape2DFactory::from_grid(grid, regions);
  add_far(grid, shape, group_of, far, regions);
  return Shape2DFactory::from_grid(grid, regions, std::move(far_loops));
}

}  // namespace csgrun
