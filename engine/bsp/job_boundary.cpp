// The polygons of materialised results in a job: faces made convex, and those that are named.
#include <algorithm>
#include <cassert>
#include <functional>
#include <numeric>

#include "engine/bsp/cell_geometry.h"
#include "engine/bsp/convexify.h"
#include "engine/bsp/enter_planes.h"
#include "engine/bsp/job.h"
#include "engine/bsp/untouched.h"

namespace csgrun {

namespace {

/// Calls f(face) for the faces of a boundary that a job has.
template <class F>
void each_face(const BoundaryMesh& mesh, const std::vector<uint32_t>* some, F&& f) {
  if (some) {
    for (const uint32_t face : *some) f(face);
  } else {
    for (uint32_t face = 0; face < mesh.faces.size(); ++face) f(face);
  }
}

template <class F>
void each_corner(const BoundaryMesh& mesh, const BoundaryMesh::Face& face, F&& f) {
  const uint32_t end = mesh.loop_starts[face.first_loop + face.loop_count];
  for (uint32_t c = mesh.loop_starts[face.first_loop]; c < end; ++c) f(mesh.corners[c]);
}

/// The points of some faces; of all, if there is no list.
std::vector<uint32_t> points_of(const BoundaryMesh& mesh, const std::vector<uint32_t>* some) {
  std::vector<uint32_t> points;
  if (!some) {
    points.resize(mesh.point_planes.size());
    std::iota(points.begin(), points.end(), 0);
    return points;
  }
  each_face(mesh, some, [&](uint32_t f) {
    each_corner(mesh, mesh.faces[f],
                [&](const BoundaryMesh::Corner& c) { points.push_back(c.point); });
  });
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

}  // namespace

/// Enters the planes of a boundary; of some faces only those that these need.
void Job::add_boundary_planes(size_t o, const Operand& operand) {
  const BoundaryMesh& mesh = *operand.boundary;
  const IVec3& moved = operand.translation;
  const FrameMap& map = sources_[o].map;
  std::vector<PlaneId>& ids = boundary_planes_[o];
  const std::vector<uint32_t>* const some = some_faces(o);
  if (!some && planes_.size() == 0 && map.is_identity() && moved == IVec3{0, 0, 0}) {
    planes_.adopt(mesh.planes);
    ids.reserve(mesh.planes.size());
    for (uint32_t p = 0; p < mesh.planes.size(); ++p) ids.emplace_back(p, false);
    return;
  }
  ids.assign(mesh.planes.size(), PlaneId());
  const auto there = [&](size_t p) {
    // A plane that is moved by whole steps has the common divisors that it had.
    const Plane plane = translate_plane(mesh.planes[p], moved);
    return map.is_identity() ? as_stored(plane) : reduce(map.plane(plane));
  };
  if (!some) {
    enter_planes(planes_, mesh.planes.size(), there, [&](size_t p, const ReducedPlane& plane) {
      ids[p] = planes_.intern_computed(plane);
    });
    return;
  }
  const auto enter = [&](uint32_t p) {
    if (!ids[p].valid()) ids[p] = planes_.intern_computed(there(p));
  };
  each_face(mesh, some, [&](uint32_t f) {
    enter(mesh.faces[f].plane.index());
    each_corner(mesh, mesh.faces[f], [&](const BoundaryMesh::Corner& c) {
      enter(c.edge_plane);
      for (const uint32_t p : mesh.point_planes[c.point]) enter(p);
    });
  });
}

void Job::add_boundary(uint32_t o, const Operand& operand) {
  const BoundaryMesh& mesh = *operand.boundary;
  const std::vector<PlaneId>& plane_of = boundary_planes_[o];
  CellGeometry geometry(planes_, nullptr);
  const bool moved = !operand.frame.is_identity || operand.translation != IVec3{0, 0, 0};
  const std::vector<uint32_t>* const some = some_faces(o);
  const std::vector<uint32_t> points = points_of(mesh, some);
  const auto number_of = [&](uint32_t point) {
    if (!some) return point;
    const auto found = std::lower_bound(points.begin(), points.end(), point);
    return static_cast<uint32_t>(found - points.begin());
  };
  for (const uint32_t p : points) {
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
  each_face(mesh, some, [&](uint32_t f) {
    const BoundaryMesh::Face& face = mesh.faces[f];
    edges.clear();
    for (uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
      const uint32_t begin = mesh.loop_starts[l], end = mesh.loop_starts[l + 1];
      for (uint32_t c = begin; c < end; ++c) {
        const BoundaryMesh::Corner& next = mesh.corners[c + 1 < end ? c + 1 : begin];
        BoundaryEdge e{number_of(mesh.corners[c].point), number_of(next.point),
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
  });
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
