#include "primitives/files/csg_sheets.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

#include <csgrun/primitives/projection.h>

namespace csgrun {
namespace {

/// Twice the area of a loop as it is seen from above, counter-clockwise loops counted up.
double twice_area(const Shape2D::Loop& loop) {
  double sum = 0;
  for (size_t i = 0; i < loop.size(); ++i) {
    const glm::dvec2 a = loop[i] - loop[0], b = loop[(i + 1) % loop.size()] - loop[0];
    sum += a.x * b.y - b.x * a.y;
  }
  return sum;
}

void append_corners(const PolygonMesh& mesh, const Affine& map, std::vector<glm::dvec3>& points) {
  std::vector<uint8_t> is_used(mesh.points.size(), mesh.hull_of_points ? 1 : 0);
  for (const uint32_t corner : mesh.corners) is_used[corner] = 1;
  for (size_t p = 0; p < is_used.size(); ++p) {
    if (is_used[p] != 0) points.push_back(map.apply(mesh.points[p]));
  }
}

NodePtr hull_leaf(std::vector<glm::dvec3> points, const std::optional<Appearance>& appearance,
                  const std::string& kind, const SourceRef& where) {
  auto mesh = std::make_shared<PolygonMesh>();
  mesh->points = std::move(points);
  mesh->hull_of_points = true;
  mesh->kind = kind;
  if (appearance) mesh->appearances.push_back(*appearance);
  return Node::leaf(std::move(mesh), where);
}

/// Whether the corners of a node are those of its children.
bool has_the_corners_of_its_children(const Node& node) {
  switch (node.kind()) {
    case NodeKind::kTransform:
    case NodeKind::kAppearance:
      return true;
    case NodeKind::kBoolean:
      return node.op() == BooleanOp::kUnion;
    case NodeKind::kConstruction:
      return node.construction() == Construction::kConvexHull;
    default:
      return false;
  }
}

}  // namespace

void CsgSheet::append(CsgSheet more) {
  faces.insert(faces.end(), std::make_move_iterator(more.faces.begin()),
               std::make_move_iterator(more.faces.end()));
}

bool is_sheet(const PolygonMesh& mesh) {
  const auto is_finite = [](const glm::dvec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  };
  return !mesh.corners.empty() && std::all_of(mesh.points.begin(), mesh.points.end(), is_finite) &&
         std::all_of(mesh.corners.begin(), mesh.corners.end(),
                     [&](uint32_t corner) { return corner < mesh.points.size(); });
}

CsgSheet sheet_of(const PolygonMesh& mesh, const Affine& map) {
  CsgSheet sheet;
  for (size_t f = 0; f < mesh.face_count(); ++f) {
    CsgSheet::Face& face = sheet.faces.emplace_back();
    for (uint32_t l = mesh.face_starts[f]; l < mesh.face_starts[f + 1]; ++l) {
      auto& loop = face.emplace_back();
      for (uint32_t c = mesh.loop_starts[l]; c < mesh.loop_starts[l + 1]; ++c)
        loop.push_back(map.apply(mesh.points[mesh.corners[c]]));
    }
  }
  return sheet;
}

CsgSheet sheet_of(const Solid& solid, const Affine& map) {
  CsgSheet sheet;
  for (const Solid::Face& given : solid.faces) {
    CsgSheet::Face& face = sheet.faces.emplace_back();
    for (uint32_t l = given.first_loop; l < given.first_loop + given.loop_count; ++l) {
      auto& loop = face.emplace_back();
      for (uint32_t c = solid.loop_starts[l]; c < solid.loop_starts[l + 1]; ++c)
        loop.push_back(map.apply(solid.positions[solid.loop_vertices[c]]));
    }
  }
  return sheet;
}

CsgSheet mapped(CsgSheet sheet, const Affine& map) {
  for (CsgSheet::Face& face : sheet.faces) {
    for (auto& loop : face) {
      for (glm::dvec3& p : loop) p = map.apply(p);
    }
  }
  return sheet;
}

Result<Shape2D> shadow_of(const CsgSheet& sheet) {
  // All faces counter-clockwise, so that none takes away what another covers.
  std::vector<Shape2D::Loop> outlines;
  for (const CsgSheet::Face& face : sheet.faces) {
    const size_t first = outlines.size();
    double area = 0;
    for (const auto& loop : face) {
      if (loop.size() < 3) continue;
      Shape2D::Loop& outline = outlines.emplace_back();
      for (const glm::dvec3& p : loop) outline.emplace_back(p.x, p.y);
      area += twice_area(outline);
    }
    for (size_t i = first; area < 0 && i < outlines.size(); ++i)
      std::reverse(outlines[i].begin(), outlines[i].end());
  }
  return Shape2D::from_outlines(outlines, FillRule::kNonZero);
}

NodePtr leaf_of_corners(const PolygonMesh& mesh, const SourceRef& where) {
  std::vector<glm::dvec3> points;
  append_corners(mesh, Affine{}, points);
  return hull_leaf(std::move(points), {}, mesh.kind, where);
}

Result<NodePtr> flattened_corners(const NodePtr& tree, const Affine& map, Evaluator& evaluator,
                                  const SourceRef& where) {
  std::vector<glm::dvec3> points;
  std::vector<std::pair<NodePtr, Affine>> open{{tree, map}};
  while (!open.empty()) {
    const auto [node, place] = std::move(open.back());
    open.pop_back();
    if (node->kind() == NodeKind::kEmpty) continue;
    if (node->kind() == NodeKind::kLeaf) {
      append_corners(*node->mesh(), place, points);
    } else if (has_the_corners_of_its_children(*node)) {
      const bool moves = node->kind() == NodeKind::kTransform;
      const Affine below = moves ? Affine::compose(place, node->transform()) : place;
      for (const NodePtr& child : node->children()) open.emplace_back(child, below);
    } else {
      const auto solid = evaluator.evaluate(node, Measuring::kNothing);
      if (!solid) return solid.error();
      for (const glm::dvec3& p : (*solid)->positions) points.push_back(place.apply(p));
    }
  }
  if (points.empty()) return Node::empty(where);
  return hull_leaf(std::move(points), one_appearance_of(tree), "multmatrix", where);
}

}  // namespace csgrun
