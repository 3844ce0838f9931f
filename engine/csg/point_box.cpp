#include "engine/csg/point_box.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

namespace csgrun {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool is_finite(const PointBox& box) {
  bool all = true;
  for (int i = 0; i < 3; ++i) all &= std::isfinite(box.lo[i]) && std::isfinite(box.hi[i]);
  return all;
}

}  // namespace

PointBox PointBox::nothing() { return {glm::dvec3(kInfinity), glm::dvec3(-kInfinity)}; }
PointBox PointBox::everything() { return {glm::dvec3(-kInfinity), glm::dvec3(kInfinity)}; }

void PointBox::include(const glm::dvec3& p) {
  lo = glm::min(lo, p);
  hi = glm::max(hi, p);
}

void PointBox::include(const PointBox& other) {
  lo = glm::min(lo, other.lo);
  hi = glm::max(hi, other.hi);
}

bool PointBox::is_nothing() const { return lo.x > hi.x || lo.y > hi.y || lo.z > hi.z; }

bool PointBox::meets(const PointBox& other) const {
  bool all = !is_nothing() && !other.is_nothing();
  for (int i = 0; i < 3; ++i) all &= lo[i] <= other.hi[i] && hi[i] >= other.lo[i];
  return all;
}

bool PointBox::holds(const PointBox& other) const {
  bool all = true;
  for (int i = 0; i < 3; ++i) all &= lo[i] <= other.lo[i] && hi[i] >= other.hi[i];
  return all;
}

PointBox box_of(const PolygonMesh& mesh) {
  PointBox box = PointBox::nothing();
  for (const glm::dvec3& p : mesh.points) box.include(p);
  return box;
}

double PointBox::size() const {
  const glm::dvec3 length = hi - lo;
  return is_nothing() ? 0 : std::max({length.x, length.y, length.z});
}

PointBox common(const PointBox& a, const PointBox& b) {
  const PointBox result{glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)};
  return result.is_nothing() ? PointBox::nothing() : result;
}

PointBox widened(PointBox box) {
  for (int i = 0; i < 3; ++i) {
    const double noise = 1e-9 * std::max(std::fabs(box.lo[i]), std::fabs(box.hi[i]));
    box.lo[i] -= noise;
    box.hi[i] += noise;
  }
  return is_finite(box) ? box : PointBox::everything();
}

PointBox image(const Affine& map, const PointBox& box) {
  if (box.is_nothing()) return box;
  PointBox result;
  for (int i = 0; i < 3; ++i) {
    double lo = map.m[i][3], hi = map.m[i][3];
    for (int j = 0; j < 3; ++j) {
      const double a = map.m[i][j] * box.lo[j], b = map.m[i][j] * box.hi[j];
      lo += std::min(a, b);
      hi += std::max(a, b);
    }
    result.lo[i] = lo;
    result.hi[i] = hi;
  }
  return is_finite(result) ? result : PointBox::everything();
}

PointBox original(const Affine& map, const PointBox& box) {
  const auto& m = map.m;
  Affine back;
  double product = 1;
  for (int i = 0; i < 3; ++i) {
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int c = (j + 1) % 3, d = (j + 2) % 3;
      back.m[j][i] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
    }
    product *= std::hypot(m[i][0], m[i][1], m[i][2]);
  }
  const double det = m[0][0] * back.m[0][0] + m[0][1] * back.m[1][0] + m[0][2] * back.m[2][0];
  constexpr double kLeastSquare = 1e-3;  // else the noise would be more than is allowed for
  if (!(std::fabs(det) > kLeastSquare * product)) return PointBox::everything();
  for (auto& row : back.m) {
    for (int j = 0; j < 3; ++j) row[j] /= det;
    row[3] = 0;
  }
  PointBox moved = box;
  for (int i = 0; i < 3; ++i) {
    moved.lo[i] -= m[i][3];
    moved.hi[i] -= m[i][3];
    const double noise = 1e-12 * std::fabs(m[i][3]);
    moved.lo[i] -= noise;
    moved.hi[i] += noise;
  }
  return widened(image(back, widened(moved)));
}

}  // namespace csgrun
