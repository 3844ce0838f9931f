#include "engine/bsp/ray_label.h"

#include <limits>
#include <span>
#include <vector>

#include "engine/bsp/piece_store.h"

namespace csgrun {
namespace {

using Position = std::array<double, 3>;

/// Rays run along (1, y, z): aslant, as coordinates along axes are often equal.
struct Direction {
  double y, z;
};
constexpr Direction kDirections[] = {
    {0.0142578125, 0.0081787109375}, {0.0313720703125, 0.0117}, {0.0057373046875, 0.0427}};

constexpr double kBoxLimit = 0x1p30;  // boxes are clamped there

class Ray {
 public:
  Ray(VertexSigns& signs, const Position& from, double error, const Direction& direction)
      : signs_(signs), from_(from), error_(error), direction_(direction) {}

  [[nodiscard]] bool may_meet(const PolygonBox& box) const {
    for (int k = 0; k < 3; ++k) {
      if (box.hi[k] < from_[k] - error_) return false;
    }
    // Twice as far as the ray gets: rounding is no matter.
    const double reach = box.hi[0] >= kBoxLimit ? std::numeric_limits<double>::infinity()
                                                : 2 * (box.hi[0] - from_[0]) + 1;
    return box.lo[1] <= from_[1] + error_ + reach * direction_.y &&
           box.lo[2] <= from_[2] + error_ + reach * direction_.z;
  }

  /// Whether the ray meets a convex polygon, the corners of which are as wrong as `error` at most.
  Inside meets(std::span<const Position> corners, double polygon_error) {
    const double error = std::max(error_, polygon_error);
    // Corners relative to the start, sheared so that the ray is the first axis.
    y_.resize(corners.size());
    z_.resize(corners.size());
    double reach = 0;
    for (size_t i = 0; i < corners.size(); ++i) {
      const Position& c = corners[i];
      const double dx = c[0] - from_[0], dy = c[1] - from_[1], dz = c[2] - from_[2];
      y_[i] = dy - direction_.y * dx;
      z_[i] = dz - direction_.z * dx;
      reach = std::max({reach, std::fabs(dx), std::fabs(dy), std::fabs(dz)});
    }
    // Of each: two rounded coordinates, three roundings of values below 2 reach.
    const double e = 4 * error + 0x1p-50 * reach;
    const auto beside = [&](const std::vector<double>& v) {
      return std::all_of(v.begin(), v.end(), [&](double x) { return x > e; }) ||
             std::all_of(v.begin(), v.end(), [&](double x) { return x < -e; });
    };
    if (beside(y_) || beside(z_)) return Inside::kNo;
    double most = 0;
    for (size_t i = 0; i < y_.size(); ++i)
      most = std::max({most, std::fabs(y_[i]), std::fabs(z_[i])});
    // A turn is off by 4 e most + 2 e e, and by its own three roundings, which are less than
    // 2^-51 most most: most is below 2 reach, and e no less than 2^-50 reach.
    const double bound = 5 * e * most + 2 * e * e;
    bool left = false, right = false, unsure = false;
    for (size_t i = 0; i < y_.size(); ++i) {
      const size_t j = i + 1 < y_.size() ? i + 1 : 0;
      const double turn = y_[i] * z_[j] - z_[i] * y_[j];
      left |= turn > bound;
      right |= turn < -bound;
      unsure |= std::fabs(turn) <= bound;
    }
    if (left && right) return Inside::kNo;  // a convex loop that goes round is seen from one side
    if (unsure) return Inside::kUnknown;
    const int side = side_of_start(corners, error);
    if (side == 0 || side == kUnsure) return Inside::kUnknown;
    return side == (left ? -1 : 1) ? Inside::kYes : Inside::kNo;
  }

 private:
  int side_of_start(std::span<const Position> c, double error) {
    // Corners may stand in line: any three that turn will do.
    for (size_t i = 1; i + 1 < c.size(); ++i) {
      const int s = signs_.orient(c[0], c[i], c[i + 1], from_, error);
      if (s != 0) return s;
    }
    return 0;
  }

  VertexSigns& signs_;
  const Position from_;
  const double error_;
  const Direction direction_;
  std::vector<double> y_, z_;
};

}  // namespace

Inside ray_label(const Job& job, VertexSigns& signs, uint32_t operand, const Position& point,
                 double error) {
  for (const double c : point) {
    if (std::fabs(c) >= kBoxLimit) return Inside::kUnknown;
  }
  const double operand_error = signs.error(operand);
  std::vector<Position> corners;
  for (const Direction& direction : kDirections) {
    Ray ray(signs, point, error, direction);
    bool inside = false, unsure = false;
    const auto look_at = [&] {
      const Inside met = ray.meets(corners, operand_error);
      unsure |= met == Inside::kUnknown;
      inside ^= met == Inside::kYes;
    };
    if (const PieceOperand* all = job.pieces(operand)) {
      const PieceStore& store = *all->store;
      all->pieces.each(
          [&](const PieceBox& box) { return !unsure && ray.may_meet(rounded_outwards(box)); },
          [&](uint32_t piece) {
            if (unsure || !ray.may_meet(rounded_outwards(store.box(piece)))) return;
            corners.clear();
            for (const uint32_t p : store.corners(piece)) corners.push_back(store.rounded(p));
            look_at();
          });
    } else {
      for (uint32_t p = job.polygon_start(operand); p < job.polygon_start(operand + 1) && !unsure;
           ++p) {
        if (!ray.may_meet(job.boxes()[p])) continue;
        corners.clear();
        for (const uint32_t v : job.corners(job.polygons()[p])) corners.push_back(job.rounded(v));
        look_at();
      }
    }
    if (!unsure) return inside ? Inside::kYes : Inside::kNo;
  }
  return Inside::kUnknown;
}

}  // namespace csgrun
