// Boxes and cylinders with round edges: hulls of the points of balls and rings.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <csgrun/primitives/freeform.h>
#include <csgrun/primitives/trig.h>

#include "primitives/base/at_most.h"
#include "primitives/base/text.h"
#include "primitives/solids/check_facets.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

/// Steps of a quarter turn: the round part then touches the flat ones.
int quarter_steps(double r, const Facets& facets) { return (facets.fragments(r) + 3) / 4; }

PolygonMesh hull_mesh(const char* kind) {
  PolygonMesh mesh;
  mesh.kind = kind;
  mesh.hull_of_points = true;
  return mesh;
}

}  // namespace

MeshResult make_rounded_cube(const glm::dvec3& size, double radius, std::array<bool, 3> center,
                             const Facets& facets) {
  constexpr const char* kNames[3] = {"size.x", "size.y", "size.z"};
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(size[i])) return not_finite("cube", kNames[i], size[i]);
    if (!(size[i] > 0)) return not_positive("cube", kNames[i], size[i]);
  }
  if (!std::isfinite(radius)) return not_finite("cube", "r", radius);
  if (!(radius > 0)) return not_positive("cube", "r", radius);
  const double most = std::min({size.x, size.y, size.z}) / 2, r = at_most(radius, most);
  if (r > most) {
    return invalid_argument("cube: r must be at most half of the shortest side, " +
                            number_text(most) + ", got " + number_text(r));
  }
  if (auto error = check_facets("cube", facets)) return *std::move(error);
  const int n = quarter_steps(r, facets);
  const double points = 8.0 * (n + 1) * (n + 1);
  if (points > kMostPoints) return too_many_points("cube", 4.0 * n, points);
  PolygonMesh mesh = hull_mesh("cube");
  for (int corner = 0; corner < 8; ++corner) {
    for (int i = 0; i <= n; ++i) {
      for (int k = 0; k <= n; ++k) {
        const double up = sin_deg(90.0 * i / n), out = cos_deg(90.0 * i / n);
        const glm::dvec3 outward(out * cos_deg(90.0 * k / n), out * sin_deg(90.0 * k / n), up);
        glm::dvec3 p;
        for (int a = 0; a < 3; ++a) {
          const double middle = center[static_cast<size_t>(a)] ? 0 : size[a] / 2;
          const double reach = size[a] / 2 - r + r * outward[a];
          p[a] = corner >> a & 1 ? middle + reach : middle - reach;
        }
        mesh.points.push_back(p);
      }
    }
  }
  return mesh;
}

MeshResult make_rounded_cylinder(double h, double r, double rounding, bool center,
                                 const Facets& facets) {
  const double round = at_most(rounding, std::min(r, h / 2));
  for (const auto& [name, value] :
       {std::pair{"h", h}, std::pair{"r", r}, std::pair{"round", round}}) {
    if (!std::isfinite(value)) return not_finite("cylinder", name, value);
    if (!(value > 0)) return not_positive("cylinder", name, value);
  }
  if (round > r || round > h / 2) {
    return invalid_argument("cylinder: round must be at most r and half of h, " +
                            number_text(std::min(r, h / 2)) + ", got " + number_text(round));
  }
  if (auto error = check_facets("cylinder", facets)) return *std::move(error);
  const int sides = facets.fragments(r), n = quarter_steps(round, facets);
  const double points = 2.0 * sides * (n + 1);
  if (points > kMostPoints) return too_many_points("cylinder", sides, points);
  PolygonMesh mesh = hull_mesh("cylinder");
  const double middle = center ? 0 : h / 2;
  for (int i = 0; i <= n; ++i) {
    const double radius = r - round + round * cos_deg(90.0 * i / n);
    const double height = h / 2 - round + round * sin_deg(90.0 * i / n);
    for (int k = 0; k < sides; ++k) {
      const double x = radius * cos_deg(360.0 * k / sides), y = radius * sin_deg(360.0 * k / sides);
      mesh.points.emplace_back(x, y, middle + height);
      mesh.points.emplace_back(x, y, middle - height);
    }
  }
  return mesh;
}

}  // namespace csgrun
