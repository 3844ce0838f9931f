#include "engine/csg/tree_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/csg/tree_nodes.h"

namespace csgrun {
namespace {

glm::dvec3 middle_of(const PointBox& box) { return box.lo / 2.0 + box.hi / 2.0; }

/// The corners of a face that is one loop; nothing for others.
std::span<const uint32_t> only_loop(const PolygonMesh& mesh, size_t face) {
  const uint32_t loop = mesh.face_starts[face];
  if (mesh.face_starts[face + 1] != loop + 1) return {};
  return std::span(mesh.corners)
      .subspan(mesh.loop_starts[loop], mesh.loop_starts[loop + 1] - mesh.loop_starts[loop]);
}

/// Whether a mesh is the six sides of its box, each once.
bool is_whole_box(const PolygonMesh& mesh, const PointBox& box) {
  if (mesh.face_count() != 6) return false;
  std::set<std::pair<int, bool>> sides;
  for (size_t f = 0; f < 6; ++f) {
    const std::span<const uint32_t> loop = only_loop(mesh, f);
    if (loop.size() != 4) return false;
    std::set<std::array<bool, 3>> ends;
    for (const uint32_t corner : loop) {
      const glm::dvec3& p = mesh.points[corner];
      for (int k = 0; k < 3; ++k) {
        if (p[k] != box.lo[k] && p[k] != box.hi[k]) return false;
      }
      ends.insert({p.x == box.hi[0], p.y == box.hi[1], p.z == box.hi[2]});
    }
    if (ends.size() != 4) return false;
    for (size_t k = 0; k < 3; ++k) {
      const bool end = (*ends.begin())[k];
      if (std::all_of(ends.begin(), ends.end(), [&](const auto& e) { return e[k] == end; })) {
        sides.insert({static_cast<int>(k), end});
      }
    }
  }
  return sides.size() == 6;
}

/// A box around the mean of the points, if all triangles of a mesh have that behind them, so that
/// they wrap around it.
PointBox box_inside(const PolygonMesh& mesh, const PointBox& box) {
  glm::dvec3 c(0);
  for (const glm::dvec3& p : mesh.points) c += p / static_cast<double>(mesh.points.size());
  const glm::dvec3 reach = glm::min(c - box.lo, box.hi - c);
  double part = 1;  // of `reach`
  for (size_t f = 0; f < mesh.face_count(); ++f) {
    const std::span<const uint32_t> loop = only_loop(mesh, f);
    if (loop.size() < 3) return PointBox::nothing();
    const glm::dvec3& a = mesh.points[loop[0]];
    for (size_t i = 1; i + 1 < loop.size(); ++i) {
      const glm::dvec3 n = glm::cross(mesh.points[loop[i]] - a, mesh.points[loop[i + 1]] - a);
      if (n == glm::dvec3(0)) continue;  // it is seen from nowhere
      const double most = glm::dot(glm::abs(n), reach);
      // Doubles are off by far less.
      part = std::min(part, glm::dot(n, a - c) / most - 1e-9);
      if (!(part > 0)) return PointBox::nothing();
    }
  }
  if (part == 1) return PointBox::nothing();  // no triangle is seen from anywhere
  return {c - part * reach, c + part * reach};
}

SolidBounds of_leaf(const PolygonMesh& mesh) {
  SolidBounds bounds;
  bounds.box = box_of(mesh);
  const bool has_points = std::all_of(mesh.corners.begin(), mesh.corners.end(),
                                      [&](uint32_t p) { return p < mesh.points.size(); });
  if (mesh.hull_of_points || mesh.fill != FillRule::kNonZero || !has_points) return bounds;
  bounds.full = is_whole_box(mesh, bounds.box) ? bounds.box : box_inside(mesh, bounds.box);
  return bounds;
}

/// Whether boxes stay boxes: each axis goes to one axis.
bool keeps_axes(const Affine& map) {
  std::array<int, 3> in_column{};
  for (const auto& row : map.m) {
    int count = 0;
    for (size_t k = 0; k < 3; ++k) {
      if (row[k] != 0) ++count, ++in_column[k];
    }
    if (count != 1) return false;
  }
  return in_column == std::array<int, 3>{1, 1, 1};
}

/// A box inside of the image of one.
PointBox box_in_image(const Affine& map, const PointBox& box) {
  if (box.is_nothing()) return box;
  PointBox result = image(map, box);
  if (!keeps_axes(map)) {
    Affine linear = map;
    for (auto& row : linear.m) row[3] = 0;
    // A point moved by 1 along each axis, or less, is taken back to one that is moved by that much.
    const glm::dvec3 back = original(linear, {glm::dvec3(-1), glm::dvec3(1)}).hi;
    const glm::dvec3 parts = (box.hi - box.lo) / 2.0 / back;
    const double reach = std::min({parts.x, parts.y, parts.z});
    const glm::dvec3 middle = map.apply(middle_of(box));
    result = {middle - reach, middle + reach};
  }
  const double size = result.size();
  return std::isfinite(size) ? result : PointBox::nothing();
}

SolidBounds moved(const Affine& map, const SolidBounds& child) {
  SolidBounds bounds;
  bounds.box = image(map, child.box);
  bounds.full = box_in_image(map, child.full);
  bounds.hole = image(map, child.hole);
  return bounds;
}

double volume(const PointBox& box) {
  const glm::dvec3 length = box.hi - box.lo;
  return box.is_nothing() ? 0 : length.x * length.y * length.z;
}

PointBox hull(PointBox a, const PointBox& b) {
  a.include(b);
  return a;
}

}  // namespace

bool is_far(const PointBox& box) {
  const glm::dvec3 most = glm::max(glm::abs(box.lo), glm::abs(box.hi));
  return !box.is_nothing() && std::max({most.x, most.y, most.z}) > TreeBounds::kFar;
}

PointBox sum(const PointBox& a, const PointBox& b) {
  if (a.is_nothing() || b.is_nothing()) return PointBox::nothing();
  return {a.lo + b.lo, a.hi + b.hi};
}

SolidBounds TreeBounds::of_boolean(const Node& node) const {
  const std::span<const NodePtr> operands = evaluated_children(node);
  SolidBounds bounds = of(operands[0]);
  for (const NodePtr& operand : operands.subspan(1)) {  // none where another tree stands for it
    const SolidBounds& next = of(operand);
    switch (node.op()) {
      case BooleanOp::kUnion:
        bounds.box.include(next.box);
        if (volume(next.full) > volume(bounds.full)) {
          bounds.full = next.full;
          bounds.hole = next.hole;
        }
        break;
      case BooleanOp::kIntersection:
        bounds.box = common(bounds.box, next.box);
        bounds.full = common(bounds.full, next.full);
        bounds.hole.include(next.hole);
        break;
      case BooleanOp::kDifference:
        // Of what the operand fills all is gone but what is in its hole.
        if (next.full.holds(bounds.box)) bounds.box = common(bounds.box, next.hole);
        bounds.hole.include(next.box);
        break;
      case BooleanOp::kSymmetricDifference:
        bounds.box.include(next.box);
        bounds.full = PointBox::nothing();
        break;
    }
  }
  return bounds;
}

/// Empty operands do not count, and which are is not known: bounds hold for the sum of any of them.
SolidBounds TreeBounds::of_sum(const Node& node) const {
  const std::span<const NodePtr> operands = evaluated_children(node);
  SolidBounds bounds = of(operands[0]);
  for (const NodePtr& operand : operands.subspan(1)) {
    const SolidBounds& next = of(operand);
    // With a, of what is `full` of one, and b, of what is full of the other, which has no hole,
    // a + b is in the sum if a is not in the hole; and it is not if a + b is in no sum of the hole
    // and a point of the other.
    const auto keep_free = [](const PointBox& hole, const PointBox& other) {
      return hull(hole, sum(hole, other));
    };
    const bool is_whole = !next.full.is_nothing() && next.hole.is_nothing();
    const bool was_whole = !bounds.full.is_nothing() && bounds.hole.is_nothing();
    bounds.hole = is_whole    ? keep_free(bounds.hole, next.box)
                  : was_whole ? keep_free(next.hole, bounds.box)
                              : PointBox::nothing();
    bounds.full = is_whole || was_whole ? sum(bounds.full, next.full) : PointBox::nothing();
    bounds.box = hull(hull(bounds.box, next.box), sum(bounds.box, next.box));
  }
  return bounds;
}

SolidBounds TreeBounds::make(const Node& node) const {
  const std::span<const NodePtr> operands = evaluated_children(node);
  const bool is_sum = is_minkowski_sum(node);
  SolidBounds bounds;
  switch (node.kind()) {
    case NodeKind::kEmpty:
      bounds.box = PointBox::nothing();
      break;
    case NodeKind::kLeaf:
      bounds = of_leaf(*node.mesh());
      break;
    case NodeKind::kTransform:
      bounds = moved(node.transform(), of(operands[0]));
      break;
    case NodeKind::kAppearance:
    case NodeKind::kOuterHull:
      bounds = of(operands[0]);
      break;
    case NodeKind::kBoolean:
      bounds = of_boolean(node);
      break;
    case NodeKind::kConstruction:
      if (is_sum) {
        bounds = of_sum(node);
      } else if (node.construction() == Construction::kConvexHull) {
        bounds.box = PointBox::nothing();
        for (const NodePtr& operand : operands) bounds.box.include(of(operand).box);
      }
      break;
  }
  bounds.has_far_sum = std::any_of(operands.begin(), operands.end(), [&](const NodePtr& operand) {
    const SolidBounds& below = of(operand);
    return below.has_far_sum || (is_sum && operands.size() > 1 && is_far(below.box));
  });
  return bounds;
}

const SolidBounds& TreeBounds::find(const NodePtr& root) {
  std::vector<NodePtr> stack{root};
  while (!stack.empty()) {
    const NodePtr node = stack.back();
    const size_t before = stack.size();
    if (node && !known_.contains(node)) {
      for (const NodePtr& operand : evaluated_children(*node)) {
        if (operand && !known_.contains(operand)) stack.push_back(operand);
      }
      if (stack.size() > before) continue;
      known_.emplace(node, make(*node));
    }
    stack.pop_back();
  }
  return of(root);
}

}  // namespace csgrun
