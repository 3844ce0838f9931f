// Random faces on small integer grids for the triangulation's tests, and the checks of its results.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "engine/mesh/triangulate.h"

namespace csgrun::test {

using FlatPoint = std::array<int64_t, 2>;
using FlatLoop = std::vector<uint32_t>;

inline int64_t cross(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Sweeps along `first`, ties along `second`.
class GridOracle : public PlanarOracle {
 public:
  explicit GridOracle(std::vector<FlatPoint> points, FlatPoint first = {1, 0},
                      FlatPoint second = {0, 1})
      : points_(std::move(points)), first_(first), second_(second) {}

  int orient(uint32_t a, uint32_t b, uint32_t c) const override;
  int compare(uint32_t a, uint32_t b) const override;
  double along(uint32_t a) const override;
  const std::vector<FlatPoint>& points() const { return points_; }

 private:
  std::vector<FlatPoint> points_;
  FlatPoint first_, second_;
};

int64_t twice_area(const std::vector<FlatLoop>& loops, const std::vector<FlatPoint>& points);

/// Why `triangles` is not a triangulation of the face, or nullptr. Positive triangles whose
/// directed edges are those of the loops and pairs of opposite ones, and whose areas add up to the
/// face's, cover the face once.
const char* fault(const std::vector<FlatLoop>& loops, const std::vector<FlatPoint>& points,
                  const std::vector<std::array<uint32_t, 3>>& triangles);

/// A random triangulation of the (n+1)^2 points of a grid, by random flips.
std::vector<std::array<uint32_t, 3>> random_triangulation(int n,
                                                          const std::vector<FlatPoint>& points,
                                                          int flips, std::mt19937& random);

/// The loops of a random connected (through edges) patch of the triangles.
std::vector<FlatLoop> random_patch(const std::vector<std::array<uint32_t, 3>>& triangles,
                                   double density, std::mt19937& random);

std::vector<FlatPoint> grid_points(int n);

}  // namespace csgrun::test
