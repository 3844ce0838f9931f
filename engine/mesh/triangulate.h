// Exact triangulation of a planar face with holes. Knows no coordinates: it asks an oracle.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <csgrun/engine/error.h>

namespace csgrun {

/// Exact answers about points of one plane, named by numbers. All answers must be consistent with
/// one affine image of the plane, seen from the face's front.
class PlanarOracle {
 public:
  virtual ~PlanarOracle() = default;
  /// +1 when a, b, c turn left (counter-clockwise seen from the front), -1 right, 0 collinear.
  virtual int orient(uint32_t a, uint32_t b, uint32_t c) const = 0;
  /// A strict total order of distinct points along a sweep direction of the plane, ties broken
  /// along another direction: -1, 0 (same point), +1.
  virtual int compare(uint32_t a, uint32_t b) const = 0;
  /// How far along the sweep a point is: where two points have different ones, the lower one comes
  /// first by compare, too.
  virtual double along(uint32_t a) const = 0;
};

/// Triangulates one face: an outer loop (counter-clockwise) and holes (clockwise). Loops are simple
/// and do not cross; they may touch one another, or themselves, in vertices; 180 degree corners are
/// allowed; an edge may occur in both directions (a slit, a hole without width). Different numbers
/// are different points. Every triangle has positive area, every directed loop edge is an edge of
/// exactly one triangle, every other edge occurs once in each direction, and the result depends
/// only on the oracle's answers and the order of the points along the sweep, not on where a loop
/// starts. O(n log n). Errors: kInternal when the loops are not such a face.
Result<std::vector<std::array<uint32_t, 3>>> triangulate_face(
    std::span<const std::vector<uint32_t>> loops, const PlanarOracle& oracle);

/// The same for many faces, one after another, in memory that it keeps.
class Triangulator {
 public:
  Triangulator();
  ~Triangulator();
  /// Sets `triangles`; their order is that of triangulate_face.
  Status face(std::span<const std::vector<uint32_t>> loops, const PlanarOracle& oracle,
              std::vector<std::array<uint32_t, 3>>& triangles);

 private:
  class Sweep;
  friend Result<std::vector<std::array<uint32_t, 3>>> triangulate_by_sweep(
      std::span<const std::vector<uint32_t>> loops, const PlanarOracle& oracle);

  std::unique_ptr<Sweep> sweep_;  ///< made for the first face that needs it
};

/// The same by the general sweep alone, without the quick way for small loops: for tests.
Result<std::vector<std::array<uint32_t, 3>>> triangulate_by_sweep(
    std::span<const std::vector<uint32_t>> loops, const PlanarOracle& oracle);

}  // namespace csgrun
