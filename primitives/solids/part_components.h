// Boxes that part the components of a solid from one another.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/solid.h>

#include "primitives/solids/box_search.h"

namespace csgrun {

/// A box along axes of its own, which are the columns: x in the world is transpose(axes) x there.
struct TurnedBox {
  glm::dmat3 axes;
  BoxSearch::Box box;

  [[nodiscard]] NodePtr node(const SourceRef& where) const;
};

/// What parts a component from all others: it is in `around` and `within`, and in none of
/// `without`, and they are not there.
struct Parting {
  BoxSearch::Box around;  ///< along the axes of the world
  std::vector<TurnedBox> within, without;
};

/// Of two components whose boxes meet, one may be clear of the other's box: of that along the axes
/// of the world, or of one along the faces of either.
class Parter {
 public:
  /// `triangles`: of each component, with those of its voids; `search`: of the boxes around them.
  /// All are looked at as long as this is.
  Parter(const Solid& solid, std::span<const std::vector<uint32_t>> triangles,
         const BoxSearch& search);

  /// Nothing if no boxes do with gaps wider than `noise` on either side. O(triangles of it and of
  /// those near to it).
  [[nodiscard]] std::optional<Parting> part(uint32_t component, double noise) const;

 private:
  bool part_from(uint32_t component, uint32_t other, double noise, Parting& result) const;
  [[nodiscard]] glm::dmat3 axes_of(uint32_t component) const;
  [[nodiscard]] BoxSearch::Box box_along(const glm::dmat3& axes, uint32_t component) const;
  [[nodiscard]] double gap(const TurnedBox& box, uint32_t component) const;
  template <class F>
  void each_triangle(uint32_t component, const glm::dmat3& axes, F&& f) const {
    for (const uint32_t t : triangles_[component]) {
      std::array<glm::dvec3, 3> corners;
      for (size_t i = 0; i < 3; ++i) {
        corners[i] = solid_.positions[solid_.triangles[t][i]] * axes;
      }
      f(corners);
    }
  }

  const Solid& solid_;
  const std::span<const std::vector<uint32_t>> triangles_;
  const BoxSearch& search_;
};

}  // namespace csgrun
