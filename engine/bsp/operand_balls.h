// Balls inside and around operands: of round ones most points and polygons are plainly in one, or
// beside the other.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/bsp/operand.h"
#include "engine/bsp/polygon_box.h"
#include "engine/bsp/square_bins.h"

namespace csgrun {

class OperandBalls {
 public:
  /// None.
  OperandBalls() = default;
  /// What is asked about: a bit for each. Of kSide points alone, of the others polygons too.
  enum Use : uint8_t { kWithin = 1, kBeyond = 2, kSide = 4 };
  /// Of those of some operands (their uses; 0: none) that are leaves and not far out, and all of
  /// whose faces are seen from behind from the middle of their box, as those of convex ones are.
  /// `boxes`: of the operands. O(n), parallel.
  OperandBalls(const std::vector<Operand>& operands, const std::vector<PolygonBox>& boxes,
               const std::vector<uint8_t>& uses);

  /// Whether an operand has one: then it is a leaf, not far out.
  [[nodiscard]] bool has(uint32_t operand) const {
    return !ball_of_.empty() && ball_of_[operand] != kNoBall;
  }

  /// Whether it is of another use than kSide, and obeys it. Those in frames do only if they are
  /// round: what hides polygons opens operands, which then cover less (see find_covered). A ball
  /// less 80 turned cubes took a sixth longer; 1000 turned balls together a twentieth of the time.
  [[nodiscard]] bool hides(uint32_t operand) const {
    return has(operand) && balls_[ball_of_[operand]].hides;
  }
  /// Whether there are such.
  [[nodiscard]] bool hide_some() const { return hide_some_; }

  /// What may be wrong by less than this many steps along each axis is less than a step away.
  static constexpr double kMostWrong = 0.5;
  /// Whether all of a polygon is strictly inside of one of the operands of use kWithin, as an inner
  /// ball tells: at(i) is corner i of `count`, wrong by less than kMostWrong.
  template <class At>
  [[nodiscard]] bool hold(uint32_t count, At&& at) const {
    if (balls_.empty()) return false;
    const std::array<double, 3>& first = at(0);
    const auto near = within_.at(first);
    return std::any_of(near.begin(), near.end(), [&](uint32_t i) {
      const Ball& ball = balls_[i];
      for (uint32_t c = 0; c < count; ++c) {
        if (ball.square_from(at(c)) >= ball.inner) return false;
      }
      return true;
    });
  }

  /// Whether all that is in a box is strictly outside of one of the operands of use kBeyond, as an
  /// outer ball tells. The first kMostBeyond of those are asked that tell more than their box does.
  [[nodiscard]] bool leave_out(const PolygonBox& box) const {
    return std::any_of(beyond_.begin(), beyond_.end(),
                       [&](uint32_t i) { return balls_[i].is_beside(box); });
  }
  static constexpr size_t kMostBeyond = 64;

  enum class Side : uint8_t { kInside, kOutside, kUnknown };
  /// Where a point is that is wrong by less than kMostWrong.
  [[nodiscard]] Side side(uint32_t operand, const std::array<double, 3>& point) const;

 private:
  struct Ball {
    std::array<double, 3> middle{};
    double inner = 0, outer = 0;  ///< squares of the radii; inner: 0 if there is none
    bool hides = false;           ///< polygons

    static Ball of(const Operand& operand, const PolygonBox& box);
    [[nodiscard]] double square_from(const std::array<double, 3>& p) const {
      const double x = p[0] - middle[0], y = p[1] - middle[1], z = p[2] - middle[2];
      return x * x + y * y + z * z;
    }
    /// Whether the outer ball holds all of a box.
    [[nodiscard]] bool is_around(const PolygonBox& box) const {
      double square = 0;
      for (size_t k = 0; k < 3; ++k) {
        const double away = std::max(box.hi[k] - middle[k], middle[k] - box.lo[k]);
        square += away * away;
      }
      return square <= outer;
    }
    /// Whether no point of a box is in the outer ball.
    [[nodiscard]] bool is_beside(const PolygonBox& box) const {
      double square = 0;
      for (size_t k = 0; k < 3; ++k) {
        const double away = std::max({box.lo[k] - middle[k], middle[k] - box.hi[k], 0.0});
        square += away * away;
      }
      return square > outer;
    }
  };
  static constexpr uint32_t kNoBall = ~0u;

  std::vector<Ball> balls_;
  std::vector<uint32_t> ball_of_;  ///< per operand, or kNoBall
  bool hide_some_ = false;
  SquareBins within_;             ///< of the inner balls of use kWithin
  std::vector<uint32_t> beyond_;  ///< the balls of use kBeyond
};

}  // namespace csgrun
