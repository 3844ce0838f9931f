// Chains of a DXF: their places on its grid of 1/1024, and how they are joined to loops.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

#include <csgrun/primitives/shape2d.h>

#include "primitives/files/flat_curves.h"

namespace csgrun {

/// Takes points to the places, 1/1024 apart, that OpenSCAD takes them to: the nearest one, or,
/// where that has no point yet, one of its eight neighbours that has.
class DxfGrid {
 public:
  using Key = std::pair<int64_t, int64_t>;
  static Key key(const glm::dvec2& p);
  glm::dvec2 aligned(const glm::dvec2& p);

 private:
  std::set<Key> taken_;
};

/// Lines that are not closed.
struct OpenLines {
  size_t count = 0;
  glm::dvec2 first{};  ///< where the first one begins
};

/// Closed chains are loops; open ones are joined end to end, and what is open then is closed by a
/// straight line and added to `open`. With `as_openscad` in OpenSCAD's order, which decides where
/// more than two chains meet. Takes the points of the chains.
std::vector<Shape2D::Loop> join_to_loops(std::vector<Chain>& chains, bool as_openscad,
                                         OpenLines& open);

}  // namespace csgrun
