#include "engine/bsp/covered_polygons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/base/counting_order.h"

namespace csgrun {
namespace {

/// Convex operands inside of which nothing is boundary: what is added to all else, or taken away
/// from it.
std::vector<uint8_t> find_removers(const Job& job, const Expression& expression) {
  std::vector<uint8_t> removes(job.operand_count(), 0);
  if (expression.nodes.empty() || expression.nodes.back().is_operand) return removes;
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
      bounds[n] = job.operand_box(node.operand);
      continue;
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
      continue;
    }
    for (uint32_t c = 0; c < node.child_count; ++c) {
      PolygonBox box = live[n];
      if (node.op == BooleanOp::kIntersection) {
        box.clip(bounds[n]);
      } else if (node.op == BooleanOp::kDifference && c > 0) {
        box.clip(bounds[child(node, 0)]);
      }
      live[child(node, c)].include(box);
    }
  }
  return of_operand;
}

/// A ball inside a convex operand.
struct Ball {
  std::array<double, 3> middle{};
  double radius = 0;  ///< not positive: none

  /// The largest one around the middle of a leaf on the grid, or a little less.
  static Ball within(const Job& job, uint32_t operand) {
    const PolygonBox& box = job.operand_box(operand);
    Ball ball;
    for (size_t k = 0; k < 3; ++k) ball.middle[k] = (double{0} + box.lo[k] + box.hi[k]) / 2;
    // Points of other operands are rounded, by less than this.
    constexpr double kMargin = 1;
    double square = HUGE_VAL;
    for (uint32_t q = job.polygon_start(operand); q < job.polygon_start(operand + 1); ++q) {
      square = std::min(square, ball.square_to(job, job.polygons()[q]));
    }
    if (square < HUGE_VAL) ball.radius = std::sqrt(square) * (1 - 0x1p-40) - kMargin;
    return ball;
  }

  [[nodiscard]] bool holds(const std::array<double, 3>& p) const {
    const double x = p[0] - middle[0], y = p[1] - middle[1], z = p[2] - middle[2];
    return x * x + y * y + z * z < radius * radius * (1 - 0x1p-40);
  }

 private:
  /// No more than the square of the distance of the middle behind the plane of a polygon; 0 if it
  /// is in front.
  [[nodiscard]] double square_to(const Job& job, const JobPolygon& polygon) const {
    using Vector = std::array<double, 3>;
    const auto minus = [](const Vector& a, const Vector& b) {
      return Vector{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    };
    const auto size = [](const Vector& v) {
      return std::fabs(v[0]) + std::fabs(v[1]) + std::fabs(v[2]);
    };
    const auto corners = job.corners(polygon);
    const Vector& origin = job.rounded(corners[0]);
    const Vector to = minus(origin, middle);
    double best = 0;
    // Three corners may stand in line; of a triangle they do not.
    for (size_t i = 1; i + 1 < corners.size(); ++i) {
      const Vector u = minus(job.rounded(corners[i]), origin),
                   v = minus(job.rounded(corners[i + 1]), origin);
      const Vector n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                     u[0] * v[1] - u[1] * v[0]};
      // Differences of grid points are exact, so 2^-48 of the product is more than all roundings
      // make; (|n| + 2^-48 product)^2 is below the divisor.
      const double product = size(u) * size(v);
      const double above =
          n[0] * to[0] + n[1] * to[1] + n[2] * to[2] - 0x1p-48 * product * size(to);
      const double divisor =
          (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) * (1 + 0x1p-39) + product * product * 0x1p-54;
      if (above > 0) best = std::max(best, above * above / divisor);
    }
    return best;
  }
};

/// Balls by the squares of a grid in x and y that they meet.
class BallBins {
 public:
  BallBins(const Job& job, const std::vector<uint8_t>& removes) {
    for (uint32_t o = 0; o < removes.size(); ++o) {
      if (!removes[o] || !job.has_grid_vertices(o)) continue;
      const Ball ball = Ball::within(job, o);
      if (ball.radius > 0) balls_.push_back(ball);
    }
    if (balls_.empty()) return;
    constexpr size_t kMost = 256;
    while (bins_ < kMost && bins_ * bins_ < 4 * balls_.size()) bins_ *= 2;
    for (int k = 0; k < 2; ++k) {
      double hi = -HUGE_VAL;
      lo_[k] = HUGE_VAL;
      for (const Ball& b : balls_) {
        lo_[k] = std::min(lo_[k], b.middle[k] - b.radius);
        hi = std::max(hi, b.middle[k] + b.radius);
      }
      per_step_[k] = static_cast<double>(bins_) / (hi - lo_[k]);
    }
    std::vector<std::pair<uint32_t, uint32_t>> entries;  // bin, ball
    for (uint32_t i = 0; i < balls_.size(); ++i) {
      const Ball& b = balls_[i];
      for (size_t y = bin(1, b.middle[1] - b.radius); y <= bin(1, b.middle[1] + b.radius); ++y) {
        for (size_t x = bin(0, b.middle[0] - b.radius); x <= bin(0, b.middle[0] + b.radius); ++x) {
          entries.emplace_back(static_cast<uint32_t>(y * bins_ + x), i);
        }
      }
    }
    in_bin_.sort(entries.size(), bins_ * bins_, [&](size_t e) { return entries[e].first; });
    for (uint32_t& e : in_bin_.order) e = entries[e].second;
  }

  [[nodiscard]] bool empty() const { return balls_.empty(); }

  /// Whether one of the balls holds all corners of a polygon.
  [[nodiscard]] bool hold(const Job& job, const JobPolygon& polygon) const {
    if (balls_.empty()) return false;
    const auto corners = job.corners(polygon);
    const auto& first = job.rounded(corners[0]);
    const size_t b = bin(1, first[1]) * bins_ + bin(0, first[0]);
    for (uint32_t i = in_bin_.starts[b]; i < in_bin_.starts[b + 1]; ++i) {
      const Ball& ball = balls_[in_bin_.order[i]];
      if (std::all_of(corners.begin(), corners.end(),
                      [&](uint32_t v) { return ball.holds(job.rounded(v)); })) {
        return true;
      }
    }
    return false;
  }

 private:
  /// Monotone: a point of a ball is in a bin between those of its ends.
  [[nodiscard]] size_t bin(int axis, double coordinate) const {
    const double at = (coordinate - lo_[axis]) * per_step_[axis];
    return static_cast<size_t>(std::clamp(at, 0.0, static_cast<double>(bins_ - 1)));
  }

  std::vector<Ball> balls_;
  size_t bins_ = 1;
  std::array<double, 2> lo_{}, per_step_{};
  CountingOrder in_bin_;
};

/// Asks whether polygons are inside a convex operand.
class Within {
 public:
  Within(Job& job, CellGeometry& geometry)
      : job_(job), geometry_(geometry), known_(job.vertex_count()) {}

  /// Whether a polygon that is in no plane of the operand is inside it, but for its corners and
  /// edges.
  bool holds(uint32_t operand, uint32_t polygon) {
    const auto corners = job_.corners(job_.polygons()[polygon]);
    return std::all_of(corners.begin(), corners.end(), [&](uint32_t v) {
      Known& known = known_[v];
      if (known.operand != operand) known = {operand, is_in_or_on(v, operand)};
      return known.is_within;
    });
  }

 private:
  struct Known {
    uint32_t operand = kNone;
    bool is_within = false;
  };

  bool is_in_or_on(uint32_t vertex, uint32_t operand) {
    const uint32_t point = geometry_.vertex_point(vertex);
    for (uint32_t q = job_.polygon_start(operand); q < job_.polygon_start(operand + 1); ++q) {
      job_.ensure_support(q);
      const PlaneId plane = job_.polygons()[q].support;
      const int side = geometry_.side(plane.index(), point);
      if (plane.flipped() ? side < 0 : side > 0) return false;
    }
    return true;
  }

  Job& job_;
  CellGeometry& geometry_;
  std::vector<Known> known_;  ///< per vertex, of the operand asked last
};

}  // namespace

std::vector<uint8_t> find_plainly_covered(const Job& job, const Expression& expression) {
  if (expression.nodes.empty() || expression.nodes.back().is_operand) return {};
  const std::vector<PolygonBox> live = find_live_boxes(job, expression);
  const std::vector<uint8_t> removes = find_removers(job, expression);
  // With two operands, what is inside one meets nothing at all.
  const BallBins balls(job, job.operand_count() > 2 ? removes : std::vector<uint8_t>());
  std::vector<uint8_t> is_covered(job.polygons().size(), 0);
  bool any = false;
  for (uint32_t o = 0; o < job.operand_count(); ++o) {
    if (balls.empty() && live[o].holds(job.operand_box(o))) continue;
    const bool is_live = !live[o].is_empty();
    for (uint32_t p = job.polygon_start(o); p < job.polygon_start(o + 1); ++p) {
      is_covered[p] =
          !is_live || !live[o].meets(job.boxes()[p]) || balls.hold(job, job.polygons()[p]);
      any |= is_covered[p] != 0;
    }
  }
  return any ? std::move(is_covered) : std::vector<uint8_t>();
}

std::vector<uint8_t> find_covered(Job& job, CellGeometry& geometry, const Expression& expression,
                                  std::span<const Contact> contacts,
                                  std::span<const uint32_t> starts,
                                  std::span<const uint32_t> contact_of) {
  std::vector<uint8_t> is_covered(job.polygons().size(), 0);
  const std::vector<uint8_t> removes = find_removers(job, expression);
  if (std::find(removes.begin(), removes.end(), 1) == removes.end()) return is_covered;
  Within within(job, geometry);
  std::vector<uint32_t> touched_by, crossed_by;
  for (uint32_t p = 0; p < is_covered.size(); ++p) {
    touched_by.clear();
    crossed_by.clear();
    for (uint32_t i = starts[p]; i < starts[p + 1]; ++i) {
      const Contact& c = contacts[contact_of[i]];
      const uint32_t o = job.polygons()[c.p == p ? c.q : c.p].operand;
      if (!removes[o]) continue;
      // What is in front of a plane of a convex operand is outside of it.
      const bool is_crossed = c.is_plain || c.is_coplanar || (c.p == p ? c.p_front : c.q_front);
      std::vector<uint32_t>& list = is_crossed ? crossed_by : touched_by;
      if (list.empty() || list.back() != o) list.push_back(o);
    }
    is_covered[p] = std::any_of(touched_by.begin(), touched_by.end(), [&](uint32_t o) {
      return std::find(crossed_by.begin(), crossed_by.end(), o) == crossed_by.end() &&
             within.holds(o, p);
    });
  }
  return is_covered;
}

}  // namespace csgrun
