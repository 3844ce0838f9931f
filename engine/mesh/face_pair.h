// Do two convex faces of one mesh meet other than in what they share? Exactly.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

/// The faces of a leaf, for tests of pairs. REQUIRES: its vertices are distinct; it outlives this.
///
/// Coordinates up to 2^40 in magnitude are exact in double; differences have 41 bits, so every
/// determinant here (three factors, at most 3 * 2 * 2^123 < 2^126) fits 128 bits.
class FacePairs {
 public:
  /// What one thread needs while it tests.
  struct Scratch {
    std::vector<int> signs_f, signs_g;   ///< of f's corners against g, and the reverse
    std::vector<uint32_t> run_f, run_g;  ///< corners on a common line
  };

  explicit FacePairs(const LeafGeometry& leaf);

  /// Whether faces f and g meet in anything but corners and edges that both have.
  [[nodiscard]] bool conflict(uint32_t f, uint32_t g, Scratch& scratch) const;
  /// A point of a conflict, in doubles: for messages. It may be off by rounding.
  [[nodiscard]] std::array<double, 3> place(uint32_t f, uint32_t g) const;

 private:
  using Corners = std::span<const uint32_t>;
  /// Where a face meets the line of two planes: in the corner `vertex`, or between corners on
  /// either side of the other's plane. `above` and `below` span, in the face's plane, a line
  /// through the point; `above` has the greater sign.
  struct LineEnd {
    uint32_t above, below, vertex;
  };
  using Point = std::array<double, 3>;
  struct Plane {
    Point normal;                  ///< each component rounded once
    Point origin;                  ///< the first of `base`
    std::array<uint32_t, 3> base;  ///< points that span it, counter-clockwise
  };
  using Normal = std::array<__int128, 3>;

  Corners corners(uint32_t f) const {
    return {leaf_.corners.data() + leaf_.face_starts[f],
            leaf_.corners.data() + leaf_.face_starts[f + 1]};
  }
  Point point(uint32_t v) const;
  Normal exact_normal(const std::array<uint32_t, 3>& base) const;
  Plane plane_of(uint32_t f) const;
  bool triangles_apart(const uint32_t* f, const uint32_t* g, const Plane& plane_of_f) const;
  int side(const Plane& plane, uint32_t v) const;
  int orient(uint32_t a, uint32_t b, uint32_t c, uint32_t d) const;
  std::span<const std::pair<uint32_t, uint32_t>> sorted_corners(uint32_t f) const;
  bool has_corner(uint32_t f, uint32_t point) const;
  bool has_edge(uint32_t f, uint32_t a, uint32_t b) const;
  void signs_against(uint32_t f, uint32_t g, const Plane& plane_of_g,
                     std::vector<int>& signs) const;
  LineEnd line_end(uint32_t f, const std::vector<int>& signs, bool last) const;
  bool crossing_conflict(uint32_t f, uint32_t g, const Scratch& scratch) const;
  bool coplanar_conflict(uint32_t f, uint32_t g, Scratch& scratch) const;
  bool runs_conflict(Scratch& scratch) const;

  const LeafGeometry& leaf_;
  /// Of faces with many corners: these sorted, with their positions; an empty range for others.
  std::vector<std::pair<uint32_t, uint32_t>> sorted_;
  std::vector<uint32_t> sorted_starts_;  ///< empty when no face has many
};

}  // namespace csgrun
