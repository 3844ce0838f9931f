// What the kernel is given: operands in plane form and the Boolean expression over them.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <csgrun/engine/csg_tree.h>

#include "engine/bsp/face_numbers.h"

namespace csgrun {

/// Integer grid coordinates, in steps.
using IVec3 = std::array<int64_t, 3>;

/// A leaf on the integer grid of its frame: planar convex polygons over integer vertices.
///
/// Invariants: |coordinate| < 2^27 (2^40 for a leaf that reaches far outside the region of
/// interest); each face is one loop, counter-clockwise from outside, exactly planar and convex,
/// with at least three corners that are not collinear (180 degree corners are allowed); closed:
/// each directed edge is balanced by its reverse. As an operand of a Boolean it bounds a solid: it
/// crosses nothing and winds once around its inside. Leaves that do not are resolved first, by a
/// job of their own (bsp/self_resolution).
struct LeafGeometry {
  std::vector<IVec3> vertices;
  std::vector<uint32_t> corners;
  std::vector<uint32_t> face_starts{0};
  /// Per face. Coplanar faces of one leaf with equal facet, surface and appearance are parts of one
  /// face. 0 for primitives; the number of the original face, from 1, for meshes whose facets are
  /// kept.
  FaceNumbers facet;
  FaceNumbers surface;     ///< per face: PolygonMesh::surface
  FaceNumbers appearance;  ///< per face: kernel-wide appearance id
  /// Per edge, which has the index (in `corners`) of the corner that it leaves: the same edge as
  /// its neighbour runs it, back. Empty unless each directed edge is there once and its reverse
  /// too.
  std::vector<uint32_t> opposite;
  bool convex = false;
  /// True when the faces at each vertex are known to be one fan.
  bool has_single_fans = false;
  /// False when no two neighbours are known to lie in one plane.
  bool may_have_flat_edges = true;
  /// False when the faces are known to meet in corners and edges that both have, or nowhere.
  bool may_touch = true;

  [[nodiscard]] size_t face_count() const { return face_starts.size() - 1; }
  /// REQUIRES: there is a face.
  [[nodiscard]] bool keeps_facets() const { return facet[0] != 0; }
  /// No face has fewer corners than a triangle.
  [[nodiscard]] bool consists_of_triangles() const { return corners.size() == 3 * face_count(); }
  /// Whether each face is a triangle and known to be a facet of its own that is kept. REQUIRES: as
  /// above.
  [[nodiscard]] bool has_triangles_as_facets() const {
    return keeps_facets() && facet.count_up() && consists_of_triangles();
  }
};

/// The frame of a leaf: world -> frame is B = matrix / 2^40 (Numbers: docs/numerics.md). A point q
/// of the frame is the world point 2^40 adj(matrix) q / det(matrix); a plane (n, d) of the frame is
/// the world plane (matrix^T n, 2^40 d). A negative determinant mirrors. Identity: `is_identity`.
struct Frame {
  static constexpr int kShift = 40;
  std::array<std::array<int64_t, 3>, 3> matrix{};
  bool is_identity = true;
  bool operator==(const Frame&) const = default;
};

struct BoundaryMesh;  // boundary_mesh.h: a materialised result in plane form
struct PieceOperand;  // piece_store.h: a materialised result in pieces

/// One operand: a leaf or a materialised result, moved by whole steps within its frame, then mapped
/// to the world by its frame. A result in pieces stands where it is, in the world, under the labels
/// that it has, and last in a list; a job has only a part of it.
struct Operand {
  std::shared_ptr<const LeafGeometry> leaf;
  std::shared_ptr<const BoundaryMesh> boundary;
  std::shared_ptr<const PieceOperand> pieces;
  IVec3 translation{0, 0, 0};
  Frame frame;
  uint32_t first_source = 0;  ///< source of a leaf; added to the sources of a boundary's labels
  std::optional<uint32_t> appearance;  ///< overrides the appearance of every face
};

/// A Boolean expression over operands, as a flat tree; children stand before their parents and the
/// root is the last node.
struct Expression {
  struct Node {
    bool is_operand = true;
    BooleanOp op = BooleanOp::kUnion;
    uint32_t operand = 0;                       ///< when is_operand
    uint32_t first_child = 0, child_count = 0;  ///< into `children`, when not
  };
  std::vector<Node> nodes;
  std::vector<uint32_t> children;  ///< node indices
};

struct KernelOptions {
  unsigned threads = 1;
  uint32_t cell_limit = 17;
  std::array<uint32_t, 3> octree_shift{0, 0, 0};
  bool literal_cells = false;
  bool whole_faces = true;  ///< cut faces whole (whole_faces.h); false: cells for all
  /// Operands stand in groups where so many of their faces overlap in planes, or cross one another,
  /// that these are less work (bsp/operand_groups.h).
  bool may_group = true;
  bool stop_when_crowded = false;  ///< of one job: give up where that is so
  bool is_of_crowd = false;        ///< the job is a part of one that was given up
  /// Faces of leaves that nothing touched are named instead of spelled out (BoundaryMesh::parts).
  bool name_untouched = false;
  /// Operands of so many faces leave those out of the job that are near no other operand
  /// (near_faces.h; with name_untouched only), or where nothing is boundary (live_faces.h).
  uint32_t faces_for_near = 4096;
  const std::atomic<bool>* cancel = nullptr;
  std::function<void(uint64_t, uint64_t)> progress;
};

/// Axis-aligned box in grid steps, closed.
struct GridBox {
  IVec3 lo{0, 0, 0}, hi{-1, -1, -1};
  [[nodiscard]] bool empty() const { return lo[0] > hi[0] || lo[1] > hi[1] || lo[2] > hi[2]; }
  [[nodiscard]] GridBox moved(const IVec3& t) const {
    return {{lo[0] + t[0], lo[1] + t[1], lo[2] + t[2]}, {hi[0] + t[0], hi[1] + t[1], hi[2] + t[2]}};
  }
};

/// Empty for no points.
inline GridBox box_of_points(const std::vector<IVec3>& points) {
  GridBox box;
  if (points.empty()) return box;
  box.lo = box.hi = points[0];
  for (const IVec3& p : points) {
    for (size_t k = 0; k < 3; ++k) {
      box.lo[k] = std::min(box.lo[k], p[k]);
      box.hi[k] = std::max(box.hi[k], p[k]);
    }
  }
  return box;
}

}  // namespace csgrun
