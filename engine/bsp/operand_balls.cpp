#include "engine/bsp/operand_balls.h"

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.h"
#include "engine/bsp/grid_planes.h"

namespace csgrun {
namespace {

/// How far half of a point is behind the plane of a polygon of a leaf on the grid.
double depth(const Job& job, const JobPolygon& polygon, const IVec3& twice) {
  const auto corners = job.corners(polygon);
  const Plane plane = support_of_loop(polygon.count, [&](uint32_t i) {
    const auto& v = job.rounded(corners[i % polygon.count]);
    return IVec3{static_cast<int64_t>(v[0]), static_cast<int64_t>(v[1]),
                 static_cast<int64_t>(v[2])};
  });
  const Int128 above = plane.a * twice[0] + plane.b * twice[1] + plane.c * twice[2] + 2 * plane.d;
  return static_cast<double>(-above) /
         (2 * std::hypot(static_cast<double>(plane.a), static_cast<double>(plane.b),
                         static_cast<double>(plane.c)));
}

/// Several squares a ball.
uint32_t squares_per_side(size_t balls) {
  constexpr double kMost = 256;
  return static_cast<uint32_t>(std::clamp(2 * std::sqrt(static_cast<double>(balls)), 1.0, kMost));
}

}  // namespace

/// The largest one inside, around the middle, and the smallest one around: less a step, and more by
/// two, as points of other operands are rounded, and so is all this, by less than a step.
OperandBalls::Ball OperandBalls::Ball::of(const Job& job, uint32_t operand) {
  const PolygonBox& box = job.operand_box(operand);
  IVec3 twice{};
  Ball ball;
  for (size_t k = 0; k < 3; ++k) {
    twice[k] = int64_t{box.lo[k]} + box.hi[k];
    ball.middle[k] = static_cast<double>(twice[k]) / 2;
  }
  double radius = (static_cast<double>(box.hi[0]) - box.lo[0]) / 2;
  for (uint32_t q = job.polygon_start(operand); q < job.polygon_start(operand + 1); ++q) {
    radius = std::min(radius, depth(job, job.polygons()[q], twice));
  }
  radius = std::max(radius - 1, 0.0);
  ball.inner = radius * radius;
  for (uint32_t v = job.vertex_start(operand); v < job.vertex_start(operand + 1); ++v) {
    ball.outer = std::max(ball.outer, ball.square_from(job.rounded(v)));
  }
  const double around = std::sqrt(ball.outer) + 2;
  ball.outer = around * around;
  return ball;
}

OperandBalls::OperandBalls(const Job& job, const std::vector<uint8_t>& operands) {
  std::vector<Ball> all(operands.size());
  for_each_alone(operands.size(), job.polygons().size() > kFewForThreads, [&](size_t o) {
    const auto operand = static_cast<uint32_t>(o);
    if (operands[o] && job.has_grid_vertices(operand)) all[o] = Ball::of(job, operand);
  });
  std::vector<SquareBins::Box> boxes;
  ball_of_.assign(operands.size(), kNoBall);
  for (size_t o = 0; o < all.size(); ++o) {
    if (all[o].inner <= 0) continue;
    ball_of_[o] = static_cast<uint32_t>(balls_.size());
    balls_.push_back(all[o]);
    SquareBins::Box& box = boxes.emplace_back();
    const double radius = std::sqrt(all[o].inner);
    for (size_t k = 0; k < 2; ++k) {
      box.lo[k] = all[o].middle[k] - radius;
      box.hi[k] = all[o].middle[k] + radius;
    }
  }
  bins_ = SquareBins(boxes, squares_per_side(boxes.size()));
}

bool OperandBalls::hold(const Job& job, const JobPolygon& polygon) const {
  const auto corners = job.corners(polygon);
  const auto& first = job.rounded(corners[0]);
  const auto near = bins_.at(first[0], first[1]);
  return std::any_of(near.begin(), near.end(), [&](uint32_t i) {
    const Ball& ball = balls_[i];
    return std::all_of(corners.begin(), corners.end(),
                       [&](uint32_t v) { return ball.square_from(job.rounded(v)) < ball.inner; });
  });
}

OperandBalls::Side OperandBalls::side(uint32_t operand, const std::array<double, 3>& point) const {
  if (ball_of_.empty() || ball_of_[operand] == kNoBall) return Side::kUnknown;
  const Ball& ball = balls_[ball_of_[operand]];
  const double square = ball.square_from(point);
  return square < ball.inner   ? Side::kInside
         : square > ball.outer ? Side::kOutside
                               : Side::kUnknown;
}

}  // namespace csgrun
