#include "engine/bsp/group_cover.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/bsp/operand_groups.h"
#include "engine/bsp/ray_boxes.h"
#include "engine/bsp/ray_label.h"
#include "engine/bsp/rounded_box.h"
#include "engine/bsp/vertex_signs.h"

namespace csgrun {
namespace {

using Position = std::array<double, 3>;

/// Places that are spread evenly.
struct Spread {
  double along = 0, across = 0;

  /// The next ones of two sequences that have no ratio in common.
  void step() {
    along = std::fmod(along + 0.7548776662466927, 1.0);
    across = std::fmod(across + 0.5698402909980532, 1.0);
  }
  /// One of a polygon: in one of its triangles. Corners would not do, as they are what sticks out
  /// of round bodies.
  [[nodiscard]] Position in(const Job& job, uint32_t polygon) const {
    const auto corners = job.corners(job.polygons()[polygon]);
    const auto triangles = static_cast<double>(corners.size() - 2);
    const auto second = 1 + static_cast<size_t>(along * triangles);
    double u = std::fmod(along * triangles, 1.0), v = across;
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Position &a = job.rounded(corners[0]), &b = job.rounded(corners[second]),
                   &c = job.rounded(corners[second + 1]);
    Position point{};
    for (size_t k = 0; k < 3; ++k) point[k] = a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]);
    return point;
  }
};

class CoverSample {
 public:
  CoverSample(const Job& job, BooleanOp op)
      : job_(job),
        decisive_(op == BooleanOp::kUnion ? Inside::kYes : Inside::kNo),
        signs_(job, true),
        boxes_(job) {}

  /// Whether a point of an operand is told to be boundary of nothing by another one.
  bool is_covered(const Position& point, uint32_t own, uint32_t other) {
    const double error = signs_.error(own) + kRounding;
    if (!may_hold(job_.operand_box(other), point, error)) return decisive_ == Inside::kNo;
    return ray_label(job_, signs_, boxes_, other, point, error) == decisive_;
  }

 private:
  /// Of doubles below 2^31, with room to spare.
  static constexpr double kRounding = 0x1p-16;

  const Job& job_;
  const Inside decisive_;  ///< that a point is inside of another one, or that it is not
  VertexSigns signs_;
  RayBoxes boxes_;
};

}  // namespace

double cover_in_groups(const Job& job, const Expression& expression) {
  if (!can_be_grouped(expression)) return 0;
  const Groupable wide = most_groupable(expression);
  const auto operand = [&](size_t child) { return expression.nodes[wide.children[child]].operand; };
  if (!std::all_of(wide.children.begin(), wide.children.end(),
                   [&](uint32_t n) { return expression.nodes[n].is_operand; })) {
    return 0;
  }
  CoverSample sample(job, wide.op);
  // All over the operands and over the polygons of each: steps that have nothing in common with
  // how these are ordered.
  constexpr size_t kPoints = 64, kStep = 7919;
  size_t points = 0, covered = 0;
  Spread spread;
  for (size_t i = 0; i < kPoints; ++i) {
    const size_t child = i * wide.children.size() / kPoints;
    const uint32_t own = operand(child);
    const uint32_t first = job.polygon_start(own), count = job.polygon_start(own + 1) - first;
    if (count == 0) continue;
    const auto polygon = first + static_cast<uint32_t>(i * kStep % count);
    const size_t begin = child / wide.size * wide.size;
    const size_t end = std::min(begin + wide.size, wide.children.size());
    spread.step();
    const Position point = spread.in(job, polygon);
    bool is_covered = false;
    for (size_t c = begin; c < end && !is_covered; ++c) {
      is_covered = c != child && sample.is_covered(point, own, operand(c));
    }
    ++points;
    covered += is_covered ? 1 : 0;
  }
  return points == 0 ? 0 : static_cast<double>(covered) / static_cast<double>(points);
}

}  // namespace csgrun
