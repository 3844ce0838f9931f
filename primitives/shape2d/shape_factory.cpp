#include "primitives/shape2d/shape_factory.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <tuple>
#include <utility>

#include "primitives/base/text.h"

namespace csgrun {
namespace {

bool lexicographic_less(const glm::dvec2& p, const glm::dvec2& q) {
  return std::tie(p.x, p.y) < std::tie(q.x, q.y);
}

}  // namespace

bool is_before(const Shape2D::Loop& a, const Shape2D::Loop& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), lexicographic_less);
}

double extent_of(const std::vector<Shape2D::Loop>& loops) {
  double extent = 0;
  for (const Shape2D::Loop& loop : loops) {
    for (const glm::dvec2& p : loop) {
      extent = std::max({extent, std::fabs(p.x), std::fabs(p.y)});
    }
  }
  return extent;
}

bool all_finite(const std::vector<Shape2D::Loop>& loops) {
  for (const Shape2D::Loop& loop : loops) {
    for (const glm::dvec2& p : loop) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) return false;
    }
  }
  return true;
}

Result<Grid2D> grid_for(double extent) {
  if (const auto grid = Grid2D::for_extent(extent)) return *grid;
  return Error{ErrorCode::kOutOfRange,
               "2D shape: coordinates up to " + number_text(extent) + " mm, the limit is 1e+12",
               {}};
}

GridLoop snap_loop(const Grid2D& grid, const Shape2D::Loop& loop) {
  GridLoop snapped(loop.size());
  std::transform(loop.begin(), loop.end(), snapped.begin(),
                 [&](const glm::dvec2& p) { return grid.snap(p); });
  return snapped;
}

const Shape2D::Turn* Shape2DFactory::turn_of(const Shape2D& shape) {
  return shape.data_ ? shape.data_->turn.get() : nullptr;
}

Shape2D Shape2DFactory::base_of(const Turn& turn) {
  Shape2D base;
  base.data_ = turn.base;
  return base;
}

std::span<const uint32_t> Shape2DFactory::group_of(const Shape2D& shape, const Grid2D& grid) {
  const bool is_known =
      shape.data_ && !shape.data_->turn && shape.data_->arranged_steps == grid.steps_per_mm();
  return is_known ? std::span<const uint32_t>(shape.data_->group_of) : std::span<const uint32_t>();
}

Shape2D Shape2DFactory::with_noise(Shape2D shape, double noise) {
  if (!shape.data_ || shape.data_->noise >= noise) return shape;
  auto data = std::make_shared<Shape2D::Data>(*shape.data_);
  data->noise = noise;
  shape.data_ = std::move(data);
  return shape;
}

std::vector<uint32_t> Shape2DFactory::outer_of(const Shape2D& shape) {
  std::vector<uint32_t> outer_of(shape.loops().size());
  for (const Shape2D::Region& region : shape.regions()) {
    outer_of[region.outer] = region.outer;
    for (const uint32_t hole : region.holes) outer_of[hole] = region.outer;
  }
  return outer_of;
}

Shape2D Shape2DFactory::from_grid(const Grid2D& grid, const GridRegions& regions,
                                  std::vector<Loop> more) {
  Shape2D shape;
  if (regions.outer_of.empty()) return shape;
  std::vector<Loop> loops;
  loops.reserve(regions.outer_of.size());
  for (const GridLoop& grid_loop : regions.loops) {
    Loop& loop = loops.emplace_back();
    loop.reserve(grid_loop.size());
    for (const Point2D& p : grid_loop) loop.push_back(grid.unsnap(p));
  }
  std::move(more.begin(), more.end(), std::back_inserter(loops));
  std::vector<uint32_t> rank;
  auto data = in_order(std::move(loops), regions.outer_of, rank);
  constexpr double kNoiseSteps = 2;
  data->noise = kNoiseSteps / grid.steps_per_mm();
  if (!regions.group_of.empty()) {
    data->arranged_steps = grid.steps_per_mm();
    data->group_of.resize(rank.size());
    for (uint32_t l = 0; l < rank.size(); ++l) data->group_of[rank[l]] = rank[regions.group_of[l]];
  }
  shape.data_ = std::move(data);
  return shape;
}

Shape2D Shape2DFactory::canonical(std::vector<Loop> loops, const std::vector<uint32_t>& outer_of,
                                  std::shared_ptr<const Turn> turn) {
  Shape2D shape;
  if (loops.empty()) return shape;
  std::vector<uint32_t> rank;
  auto data = in_order(std::move(loops), outer_of, rank);
  data->turn = std::move(turn);
  shape.data_ = std::move(data);
  return shape;
}

/// Sets `rank` to the new places of the loops.
std::shared_ptr<Shape2D::Data> Shape2DFactory::in_order(std::vector<Loop> loops,
                                                        const std::vector<uint32_t>& outer_of,
                                                        std::vector<uint32_t>& rank) {
  for (Loop& loop : loops) {
    for (glm::dvec2& p : loop) p += 0.0;  // no negative zeros
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end(), lexicographic_less),
                loop.end());
  }
  std::vector<uint32_t> order(loops.size());
  rank.resize(loops.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](uint32_t i, uint32_t j) { return is_before(loops[i], loops[j]); });
  auto data = std::make_shared<Shape2D::Data>();
  for (uint32_t k = 0; k < order.size(); ++k) {
    rank[order[k]] = k;
    data->loops.push_back(std::move(loops[order[k]]));
  }
  std::vector<std::vector<uint32_t>> holes(loops.size());
  for (uint32_t k = 0; k < order.size(); ++k) {
    const uint32_t outer = rank[outer_of[order[k]]];
    if (outer != k) holes[outer].push_back(k);
  }
  for (uint32_t k = 0; k < order.size(); ++k) {
    if (outer_of[order[k]] == order[k]) data->regions.push_back({k, std::move(holes[k])});
  }
  return data;
}

Result<Shape2D> Shape2DFactory::arranged(const Grid2D& grid, std::vector<Segment2D> segments,
                                         const std::function<bool(int32_t, int32_t)>& inside) {
  const auto arrangement = arrange(std::move(segments));
  if (!arrangement) {
    return Error{ErrorCode::kInternal, "2D Boolean: crossings do not settle on the grid", {}};
  }
  return from_grid(grid, extract_regions(*arrangement, inside));
}

}  // namespace csgrun
