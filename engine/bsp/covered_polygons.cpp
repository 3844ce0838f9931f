#include "engine/bsp/covered_polygons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/bsp/contact_table.h"
#include "engine/bsp/grid_planes.h"
#include "engine/bsp/square_bins.h"

namespace csgrun {
namespace {

/// Convex operands inside of which nothing is boundary: what is added to all else, or taken away
/// from it.
std::vector<uint8_t> find_removers(const Job& job, const Expression& expression) {
  std::vector<uint8_t> removes(job.operand_count(), 0);
  if (expression.nodes.empty()) return removes;
  const Expression::Node& root = expression.nodes.back();
  const bool is_union = root.op == BooleanOp::kUnion;
  if (!is_union && root.op != BooleanOp::kDifference) return removes;
  for (uint32_t c = is_union ? 0 : 1; c < root.child_count; ++c) {
    const Expression::Node& child = expression.nodes[expression.children[root.first_child + c]];
    if (child.is_operand && job.is_convex(child.operand)) removes[child.operand] = 1;
  }
  return removes;
}

/// Per operand, a box beside which its surface bounds nothing, whatever it is.
std::vector<PolygonBox> find_live_boxes(const Job& job, const Expression& expression) {
  PolygonBox everywhere = PolygonBox::none();
  std::swap(everywhere.lo, everywhere.hi);
  // Boxes that hold what a node is, from the operands up.
  std::vector<PolygonBox> bounds(expression.nodes.size(), PolygonBox::none());
  const auto child = [&](const Expression::Node& node, uint32_t c) {
    return expression.children[node.first_child + c];
  };
  for (size_t n = 0; n < expression.nodes.size(); ++n) {
    const Expression::Node& node = expression.nodes[n];
    if (node.is_operand) {
      bounds[n] = job.operand_box(node.operand);  // and there are no children
    }
    if (node.op == BooleanOp::kIntersection) bounds[n] = everywhere;
    for (uint32_t c = 0; c < node.child_count; ++c) {
      if (node.op == BooleanOp::kIntersection) {
        bounds[n].clip(bounds[child(node, c)]);
      } else if (c == 0 || node.op != BooleanOp::kDifference) {
        bounds[n].include(bounds[child(node, c)]);
      }
    }
  }
  // And where they matter, from the root down; a node may have several parents.
  std::vector<PolygonBox> live(expression.nodes.size(), PolygonBox::none());
  std::vector<PolygonBox> of_operand(job.operand_count(), PolygonBox::none());
  live.back() = everywhere;
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

/// Whether a polygon in one box is beside another one, but for its rim at most: they have nothing
/// in common, or part of a plane that the polygon goes across, or up to.
bool is_beside(const PolygonBox& box, const PolygonBox& other) {
  bool beside = false;
  for (size_t k = 0; k < 3; ++k) {
    const int32_t lo = std::max(box.lo[k], other.lo[k]), hi = std::min(box.hi[k], other.hi[k]);
    beside |= lo > hi || (lo == hi && box.lo[k] < box.hi[k]);
  }
  return beside;
}

/// A ball inside a convex operand.
struct Ball {
  std::array<double, 3> middle{};
  double radius = 0;  ///< not positive: none

  /// The largest one around the middle of a leaf on the grid, less one step.
  static Ball within(const Job& job, uint32_t operand) {
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
    // Points of other operands are rounded, and so is all this, by less than a step.
    constexpr double kMargin = 1;
    ball.radius = radius - kMargin;
    return ball;
  }

  [[nodiscard]] bool holds(const std::array<double, 3>& p) const {
    const double x = p[0] - middle[0], y = p[1] - middle[1], z = p[2] - middle[2];
    return x * x + y * y + z * z < radius * radius;
  }

 private:
  /// How far half of a point is behind the plane of a polygon.
  static double depth(const Job& job, const JobPolygon& polygon, const IVec3& twice) {
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
};

/// Balls inside the convex leaves on the grid among some operands.
class Balls {
 public:
  Balls(const Job& job, const std::vector<uint8_t>& operands)
      : balls_(find(job, operands)), bins_(boxes(), per_side()) {}

  [[nodiscard]] bool empty() const { return balls_.empty(); }

  /// Whether one of them holds all corners of a polygon.
  [[nodiscard]] bool hold(const Job& job, const JobPolygon& polygon) const {
    const auto corners = job.corners(polygon);
    const auto& first = job.rounded(corners[0]);
    const auto near = bins_.at(first[0], first[1]);
    return std::any_of(near.begin(), near.end(), [&](uint32_t i) {
      return std::all_of(corners.begin(), corners.end(),
                         [&](uint32_t v) { return balls_[i].holds(job.rounded(v)); });
    });
  }

 private:
  static std::vector<Ball> find(const Job& job, const std::vector<uint8_t>& operands) {
    std::vector<Ball> balls(operands.size());
    for_each_alone(operands.size(), job.polygons().size() > kFewForThreads, [&](size_t o) {
      const auto operand = static_cast<uint32_t>(o);
      if (operands[o] && job.has_grid_vertices(operand)) balls[o] = Ball::within(job, operand);
    });
    std::erase_if(balls, [](const Ball& ball) { return ball.radius <= 0; });
    return balls;
  }

  [[nodiscard]] std::vector<SquareBins::Box> boxes() const {
    std::vector<SquareBins::Box> boxes;
    for (const Ball& b : balls_) {
      SquareBins::Box& box = boxes.emplace_back();
      for (size_t k = 0; k < 2; ++k) {
        box.lo[k] = b.middle[k] - b.radius;
        box.hi[k] = b.middle[k] + b.radius;
      }
    }
    return boxes;
  }

  /// Several squares a ball.
  [[nodiscard]] uint32_t per_side() const {
    constexpr double kMost = 256;
    return static_cast<uint32_t>(
        std::clamp(2 * std::sqrt(static_cast<double>(balls_.size())), 1.0, kMost));
  }

  const std::vector<Ball> balls_;
  const SquareBins bins_;
};

}  // namespace

std::vector<uint8_t> find_plainly_covered(const Job& job, const Expression& expression) {
  if (expression.nodes.empty()) return {};
  const std::vector<PolygonBox> live = find_live_boxes(job, expression);
  const std::vector<uint8_t> removes = find_removers(job, expression);
  // With two operands, what is inside one meets nothing at all.
  const Balls balls(job, job.operand_count() > 2 ? removes : std::vector<uint8_t>());
  std::vector<uint8_t> is_covered(job.polygons().size(), 0), any(job.operand_count(), 0);
  for_each_alone(job.operand_count(), job.polygons().size() > kFewForThreads, [&](size_t operand) {
    const auto o = static_cast<uint32_t>(operand);
    if (balls.empty() && live[o].holds(job.operand_box(o))) return;
    const bool is_live = !live[o].is_empty();
    for (uint32_t p = job.polygon_start(o); p < job.polygon_start(o + 1); ++p) {
      is_covered[p] =
          !is_live || is_beside(job.boxes()[p], live[o]) || balls.hold(job, job.polygons()[p]);
      any[o] |= is_covered[p];
    }
  });
  const bool some = std::find(any.begin(), any.end(), 1) != any.end();
  return some ? std::move(is_covered) : std::vector<uint8_t>();
}

std::vector<uint8_t> find_covered(const Job& job, const Expression& expression,
                                  const ContactTable& contacts) {
  std::vector<uint8_t> is_covered(job.polygons().size(), 0);
  const std::vector<uint8_t> removes = find_removers(job, expression);
  for_each_range(is_covered.size(), [&](size_t begin, size_t end) {
    std::vector<uint32_t> touched_by, crossed_by;
    for (auto p = static_cast<uint32_t>(begin); p < end; ++p) {
      touched_by.clear();
      crossed_by.clear();
      for (const uint32_t i : contacts.of(p)) {
        const Contact& c = contacts[i];
        const uint32_t o = job.polygons()[c.p == p ? c.q : c.p].operand;
        if (!removes[o]) continue;
        // What meets a convex body and is not within it goes to the front of a face that it meets.
        const bool leaves = c.is_coplanar || (c.p == p ? c.p_front : c.q_front);
        (leaves ? crossed_by : touched_by).push_back(o);
      }
      is_covered[p] = std::any_of(touched_by.begin(), touched_by.end(), [&](uint32_t o) {
        return std::find(crossed_by.begin(), crossed_by.end(), o) == crossed_by.end();
      });
    }
  });
  return is_covered;
}

}  // namespace csgrun
