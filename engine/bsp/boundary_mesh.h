// A materialised result in plane form: the labelled boundary of a solid.
//
// The value of a node is a labelled point set: which points are boundary, which side is outside,
// and from which facet of which leaf each boundary point comes. Faces are maximal regions of one
// (plane, side, label); they carry only their true corners. Nothing here depends on the order of
// evaluation.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/base/raw_vector.h"
#include "engine/bsp/frame_map.h"
#include "engine/bsp/operand.h"
#include "engine/exact/plane.h"
#include "engine/exact/point.h"

namespace csgrun {

/// Where a piece of boundary comes from. `source` counts the leaves of the evaluated tree in
/// depth-first order.
struct FaceLabel {
  uint32_t source = 0, facet = 0, surface = 0, appearance = 0;
  bool operator==(const FaceLabel&) const = default;
  auto operator<=>(const FaceLabel&) const = default;
};

/// Triangles of one leaf that nothing touched (see bsp/untouched), by reference.
struct UntouchedPart {
  /// A corner that other faces of the boundary have, too: a vertex of the leaf and the point.
  struct Shared {
    uint32_t vertex, point;
  };

  std::shared_ptr<const LeafGeometry> leaf;
  IVec3 translation{0, 0, 0};  ///< in the leaf's frame
  FrameMap map;                ///< to the world; it does not mirror
  uint32_t source = 0;
  std::optional<uint32_t> appearance;  ///< overrides that of every face
  bool flipped = false;
  std::vector<uint32_t> faces;  ///< of the leaf, ascending
  std::vector<Shared> shared;   ///< by vertex
  /// Of each vertex of the leaf, its coordinates in the world, correctly rounded; none if they are
  /// its own.
  std::vector<std::array<double, 3>> world;

  /// A vertex in the leaf's frame, and in the world.
  [[nodiscard]] IVec3 vertex(uint32_t v) const {
    const IVec3& p = leaf->vertices[v];
    return {p[0] + translation[0], p[1] + translation[1], p[2] + translation[2]};
  }
  [[nodiscard]] Point point(uint32_t v) const { return map.point(vertex(v)); }
  [[nodiscard]] std::array<double, 3> rounded_point(uint32_t v) const {
    if (!map.is_identity()) return world[v];
    const IVec3 p = vertex(v);
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  }
  /// The corners of a face of the leaf, counter-clockwise from outside of the result.
  [[nodiscard]] std::array<uint32_t, 3> triangle(uint32_t face) const {
    const uint32_t* c = leaf->corners.data() + leaf->face_starts[face];
    return flipped ? std::array{c[2], c[1], c[0]} : std::array{c[0], c[1], c[2]};
  }
  [[nodiscard]] FaceLabel label(uint32_t face) const {
    return {source, leaf->facet[face], leaf->surface[face],
            appearance.value_or(leaf->appearance[face])};
  }
};

struct BoundaryMesh {
  /// A corner of a loop: the point, and a plane (index, any orientation) that holds the edge to the
  /// next corner and is not the face's own.
  struct Corner {
    uint32_t point, edge_plane;
  };
  /// A region of one plane: loops with the interior on their left, seen from outside. Outer loops
  /// and holes are not told apart here.
  struct Face {
    PlaneId plane;  ///< into `planes`; oriented outwards
    FaceLabel label;
    bool whole = false;  ///< exactly one facet of a leaf whose facets are kept, uncut
    uint32_t first_loop = 0, loop_count = 0;
    /// Together with the face of the same label on the other side of the plane, if there is one,
    /// exactly such a facet: what is cut by a symmetric difference may be made whole by another
    /// one.
    bool complete = false;
  };

  /// False when parts of the surface certainly meet in corners and edges that both have, or
  /// nowhere. This and `touches` alone may depend on the way of evaluation.
  bool may_touch = true;
  /// If they may touch, boxes in which all places are where they do; none: it can be anywhere.
  std::vector<GridBox> touches;
  RawVector<Plane> planes;
  std::vector<std::array<uint32_t, 3>> point_planes;  ///< each point: three planes that meet in it
  std::vector<std::array<double, 3>> point_rounded;   ///< and its coordinates, correctly rounded
  std::vector<Face> faces;
  std::vector<uint32_t> loop_starts{0};
  std::vector<Corner> corners;
  /// More faces. All points, faces and corners above are those of the others only.
  std::vector<UntouchedPart> parts;

  struct NamedFace {
    const UntouchedPart* part;
    uint32_t face;  ///< of its leaf
  };
  /// The faces of the parts have the numbers after `faces`, in their order. O(parts).
  [[nodiscard]] NamedFace named_face(uint32_t number) const {
    size_t place = number - faces.size();
    const UntouchedPart* part = parts.data();
    for (; place >= part->faces.size(); ++part) place -= part->faces.size();
    return {part, part->faces[place]};
  }

  [[nodiscard]] Point exact_point(uint32_t p) const {
    const auto& t = point_planes[p];
    return intersect(planes[t[0]], planes[t[1]], planes[t[2]]);
  }
};

/// The label of a face of an operand, a leaf or a boundary; of the latter's also named ones.
FaceLabel label_of(const Operand& operand, uint32_t face);

/// The plane moved by `t` grid steps: as canonical as it was.
Plane translate_plane(const Plane& plane, const IVec3& t);

/// The correctly rounded coordinates of a point, moved by `t` grid steps.
std::array<double, 3> rounded_when_moved(const BoundaryMesh& mesh, uint32_t point, const IVec3& t);

/// The boundary moved by `t` grid steps: what a job with this operand alone would make of it. O(n).
BoundaryMesh translated(const BoundaryMesh& mesh, const IVec3& t);

bool is_empty(const BoundaryMesh& mesh);
/// Of all faces, named ones too.
size_t face_count(const BoundaryMesh& mesh);
/// Bytes held by a boundary, for the cache's bound.
size_t memory_bytes(const BoundaryMesh& mesh);
/// Bounding box in grid steps, rounded outwards; empty for an empty boundary.
GridBox bounding_box(const BoundaryMesh& mesh);
/// The appearance that all faces have; nothing when they differ or there are none.
std::optional<uint32_t> only_appearance(const BoundaryMesh& mesh);

}  // namespace csgrun
