// Do two convex faces of one mesh meet other than in what they share? Exactly.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/bsp/operand.h"
#include "engine/mesh/box_tree.h"

namespace csgrun {

/// The faces of a leaf, prepared for tests of pairs. Points are numbered by their lexicographic
/// order, equal ones alike: on any line that is the order along the line.
///
/// Coordinates up to 2^40 in magnitude: differences have 41 bits, so every determinant here (three
/// factors, at most 3 * 2 * 2^123 < 2^126) fits 128 bits.
class FacePairs {
 public:
  explicit FacePairs(const LeafGeometry& leaf);

  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }
  /// Whether faces f and g meet in anything but corners and edges that both have.
  [[nodiscard]] bool conflict(uint32_t f, uint32_t g);
  /// A point of a conflict, in doubles: for messages.
  [[nodiscard]] std::array<double, 3> place(uint32_t f, uint32_t g) const;

 private:
  using Corners = std::span<const uint32_t>;
  /// Where a face meets the line of two planes: in the corner `vertex`, or between corners on
  /// either side of the other's plane. `above` and `below` span, in the face's plane, a line
  /// through the point; `above` has the greater sign.
  struct LineEnd {
    uint32_t above, below, vertex;
  };
  struct Plane {
    std::array<double, 3> normal;  ///< each component rounded once
    std::array<uint32_t, 3> base;  ///< points that span it, counter-clockwise
  };
  using Normal = std::array<__int128, 3>;

  Corners corners(uint32_t f) const {
    return {corners_.data() + starts_[f], corners_.data() + starts_[f + 1]};
  }
  Normal exact_normal(const std::array<uint32_t, 3>& base) const;
  int side(uint32_t f, uint32_t point) const;
  int orient(uint32_t a, uint32_t b, uint32_t c, uint32_t d) const;
  bool has_corner(uint32_t f, uint32_t point) const;
  bool has_edge(uint32_t f, uint32_t a, uint32_t b) const;
  void signs_against(uint32_t f, uint32_t g, std::vector<int>& signs) const;
  LineEnd line_end(uint32_t f, const std::vector<int>& signs, bool last) const;
  bool crossing_conflict(uint32_t f, uint32_t g) const;
  bool coplanar_conflict(uint32_t f, uint32_t g);
  bool runs_conflict();

  std::vector<IVec3> points_;  ///< sorted, distinct
  std::vector<uint32_t> corners_, starts_;
  std::vector<Plane> planes_;
  std::vector<Box> boxes_;
  /// Of faces with many corners: these sorted, with their positions; an empty range for others.
  std::vector<std::pair<uint32_t, uint32_t>> sorted_;
  std::vector<uint32_t> sorted_starts_;
  std::vector<int> signs_f_, signs_g_;   ///< of f's corners against g, and the reverse
  std::vector<uint32_t> run_f_, run_g_;  ///< corners on a common line
};

}  // namespace csgrun
