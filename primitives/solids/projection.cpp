#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include <csgrun/primitives/projection.h>

#include "primitives/shape2d/shape_factory.h"
#include "primitives/solids/box_leaf.h"

namespace csgrun {
namespace {

Shape2D::Loop outline(const Solid& solid, uint32_t loop) {
  Shape2D::Loop result;
  for (uint32_t c = solid.loop_starts[loop]; c < solid.loop_starts[loop + 1]; ++c) {
    const glm::dvec3& p = solid.positions[solid.loop_vertices[c]];
    result.emplace_back(p.x, p.y);
  }
  return result;
}

}  // namespace

Result<Shape2D> project_solid(const Solid& solid) {
  std::vector<Shape2D::Loop> outlines;
  std::vector<uint32_t> face_of;
  for (uint32_t f = 0; f < solid.faces.size(); ++f) {
    if (!(solid.face_normals[f].z > 0)) continue;
    const Solid::Face& face = solid.faces[f];
    for (uint32_t l = 0; l < face.loop_count; ++l) {
      outlines.push_back(outline(solid, face.first_loop + l));
      face_of.push_back(f);
    }
  }
  if (outlines.empty()) return Shape2D();
  const Result<Grid2D> grid = grid_for(extent_of(outlines));
  if (!grid) return grid.error();
  // Seen from above all these faces run counter-clockwise: the winding number of a point is how
  // many of them are over it.
  std::vector<Segment2D> segments;
  // Each is an operand: faces that meet when they are seen from above have edges of one wall, or of
  // walls in one plane, but mostly no corners in common.
  for (size_t l = 0; l < outlines.size(); ++l) {
    add_outline(snap_loop(*grid, outlines[l]), kRestOfOperands + face_of[l], segments);
  }
  return Shape2DFactory::arranged(*grid, std::move(segments),
                                  [](int32_t, int32_t rest) { return rest > 0; });
}

Result<Shape2D> slice_solid(Evaluator& evaluator, const NodePtr& solid, double z,
                            const SourceRef& where) {
  Affine down;
  down.m[2][3] = -z;
  const NodePtr moved = Node::transformed(down, solid, where);
  const auto extent = evaluator.extent(moved);
  if (!extent) return extent.error();
  if (extent->empty || extent->bbox[0].z > 0 || extent->bbox[1].z <= 0) return Shape2D();
  const glm::dvec3 size = extent->bbox[1] - extent->bbox[0];
  const double margin = std::max({size.x, size.y, size.z});
  glm::dvec3 low = extent->bbox[0] - glm::dvec3(margin),
             high = extent->bbox[1] + glm::dvec3(margin);
  low.z = 0;
  const auto above = evaluator.evaluate(
      Node::boolean(BooleanOp::kIntersection, {moved, box_leaf(low, high, where)}, where),
      Measuring::kNothing);
  if (!above) return above.error();
  std::vector<Shape2D::Loop> outlines;
  const Solid& part = **above;
  for (size_t f = 0; f < part.faces.size(); ++f) {
    const glm::dvec3& normal = part.face_normals[f];
    if (!(normal.z < 0) || normal.x != 0 || normal.y != 0) continue;
    const Solid::Face& face = part.faces[f];
    if (part.positions[part.loop_vertices[part.loop_starts[face.first_loop]]].z != 0) continue;
    for (uint32_t l = 0; l < face.loop_count; ++l) {
      outlines.push_back(outline(part, face.first_loop + l));
    }
  }
  return Shape2D::from_outlines(outlines);
}

std::optional<Appearance> one_appearance_of(const NodePtr& root) {
  std::optional<Appearance> found;
  const auto add = [&](const Appearance& look) {
    if (!found) found = look;
    return *found == look;
  };
  std::vector<const Node*> open{root.get()};
  std::set<const Node*> seen;
  while (!open.empty()) {
    const Node* node = open.back();
    open.pop_back();
    if (!seen.insert(node).second) continue;
    if (node->kind() == NodeKind::kAppearance) {
      if (!add(node->appearance())) return std::nullopt;
    } else if (node->kind() == NodeKind::kLeaf) {
      const PolygonMesh& mesh = *node->mesh();
      if (mesh.appearances.empty() && !add(Appearance{})) return std::nullopt;
      for (const Appearance& look : mesh.appearances) {
        if (!add(look)) return std::nullopt;
      }
    } else if (!node->children().empty()) {
      // Constructions have the appearance of their first operand, too.
      const bool all = node->kind() == NodeKind::kBoolean && node->op() != BooleanOp::kDifference;
      const size_t count = all ? node->children().size() : 1;
      for (size_t i = 0; i < count; ++i) open.push_back(node->children()[i].get());
    }
  }
  if (found && found->is_default) return std::nullopt;
  return found;
}

}  // namespace csgrun
