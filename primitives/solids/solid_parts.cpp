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
#include <csgrun/engine/tree_in_boxes.h>
#include <csgrun/primitives/freeform.h>
#include <csgrun/primitives/solid_parts.h>
#include <csgrun/primitives/solids.h>

#include "primitives/base/text.h"
#include "primitives/solids/box_leaf.h"
#include "primitives/solids/box_search.h"
#include "primitives/solids/part_components.h"

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

BoxSearch search_of(const std::vector<Surface>& surfaces) {
  std::vector<std::array<glm::dvec3, 2>> boxes;
  for (const Surface& surface : surfaces) boxes.push_back({surface.low, surface.high});
  return BoxSearch(std::move(boxes));
}

size_t count_off_grid(const Solid& solid, const std::vector<uint32_t>& triangles) {
  std::vector<uint32_t> vertices;
  for (const uint32_t t : triangles) {
    for (const uint32_t v : solid.triangles[t]) {
      if (solid.on_grid[v] == 0) vertices.push_back(v);
    }
  }
  std::sort(vertices.begin(), vertices.end());
  return static_cast<size_t>(std::unique(vertices.begin(), vertices.end()) - vertices.begin());
}

/// Whether a void lies in what a surface encloses: then nothing is wrapped around a point in it.
bool is_void_of(const Solid& solid, const Surface& hole, const Surface& outer) {
  auto triangles = triangles_of(solid, hole);
  const auto others = triangles_of(solid, outer);
  triangles.insert(triangles.end(), others.begin(), others.end());
  const uint32_t first = 0;
  return windings_in_front({solid.positions, triangles}, {&first, 1})[0] == 0;
}

}  // namespace

Result<NodePtr> offset_solid(Evaluator& evaluator, const NodePtr& solid, const NodePtr& tool,
                             double distance) {
  const SourceRef& where = tool->where();
  const auto extent = evaluator.extent(solid);
  if (!extent) return extent.error();
  if (extent->empty) return solid;  // a sum would leave the tool
  if (distance > 0) return Node::minkowski_sum({solid, tool}, where);
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

Result<Components> decompose_solid(Evaluator& evaluator, const NodePtr& solid,
                                   const SourceRef& where) {
  const auto evaluated = evaluator.evaluate(solid, Measuring::kNothing);
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
  if (outer.size() == 1) return Components{{solid}, 0};
  const BoxSearch search = search_of(outer);
  std::vector<std::vector<uint32_t>> triangles;
  for (const Surface& surface : outer) triangles.push_back(surface.triangles);
  for (const Surface& hole : holes) {
    // It is in one of those whose boxes hold it.
    const std::vector<uint32_t> around = search.holding({hole.low, hole.high});
    size_t innermost = outer.size();
    for (const uint32_t i : around) {
      if (innermost < outer.size() && outer[innermost].volume <= outer[i].volume) continue;
      if (around.size() == 1 || is_void_of(whole, hole, outer[i])) innermost = i;
    }
    if (innermost == outer.size()) {
      return Error{ErrorCode::kInternal, "a void lies in no component", where};
    }
    triangles[innermost].insert(triangles[innermost].end(), hole.triangles.begin(),
                                hole.triangles.end());
  }
  const Parter parter(whole, triangles, search);
  TreeInBoxes leaves(solid);
  Components result;
  for (uint32_t i = 0; i < outer.size(); ++i) {
    // Several steps of any grid on which the solid stands.
    const double reach = glm::length(glm::max(glm::abs(outer[i].low), glm::abs(outer[i].high)));
    const double noise = 1e-6 * reach;
    // Beside others that are near, corners on the grid say as much, and take less.
    const size_t off_grid = count_off_grid(whole, triangles[i]);
    const bool is_apart = search.near(i, 2 * noise).empty();
    const auto parting =
        is_apart || off_grid > 0 ? parter.part(i, noise) : std::optional<Parting>();
    if (!parting) {
      result.parts.push_back(Node::leaf(
          std::make_shared<const PolygonMesh>(mesh_of_solid(whole, triangles[i], "component")),
          where));
      result.rounded_corners += off_grid;
      continue;
    }
    const auto& [low, high] = parting->around;
    const NodePtr box = box_leaf(low, high, where);
    // The box holds all of some leaves, and the whole need not be looked at for each piece.
    const glm::dvec3 slack(noise + 4 * evaluator.stats().grid_mm);
    const NodePtr near = leaves.within(low - slack, high + slack);
    std::vector<NodePtr> inside{
        near ? Node::intersection_as(
                   {solid, box}, Node::boolean(BooleanOp::kIntersection, {near, box}, where), where)
             : Node::boolean(BooleanOp::kIntersection, {solid, box}, where)};
    for (const TurnedBox& more : parting->within) inside.push_back(more.node(where));
    std::vector<NodePtr> operands{
        inside.size() == 1 ? inside[0] : Node::boolean(BooleanOp::kIntersection, inside, where)};
    for (const TurnedBox& less : parting->without) operands.push_back(less.node(where));
    result.parts.push_back(operands.size() == 1
                               ? operands[0]
                               : Node::boolean(BooleanOp::kDifference, operands, where));
  }
  return result;
}

}  // namespace csgrun
