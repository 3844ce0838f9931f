#include "primitives/files/csg_sheets.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <set>
#include <tuple>
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

/// What a tree is a union of, under a map: `leaf` gets the meshes, `other` what is to be evaluated.
/// For corners alone hulls are unions, and any mesh is its points; else only convex ones are.
template <class Leaf, class Other>
Status for_each_member(const NodePtr& tree, const Affine& map, bool corners_alone, Leaf&& leaf,
                       Other&& other) {
  std::vector<std::pair<NodePtr, Affine>> open{{tree, map}};
  while (!open.empty()) {
    const auto [node, place] = std::move(open.back());
    open.pop_back();
    const NodeKind kind = node->kind();
    const bool moves = kind == NodeKind::kTransform;
    const bool is_union = (kind == NodeKind::kBoolean && node->op() == BooleanOp::kUnion) ||
                          (corners_alone && kind == NodeKind::kConstruction &&
                           node->construction() == Construction::kConvexHull);
    if (kind == NodeKind::kEmpty) continue;
    if (kind == NodeKind::kLeaf &&
        (corners_alone || node->mesh()->convex || node->mesh()->hull_of_points)) {
      leaf(*node->mesh(), place);
    } else if (moves || kind == NodeKind::kAppearance || is_union) {
      const Affine below = moves ? Affine::compose(place, node->transform()) : place;
      for (const NodePtr& child : node->children()) open.emplace_back(child, below);
    } else if (Status status = other(node, place); !status) {
      return status;
    }
  }
  return std::monostate();
}

bool is_before(const glm::dvec3& a, const glm::dvec3& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

struct PointsLess {
  bool operator()(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) const {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), is_before);
  }
};

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
  const Status done = for_each_member(
      tree, map, true,
      [&](const PolygonMesh& mesh, const Affine& place) { append_corners(mesh, place, points); },
      [&](const NodePtr& node, const Affine& place) -> Status {
        const auto solid = evaluator.evaluate(node, Measuring::kNothing);
        if (!solid) return solid.error();
        for (const glm::dvec3& p : (*solid)->positions) points.push_back(place.apply(p));
        return std::monostate();
      });
  if (!done) return done.error();
  if (points.empty()) return Node::empty(where);
  return hull_leaf(std::move(points), one_appearance_of(tree), "multmatrix", where);
}

Result<NodePtr> flattened_parts(const NodePtr& tree, const Affine& map, Evaluator& evaluator,
                                const SourceRef& where) {
  std::set<std::vector<glm::dvec3>, PointsLess> parts;
  const auto add = [&](std::vector<glm::dvec3> points) {
    std::sort(points.begin(), points.end(), is_before);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (!points.empty()) parts.insert(std::move(points));
  };
  const auto evaluated = [&](const NodePtr& node, const Affine& place) -> Status {
    const auto solid = evaluator.evaluate(node, Measuring::kNothing);
    if (!solid) return solid.error();
    const std::vector<glm::dvec3>& at = (*solid)->positions;
    for (const auto& t : (*solid)->triangles)
      add({place.apply(at[t[0]]), place.apply(at[t[1]]), place.apply(at[t[2]])});
    return std::monostate();
  };
  const Status done = for_each_member(
      tree, map, false,
      [&](const PolygonMesh& mesh, const Affine& place) {
        std::vector<glm::dvec3> points;
        append_corners(mesh, place, points);
        add(std::move(points));
      },
      evaluated);
  if (!done) return done.error();
  const auto appearance = one_appearance_of(tree);
  std::vector<NodePtr> leaves;
  for (const auto& points : parts)
    leaves.push_back(hull_leaf(points, appearance, "multmatrix", where));
  if (leaves.empty()) return Node::empty(where);
  if (leaves.size() == 1) return leaves[0];
  return Node::boolean(BooleanOp::kUnion, std::move(leaves), where);
}

}  // namespace csgrun
