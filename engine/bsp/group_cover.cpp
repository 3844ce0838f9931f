#include "engine/bsp/group_cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "engine/bsp/operand_groups.h"
#include "engine/bsp/pruned_expression.h"
#include "engine/bsp/ray_boxes.h"
#include "engine/bsp/ray_label.h"
#include "engine/bsp/rounded_box.h"
#include "engine/bsp/vertex_signs.h"

namespace csgrun {
namespace {

using Position = std::array<double, 3>;

constexpr size_t kPoints = 64;  ///< of a sample
/// Of doubles below 2^31, with room to spare.
constexpr double kRounding = 0x1p-16;

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

/// About where an edge of a polygon passes through the plane of another one.
Position end_of(const Job& job, const Contact& c, const Contact::End& end) {
  const auto corners = job.corners(job.polygons()[end.on_p ? c.p : c.q]);
  const auto others = job.corners(job.polygons()[end.on_p ? c.q : c.p]);
  const Position& from = job.rounded(corners[end.edge]);
  const Position& to = job.rounded(corners[end.edge + 1 < corners.size() ? end.edge + 1 : 0]);
  const VertexSigns::Base plane =
      VertexSigns::base(job.rounded(others[0]), job.rounded(others[1]), job.rounded(others[2]));
  double above = 0, below = 0;
  for (size_t k = 0; k < 3; ++k) {
    above += plane.normal[k] * (from[k] - plane.origin[k]);
    below += plane.normal[k] * (to[k] - plane.origin[k]);
  }
  const double way = above == below ? 0.5 : std::clamp(above / (above - below), 0.0, 1.0);
  Position point{};
  for (size_t k = 0; k < 3; ++k) point[k] = from[k] + way * (to[k] - from[k]);
  return point;
}

/// About the middle of what two polygons have in common.
Position middle_of(const Job& job, const Contact& c) {
  const Position lower = end_of(job, c, c.lower), upper = end_of(job, c, c.upper);
  Position middle{};
  for (size_t k = 0; k < 3; ++k) middle[k] = (lower[k] + upper[k]) / 2;
  return middle;
}

/// Operands that would stand in groups.
struct GroupedOperands {
  BooleanOp op;
  std::vector<uint32_t> operands;  ///< in their order in the operator
  size_t size;                     ///< of each group
};

/// Nothing if there can be no groups, or if operators would stand in them.
std::optional<GroupedOperands> grouped_operands(const Expression& expression) {
  if (!can_be_grouped(expression)) return std::nullopt;
  const Groupable wide = most_groupable(expression);
  GroupedOperands result{wide.op, {}, wide.size};
  for (const uint32_t n : wide.children) {
    if (!expression.nodes[n].is_operand) return std::nullopt;
    result.operands.push_back(expression.nodes[n].operand);
  }
  return result;
}

double dot(const Position& a, const Position& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

class CoverSample {
 public:
  CoverSample(const Job& job, const GroupedOperands& grouped)
      : job_(job),
        grouped_(grouped),
        decisive_(grouped.op == BooleanOp::kUnion ? Inside::kYes : Inside::kNo),
        place_(job.operand_count(), kNowhere),
        signs_(job, true),
        boxes_(job) {
    for (uint32_t i = 0; i < grouped.operands.size(); ++i) place_[grouped.operands[i]] = i;
  }

  /// Whether a point of an operand, and maybe of another one, is told to be boundary of nothing by
  /// a third one of its group.
  bool is_covered(const Position& point, uint32_t own, uint32_t other) {
    const double error = std::max(signs_.error(own), signs_.error(other)) + kRounding;
    return any_in_group(
        own, [&](uint32_t third) { return third != other && decides(point, third, error); });
  }

  /// Whether a point of a polygon is also in a coplanar one of another operand of its group that
  /// leaves nothing of it: one that comes before it, or that faces it.
  bool is_covered_in_plane(const Position& point, uint32_t polygon) {
    const uint32_t own = job_.polygons()[polygon].operand;
    return any_in_group(own, [&](uint32_t third) {
      const double error = std::max(signs_.error(own), signs_.error(third)) + kRounding;
      if (!may_hold(job_.operand_box(third), point, error)) return false;
      for (uint32_t p = job_.polygon_start(third); p < job_.polygon_start(third + 1); ++p) {
        if (!may_hold(job_.boxes()[p], point, error) || !is_in_plane(polygon, p)) continue;
        const Position normal = base_of(polygon).normal;
        if (!is_around(p, point, normal)) continue;
        return place_[third] < place_[own] || dot(normal, base_of(p).normal) < 0;
      }
      return false;
    });
  }

 private:
  static constexpr uint32_t kNowhere = UINT32_MAX;

  /// Whether `is_wanted` holds for another operand of the group in which one stands.
  template <class Wanted>
  bool any_in_group(uint32_t own, Wanted&& is_wanted) {
    const uint32_t place = place_[own];
    if (place == kNowhere) return false;
    const size_t begin = place / grouped_.size * grouped_.size;
    const size_t end = std::min(begin + grouped_.size, grouped_.operands.size());
    return std::any_of(grouped_.operands.begin() + static_cast<std::ptrdiff_t>(begin),
                       grouped_.operands.begin() + static_cast<std::ptrdiff_t>(end),
                       [&](uint32_t other) { return other != own && is_wanted(other); });
  }

  [[nodiscard]] VertexSigns::Base base_of(uint32_t polygon) const {
    const auto corners = job_.corners(job_.polygons()[polygon]);
    return VertexSigns::base(job_.rounded(corners[0]), job_.rounded(corners[1]),
                             job_.rounded(corners[2]));
  }

  /// Whether the corners of a polygon are in the plane of another one, or so near that doubles do
  /// not tell.
  bool is_in_plane(uint32_t plane, uint32_t polygon) {
    const auto of_plane = job_.corners(job_.polygons()[plane]);
    const auto corners = job_.corners(job_.polygons()[polygon]);
    const double error = std::max(signs_.error(job_.polygons()[plane].operand),
                                  signs_.error(job_.polygons()[polygon].operand));
    return std::all_of(corners.begin(), corners.end(), [&](uint32_t v) {
      const int side = signs_.orient(job_.rounded(of_plane[0]), job_.rounded(of_plane[1]),
                                     job_.rounded(of_plane[2]), job_.rounded(v), error);
      return side == 0 || side == kUnsure;
    });
  }

  /// Whether a polygon in a plane with that normal goes round a point of it, about.
  [[nodiscard]] bool is_around(uint32_t polygon, const Position& point,
                               const Position& normal) const {
    const auto corners = job_.corners(job_.polygons()[polygon]);
    bool left = false, right = false;
    for (size_t i = 0; i < corners.size(); ++i) {
      const Position& to = job_.rounded(corners[i + 1 < corners.size() ? i + 1 : 0]);
      const double turn =
          dot(normal, VertexSigns::base(job_.rounded(corners[i]), to, point).normal);
      left |= turn > 0;
      right |= turn < 0;
    }
    return left != right;
  }

  bool decides(const Position& point, uint32_t operand, double error) {
    if (!may_hold(job_.operand_box(operand), point, error)) return decisive_ == Inside::kNo;
    return ray_label(job_, signs_, boxes_, operand, point, error) == decisive_;
  }

  const Job& job_;
  const GroupedOperands& grouped_;
  const Inside decisive_;        ///< that a point is inside of another one, or that it is not
  std::vector<uint32_t> place_;  ///< by operand, among those that are grouped
  VertexSigns signs_;
  RayBoxes boxes_;
};

}  // namespace

double cover_in_groups(const Job& job, const Expression& expression) {
  const std::optional<GroupedOperands> wide = grouped_operands(expression);
  if (!wide) return 0;
  CoverSample sample(job, *wide);
  // All over the operands and over the polygons of each: steps that have nothing in common with
  // how these are ordered.
  constexpr size_t kStep = 7919;
  size_t points = 0, covered = 0;
  Spread spread;
  for (size_t i = 0; i < kPoints; ++i) {
    const size_t child = i * wide->operands.size() / kPoints;
    const uint32_t own = wide->operands[child];
    const uint32_t first = job.polygon_start(own), count = job.polygon_start(own + 1) - first;
    if (count == 0) continue;
    const auto polygon = first + static_cast<uint32_t>(i * kStep % count);
    spread.step();
    const Position point = spread.in(job, polygon);
    ++points;
    const bool is_covered =
        sample.is_covered(point, own, own) || sample.is_covered_in_plane(point, polygon);
    covered += is_covered ? 1 : 0;
  }
  return points == 0 ? 0 : static_cast<double>(covered) / static_cast<double>(points);
}

namespace {

/// The part of plain contacts, the same ones each time, for which `is_covered(a, b, middle)` holds:
/// of operands a and b, about the middle of what their faces have in common.
template <class Covered>
double covered_part(const Job& job, std::span<const Contact> contacts, Covered&& is_covered) {
  size_t points = 0, covered = 0;
  for (size_t i = 0; i < kPoints; ++i) {
    const size_t begin = i * contacts.size() / kPoints, end = (i + 1) * contacts.size() / kPoints;
    const auto some = contacts.subspan(begin, end - begin);
    const auto plain =
        std::find_if(some.begin(), some.end(), [](const Contact& c) { return c.is_plain; });
    if (plain == some.end()) continue;
    const uint32_t a = job.polygons()[plain->p].operand, b = job.polygons()[plain->q].operand;
    ++points;
    covered += is_covered(a, b, middle_of(job, *plain)) ? 1 : 0;
  }
  return points == 0 ? 0 : static_cast<double>(covered) / static_cast<double>(points);
}

}  // namespace

double contact_cover_in_groups(const Job& job, const Expression& expression,
                               std::span<const Contact> contacts) {
  const std::optional<GroupedOperands> wide = grouped_operands(expression);
  if (!wide) return 0;
  CoverSample sample(job, *wide);
  return covered_part(job, contacts, [&](uint32_t a, uint32_t b, const Position& middle) {
    return sample.is_covered(middle, a, b) || sample.is_covered(middle, b, a);
  });
}

double hidden_contacts(const Job& job, const Expression& expression,
                       std::span<const Contact> contacts) {
  const PrunedExpression pruned(expression);
  VertexSigns signs(job, true);
  RayBoxes boxes(job);
  std::vector<Inside> scratch;
  return covered_part(job, contacts, [&](uint32_t a, uint32_t b, const Position& middle) {
    const auto label_of = [&](uint32_t operand) {
      if (operand == a || operand == b) return Inside::kUnknown;
      const double error =
          std::max({signs.error(a), signs.error(b), signs.error(operand)}) + kRounding;
      if (!may_hold(job.operand_box(operand), middle, error)) return Inside::kNo;
      return ray_label(job, signs, boxes, operand, middle, error);
    };
    return pruned.evaluate(label_of, scratch) != Inside::kUnknown;
  });
}

double meeting_boxes(const Job& job) {
  const auto& all = job.boxes();
  if (all.empty()) return 0;
  constexpr size_t kStep = 7919;
  double meeting = 0;
  for (size_t i = 0; i < kPoints; ++i) {
    const size_t polygon = (i * all.size() / kPoints + i * kStep) % all.size();
    const uint32_t own = job.polygons()[polygon].operand;
    for (uint32_t o = 0; o < job.operand_count(); ++o) {
      const size_t first = job.polygon_start(o), count = job.polygon_start(o + 1) - first;
      if (o == own || count == 0 || !job.operand_box(o).meets(all[polygon])) continue;
      const size_t asked = std::min(count, kPoints);
      size_t met = 0;
      for (size_t k = 0; k < asked; ++k) {
        met += all[first + k * count / asked].meets(all[polygon]) ? 1 : 0;
      }
      meeting += static_cast<double>(met) * static_cast<double>(count) / static_cast<double>(asked);
    }
  }
  return meeting / static_cast<double>(kPoints);
}

}  // namespace csgrun
