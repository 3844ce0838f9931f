// Leaf solids, with OpenSCAD's meaning to the vertex (names, defaults, vertex positions).
#pragma once

#include <array>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <csgrun/engine/error.h>
#include <csgrun/engine/polygon_mesh.h>

namespace csgrun {

/// More facets of a full turn than anybody can mean: scripts and trees that ask for them are
/// refused where they do, before anything is made.
inline constexpr double kMostFacets = 100000;

/// How round things become polygons: OpenSCAD's $fn, $fa, $fs, and its experimental $fe.
struct Facets {
  double fn = 0, fa = 12, fs = 2;
  double fe = 0;  ///< mm between a circle and its sides; fa and fs do not count then. 0: not asked
  friend bool operator==(const Facets&, const Facets&) = default;
  /// Whether fe says how many fragments there are; it is finite then.
  [[nodiscard]] bool by_error() const;
  /// Number of fragments of a full (or partial) turn of radius r.
  [[nodiscard]] int fragments(double r, double angle_deg = 360) const;
};

using MeshResult = Result<PolygonMesh>;

/// Box of the given size, a corner in the origin, or centred along the axes asked for.
MeshResult make_cube(const glm::dvec3& size, std::array<bool, 3> center = {false, false, false});
MeshResult make_sphere(double r, const Facets& facets);
/// Cylinder, cone (a radius may be 0) or frustum along +Z.
MeshResult make_cylinder(double h, double r1, double r2, bool center, const Facets& facets);
/// Faces are loops of 0-based indices, clockwise seen from outside (as OpenSCAD has it). Equal
/// points are welded. A solid that is inside out is turned over and `note` says so, unless `fill`,
/// which says what is inside where the faces cross, is kPositive: then orientation has a meaning.
/// Errors name the first bad face, edge or index.
/// Bent faces of four corners are cut as OpenSCAD cuts them where they lie; if there are any,
/// `uncut` gets the mesh without that, and not turned over.
MeshResult make_polyhedron(const std::vector<glm::dvec3>& points,
                           const std::vector<std::vector<uint32_t>>& faces, std::string* note,
                           FillRule fill = FillRule::kNonZero, PolygonMesh* uncut = nullptr);

}  // namespace csgrun
