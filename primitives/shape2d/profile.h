// What both extrusions need of a shape: shared vertices, loops by index, smooth chains.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include <csgrun/primitives/shape2d.h>

namespace csgrun {

/// A shape with its points numbered: loops that touch share the number.
struct Profile {
  std::vector<glm::dvec2> points;
  std::vector<std::vector<uint32_t>> loops;  ///< as Shape2D::loops()
  std::vector<bool> is_hole;                 ///< per loop
  std::vector<Shape2D::Region> regions;
};

/// Numbers the points of the given loops (those of the shape, perhaps with more vertices on edges).
Profile make_profile(const Shape2D& shape, const std::vector<Shape2D::Loop>& loops);

/// Per edge of a loop: a chain number from 0, equal for neighbours that turn by less than 40
/// degrees. `chain_count` gets the number of chains.
std::vector<uint32_t> smooth_chains(const Shape2D::Loop& loop, uint32_t& chain_count);

/// Whether walls over a loop of so many vertices and smooth chains are shaded as a curved surface:
/// a dodecagon is round, an octagon is not.
constexpr bool is_round_loop(size_t vertices, uint32_t chain_count) {
  return chain_count == 1 && vertices >= 12;
}

}  // namespace csgrun
