// An evaluated solid: the canonical boundary of a CSG tree as arrays, ready to be measured and
// written.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <csgrun/engine/polygon_mesh.h>

namespace csgrun {

/// Exact measures, each correctly rounded to double once (area: within one unit in the last place).
struct Measures {
  double volume = 0;                 ///< mm^3
  double area = 0;                   ///< mm^2
  std::array<glm::dvec3, 2> bbox{};  ///< mm; meaningless when empty
  glm::dvec3 centroid{};             ///< mm, of the volume
  int64_t components = 0;            ///< connected surfaces, touching ones counted apart
  int64_t genus = 0;                 ///< sum over the components
  bool closed = true;
};

/// What is measured of solids. Measures are exact: of large results they take up to as long as
/// everything else. What is not asked for may be there or not.
enum class Measuring : uint8_t {
  kNothing,       ///< nothing of Solid::measures, and no Solid::canonical_hash
  kTopology,      ///< Measures::components and genus, which take little
  kButTheCentre,  ///< all but Measures::centroid
  kAll,
};

/// One solid. A closed, oriented 2-manifold by index: every directed edge of `triangles` occurs
/// once and so does its reverse; the triangles around a vertex form one fan. Where surfaces touch
/// in an edge or a vertex, vertices are duplicated; copies have the same `point_of`.
///
/// The order of everything is canonical: it depends on the geometry only.
struct Solid {
  struct Face {
    uint32_t first_loop, loop_count;  ///< outer loop counter-clockwise from outside, then holes
    uint32_t appearance;              ///< index into `appearances`
    uint32_t surface;                 ///< 0 = flat; equal ids > 0: one curved surface
    uint32_t source;                  ///< index into `sources`: the leaf that made it
  };
  struct Source {
    std::string kind;   ///< PolygonMesh::kind of the leaf
    std::string where;  ///< "file:line", may be empty
  };

  std::vector<glm::dvec3> positions;                ///< mm, correctly rounded
  std::vector<std::array<float, 3>> positions_f32;  ///< mm, correctly rounded from the exact value
  std::vector<uint32_t> point_of;  ///< per vertex: its geometric point; a number may be left out
  std::vector<uint8_t> on_grid;    ///< per vertex: 1 if it is exactly a point of the grid, else 0
  std::vector<std::array<uint32_t, 3>> triangles;  ///< counter-clockwise from outside
  std::vector<uint32_t> triangle_face;             ///< per triangle: its face
  std::vector<Face> faces;
  std::vector<uint32_t> loop_starts{0};  ///< loops index `loop_vertices`
  std::vector<uint32_t> loop_vertices;
  /// Per face: a vector along its outward normal, of no certain length; each coordinate is within
  /// one unit in the last place of the exact plane's.
  std::vector<glm::dvec3> face_normals;
  std::vector<Appearance> appearances;
  std::vector<Source> sources;
  /// By `point_of`: x, y, z in mm as fractions in lowest terms, "p/q" or "p". Empty unless
  /// EvaluateOptions::exact_points asks for them; no points, no text.
  std::vector<std::array<std::string, 3>> exact_points;
  Measures measures;
  std::array<uint64_t, 2> canonical_hash{};  ///< of the exact geometry, faces and appearances

  [[nodiscard]] bool empty() const { return triangles.empty(); }
};

using SolidPtr = std::shared_ptr<const Solid>;

}  // namespace csgrun
