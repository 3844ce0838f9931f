#include "engine/bsp/piece_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace csgrun {
namespace {

/// Points inside of pieces are looked for on a grid so much finer than that of vertices.
constexpr int kFineShift = 22;
constexpr int64_t kFine = int64_t{1} << kFineShift;
/// Coordinates in fine steps, widths::kFarGrid + kFineShift bits at most.
constexpr double kMostFine = 0x1p62;

using Wide = Int<4>;
Wide wide(Int128 v) { return Wide::from_int128(v); }

int sign(Int128 v) { return (v > 0) - (v < 0); }

Int128 coefficient(const Plane& plane, size_t axis) {
  return axis == 0 ? plane.a : axis == 1 ? plane.b : plane.c;
}

PackedBoxes tree_over(const Job& job) {
  std::vector<FloatBox> boxes;
  boxes.reserve(job.boxes().size());
  for (const PolygonBox& box : job.boxes()) {
    FloatBox& b = boxes.emplace_back();
    for (size_t k = 0; k < 3; ++k) {
      b.lo[k] = static_cast<float>(box.lo[k]);
      b.hi[k] = static_cast<float>(box.hi[k]);
    }
  }
  return PackedBoxes(boxes);
}

/// fine * (u, v part of the plane's value on the line, and its offset). A coefficient has 82 bits
/// (widths::normal of the far grid), a place on the line 62, an offset 122.
template <class Line>
Wide base_value(const Plane& plane, const Line& line) {
  return multiply<4>(wide(coefficient(plane, line.u)), Wide(line.at[0])) +
         multiply<4>(wide(coefficient(plane, line.v)), Wide(line.at[1])) +
         multiply<4>(wide(plane.d), Wide(kFine));
}

/// The side of a plane on which the line meets another one, which it is not parallel to.
template <class Line>
int side_where_met(const Plane& plane, const Plane& met, const Line& line) {
  const Int128 along = coefficient(met, line.axis);
  const Wide value = multiply<4>(base_value(plane, line), wide(along)) -
                     multiply<4>(base_value(met, line), wide(coefficient(plane, line.axis)));
  return value.sign() * sign(along);
}

}  // namespace

PieceRays::PieceRays(const Job& job, CellGeometry& geometry)
    : job_(job), geometry_(geometry), tree_(tree_over(job)) {}

std::optional<PieceRays::Line> PieceRays::line_through(const Fragment& piece,
                                                       const Plane& plane) const {
  Line line{};
  for (size_t k = 1; k < 3; ++k) {
    if (magnitude(coefficient(plane, k)) > magnitude(coefficient(plane, line.axis))) line.axis = k;
  }
  line.u = (line.axis + 1) % 3, line.v = (line.axis + 2) % 3;
  std::array<double, 2> middle{0, 0};
  for (const uint32_t corner : std::span(geometry_.corners(piece), piece.count)) {
    const auto& at = geometry_.point(corner).rounded;
    middle[0] += at[line.u] / piece.count, middle[1] += at[line.v] / piece.count;
  }
  for (size_t i = 0; i < 2; ++i) {
    const double fine = middle[i] * static_cast<double>(kFine);
    if (!(std::fabs(fine) < kMostFine)) return std::nullopt;
    line.at[i] = std::llround(fine);
  }
  for (uint32_t e = 0; e < piece.count; ++e) {
    const uint32_t edge = geometry_.edges(piece)[e];
    int inner = 0;
    for (uint32_t k = 2; k < piece.count && inner == 0; ++k) {
      inner = geometry_.side(edge, geometry_.corners(piece)[(e + k) % piece.count]);
    }
    const int side = side_where_met(job_.planes().plane(edge), plane, line);
    if (inner == 0 || side != inner) return std::nullopt;
  }
  return line;
}

/// How often a polygon's boundary turns around the line, moved by e along u and by e^2 along v,
/// seen from where the axis points.
int PieceRays::turns_around(uint32_t polygon, const Line& line) const {
  const auto corners = job_.corners(job_.polygons()[polygon]);
  const auto place = [&](uint32_t vertex) {
    const auto& p = job_.rounded(vertex);  // whole numbers
    return std::array{static_cast<int64_t>(p[line.u]), static_cast<int64_t>(p[line.v])};
  };
  int turns = 0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const auto a = place(corners[i]), b = place(corners[i + 1 < corners.size() ? i + 1 : 0]);
    const bool a_above = Int128{kFine} * a[1] > line.at[1],
               b_above = Int128{kFine} * b[1] > line.at[1];
    if (a_above == b_above) continue;
    int left = sign((b[0] - a[0]) * (line.at[1] - Int128{kFine} * a[1]) -
                    (b[1] - a[1]) * (line.at[0] - Int128{kFine} * a[0]));
    if (left == 0) left = b_above ? -1 : 1;
    if (b_above && left > 0) ++turns;
    if (a_above && left < 0) --turns;
  }
  return turns;
}

Plane PieceRays::plane_of(uint32_t polygon) const {
  const auto corners = job_.corners(job_.polygons()[polygon]);
  const auto whole = [&](uint32_t vertex, size_t k) {
    return static_cast<int64_t>(job_.rounded(vertex)[k]);
  };
  for (size_t i = 1; i + 1 < corners.size(); ++i) {
    std::array<Int128, 3> n{};
    for (size_t k = 0; k < 3; ++k) {
      const size_t u = (k + 1) % 3, v = (k + 2) % 3;
      const auto from = [&](uint32_t vertex, size_t axis) {
        return static_cast<Int128>(whole(vertex, axis) - whole(corners[0], axis));
      };
      n[k] = from(corners[i], u) * from(corners[i + 1], v) -
             from(corners[i], v) * from(corners[i + 1], u);
    }
    if (n == std::array<Int128, 3>{}) continue;
    Int128 d = 0;
    for (size_t k = 0; k < 3; ++k) d -= n[k] * whole(corners[0], k);
    return {n[0], n[1], n[2], d};
  }
  return {};
}

std::optional<int32_t> PieceRays::winding_in_front(const Fragment& piece) const {
  const Plane plane = job_.planes().oriented(piece.support);
  const auto line = line_through(piece, plane);
  if (!line) return std::nullopt;
  const bool rises = coefficient(plane, line->axis) > 0;  // the ray, which starts in front
  FloatBox ray;
  for (size_t i = 0; i < 2; ++i) {
    const double at = static_cast<double>(line->at[i]) / static_cast<double>(kFine);
    ray.lo[i == 0 ? line->u : line->v] = static_cast<float>(std::floor(at) - 1);
    ray.hi[i == 0 ? line->u : line->v] = static_cast<float>(std::ceil(at) + 1);
  }
  double start = geometry_.point(geometry_.corners(piece)[0]).rounded[line->axis];
  for (const uint32_t corner : std::span(geometry_.corners(piece), piece.count)) {
    const double at = geometry_.point(corner).rounded[line->axis];
    start = rises ? std::min(start, at) : std::max(start, at);
  }
  constexpr float kEnd = std::numeric_limits<float>::max();
  ray.lo[line->axis] = rises ? static_cast<float>(std::floor(start) - 1) : -kEnd;
  ray.hi[line->axis] = rises ? kEnd : static_cast<float>(std::ceil(start) + 1);
  int32_t winding = 0;
  tree_.visit_all(ray, [&](uint32_t place) {
    const uint32_t polygon = tree_.order()[place];
    const int turns = turns_around(polygon, *line);
    if (turns == 0) return;
    // Polygons that face the way of the ray are left through their fronts. What lies where the
    // piece does is behind the start.
    const int side = side_where_met(plane_of(polygon), plane, *line);
    const int outwards = rises ? turns : -turns;
    if (side * outwards < 0) winding += outwards;
  });
  return winding;
}

}  // namespace csgrun
