// The canonical order of a boundary: points by exact coordinates, loops from their lowest corner,
// faces by their lowest loop. Nothing that depends on the way of evaluation is left.
#pragma once

#include <vector>

#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/cell_geometry.h"
#include "engine/bsp/regions.h"

namespace csgrun {

/// Faces over the points and planes of an evaluation, in any order.
struct DraftBoundary {
  struct Face {
    PlaneId plane;
    FaceLabel label;
    bool whole, complete;
    uint32_t first_loop, loop_count;
  };
  std::vector<Face> faces;
  std::vector<uint32_t> loop_starts{0};
  std::vector<DirectedEdge> edges;

  /// Adds a face without loops, and a loop to the last face: the edges since the last loop.
  void begin_face(PlaneId plane, const FaceLabel& label, bool whole, bool complete) {
    faces.push_back(
        {plane, label, whole, complete, static_cast<uint32_t>(loop_starts.size() - 1), 0});
  }
  void end_loop() {
    loop_starts.push_back(static_cast<uint32_t>(edges.size()));
    ++faces.back().loop_count;
  }
  /// Adds a face of a boundary, the points of which have the numbers from `first_point` on here;
  /// plane_of(index) is the plane that one of the boundary's is.
  template <class PlaneOf>
  void add_face(const BoundaryMesh& mesh, const BoundaryMesh::Face& face, const FaceLabel& label,
                uint32_t first_point, PlaneOf&& plane_of) {
    const PlaneId plane = plane_of(face.plane.index());
    begin_face(face.plane.flipped() ? plane.flip() : plane, label, face.whole, face.complete);
    for (uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
      const uint32_t begin = mesh.loop_starts[l], end = mesh.loop_starts[l + 1];
      for (uint32_t c = begin; c < end; ++c) {
        edges.push_back({first_point + mesh.corners[c].point,
                         first_point + mesh.corners[c + 1 < end ? c + 1 : begin].point,
                         plane_of(mesh.corners[c].edge_plane).index()});
      }
      end_loop();
    }
  }
  /// Adds the faces of another one over the same points.
  void append(const DraftBoundary& more) {
    const auto first_loop = static_cast<uint32_t>(loop_starts.size() - 1),
               first_edge = static_cast<uint32_t>(edges.size());
    for (Face face : more.faces) {
      face.first_loop += first_loop;
      faces.push_back(face);
    }
    for (size_t l = 1; l < more.loop_starts.size(); ++l) {
      loop_starts.push_back(first_edge + more.loop_starts[l]);
    }
    edges.insert(edges.end(), more.edges.begin(), more.edges.end());
  }
};

/// The same faces with numbers of their own, in canonical order; `number`, if it is given, tells
/// those of the geometry's points (kNone: of no face). O(n log n).
BoundaryMesh canonical(CellGeometry& geometry, const PlaneTable& planes, DraftBoundary draft,
                       std::vector<uint32_t>* number = nullptr);

}  // namespace csgrun
