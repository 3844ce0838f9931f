// The faces of a result as users see them: pieces of one plane, side and appearance are one face
// wherever an operation touched them; facets of imports that nothing touched stay as they were.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/regions.h"
#include "engine/mesh/face_loops.h"

namespace csgrun {

/// Where other faces touch one from within (see conform.h).
struct InnerContacts {
  std::vector<uint32_t> points;                      ///< corners
  std::vector<std::pair<uint32_t, uint32_t>> slits;  ///< edges by their ends, the lower first
};

/// One connected face: the outer loop first, then its holes.
struct MergedFace {
  PlaneId plane;
  uint32_t appearance, surface, source;
  bool untouched;  ///< a facet that nothing touched: it shares no line with anything but its leaf
  FaceLoops loops;
  std::unique_ptr<InnerContacts> contacts{};  ///< of the few that have any

  [[nodiscard]] std::span<const uint32_t> points() const {
    return contacts ? contacts->points : std::span<const uint32_t>();
  }
  [[nodiscard]] std::span<const std::pair<uint32_t, uint32_t>> slits() const {
    return contacts ? contacts->slits : std::span<const std::pair<uint32_t, uint32_t>>();
  }
  InnerContacts& own_contacts() {
    if (!contacts) contacts = std::make_unique<InnerContacts>();
    return *contacts;
  }
};

/// Regroups the faces of a boundary. `geometry` holds the boundary's points under their own
/// numbers, `planes` its planes under theirs. A facet counts as touched when some face
/// at one of its corners is not a whole facet of the same leaf. The source and surface of a face
/// are those of the lowest label within it. Canonical order. False when a region does not close.
/// Parallel; reads the geometry only.
bool merge_faces(const BoundaryMesh& boundary, const CellGeometry& geometry,
                 const PlaneTable& planes, std::vector<MergedFace>& faces);

/// Brings faces into canonical order: loops from their lowest edge, faces by their lowest loop.
/// Points must be numbered in canonical order.
void sort_faces(std::vector<MergedFace>& faces, const PlaneTable& planes);

}  // namespace csgrun
