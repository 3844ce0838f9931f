#include "lua_bindings/affine_maps.h"

#include <algorithm>
#include <cmath>

#include <csgrun/primitives/trig.h>

namespace csgrun {
namespace {

/// The same direction with a largest coordinate of 1, so that no square leaves the range; 0 stays.
glm::dvec3 moderate(const glm::dvec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest > 0 && (largest < 1e-100 || largest > 1e100) ? v / largest : v;
}

}  // namespace

Affine translation(const glm::dvec3& v) {
  Affine map;
  map.m[0][3] = v.x;
  map.m[1][3] = v.y;
  map.m[2][3] = v.z;
  return map;
}

Affine axis_rotation(int axis, double degrees) {
  const double c = cos_deg(degrees), s = sin_deg(degrees);
  const auto i = static_cast<size_t>((axis + 1) % 3), j = static_cast<size_t>((axis + 2) % 3);
  Affine map;
  map.m[i][i] = c;
  map.m[i][j] = -s;
  map.m[j][i] = s;
  map.m[j][j] = c;
  return map;
}

Affine rotation_about(const glm::dvec3& given, double degrees) {
  const glm::dvec3 axis = moderate(given);
  const double length = std::sqrt(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
  if (length == 0) return {};
  // Along a coordinate axis the matrix is exact; the general formula would round it.
  for (int i = 0; i < 3; ++i) {
    if (std::abs(axis[i]) == length) return axis_rotation(i, axis[i] > 0 ? degrees : -degrees);
  }
  const glm::dvec3 u(axis.x / length, axis.y / length, axis.z / length);
  const double c = cos_deg(degrees), s = sin_deg(degrees), t = 1 - c;
  Affine map;
  map.m[0] = {t * u.x * u.x + c, t * u.x * u.y - s * u.z, t * u.x * u.z + s * u.y, 0};
  map.m[1] = {t * u.x * u.y + s * u.z, t * u.y * u.y + c, t * u.y * u.z - s * u.x, 0};
  map.m[2] = {t * u.x * u.z - s * u.y, t * u.y * u.z + s * u.x, t * u.z * u.z + c, 0};
  return map;
}

Affine reflection(const glm::dvec3& normal) {
  const glm::dvec3 n = moderate(normal);
  const double square = n.x * n.x + n.y * n.y + n.z * n.z;
  Affine map;
  if (square == 0) return map;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      map.m[static_cast<size_t>(i)][static_cast<size_t>(j)] =
          (i == j ? 1.0 : 0.0) - 2 * n[i] * n[j] / square;
    }
  }
  return map;
}

std::optional<Affine> inverse(const Affine& map) {
  const auto& m = map.m;
  const auto minor = [&](size_t a, size_t b, size_t c, size_t d) {
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
  };
  const double det =
      m[0][0] * minor(1, 2, 1, 2) - m[0][1] * minor(1, 2, 0, 2) + m[0][2] * minor(1, 2, 0, 1);
  if (!std::isnormal(det)) return std::nullopt;
  Affine back;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      const size_t a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      back.m[i][j] = minor(a, b, c, d) / det;
    }
  }
  for (size_t i = 0; i < 3; ++i) {
    back.m[i][3] = 0;
    for (size_t j = 0; j < 3; ++j) back.m[i][3] -= back.m[i][j] * m[j][3];
  }
  for (const auto& row : back.m) {
    for (const double entry : row) {
      if (!std::isfinite(entry)) return std::nullopt;
    }
  }
  return back;
}

}  // namespace csgrun
