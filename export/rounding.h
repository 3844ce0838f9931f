// The mesh of one file: a part in its place, with coordinates as the file can hold them.
//
// The engine's solid is a closed manifold of exact points, each correctly rounded once. Rounding
// may make points equal; then triangles vanish (see collapse.h). What is returned is a closed,
// oriented manifold by index in any case, and says what happened to get there.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <csgrun/engine/error.h>
#include <csgrun/export/write.h>

#include "export/half_edges.h"

namespace csgrun {

enum class Precision { kFloat, kDouble };

/// A solid under an affine map, not rounded yet to a file's precision.
struct PlacedSolid {
  std::vector<glm::dvec3> positions;  ///< per vertex of the solid
  bool mirrored = false;              ///< the map turned the surface inside out: reverse every loop
  std::vector<glm::dvec3> face_normals;  ///< per face of the solid: unit length, outwards
};

struct RoundedMesh {
  std::vector<glm::dvec3> positions;     ///< mm; exactly representable in the file; never -0
  std::vector<Triangle> triangles;       ///< counter-clockwise from outside
  std::vector<uint32_t> triangle_face;   ///< per triangle: its face of the solid
  std::vector<uint32_t> twins;           ///< see half_edges.h
  std::vector<glm::dvec3> face_normals;  ///< per face of the solid: unit length, outwards
  /// Per face of the solid: its outline as one loop of vertices, counter-clockwise from outside.
  /// Empty where the face cannot stand for its triangles: it has holes, or rounding changed it.
  /// Faces without triangles have none either.
  std::vector<std::vector<uint32_t>> outlines;

  uint64_t dropped = 0;    ///< triangles with two equal corners, left out
  uint64_t cancelled = 0;  ///< triangles that lay on their own reverse, left out
  uint64_t flipped = 0;    ///< triangles that look to the other side than their exact face
};

/// A number for each distinct position, in the order of first occurrence.
std::vector<uint32_t> number_places(std::span<const glm::dvec3> positions);

/// The position of each place that number_places() numbered.
std::vector<glm::dvec3> positions_of_places(std::span<const glm::dvec3> positions,
                                            std::span<const uint32_t> place);

/// The part's solid under `placement`. Exact when that is the identity.
PlacedSolid place_solid(const Solid& solid, const Affine& placement);

/// Rounds a part. `with_outlines`: fill `outlines`. Errors: kInternal when the solid is not what
/// solid.h promises, or the result is not a closed manifold. O(n log d), O(n log n) if points met.
Result<RoundedMesh> round_part(const Solid& solid, const Affine& placement, Precision precision,
                               bool with_outlines);

/// Moves the vertices of a mesh, which may bring some together: what vanishes then is taken out as
/// rounding does it, and counted. Outlines are lost. Errors: kInternal when the result is not a
/// closed manifold.
Status move_vertices(RoundedMesh& mesh, std::vector<glm::dvec3> positions);

/// What rounding did to the parts of one file: a line for each kind, however many parts there are.
class RoundingTotals {
 public:
  void add(const RoundedMesh& mesh, const std::string& part);
  /// Appends the warnings, if anything happened.
  void report(WriteReport& report) const;

 private:
  struct Kind {
    uint64_t count = 0;
    uint64_t parts = 0;
    std::string first_part;
    void add(uint64_t more, const std::string& part);
  };
  Kind vanished_, dropped_, cancelled_, flipped_;
};

}  // namespace csgrun
