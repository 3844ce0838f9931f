#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <csgrun/engine/exact_triangles.h>
#include <csgrun/primitives/freeform.h>
#include <csgrun/primitives/solid_parts.h>
#include <csgrun/primitives/solids.h>

#include "primitives/base/text.h"
#include "primitives/solids/box_leaf.h"

namespace csgrun {
namespace {

/// Connected surfaces of a solid.
struct Surface {
  std::vector<uint32_t> triangles;
  glm::dvec3 low{0}, high{0};
  double volume = 0;  ///< negative for a void
};

std::vector<Surface> surfaces_of(const Solid& solid) {
  std::vector<uint32_t> parent(solid.positions.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto find = [&](uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& t : solid.triangles) {
    for (int i = 1; i < 3; ++i) parent[find(t[i])] = find(t[0]);
  }
  std::vector<uint32_t> number(solid.positions.size(), UINT32_MAX);
  std::vector<Surface> surfaces;
  for (uint32_t t = 0; t < solid.triangles.size(); ++t) {
    uint32_t& n = number[find(solid.triangles[t][0])];
    if (n == UINT32_MAX) {
      n = static_cast<uint32_t>(surfaces.size());
      surfaces.emplace_back();
      surfaces.back().low = surfaces.back().high = solid.positions[solid.triangles[t][0]];
    }
    Surface& surface = surfaces[n];
    surface.triangles.push_back(t);
    for (const uint32_t v : solid.triangles[t]) {
      surface.low = glm::min(surface.low, solid.positions[v]);
      surface.high = glm::max(surface.high, solid.positions[v]);
    }
  }
  return surfaces;
}

std::vector<std::array<uint32_t, 3>> triangles_of(const Solid& solid, const Surface& surface) {
  std::vector<std::array<uint32_t, 3>> result;
  for (const uint32_t t : surface.triangles) result.push_back(solid.triangles[t]);
  return result;
}

bool holds(const Surface& outer, const Surface& inner) {
  for (int i = 0; i < 3; ++i) {
    if (inner.low[i] < outer.low[i] || inner.high[i] > outer.high[i]) return false;
  }
  return true;
}

/// Whether a void lies in what a surface encloses: then nothing is wrapped around a point in it.
bool is_void_of(const Solid& solid, const Surface& hole, const Surface& outer) {
  if (!holds(outer, hole)) return false;
  auto triangles = triangles_of(solid, hole);
  const auto others = triangles_of(solid, outer);
  triangles.insert(triangles.end(), others.begin(), others.end());
  const uint32_t first = 0;
  return windings_in_front({solid.positions, triangles}, {&first, 1})[0] == 0;
}

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
  for (int digits = 0; digits <= kMostDigits; ++digits) {
    if (const auto whole = scaled(std::pow(10.0, digits))) return whole;
  }
  for (int bits = 1; bits <= kMostBits; ++bits) {
    if (const auto whole = scaled(std::ldexp(1.0, bits))) return whole;
  }
  return {};
}

/// Two vectors in a plane, of whole numbers of 2^-9 mm: from one grid point of the plane they lead
/// to others, whichever the grid's step is (a whole part of that, of up to 1 mm). No longer than
/// `longest`. None for planes along the axes, and for normals of other than small whole numbers.
std::optional<std::array<glm::dvec3, 2>> plane_lattice(const glm::dvec3& normal, double longest) {
  constexpr int kMostHalvings = 9;
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
    const double common = static_cast<double>(
        std::gcd(static_cast<int64_t>(v[widest]), static_cast<int64_t>(n[widest])));
    v /= std::fabs(common);
    int halvings = 0;
    for (; glm::length(v) > longest && halvings < kMostHalvings; ++halvings) v /= 2;
    if (glm::length(v) > longest) return {};
  }
  return lattice;
}

/// A box on a parallelogram of the plane that holds the disc around what is nearest to `middle`.
NodePtr lattice_box(const CutPlane& plane, const std::array<glm::dvec3, 2>& lattice,
                    const glm::dvec3& middle, double radius, double depth, const SourceRef& where) {
  const auto& [a, b] = lattice;
  const glm::dvec3 to = middle - plane.point;
  // Coordinates in the plane, along a and b, by vectors across the other one.
  const glm::dvec3 over_b = glm::cross(b, plane.normal), over_a = glm::cross(a, plane.normal);
  const double along_a = glm::dot(a, over_b), along_b = glm::dot(b, over_a);
  const double x = glm::dot(to, over_b) / along_a, y = glm::dot(to, over_a) / along_b;
  const double reach_x = radius * glm::length(over_b) / std::fabs(along_a),
               reach_y = radius * glm::length(over_a) / std::fabs(along_b);
  auto mesh = std::make_shared<PolygonMesh>();
  for (int corner = 0; corner < 4; ++corner) {
    const double i = corner & 1 ? std::ceil(x + reach_x) : std::floor(x - reach_x);
    const double j = corner & 2 ? std::ceil(y + reach_y) : std::floor(y - reach_y);
    const glm::dvec3 point = plane.point + (i * a + j * b);
    mesh->points.push_back(point);
    mesh->points.push_back(point + plane.normal * depth);
  }
  mesh->hull_of_points = true;
  mesh->kind = "half-space";
  return Node::leaf(std::move(mesh), where);
}

/// Half of the widest gap between two boxes along an axis; not positive when they meet.
double half_gap(const Surface& a, const Surface& b) {
  double gap = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) gap = std::max({gap, b.low[i] - a.high[i], a.low[i] - b.high[i]});
  return gap / 2;
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
  const double height = glm::dot(plane.normal, middle);
  if (height + radius <= plane.offset) return Node::empty(where);
  if (height - radius < plane.offset) {
    const double depth = height + radius - plane.offset;
    if (const auto lattice = plane_lattice(plane.direction, radius)) {
      return lattice_box(plane, *lattice, middle, radius, depth, where);
    }
  }
  // Axes with the normal as the third: the plane is where the third coordinate is the offset,
  // whatever the solid.
  int least = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::fabs(plane.normal[i]) < std::fabs(plane.normal[least])) least = i;
  }
  glm::dvec3 axis(0);
  axis[least] = 1;
  const glm::dvec3 v = glm::normalize(glm::cross(plane.normal, axis));
  const glm::dvec3 u = glm::cross(v, plane.normal);
  const double x = glm::dot(u, middle), y = glm::dot(v, middle);
  // No lower than it must be: what is far away would make the grid coarse.
  const double low = std::max(plane.offset, height - radius);
  const NodePtr box =
      box_leaf({x - radius, y - radius, low}, {x + radius, y + radius, height + radius}, where);
  Affine turn;
  for (int i = 0; i < 3; ++i) turn.m[i] = {u[i], v[i], plane.normal[i], 0};
  return Node::transformed(turn, box, where);
}

Result<NodePtr> offset_solid(Evaluator& evaluator, const NodePtr& solid, const NodePtr& tool,
                             double distance) {
  const SourceRef& where = tool->where();
  if (distance > 0) return Node::minkowski_sum({solid, tool}, where);
  const auto extent = evaluator.extent(solid);
  if (!extent) return extent.error();
  if (extent->empty) return solid;
  // The tool has no room in what is no larger, and a tool that is far larger would make the grid
  // coarse.
  const auto reach = evaluator.extent(tool);
  if (!reach) return reach.error();
  const glm::dvec3 room = extent->bbox[1] - extent->bbox[0];
  for (int i = 0; i < 3; ++i) {
    if (reach->bbox[1][i] - reach->bbox[0][i] >= room[i]) return Node::empty(where);
  }
  // All that is outside of the solid and near to it.
  const glm::dvec3 margin(2 * std::fabs(distance));
  const NodePtr around = box_leaf(extent->bbox[0] - margin, extent->bbox[1] + margin, where);
  const NodePtr outside = Node::boolean(BooleanOp::kDifference, {around, solid}, where);
  const NodePtr gone = Node::minkowski_sum({outside, tool}, where);
  return Node::boolean(BooleanOp::kDifference, {solid, gone}, where);
}

Result<std::vector<NodePtr>> decompose_solid(Evaluator& evaluator, const NodePtr& solid,
                                             const SourceRef& where) {
  const auto evaluated = evaluator.evaluate(solid);
  if (!evaluated) return evaluated.error();
  const Solid& whole = **evaluated;
  std::vector<Surface> outer, holes;
  for (Surface& surface : surfaces_of(whole)) {
    const auto triangles = triangles_of(whole, surface);
    surface.volume = exact_volume({whole.positions, triangles});
    (surface.volume > 0 ? outer : holes).push_back(std::move(surface));
  }
  std::sort(outer.begin(), outer.end(), [](const Surface& a, const Surface& b) {
    return std::tie(a.low.x, a.low.y, a.low.z, a.triangles[0]) <
           std::tie(b.low.x, b.low.y, b.low.z, b.triangles[0]);
  });
  std::vector<std::vector<uint32_t>> triangles;
  for (const Surface& surface : outer) triangles.push_back(surface.triangles);
  for (const Surface& hole : holes) {
    size_t innermost = outer.size();
    for (size_t i = 0; i < outer.size(); ++i) {
      if (innermost < outer.size() && outer[innermost].volume <= outer[i].volume) continue;
      if (is_void_of(whole, hole, outer[i])) innermost = i;
    }
    if (innermost == outer.size()) {
      return Error{ErrorCode::kInternal, "a void lies in no component", where};
    }
    triangles[innermost].insert(triangles[innermost].end(), hole.triangles.begin(),
                                hole.triangles.end());
  }
  if (outer.size() == 1) return std::vector<NodePtr>{solid};
  std::vector<NodePtr> result;
  for (size_t i = 0; i < outer.size(); ++i) {
    double margin = std::numeric_limits<double>::infinity();
    for (size_t k = 0; k < outer.size(); ++k) {
      if (k != i) margin = std::min(margin, half_gap(outer[i], outer[k]));
    }
    // Several steps of any grid on which the solid stands.
    const double reach = glm::length(glm::max(glm::abs(outer[i].low), glm::abs(outer[i].high)));
    if (margin > 1e-6 * reach) {
      const NodePtr box =
          box_leaf(outer[i].low - glm::dvec3(margin), outer[i].high + glm::dvec3(margin), where);
      result.push_back(Node::boolean(BooleanOp::kIntersection, {solid, box}, where));
    } else {
      result.push_back(Node::leaf(
          std::make_shared<const PolygonMesh>(mesh_of_solid(whole, triangles[i], "component")),
          where));
    }
  }
  return result;
}

}  // namespace csgrun
