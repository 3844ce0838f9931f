#include "engine/mesh/long_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/base/parallel.h"
#include "engine/mesh/triangle_shape.h"

namespace csgrun {
namespace {

/// Coordinates from the middle of the mesh are brought below this by a power of two.
constexpr double kReach = 0x1p28;
/// Where they are below this before, or above, nothing is told.
constexpr int kMostExponent = 900;

}  // namespace

LongTriangles::LongTriangles(const TriangleView& mesh, std::span<const uint32_t> order) {
  if (order.empty()) return;
  Box all = box_of(corners_of(mesh, order[0]));
  for (const uint32_t t : order) all.include(box_of(corners_of(mesh, t)));
  double half = 0;
  glm::dvec3 middle;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<size_t>(k);
    middle[k] = all.lo[axis] / 2 + all.hi[axis] / 2;
    half = std::max(half, all.hi[axis] / 2 - all.lo[axis] / 2);
  }
  // (What rounding adds to the way from the middle is less than a thousandth of the slack.)
  int exponent = 0;
  std::frexp(half, &exponent);
  if (half == 0 || std::abs(exponent) > kMostExponent) return;
  const double scale = std::ldexp(kReach, -exponent);
  slabs_.resize((order.size() + 7) / 8);
  for_each_range(slabs_.size(), [&](size_t begin, size_t end) {
    for (size_t group = begin; group < end; ++group) {
      const std::span<const uint32_t> own =
          order.subspan(8 * group, std::min<size_t>(8, order.size() - 8 * group));
      EightSlabs::Corners corners{};
      for (size_t lane = 0; lane < own.size(); ++lane) {
        const TriangleCorners t = corners_of(mesh, own[lane]);
        for (size_t i = 0; i < 3; ++i) {
          for (int k = 0; k < 3; ++k) {
            corners[i][static_cast<size_t>(k)][lane] =
                static_cast<float>((t[i][k] - middle[k]) * scale);
          }
        }
      }
      slabs_[group] = EightSlabs(corners, (1u << own.size()) - 1, kReach);
    }
  });
}

}  // namespace csgrun
