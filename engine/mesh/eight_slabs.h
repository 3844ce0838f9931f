// Eight triangles with what they take up, so that one of another eight is held against all of them
// at once, in both senses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace csgrun {

/// Triangles of coordinates below 2^29 in magnitude, rounded. Each has four slabs: along its normal
/// and, in its plane, across each of its sides. Two that are apart in one plane, or beside an edge
/// of one of them, are apart along a slab of one or of the other.
class EightSlabs {
 public:
  /// [corner][axis][lane]
  using Corners = std::array<std::array<std::array<float, 8>, 3>, 3>;

  EightSlabs() = default;  ///< of nothing that is set
  /// `lanes`: a bit for each that is a triangle. `reach` is not below any coordinate, of these and
  /// of others, in magnitude.
  EightSlabs(const Corners& corners, uint32_t lanes, double reach);

  /// Of the eight, those of `which` that certainly have no point in common with one of another
  /// eight; none if that is no triangle.
  [[nodiscard]] uint32_t apart(const EightSlabs& others, uint32_t lane, uint32_t which) const;

 private:
  /// Four numbers that are computed with at once.
  using Four = float __attribute__((vector_size(16)));
  static constexpr size_t kHalves = 2;
  using Eight = std::array<Four, kHalves>;

  struct Slab {
    std::array<Eight, 3> along;  ///< of any length
    Eight lo, hi;
  };

  std::array<std::array<Eight, 3>, 3> corners_;  ///< [corner][axis]
  std::array<Slab, 4> slabs_;                    ///< across the sides, then along the normal
  uint32_t lanes_;
};

}  // namespace csgrun
