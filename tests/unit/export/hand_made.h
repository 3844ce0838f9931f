// Solids made by hand, for tests of what is written of them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <csgrun/engine/solid.h>

namespace csgrun::testing {

/// Builds a Solid from points and faces; the caller sees to it that it is a closed manifold.
class HandMade {
 public:
  HandMade();

  uint32_t vertex(double x, double y, double z);

  uint32_t appearance(const Appearance& a);

  uint32_t source(std::string kind, std::string where);

  /// A convex face; its triangles are a fan about the first corner.
  void face(const std::vector<uint32_t>& loop, uint32_t appearance = 0, uint32_t surface = 0,
            uint32_t source = 0);

  /// A face with holes and its triangles.
  void face(const std::vector<std::vector<uint32_t>>& loops,
            const std::vector<std::array<uint32_t, 3>>& triangles, uint32_t appearance = 0,
            uint32_t surface = 0, uint32_t source = 0);

  /// An axis-parallel box with vertices of its own; bottom, top, then the sides.
  void box(const glm::dvec3& low, const glm::dvec3& high, uint32_t appearance = 0);

  /// A tetrahedron; it looks outwards when d lies behind a, b, c.
  void tetrahedron(const std::array<glm::dvec3, 4>& p);

  /// A prism over a regular polygon given by its corners, z from 0 to h; the side is surface 1.
  void prism(const std::vector<std::pair<double, double>>& corners, double h,
             uint32_t side_surface);

  [[nodiscard]] SolidPtr share() const;

  Solid solid;

 private:
  std::map<std::array<double, 3>, size_t> points_;
};

SolidPtr cube(double size);

/// Two cubes that share an edge (0,0,z), with vertices of their own there.
SolidPtr edge_touching_cubes();

/// Two cubes joined by a square tube of length 1, from (1, .5, .5) on. `width` of 1e-9 vanishes by
/// rounding to float, and by rounding to double when it is 1e-17.
SolidPtr dumbbell(double width);

}  // namespace csgrun::testing
