// How far a repaired mesh may be from the solid that it was rounded from.
//
// Vertices that move by at most d take the surface through no more volume than d times its area
// (which grows a little meanwhile). The union of a mesh with itself, with winding numbers above 0,
// brings no point of space farther from the solid: where one is inside that was not, or the other
// way round, moves have been before. So the volume of a repaired mesh differs from that of the
// solid by what its moves explain, and a body or void that is gone was no thicker than both its
// sides moved. What differs by more is no repair.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <csgrun/engine/error.h>
#include <csgrun/engine/solid.h>

#include "export/half_edges.h"
#include "export/rounding.h"

namespace csgrun {

/// One unit in the last place of the numbers of a file, mm, at the largest of these coordinates.
double unit_of(Precision precision, std::span<const glm::dvec3> positions);

/// What the moves of vertices come to.
struct Moves {
  double distance = 0;  ///< mm: no point of the surface is farther from where it was
  double volume = 0;    ///< mm^3: what the surface may have swept

  /// All vertices of the mesh move by at most `by`. O(n).
  void add(std::span<const glm::dvec3> positions, std::span<const Triangle> triangles, double by);
};

/// A connected surface of the solid.
struct SolidShell {
  double volume = 0;  ///< mm^3; negative for a void
  double area = 0;    ///< mm^2
  glm::dvec3 at{};    ///< mm: one of its vertices
  uint32_t face = 0;  ///< the first of its faces
  /// What a plate of its volume and area measures across.
  [[nodiscard]] double thickness() const;
};

class Fidelity {
 public:
  /// Errors: kInternal when the solid is not a manifold.
  static Result<Fidelity> of(const Solid& solid, const Affine& placement, Precision precision);

  /// What rounding to the file's precision moved.
  [[nodiscard]] const Moves& rounding() const { return rounding_; }
  /// Surfaces of the solid of whose faces nothing is left, if triangles of these faces are.
  [[nodiscard]] std::vector<SolidShell> vanished(std::span<const uint32_t> triangle_face) const;
  /// Why the mesh differs from the solid by more than the moves explain; empty if it does not.
  /// `triangle_face` are faces of the solid.
  [[nodiscard]] std::string breach(const RoundedMesh& mesh, std::span<const uint32_t> triangle_face,
                                   const Moves& moves) const;

 private:
  Fidelity() = default;

  std::vector<glm::dvec3> positions_;
  std::vector<Triangle> triangles_;
  std::vector<uint32_t> triangle_face_, shell_;  // per triangle
  double volume_ = 0, unit_ = 0;
  Moves rounding_;
};

}  // namespace csgrun
