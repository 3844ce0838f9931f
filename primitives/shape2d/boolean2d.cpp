// Booleans of 2D shapes: each on one grid, in the axes that its operands share.
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <glm/geometric.hpp>

#include <csgrun/primitives/shape2d.h>

#include "primitives/shape2d/near_loops.h"
#include "primitives/shape2d/shape_factory.h"

namespace csgrun {
namespace {

using Loops = std::vector<Shape2D::Loop>;

/// Operands that one grid serves.
struct FrameGroup {
  Frame2D frame;          ///< that of the first
  bool in_world = false;  ///< the frame is the world's, or the world serves better
  std::vector<Shape2D> shapes;
};

/// In the order of the first of each group.
std::vector<FrameGroup> group_by_frame(const std::vector<Shape2D>& shapes) {
  std::vector<FrameGroup> groups;
  for (const Shape2D& shape : shapes) {
    const auto* turn = Shape2DFactory::turn_of(shape);
    const auto fits = [turn](const FrameGroup& group) {
      return turn == nullptr ? group.in_world
                             : !group.in_world && quarter_turn(group.frame, turn->split.frame);
    };
    auto group = std::find_if(groups.begin(), groups.end(), fits);
    if (group == groups.end()) {
      groups.push_back({turn == nullptr ? Frame2D() : turn->split.frame, turn == nullptr, {}});
      group = groups.end() - 1;
    }
    group->shapes.push_back(shape);
  }
  for (FrameGroup& group : groups) {
    if (!group.in_world) group.in_world = Shape2DFactory::are_upright(group.shapes);
  }
  return groups;
}

/// Loops in the axes of `frame`, seen from `origin`. REQUIRES: the frame is that of the shape.
Loops loops_in_frame(const Shape2DFactory::Turn& turn, const Frame2D& frame,
                     const glm::dvec2& origin) {
  const QuarterTurn quarter = *quarter_turn(frame, turn.split.frame);
  const glm::dvec2 moved = glm::dvec2(turn.map.m[0][3], turn.map.m[1][3]) - origin;
  const glm::dvec2 offset(glm::dot(frame.rows[0], moved), glm::dot(frame.rows[1], moved));
  const glm::dvec2 scale(turn.split.scale[0], turn.split.scale[1]);
  Loops loops = Shape2DFactory::base_of(turn).loops();
  for (Shape2D::Loop& loop : loops) {
    for (glm::dvec2& p : loop) p = quarter.apply(scale * p) + offset;
    if (quarter.mirrors()) std::reverse(loop.begin(), loop.end());
  }
  return loops;
}

Result<Grid2D> grid_of(const std::vector<const Loops*>& operands) {
  double extent = 0;
  for (const Loops* loops : operands) extent = std::max(extent, extent_of(*loops));
  return grid_for(extent);
}

/// Where a point is inside. Each operand winds around a point once or not at all, so sums tell how
/// many of them hold it. (Snapping may turn a sliver over, hence "greater than" and never "not 0".)
std::function<bool(int32_t, int32_t)> inside_of(BooleanOp op, size_t operands) {
  const auto all = static_cast<int32_t>(operands);
  switch (op) {
    case BooleanOp::kUnion:
      break;
    case BooleanOp::kIntersection:
      return [all](int32_t first, int32_t rest) { return first + rest >= all; };
    case BooleanOp::kDifference:
      return [](int32_t first, int32_t rest) { return first > 0 && rest <= 0; };
    case BooleanOp::kSymmetricDifference:
      return [](int32_t first, int32_t rest) { return (first + rest) % 2 != 0; };
  }
  return [](int32_t first, int32_t rest) { return first + rest > 0; };
}

/// The operation on the grid. Each operand is clean, and winds counter-clockwise.
Result<Shape2D> on_grid(BooleanOp op, const Grid2D& grid,
                        const std::vector<const Loops*>& operands) {
  std::vector<Segment2D> segments;
  for (uint32_t i = 0; i < operands.size(); ++i) {
    for (const Shape2D::Loop& loop : *operands[i]) add_outline(snap_loop(grid, loop), i, segments);
  }
  return Shape2DFactory::arranged(grid, std::move(segments), inside_of(op, operands.size()));
}

Result<Shape2D> in_world(BooleanOp op, const std::vector<Shape2D>& shapes) {
  std::vector<const Loops*> operands;
  for (const Shape2D& shape : shapes) operands.push_back(&shape.loops());
  const Result<Grid2D> grid = grid_of(operands);
  if (!grid) return grid.error();
  const auto inside = inside_of(op, shapes.size());
  auto near = boolean_of_near_loops({*grid, shapes, op, inside});
  return near ? *std::move(near) : on_grid(op, *grid, operands);
}

/// The result with the corners of its operands where they were before they were rounded, but for
/// the noise that the grid forgives. So they are rounded once, wherever the result goes: to the
/// grid of another origin, or to that of the world, where a turned edge may well be upright.
Shape2D with_corners(const Shape2D& result, const Grid2D& grid,
                     const std::vector<const Loops*>& operands) {
  std::vector<std::pair<Point2D, glm::dvec2>> corners;
  for (const Loops* loops : operands) {
    for (const Shape2D::Loop& loop : *loops) {
      for (const glm::dvec2& p : loop) corners.emplace_back(grid.snap(p), p);
    }
  }
  const auto by_place = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::stable_sort(corners.begin(), corners.end(), by_place);  // the first operand's corner counts
  const double noise = 0x1p-12 * grid.unsnap({1, 1}).x;
  Loops loops = result.loops();
  for (Shape2D::Loop& loop : loops) {
    for (glm::dvec2& p : loop) {
      const std::pair<Point2D, glm::dvec2> place(grid.snap(p), p);
      const auto corner = std::lower_bound(corners.begin(), corners.end(), place, by_place);
      if (corner == corners.end() || corner->first != place.first) continue;  // a crossing
      for (int i = 0; i < 2; ++i) {
        if (std::fabs(corner->second[i] - p[i]) > noise) p[i] = corner->second[i];
      }
    }
  }
  return Shape2DFactory::with_noise(
      Shape2DFactory::canonical(std::move(loops), Shape2DFactory::outer_of(result)),
      Shape2DFactory::noise_of(result));
}

/// That of the shapes: what they are made to has it as well.
double noise_of(const std::vector<Shape2D>& shapes) {
  double noise = 0;
  for (const Shape2D& shape : shapes) noise = std::max(noise, Shape2DFactory::noise_of(shape));
  return noise;
}

/// The operation on shapes that share a frame; the result has it too.
Result<Shape2D> in_frame(BooleanOp op, const FrameGroup& group) {
  if (group.in_world) return in_world(op, group.shapes);
  const Affine& first = Shape2DFactory::turn_of(group.shapes[0])->map;
  const glm::dvec2 origin(first.m[0][3], first.m[1][3]);
  std::vector<Loops> local;
  for (const Shape2D& shape : group.shapes) {
    local.push_back(loops_in_frame(*Shape2DFactory::turn_of(shape), group.frame, origin));
  }
  std::vector<const Loops*> operands;
  for (const Loops& loops : local) operands.push_back(&loops);
  const Result<Grid2D> grid = grid_of(operands);
  if (!grid) return grid.error();
  Result<Shape2D> base = on_grid(op, *grid, operands);
  if (!base || base->empty()) return base;
  base = Shape2DFactory::with_noise(*std::move(base), noise_of(group.shapes));
  return Shape2DFactory::turned(with_corners(*base, *grid, operands), group.frame.map(origin),
                                {group.frame, {1, 1}});
}

/// What is left to be done in the world, after each frame's own part: one shape, or more.
Result<std::vector<Shape2D>> reduced(BooleanOp op, const std::vector<Shape2D>& shapes) {
  const std::vector<FrameGroup> groups = group_by_frame(shapes);
  std::vector<Shape2D> rest;
  for (size_t i = 0; i < groups.size(); ++i) {
    const FrameGroup& group = groups[i];
    // What has no turn is on the grid of the world in any case. Subtrahends are united; those of
    // the first operand's frame are taken from it there.
    if (group.shapes.size() == 1 || (group.in_world && groups.size() > 1)) {
      rest.insert(rest.end(), group.shapes.begin(), group.shapes.end());
      continue;
    }
    const bool unite = op == BooleanOp::kDifference && i > 0;
    Result<Shape2D> part = in_frame(unite ? BooleanOp::kUnion : op, group);
    if (!part) return part.error();
    rest.push_back(*std::move(part));
  }
  return rest;
}

/// The operands that matter; none when the result is empty whatever the others are.
std::vector<Shape2D> without_empty(BooleanOp op, const std::vector<Shape2D>& operands) {
  std::vector<Shape2D> some;
  for (size_t i = 0; i < operands.size(); ++i) {
    const bool needed = op == BooleanOp::kIntersection || (op == BooleanOp::kDifference && i == 0);
    if (!operands[i].empty()) {
      some.push_back(operands[i]);
    } else if (needed) {
      return {};
    }
  }
  return some;
}

}  // namespace

Result<Shape2D> Shape2D::boolean(BooleanOp op, const std::vector<Shape2D>& operands) {
  const std::vector<Shape2D> shapes = without_empty(op, operands);
  if (shapes.empty()) return Shape2D();
  if (shapes.size() == 1) return shapes[0];
  double extent = 0;
  for (const Shape2D& shape : shapes) extent = std::max(extent, extent_of(shape.loops()));
  if (const Result<Grid2D> grid = grid_for(extent); !grid) return grid.error();
  const Result<std::vector<Shape2D>> rest = reduced(op, shapes);
  if (!rest) return rest.error();
  const std::vector<Shape2D> parts = without_empty(op, *rest);
  if (parts.empty()) return Shape2D();
  if (parts.size() == 1) return parts[0];
  Result<Shape2D> result = in_world(op, parts);
  if (result) result = Shape2DFactory::with_noise(*std::move(result), noise_of(parts));
  return result;
}

}  // namespace csgrun
