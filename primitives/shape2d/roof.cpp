// What both kinds of roofs have in common: the outline on a grid, the floor, the last check.
#include <algorithm>
#include <cmath>
#include <utility>

#include <csgrun/engine/validate.h>
#include <csgrun/primitives/roof.h>

#include "primitives/base/text.h"
#include "primitives/shape2d/regions.h"
#include "primitives/shape2d/roof_mend.h"
#include "primitives/shape2d/roof_outline.h"
#include "primitives/shape2d/shape_factory.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {

namespace {

/// Loops that touch in a point may run on around it, as holes that touch do: an edge is followed by
/// the one that bounds the same wedge of the shape, the first clockwise from where it came.
void pair_touching_edges(RoofOutline& outline) {
  std::vector<std::vector<uint32_t>> leaving(outline.points.size());
  for (uint32_t e = 0; e < outline.edge_count(); ++e) leaving[outline.from[e]].push_back(e);
  for (uint32_t e = 0; e < outline.edge_count(); ++e) {
    const std::vector<uint32_t>& all = leaving[outline.to[e]];
    if (all.size() == 1) continue;
    const Point2D back = -outline.way(e);
    outline.next[e] = *std::min_element(all.begin(), all.end(), [&](uint32_t f, uint32_t g) {
      return clockwise_before(back, outline.way(f), outline.way(g));
    });
  }
}

}  // namespace

Result<RoofOutline> make_roof_outline(const Shape2D& shape, int bits) {
  RoofOutline outline;
  const double extent = extent_of(shape.loops());
  // A power of two, so that short decimals in binary stay what they are.
  outline.step = std::ldexp(1.0, std::ilogb(extent) + 1 - bits);
  const auto snap = [&](const glm::dvec2& p) {
    return Point2D{static_cast<int64_t>(std::floor(p.x / outline.step + 0.5)),
                   static_cast<int64_t>(std::floor(p.y / outline.step + 0.5))};
  };
  std::vector<Segment2D> segments;
  std::vector<std::pair<Point2D, glm::dvec2>> given;
  for (const Shape2D::Loop& loop : shape.loops()) {
    GridLoop snapped;
    for (const glm::dvec2& p : loop) {
      snapped.push_back(snap(p));
      given.emplace_back(snapped.back(), p);
    }
    add_outline(snapped, kRestOfOperands, segments);
  }
  auto arranged = arrange(std::move(segments));
  if (!arranged) return Error{ErrorCode::kInternal, "roof: the outlines do not settle", {}};
  const GridRegions regions =
      extract_regions(*arranged, [](int32_t, int32_t around) { return around > 0; });

  for (const GridLoop& loop : regions.loops) {
    outline.points.insert(outline.points.end(), loop.begin(), loop.end());
  }
  std::sort(outline.points.begin(), outline.points.end());
  outline.points.erase(std::unique(outline.points.begin(), outline.points.end()),
                       outline.points.end());
  // A corner of the shape stays where it was given, of several on one grid point the first.
  std::stable_sort(given.begin(), given.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const Point2D& p : outline.points) {
    const auto at = std::lower_bound(given.begin(), given.end(), p,
                                     [](const auto& a, const Point2D& b) { return a.first < b; });
    const glm::dvec2 on_grid(static_cast<double>(p.x) * outline.step,
                             static_cast<double>(p.y) * outline.step);
    outline.places.push_back(at != given.end() && at->first == p ? at->second : on_grid);
  }
  for (const GridLoop& loop : regions.loops) {
    const auto first = static_cast<uint32_t>(outline.from.size());
    const auto count = static_cast<uint32_t>(loop.size());
    std::vector<uint32_t>& indices = outline.loops.emplace_back();
    for (const Point2D& p : loop) {
      const auto at = std::lower_bound(outline.points.begin(), outline.points.end(), p);
      indices.push_back(static_cast<uint32_t>(at - outline.points.begin()));
    }
    for (uint32_t i = 0; i < count; ++i) {
      outline.from.push_back(indices[i]);
      outline.to.push_back(indices[(i + 1) % count]);
      outline.next.push_back(first + (i + 1) % count);
    }
  }
  outline.outer_of = regions.outer_of;
  pair_touching_edges(outline);
  return outline;
}

PolygonMesh roof_floor(const RoofOutline& outline) {
  PolygonMesh mesh;
  mesh.kind = "roof";
  for (const glm::dvec2& p : outline.places) mesh.points.emplace_back(p.x, p.y, 0);
  for (uint32_t outer = 0; outer < outline.loops.size(); ++outer) {
    if (outline.outer_of[outer] != outer) continue;
    std::vector<std::vector<uint32_t>> loops{outline.loops[outer]};
    for (uint32_t hole = 0; hole < outline.loops.size(); ++hole) {
      if (hole != outer && outline.outer_of[hole] == outer) loops.push_back(outline.loops[hole]);
    }
    for (auto& loop : loops) std::reverse(loop.begin(), loop.end());
    add_face_with_holes(mesh, loops);
  }
  return mesh;
}

Result<PolygonMesh> closed_roof(const RoofOutline& outline, PolygonMesh mesh) {
  constexpr double kThin = 64;  // steps: 6e-8 of the extent
  size_t floors = 0;
  for (uint32_t loop = 0; loop < outline.loops.size(); ++loop)
    floors += outline.outer_of[loop] == loop;
  mend_thin_parts(mesh, outline.points.size(), floors, kThin * outline.step);
  const MeshReport report = check_mesh(mesh);
  if (!report.open_edges && !report.misoriented_edges) return mesh;
  return Error{ErrorCode::kInternal,
               "roof: this shape has details too fine for its extent, no closed roof was found",
               {}};
}

namespace {

bool is_convex(const RoofOutline& outline) {
  for (uint32_t e = 0; e < outline.edge_count(); ++e) {
    if (outline.is_reflex_end(e)) return false;
  }
  return true;
}

/// Where no corner points inwards the roof is the same by both methods. The wavefront takes all
/// that happens at one time together, so a circle's roof has one top; in the diagram the top is as
/// many vertices as there are edges, apart by its rounding only, and the faces between them turn
/// over.
MeshResult one_roof(const RoofOutline& outline, const RoofOptions& options) {
  if (options.method == RoofMethod::kStraight) return straight_roof(outline);
  if (is_convex(outline)) {
    MeshResult roof = straight_roof(outline);
    if (roof) return roof;
  }
  return voronoi_roof(outline, options);
}

}  // namespace

MeshResult make_roof(const Shape2D& shape, const RoofOptions& options) {
  if (shape.empty()) return invalid_argument("roof: the shape is empty");
  const Facets& facets = options.facets;
  for (const auto& [name, value] :
       {std::pair{"fn", facets.fn}, std::pair{"fa", facets.fa}, std::pair{"fs", facets.fs}}) {
    if (!std::isfinite(value)) return not_finite("roof", name, value);
  }
  // Where outlines come near each other by parts of a step, a coarser grid joins them.
  MeshResult roof = invalid_argument("roof: the shape is thinner than the grid");
  for (const int bits : {30, 26, 22}) {
    const Result<RoofOutline> outline = make_roof_outline(shape, bits);
    if (!outline) return outline.error();
    if (outline->loops.empty()) break;
    roof = one_roof(*outline, options);
    if (roof || roof.error().code != ErrorCode::kInternal) break;
  }
  return roof;
}

}  // namespace csgrun
