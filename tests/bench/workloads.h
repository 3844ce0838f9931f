// The geometry of the benchmarks: raw meshes as a peer would be given them, made the same way each
// time (docs/performance.md says how each is defined).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <csgrun/engine/polygon_mesh.h>

namespace csgrun::bench {

/// Indexed triangles in doubles.
struct RawMesh {
  std::vector<double> points;       ///< x y z ...
  std::vector<uint32_t> triangles;  ///< a b c ...
  [[nodiscard]] size_t point_count() const { return points.size() / 3; }
  [[nodiscard]] size_t triangle_count() const { return triangles.size() / 3; }
};

/// The same for the engine.
PolygonMesh polygon_mesh(const RawMesh& raw, bool keep_facets);

RawMesh box(double x0, double y0, double z0, double x1, double y1, double z1);
/// A sphere made of an octahedron whose faces are divided; `segments` at the equator, a multiple
/// of 4.
RawMesh octahedron_sphere(double radius, int segments);
/// From z = 0 to `height`; caps are fans without a centre.
RawMesh cylinder(double radius, double height, int segments);
RawMesh moved(const RawMesh& mesh, double x, double y, double z);
/// Turned about z through the centre of the bounding box; vertices stay doubles.
RawMesh rotated_z(const RawMesh& mesh, double degrees);

/// The tools of `chain` and `batch`: n spheres of radius 1.5 (512 triangles) on the top face of
/// block(), at places drawn from a linear congruential generator.
std::vector<RawMesh> drill_spheres(int n);
RawMesh block();
/// The tools of `dome`: n spheres of radius 2 (512 triangles) whose middles lie on dome(), in
/// directions drawn from the same generator: z first, then the angle about it.
std::vector<RawMesh> dome_spheres(int n);
/// A sphere of radius 50 (8192 triangles).
RawMesh dome();
/// The bars to be taken out of the cube [0, 3^k]^3 for a Menger sponge of level k, for one axis
/// after the other (x, y, z): none inside a larger one, sticking out by 1 at both ends.
std::vector<RawMesh> menger_bars(int k);
RawMesh menger_cube(int k);
/// n x n cylinders of radius 0.6, one apart.
std::vector<RawMesh> cylinder_grid(int n);
/// n^3 touching unit cubes in raster order, x running fastest.
std::vector<RawMesh> cube_grid(int n);
/// Operands that go through one another, each turned by a rotation drawn uniformly from all: n
/// spheres of radius 10 (800 triangles) about one centre.
std::vector<RawMesh> shells(int n);
/// n rods of 200 x 2 x 2 whose middles lie in a cube of side 50.
std::vector<RawMesh> rods(int n);
/// n plates of 14 x 13 x 5 that stand on z = 0, at random places of a square of side 300, each
/// turned about z.
std::vector<RawMesh> plates(int n);

/// Moves the middle of the bounding box to the origin, and scales its longest side to 100.
void scale_to_box(PolygonMesh& mesh);
/// Turns the points about the origin by a rotation that is drawn uniformly from all of them.
void rotate_at_random(PolygonMesh& mesh, uint64_t seed);

}  // namespace csgrun::bench
