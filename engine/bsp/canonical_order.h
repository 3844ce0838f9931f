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
