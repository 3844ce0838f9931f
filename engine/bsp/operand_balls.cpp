#include "engine/bsp/operand_balls.h"

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.h"
#include "engine/bsp/convex_sides.h"

namespace csgrun {
namespace {

bool is_far_out(const PolygonBox& box) {
  bool far = false;
  for (size_t k = 0; k < 3; ++k) {
    far |= box.lo[k] <= -PolygonBox::kLimit || box.hi[k] >= PolygonBox::kLimit;
  }
  return far;
}

/// Several squares a ball.
uint32_t most_squares(size_t balls) {
  constexpr size_t kEach = 4, kMost = 256 * 256;
  return static_cast<uint32_t>(std::clamp<size_t>(kEach * balls, 1, kMost));
}

}  // namespace

/// The largest one inside, around the middle, and the smallest one around, less a step and more by
/// one: points may be wrong, and so is all this, by less than a step together.
///
/// A point that is behind the planes of all faces of a closed surface is inside of it: the surface
/// goes round it, at least once and one way only. No face comes nearer than its plane.
OperandBalls::Ball OperandBalls::Ball::of(const Operand& operand, const PolygonBox& box) {
  Ball ball;
  for (size_t k = 0; k < 3; ++k) {
    ball.middle[k] = static_cast<double>(int64_t{box.lo[k]} + box.hi[k]) / 2;
  }
  const FrameMap map(operand.frame);
  double radius = (static_cast<double>(box.hi[0]) - box.lo[0]) / 2 - 1;
  for (size_t f = 0; f < operand.leaf->face_count() && radius > 0; ++f) {
    radius = std::min(radius, -above(unit_plane(operand, map, f), ball.middle) - 1);
  }
  if (!(radius > 0)) return ball;  // which is none
  ball.inner = radius * radius;
  for (const IVec3& v : operand.leaf->vertices) {
    const IVec3& t = operand.translation;
    const IVec3 moved{v[0] + t[0], v[1] + t[1], v[2] + t[2]};
    std::array<double, 3> at{};
    if (map.is_identity()) {
      for (size_t k = 0; k < 3; ++k) at[k] = static_cast<double>(moved[k]);
    } else {
      at = rounded(map.point(moved));
    }
    ball.outer = std::max(ball.outer, ball.square_from(at));
  }
  const double around = std::sqrt(ball.outer) + 1;
  ball.outer = around * around;
  return ball;
}

OperandBalls::OperandBalls(const std::vector<Operand>& operands,
                           const std::vector<PolygonBox>& operand_boxes,
                           const std::vector<uint8_t>& uses) {
  std::vector<Ball> all(operands.size());
  size_t faces = 0;
  for (const Operand& operand : operands) faces += operand.leaf ? operand.leaf->face_count() : 0;
  for_each_alone(operands.size(), faces > kFewForThreads, [&](size_t o) {
    const Operand& operand = operands[o];
    if (uses[o] != 0 && operand.leaf && operand.leaf->face_count() > 0 &&
        !is_far_out(operand_boxes[o])) {
      all[o] = Ball::of(operand, operand_boxes[o]);
    }
  });
  std::vector<SquareBins::Box> boxes;
  ball_of_.assign(operands.size(), kNoBall);
  for (size_t o = 0; o < all.size(); ++o) {
    if (all[o].inner <= 0) continue;
    constexpr double kRound = 0.5;  // of squares: a cube has a third, an octagon's sphere more
    const bool obeys = operands[o].frame.is_identity || all[o].inner >= kRound * all[o].outer;
    const uint8_t use = obeys ? uses[o] : uint8_t{kSide};
    all[o].hides = (use & (kWithin | kBeyond)) != 0;
    hide_some_ |= all[o].hides;
    const auto number = static_cast<uint32_t>(balls_.size());
    ball_of_[o] = number;
    balls_.push_back(all[o]);
    if ((use & kBeyond) != 0 && beyond_.size() < kMostBeyond &&
        !all[o].is_around(operand_boxes[o])) {
      beyond_.push_back(number);
    }
    // Bins have a box for each ball: of those of other use an empty one.
    SquareBins::Box& box = boxes.emplace_back();
    const double radius = (use & kWithin) != 0 ? std::sqrt(all[o].inner) : -1;
    for (size_t k = 0; k < 3; ++k) {
      box.lo[k] = all[o].middle[k] - radius;
      box.hi[k] = all[o].middle[k] + radius;
    }
  }
  within_ = SquareBins(boxes, most_squares(boxes.size()));
}

OperandBalls::Side OperandBalls::side(uint32_t operand, const std::array<double, 3>& point) const {
  if (!has(operand)) return Side::kUnknown;
  const Ball& ball = balls_[ball_of_[operand]];
  const double square = ball.square_from(point);
  return square < ball.inner   ? Side::kInside
         : square > ball.outer ? Side::kOutside
                               : Side::kUnknown;
}

}  // namespace csgrun
