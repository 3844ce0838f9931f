#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <csgrun/primitives/projection.h>

#include "primitives/shape2d/shape_factory.h"
#include "primitives/shape2d/straight_corners.h"

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

Result<Shape2D> project_solid(const Solid& solid, double grid_mm) {
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
  Result<Shape2D> shadow = Shape2DFactory::arranged(*grid, std::move(segments),
                                                    [](int32_t, int32_t rest) { return rest > 0; });
  constexpr double kNoiseSteps = 2;
  if (shadow) shadow = Shape2DFactory::with_noise(*std::move(shadow), kNoiseSteps * grid_mm);
  return shadow;
}

Result<Shape2D> slice_solid(Evaluator& evaluator, const NodePtr& solid, double z) {
  const auto section = evaluator.section(solid, z);
  if (!section) return section.error();
  if (section->empty()) return Shape2D();
  double extent = 0;
  for (const SectionSegment& s : *section) {
    for (const glm::dvec2& p : {s.from, s.to}) {
      extent = std::max({extent, std::fabs(p.x), std::fabs(p.y)});
    }
  }
  const Result<Grid2D> grid = grid_for(extent);
  if (!grid) return grid.error();
  std::vector<Segment2D> segments;
  std::map<Point2D, double> noise;  // of the corners: that of both segments
  for (const SectionSegment& s : *section) {
    const Point2D from = grid->snap(s.from), to = grid->snap(s.to);
    add_segment(from, to, kRestOfOperands, segments);
    noise[from] += s.noise;
    noise[to] += s.noise;
  }
  Result<Shape2D> shape = Shape2DFactory::arranged(*grid, std::move(segments),
                                                   [](int32_t, int32_t rest) { return rest > 0; });
  if (!shape) return shape;
  // Faces that the grid made bent have a corner where they are.
  std::vector<Shape2D::Loop> lean;
  bool is_lean = true;
  for (const Shape2D::Loop& loop : shape->loops()) {
    lean.push_back(without_straight_corners(loop, [&](const glm::dvec2& corner) {
      const auto found = noise.find(grid->snap(corner));
      return found == noise.end() ? 0 : found->second;
    }));
    is_lean = is_lean && lean.back().size() == loop.size();
  }
  return is_lean ? shape : Shape2D::from_outlines(lean);
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
