// Is a point inside? By brute force: the winding number along a ray, exactly. Doubles only where an
// interval settles a comparison; everything else in GMP. Nothing is shared with the kernel.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "tests/support/exact_solid.h"

namespace csgrun::test {

/// A point whose coordinates are doubles, taken as exact.
using Query = std::array<double, 3>;

class Oracle {
 public:
  explicit Oracle(ExactSolid solid);

  [[nodiscard]] const ExactSolid& solid() const { return solid_; }

  /// How often the surface winds around the point: 1 inside, 0 outside of a sound solid. Nothing
  /// when the point lies on the boundary, or the ray along +x passes through an edge.
  [[nodiscard]] std::optional<int> winding(const Query& q) const;

 private:
  struct Box {
    Query lo{HUGE_VAL, HUGE_VAL, HUGE_VAL}, hi{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  };
  static double margin(double v) { return 1e-300 + 0x1p-48 * std::fabs(v); }

  /// Whether coordinate k of point p is at most the query's.
  [[nodiscard]] bool at_most(uint32_t p, int k, double q) const;

  /// The winding number of the face's loops around the query, both projected along x.
  [[nodiscard]] std::optional<int> winding_in_face(size_t f, const Query& q) const;

  [[nodiscard]] int turn_of(uint32_t a, uint32_t b, const Query& q) const;

  [[nodiscard]] int side_of_face(size_t f, const Query& q) const;

  ExactSolid solid_;
  std::vector<Query> near_;
  std::vector<Rational3> normals_;
  std::vector<Box> boxes_;
};

}  // namespace csgrun::test
