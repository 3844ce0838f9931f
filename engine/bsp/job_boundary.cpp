// The polygons of materialised results in a job: faces made convex, and those that are named.
#include <algorithm>
#include <cassert>
#include <functional>

#include "engine/bsp/cell_geometry.h"
#include "engine/bsp/convexify.h"
#include "engine/bsp/job.h"
#include "engine/bsp/untouched.h"

namespace csgrun {

void Job::add_boundary(uint32_t o, const Operand& operand) {
  const BoundaryMesh& mesh = *operand.boundary;
  const std::vector<PlaneId>& plane_of = boundary_planes_[o];
  CellGeometry geometry(planes_, nullptr);
  const bool moved = !operand.frame.is_identity || operand.translation != IVec3{0, 0, 0};
  for (size_t p = 0; p < mesh.point_planes.size(); ++p) {
    const auto& t = mesh.point_planes[p];
    const std::array<uint32_t, 3> planes{plane_of[t[0]].index(), plane_of[t[1]].index(),
                                         plane_of[t[2]].index()};
    if (moved) {
      geometry.add_point(planes);
    } else {
      geometry.add_point(planes, mesh.point_rounded[p]);
    }
  }
  const std::function<uint32_t(int, int64_t)> wall_of = [this](int axis, int64_t m) {
    return wall(axis, m);
  };
  const bool mirrored = sources_[o].map.is_mirrored();
  std::vector<Fragment> pieces;
  std::vector<BoundaryEdge> edges;
  const auto first_vertex = static_cast<uint32_t>(rounded_.size());
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const BoundaryMesh::Face& face = mesh.faces[f];
    edges.clear();
    for (uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
      const uint32_t begin = mesh.loop_starts[l], end = mesh.loop_starts[l + 1];
      for (uint32_t c = begin; c < end; ++c) {
        const BoundaryMesh::Corner& next = mesh.corners[c + 1 < end ? c + 1 : begin];
        BoundaryEdge e{mesh.corners[c].point, next.point,
                       plane_of[mesh.corners[c].edge_plane].index()};
        if (mirrored) std::swap(e.from, e.to);
        edges.push_back(e);
      }
    }
    if (mirrored) std::reverse(edges.begin(), edges.end());
    const PlaneId mapped = plane_of[face.plane.index()];
    const PlaneId support = face.plane.flipped() ? mapped.flip() : mapped;
    pieces.clear();
    convexify(geometry, planes_, support, edges, wall_of, pieces);
    for (const Fragment& piece : pieces) {
      const auto first = static_cast<uint32_t>(corners_.size());
      for (uint32_t i = 0; i < piece.count; ++i) {
        corners_.push_back(first_vertex + geometry.corners(piece)[i]);
      }
      edge_planes_.resize(corners_.size(), kNone);
      std::copy_n(geometry.edges(piece), piece.count, edge_planes_.begin() + first);
      polygons_.push_back({o, f, first, piece.count, support});
    }
  }
  for (uint32_t p = 0; p < geometry.point_count(); ++p) {
    rounded_.push_back(geometry.point(p).rounded);
    boundary_vertices_[o].push_back(geometry.point(p).planes);
  }
  for (uint32_t p = polygon_starts_.back(); with_boxes_ && p < polygons_.size(); ++p) {
    boxes_.push_back(box_of(polygons_[p]));
  }
  if (!mesh.parts.empty()) add_parts(o, operand);
}

/// Adds the named faces as they stand in their leaves, which share the corners with the others that
/// they share in the boundary.
void Job::add_parts(uint32_t o, const Operand& operand) {
  assert(can_stand_named(operand));
  const BoundaryMesh& mesh = *operand.boundary;
  const uint32_t first_vertex = vertex_operand_starts_.back();
  auto number = static_cast<uint32_t>(mesh.faces.size());
  for (const UntouchedPart& part : mesh.parts) {
    const auto first_polygon = static_cast<uint32_t>(polygons_.size());
    RawVector<uint32_t> vertex_of(part.leaf->vertices.size());
    add_part_vertices(part, operand.translation, vertex_of);
    for (const UntouchedPart::Shared& s : part.shared) {
      vertex_of[s.vertex] = first_vertex + s.point;
    }
    auto corner = static_cast<uint32_t>(corners_.size());
    corners_.resize(corner + 3 * part.faces.size());
    edge_planes_.resize(corners_.size(), kNone);
    polygons_.resize(first_polygon + part.faces.size());
    for (size_t i = 0; i < part.faces.size(); ++i, corner += 3) {
      const auto triangle = part.triangle(part.faces[i]);
      for (size_t k = 0; k < 3; ++k) corners_[corner + k] = vertex_of[triangle[k]];
      polygons_[first_polygon + i] = {o, number++, corner, 3, PlaneId()};
    }
    for (uint32_t p = first_polygon; with_boxes_ && p < polygons_.size(); ++p) {
      boxes_.push_back(grid_box_of(polygons_[p]));
    }
    named_parts_[o].push_back({first_polygon, std::move(vertex_of)});
  }
}

/// Those of the faces of a part that are no others'.
void Job::add_part_vertices(const UntouchedPart& part, const IVec3& translation,
                            RawVector<uint32_t>& vertex_of) {
  std::vector<uint8_t> is_own(part.leaf->vertices.size(), 0);
  for (const uint32_t f : part.faces) {
    for (const uint32_t v : part.triangle(f)) is_own[v] = 1;
  }
  for (const UntouchedPart::Shared& s : part.shared) is_own[s.vertex] = 0;
  auto next = static_cast<uint32_t>(rounded_.size());
  rounded_.resize(rounded_.size() + is_own.size() + 1);  // each is set, and kept if it is one
  for (uint32_t v = 0; v < is_own.size(); ++v) {
    const IVec3 at = part.vertex(v);
    for (size_t k = 0; k < 3; ++k) {
      rounded_[next][k] = static_cast<double>(at[k] + translation[k]);
    }
    vertex_of[v] = next;
    next += is_own[v];
  }
  rounded_.resize(next);
}

bool Job::is_face_of_leaf(const JobPolygon& p) const {
  const Operand& operand = (*operands_)[p.operand];
  return operand.leaf || (operand.boundary && p.face >= operand.boundary->faces.size());
}

}  // namespace csgrun
