// Half-spaces, as large as a solid needs them.
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <csgrun/primitives/solid_parts.h>

#include "primitives/base/text.h"
#include "primitives/solids/box_leaf.h"

namespace csgrun {
namespace {

/// A direction as whole numbers without a common factor, if small ones have it exactly.
std::optional<glm::dvec3> whole_direction(const glm::dvec3& direction) {
  constexpr double kLargest = 1e6;
  constexpr int kMostDigits = 6, kMostBits = 20;
  const auto scaled = [&](double scale) -> std::optional<glm::dvec3> {
    glm::dvec3 whole;
    int64_t common = 0;
    for (int k = 0; k < 3; ++k) {
      whole[k] = std::nearbyint(direction[k] * scale);
      if (std::fabs(whole[k]) > kLargest || whole[k] / scale != direction[k]) return {};
      common = std::gcd(common, static_cast<int64_t>(whole[k]));
    }
    return whole / static_cast<double>(common);
  };
  double power = 1;
  for (int digits = 0; digits <= kMostDigits; ++digits, power *= 10) {
    if (const auto whole = scaled(power)) return whole;
  }
  for (int bits = 1; bits <= kMostBits; ++bits) {
    if (const auto whole = scaled(std::ldexp(1.0, bits))) return whole;
  }
  return {};
}

/// Two vectors in a plane, no longer than `longest`: whole numbers of mm, or of as large a power of
/// two below that as is small enough. From a point of the grid they lead to others, unless the grid
/// is coarser. None for planes along the axes, and for normals of other than small whole numbers.
std::optional<std::array<glm::dvec3, 2>> plane_lattice(const glm::dvec3& normal, double longest) {
  constexpr int kMostHalvings = 20;
  const auto whole = whole_direction(normal);
  if (!whole) return {};
  const glm::dvec3& n = *whole;
  int zeros = 0, widest = 0;
  for (int k = 0; k < 3; ++k) {
    zeros += n[k] == 0 ? 1 : 0;
    if (std::fabs(n[k]) > std::fabs(n[widest])) widest = k;
  }
  if (zeros == 2) return {};
  const int i = (widest + 1) % 3, j = (widest + 2) % 3;
  std::array<glm::dvec3, 2> lattice{glm::dvec3(0), glm::dvec3(0)};
  lattice[0][i] = n[widest], lattice[0][widest] = -n[i];
  lattice[1][j] = n[widest], lattice[1][widest] = -n[j];
  for (glm::dvec3& v : lattice) {
    v /= static_cast<double>(
        std::gcd(static_cast<int64_t>(v[widest]), static_cast<int64_t>(n[widest])));
    for (int halvings = 0; glm::length(v) > longest && halvings < kMostHalvings; ++halvings) v /= 2;
    if (glm::length(v) > longest) return {};
  }
  return lattice;
}

/// A prism on a triangle of lattice points that holds the disc around what is nearest to `middle`.
/// Three points stay in one plane however they are rounded.
NodePtr lattice_prism(const CutPlane& plane, const std::array<glm::dvec3, 2>& lattice,
                      const glm::dvec3& middle, double radius, double depth,
                      const SourceRef& where) {
  const auto& [a, b] = lattice;
  // Coordinates in the plane, along a and b, by vectors across the other one.
  const glm::dvec3 over_b = glm::cross(b, plane.normal), over_a = glm::cross(a, plane.normal);
  const double along_a = glm::dot(a, over_b), along_b = glm::dot(b, over_a);
  const glm::dvec3 u = glm::normalize(a), v = glm::cross(plane.normal, u);
  // A corner is off what is wanted by half of a and b at most, and so are the sides; the circle
  // within the triangle has half the radius of that around it.
  const double reach = 2 * (radius + (glm::length(a) + glm::length(b)) / 2);
  const glm::dvec3 center = middle - plane.point;
  auto mesh = std::make_shared<PolygonMesh>();
  for (const glm::dvec2 way :
       {glm::dvec2(1, 0), glm::dvec2(-0.5, std::sqrt(0.75)), glm::dvec2(-0.5, -std::sqrt(0.75))}) {
    const glm::dvec3 wanted = center + reach * (way.x * u + way.y * v);
    const double i = std::nearbyint(glm::dot(wanted, over_b) / along_a),
                 j = std::nearbyint(glm::dot(wanted, over_a) / along_b);
    const glm::dvec3 corner = plane.point + (i * a + j * b);
    mesh->points.push_back(corner);
    mesh->points.push_back(corner + plane.normal * depth);
  }
  mesh->hull_of_points = true;
  mesh->kind = "half-space";
  return Node::leaf(std::move(mesh), where);
}

/// A box from `low` to `high` along the normal, with the normal as its third axis: its faces are
/// where the third coordinate is that, whatever the solid.
NodePtr turned_box(const CutPlane& plane, const glm::dvec3& middle, double radius, double low,
                   double high, const SourceRef& where) {
  int least = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::fabs(plane.normal[i]) < std::fabs(plane.normal[least])) least = i;
  }
  glm::dvec3 axis(0);
  axis[least] = 1;
  const glm::dvec3 v = glm::normalize(glm::cross(plane.normal, axis));
  const glm::dvec3 u = glm::cross(v, plane.normal);
  const double x = glm::dot(u, middle), y = glm::dot(v, middle);
  const NodePtr box =
      box_leaf({x - radius, y - radius, low}, {x + radius, y + radius, high}, where);
  Affine turn;
  for (int i = 0; i < 3; ++i) turn.m[i] = {u[i], v[i], plane.normal[i], 0};
  return Node::transformed(turn, box, where);
}

}  // namespace

Result<CutPlane> make_cut_plane(const glm::dvec3& normal, double offset) {
  const double length = glm::length(normal);
  if (!std::isfinite(length) || length == 0) {
    return invalid_argument("the normal must be finite and not 0");
  }
  if (!std::isfinite(offset)) return invalid_argument("the offset must be finite");
  CutPlane plane{normal / length, offset, normal, {}};
  // A normal along an axis has exactly this direction.
  for (int i = 0; i < 3; ++i) {
    if (std::fabs(normal[i]) != length) continue;
    plane.normal = glm::dvec3(0);
    plane.normal[i] = normal[i] > 0 ? 1 : -1;
  }
  plane.point = plane.normal * offset;
  return plane;
}

Result<CutPlane> make_cut_plane(const glm::dvec3& normal, const glm::dvec3& point) {
  auto plane = make_cut_plane(normal, 0);
  if (!plane) return plane;
  plane->offset = glm::dot(plane->normal, point);
  plane->point = point;
  if (!std::isfinite(plane->offset)) return invalid_argument("the point must be finite");
  return plane;
}

Result<NodePtr> half_space(Evaluator& evaluator, const NodePtr& solid, const CutPlane& plane,
                           const SourceRef& where) {
  const auto extent = evaluator.extent(solid);
  if (!extent) return extent.error();
  if (extent->empty) return Node::empty(where);
  const glm::dvec3 middle = (extent->bbox[0] + extent->bbox[1]) / 2.0;
  const double radius = glm::length(extent->bbox[1] - middle) * 1.125;
  // No lower than it must be: what is far away would make the grid coarse.
  const double height = glm::dot(plane.normal, middle), high = height + radius,
               low = std::max(plane.offset, height - radius);
  if (high <= plane.offset) return Node::empty(where);
  if (low == plane.offset) {
    if (const auto lattice = plane_lattice(plane.direction, radius / 4)) {
      return lattice_prism(plane, *lattice, middle, radius, high - low, where);
    }
  }
  return turned_box(plane, middle, radius, low, high, where);
}

}  // namespace csgrun
