// Solids that are no longer made of what made them: meshes refined, smoothed and bent, level sets.
#pragma once

#include <functional>
#include <span>
#include <string>

#include <glm/vec3.hpp>

#include <csgrun/engine/error.h>
#include <csgrun/engine/solid.h>
#include <csgrun/primitives/solids.h>

namespace csgrun {

/// The triangles of an evaluated solid, or some of them, as a mesh with its colours and curved
/// surfaces. Corners are rounded to doubles.
PolygonMesh mesh_of_solid(const Solid& solid, std::string kind);
PolygonMesh mesh_of_solid(const Solid& solid, std::span<const uint32_t> triangles,
                          std::string kind);

/// Halves edges until none is longer than `length`, triangles with them; facets are kept.
/// `mesh` is of triangles. Errors: kInvalidArgument, kLimit above 2^22 points.
MeshResult refine_mesh(PolygonMesh mesh, double length);

/// Rounds of subdivision after Loop (1987), each with four triangles for one: the surface draws
/// near one without edges. Facets are kept; they are shaded as one curved surface.
/// `mesh` is of triangles, closed, with two at each edge. Errors: kInvalidArgument, kLimit.
MeshResult smooth_mesh(PolygonMesh mesh, int rounds);

/// Moves every point. What is turned inside out, all in all, is turned over. What is left may cross
/// itself, and may enclose nothing. Errors: those of `move`; kInvalidArgument when points become
/// infinite.
MeshResult warp_mesh(PolygonMesh mesh,
                     const std::function<Result<glm::dvec3>(const glm::dvec3&)>& move);

struct LevelSetOptions {
  glm::dvec3 low{0}, high{0};  ///< where it is looked for; what reaches farther is cut off
  double step = 1;             ///< mm between samples, at most
  double level = 0;
};
/// The solid where a function is at most `level`, within the bounds, whose sides close it where it
/// reaches them. The function is asked on a lattice, in ascending z, y, x, each side of the bounds
/// cut into equal parts no longer than a step, and taken as linear in six tetrahedra of each cell:
/// so the surface is closed whatever the function does, it is exact where its corners lie on the
/// lattice, and what is smaller than a step may be missed. An empty mesh (no faces) when nothing is
/// inside. Errors: those of `function`, kInvalidArgument, kLimit above 2^28 samples. Memory for two
/// layers.
MeshResult make_level_set(const std::function<Result<double>(const glm::dvec3&)>& function,
                          const LevelSetOptions& options);

/// A box with round edges and corners of radius r: its extents are those of the box. The number of
/// facets of a full turn is a multiple of 4. Errors: kInvalidArgument when r is not positive or
/// more than half of the shortest side, kLimit.
MeshResult make_rounded_cube(const glm::dvec3& size, double r, std::array<bool, 3> center,
                             const Facets& facets);
/// A cylinder along +Z with round rims of radius `round`. Errors: kInvalidArgument when that is
/// more than r or half of h, kLimit.
MeshResult make_rounded_cylinder(double h, double r, double round, bool center,
                                 const Facets& facets);

}  // namespace csgrun
