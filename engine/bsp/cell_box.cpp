#include "engine/bsp/cell_box.h"

#include <cmath>

namespace csgrun {
namespace {

double distance_to(const double* center, const std::array<double, 3>& p) {
  return std::max(
      {std::fabs(center[0] - p[0]), std::fabs(center[1] - p[1]), std::fabs(center[2] - p[2])});
}

/// Separating axes in doubles: the polygon's normal, and in the projection along its longest
/// component the normals of its edges. Margins cover the rounding: coordinates are off by 2^-23 at
/// most (rounded vertices below 2^30), products by 2^-52 of their size.
bool separated(const Job& job, uint32_t polygon, const CellBox& cell) {
  const auto corners = job.corners(job.polygons()[polygon]);
  double center[3], half[3], reach_of_cell = 0;
  for (int k = 0; k < 3; ++k) {
    half[k] = static_cast<double>(cell.hi[k] - cell.lo[k]) * 0.5 + 1;
    center[k] = static_cast<double>(cell.lo[k]) + half[k];
    reach_of_cell = std::max(reach_of_cell, half[k]);
  }
  const auto &a = job.rounded(corners[0]), &b = job.rounded(corners[1]),
             &c = job.rounded(corners[2]);
  double u[3], v[3], n[3], length = 0, distance = 0;
  for (int k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
    length = std::max({length, std::fabs(u[k]), std::fabs(v[k])});
    distance = std::max(distance, std::fabs(center[k] - a[k]));
  }
  double value = 0, reach = 0;
  const double normal_error = 0x1p-50 * length * length + 0x1p-21 * length;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    n[k] = u[i] * v[j] - u[j] * v[i];
    value += n[k] * (center[k] - a[k]);
    reach += std::fabs(n[k]) * (half[k] + 1);
  }
  if (std::fabs(value) > reach * (1 + 0x1p-40) + 4 * normal_error * (distance + reach_of_cell)) {
    return true;
  }
  const int axis = std::fabs(n[0]) >= std::fabs(n[1]) && std::fabs(n[0]) >= std::fabs(n[2]) ? 0
                   : std::fabs(n[1]) >= std::fabs(n[2])                                     ? 1
                                                                                            : 2;
  if (std::fabs(n[axis]) <= 4 * normal_error) return false;  // too thin to have a sure orientation
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const double sign = n[axis] > 0 ? 1 : -1;
  for (size_t k = 0; k < corners.size(); ++k) {
    const auto &p = job.rounded(corners[k]),
               &q = job.rounded(corners[k + 1 < corners.size() ? k + 1 : 0]);
    const double du = q[i] - p[i], dv = q[j] - p[j];
    // Left of the edge is inside: the cell is outside when its leftmost corner is right of it.
    const double left = sign * (du * (center[j] - p[j]) - dv * (center[i] - p[i]));
    const double spread = std::fabs(du) * (half[j] + 1) + std::fabs(dv) * (half[i] + 1);
    // The corner may be farther off than the center: cells may be long and thin.
    const double margin = (std::fabs(du) + std::fabs(dv)) * 0x1p-20 +
                          0x1p-20 * (distance_to(center, p) + reach_of_cell);
    if (left < -spread * (1 + 0x1p-40) - margin) return true;
  }
  return false;
}

}  // namespace

CellBox root_cell(const GridBox& region, const std::array<uint32_t, 3>& shift) {
  CellBox box;
  int64_t extent = 1;
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = region.lo[k] - 1 - shift[k];
    extent = std::max(extent, region.hi[k] + 1 - box.lo[k]);
  }
  int64_t size = 1;
  while (size < extent) size *= 2;
  for (int k = 0; k < 3; ++k) box.hi[k] = box.lo[k] + size;
  return box;
}

bool may_meet(const Job& job, uint32_t polygon, const CellBox& cell) {
  const PolygonBox& b = job.boxes()[polygon];
  int larger = 0;
  for (int k = 0; k < 3; ++k) {
    if (b.hi[k] <= cell.lo[k] || b.lo[k] > cell.hi[k]) return false;
    larger += b.lo[k] < cell.lo[k] || b.hi[k] > cell.hi[k];
  }
  return larger == 0 || !separated(job, polygon, cell);
}

}  // namespace csgrun
