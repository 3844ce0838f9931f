// From the polygons of a user to a leaf on the integer grid.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <csgrun/engine/polygon_mesh.h>

#include "engine/bsp/operand.h"
#include "engine/csg/frames.h"
#include "engine/csg/grid.h"

namespace csgrun {

/// How the points of a leaf become integers. In a frame: X = scale v + offset in the local axes,
/// rounded as the frame's axes have it (permutation X), so that leaves that share a frame agree on
/// ties. In the world: X = map(v).
struct LeafRounding {
  static constexpr double kEndless = std::numeric_limits<double>::infinity();
  bool in_world = false;
  Affine map;  ///< when in_world
  std::array<double, 3> scale{1, 1, 1};
  std::array<double, 3> offset{0, 0, 0};
  /// Where ends are drawn to that are beyond (scene_step.h), in the local axes.
  std::array<double, 3> lo{-kEndless, -kEndless, -kEndless}, hi{kEndless, kEndless, kEndless};
  SignedPermutation permutation;
};

/// A byte for each point of a mesh, 1 if a face uses it, or if the mesh is but points.
std::vector<uint8_t> find_used_points(const PolygonMesh& mesh);

/// The points that the mesh's faces use (others are 0), rounded, in local axes. std::nullopt when a
/// coordinate is 2^40 steps or more.
std::optional<std::vector<IVec3>> round_points(const PolygonMesh& mesh,
                                               const LeafRounding& rounding,
                                               const Quantiser& quantiser);

/// A leaf on the grid, in its local axes, or why it is none.
struct PreparedLeaf {
  enum class Status {
    kGood,     ///< the boundary of a solid
    kTangled,  ///< crosses itself, or its shells do not fit together: a fill rule says what is
               ///< inside
    kFlat,     ///< no face is left on the grid, or all lie in a plane across an axis
    kOpen,     ///< a directed edge without its reverse
  };
  Status status = Status::kFlat;
  std::shared_ptr<const LeafGeometry> geometry;    ///< when kGood or kTangled
  GridBox box;                                     ///< of the geometry
  std::vector<std::array<uint32_t, 2>> crossings;  ///< see find_self_intersections
  bool by_rounding = false;  ///< a face's loops cross only since they were rounded
  bool connected = true;     ///< one shell, without edges of more than two faces
};

/// Makes the faces of `mesh` over integer `points` planar and convex, and checks what they enclose
/// (see LeafGeometry). `turn` reverses every loop. `appearance` has an id per face. The mesh's
/// promise to be convex is verified.
PreparedLeaf prepare_leaf(const PolygonMesh& mesh, const std::vector<IVec3>& points, bool turn,
                          const FaceNumbers& appearance);

/// The same of faces that are planar and convex already, over distinct vertices.
PreparedLeaf prepare_faces(LeafGeometry&& leaf);

/// The geometry in other axes. A mirroring permutation reverses every loop.
LeafGeometry permuted(const LeafGeometry& leaf, const SignedPermutation& permutation);

}  // namespace csgrun
