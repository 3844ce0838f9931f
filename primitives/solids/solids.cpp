// Cube, sphere and cylinder. Vertex positions and counts are OpenSCAD's; all are convex, and their
// facets are inscribed.
#include <algorithm>
#include <cmath>

#include <csgrun/primitives/solids.h>
#include <csgrun/primitives/trig.h>

#include "primitives/base/text.h"
#include "primitives/solids/check_facets.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

/// Checks a size that must be positive and finite.
std::optional<Error> check_size(const char* function, const char* argument, double value) {
  if (!std::isfinite(value)) return not_finite(function, argument, value);
  if (!(value > 0)) return not_positive(function, argument, value);
  return std::nullopt;
}

uint32_t surface_of(int fragments) { return 360.0 / fragments < kSmoothTurnDegrees ? 1 : 0; }

/// The directions of n points on a circle, the first on +X. Exact sines cost more than all else
/// that a sphere does, so a solid asks for them once.
std::vector<glm::dvec2> ring_directions(int n) {
  std::vector<glm::dvec2> directions;
  directions.reserve(static_cast<size_t>(n));
  for (int k = 0; k < n; ++k) {
    const double angle = 360.0 * k / n;
    directions.emplace_back(cos_deg(angle), sin_deg(angle));
  }
  return directions;
}

/// One horizontal ring of points; a radius of 0 makes one point. Returns the index of the first.
uint32_t add_ring(PolygonMesh& mesh, double r, double z,
                  const std::vector<glm::dvec2>& directions) {
  const auto first = static_cast<uint32_t>(mesh.points.size());
  if (r == 0) {
    mesh.points.emplace_back(0.0, 0.0, z);
    return first;
  }
  for (const glm::dvec2& d : directions) mesh.points.emplace_back(r * d.x, r * d.y, z);
  return first;
}

/// A horizontal n-gon, seen from above counter-clockwise when `up`.
void add_cap(PolygonMesh& mesh, uint32_t first, int n, bool up) {
  std::vector<uint32_t> loop(n);
  for (int k = 0; k < n; ++k) loop[k] = first + (up ? k : n - 1 - k);
  mesh.add_face(loop);
}

/// The band between a lower and an upper ring.
void add_band(PolygonMesh& mesh, uint32_t lower, bool lower_is_point, uint32_t upper,
              bool upper_is_point, int n, uint32_t surface_id) {
  for (int k = 0; k < n; ++k) {
    const uint32_t a = k, b = (k + 1) % n;
    if (lower_is_point) {
      mesh.add_face(std::array<uint32_t, 3>{lower, upper + b, upper + a}, surface_id);
    } else if (upper_is_point) {
      mesh.add_face(std::array<uint32_t, 3>{lower + a, lower + b, upper}, surface_id);
    } else {
      mesh.add_face(std::array<uint32_t, 4>{lower + a, lower + b, upper + b, upper + a},
                    surface_id);
    }
  }
}

}  // namespace

MeshResult make_cube(const glm::dvec3& size, std::array<bool, 3> center) {
  constexpr std::array<const char*, 3> kNames{"size.x", "size.y", "size.z"};
  std::array<std::array<double, 2>, 3> range{};
  for (int i = 0; i < 3; ++i) {
    if (auto error = check_size("cube", kNames[i], size[i])) return *error;
    range[i] = center[i] ? std::array<double, 2>{-size[i] / 2, size[i] / 2}
                         : std::array<double, 2>{0, size[i]};
  }
  PolygonMesh mesh;
  mesh.kind = "cube";
  mesh.convex = true;
  for (int i = 0; i < 8; ++i) {
    mesh.points.emplace_back(range[0][i & 1], range[1][(i >> 1) & 1], range[2][i >> 2]);
  }
  constexpr std::array<std::array<uint32_t, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}};
  for (const auto& face : kFaces) mesh.add_face(face);
  return mesh;
}

MeshResult make_sphere(double r, const Facets& facets) {
  if (auto error = check_size("sphere", "r", r)) return *error;
  if (auto error = check_facets("sphere", facets)) return *error;
  const int n = facets.fragments(r);
  const int rings = (n + 1) / 2;
  if (static_cast<double>(n) * rings > kMostPoints) {
    return too_many_points("sphere", n, static_cast<double>(n) * rings);
  }
  PolygonMesh mesh;
  mesh.kind = "sphere";
  mesh.convex = true;
  // The first ring is the top one. No vertex lies at a pole.
  const std::vector<glm::dvec2> directions = ring_directions(n);
  for (int i = 0; i < rings; ++i) {
    const double polar = 180.0 * (i + 0.5) / rings;
    add_ring(mesh, r * sin_deg(polar), r * cos_deg(polar), directions);
  }
  add_cap(mesh, 0, n, true);
  const uint32_t surface_id = surface_of(n);
  for (int i = 0; i + 1 < rings; ++i) {
    add_band(mesh, static_cast<uint32_t>(i + 1) * n, false, static_cast<uint32_t>(i) * n, false, n,
             surface_id);
  }
  add_cap(mesh, static_cast<uint32_t>(rings - 1) * n, n, false);
  return mesh;
}

MeshResult make_cylinder(double h, double r1, double r2, bool center, const Facets& facets) {
  if (auto error = check_size("cylinder", "h", h)) return *error;
  for (const auto& [name, r] : {std::pair{"r1", r1}, std::pair{"r2", r2}}) {
    if (!std::isfinite(r)) return not_finite("cylinder", name, r);
    if (r < 0) {
      return invalid_argument(std::string("cylinder: ") + name + " must not be negative, got " +
                              number_text(r));
    }
  }
  if (r1 == 0 && r2 == 0) return invalid_argument("cylinder: r1 and r2 must not both be 0");
  if (auto error = check_facets("cylinder", facets)) return *error;
  const int n = facets.fragments(std::max(r1, r2));
  if (2.0 * n > kMostPoints) return too_many_points("cylinder", n, 2.0 * n);
  PolygonMesh mesh;
  mesh.kind = r1 == r2 ? "cylinder" : "cone";
  mesh.convex = true;
  const std::vector<glm::dvec2> directions = ring_directions(n);
  const uint32_t lower = add_ring(mesh, r1, center ? -h / 2 : 0, directions);
  const uint32_t upper = add_ring(mesh, r2, center ? h / 2 : h, directions);
  if (r1 > 0) add_cap(mesh, lower, n, false);
  add_band(mesh, lower, r1 == 0, upper, r2 == 0, n, surface_of(n));
  if (r2 > 0) add_cap(mesh, upper, n, true);
  return mesh;
}

}  // namespace csgrun
