// The integer grid of 2D shapes: points, exact orientation, and the way there and back.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

namespace csgrun {

using int128 = __int128;

/// Coordinates are below 2^40 in absolute value: a crossing point is then rounded exactly in 128
/// bits (a difference has 41 bits, a cross product 83, their product 124).
constexpr int64_t kMostGrid2D = int64_t{1} << 40;

struct Point2D {
  int64_t x = 0, y = 0;
  auto operator<=>(const Point2D&) const = default;
  friend Point2D operator-(const Point2D& a, const Point2D& b) { return {a.x - b.x, a.y - b.y}; }
  friend Point2D operator-(const Point2D& a) { return {-a.x, -a.y}; }
};

inline int128 cross(const Point2D& a, const Point2D& b) {
  return static_cast<int128>(a.x) * b.y - static_cast<int128>(a.y) * b.x;
}

inline int128 dot(const Point2D& a, const Point2D& b) {
  return static_cast<int128>(a.x) * b.x + static_cast<int128>(a.y) * b.y;
}

inline int sign(int128 v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }

/// +1 when a, b, c turn left, -1 right, 0 when they are collinear.
inline int orient(const Point2D& a, const Point2D& b, const Point2D& c) {
  return sign(cross(b - a, c - a));
}

using GridLoop = std::vector<Point2D>;

/// A decimal grid: the step is 2^g nanometres with g = -6, -3, 0, 3 ...
class Grid2D {
 public:
  /// The finest grid that holds coordinates up to `extent` mm; nothing beyond 1e12 mm.
  static std::optional<Grid2D> for_extent(double extent);

  /// Nearest grid point. Half a step goes up, with 2^-12 of a step to spare for the noise of
  /// doubles (the rule by which leaves are quantised).
  [[nodiscard]] Point2D snap(const glm::dvec2& p) const;
  /// The double nearest to the decimal that the grid point stands for.
  [[nodiscard]] glm::dvec2 unsnap(const Point2D& p) const;
  [[nodiscard]] double steps_per_mm() const { return steps_per_mm_; }

 private:
  explicit Grid2D(double steps_per_mm) : steps_per_mm_(steps_per_mm) {}
  double steps_per_mm_;
};

}  // namespace csgrun
