// A convex polyhedron inside a cell, in plane form: the region of a node in the literal path.
//
// Its faces share corners by number, so cutting is combinatorial once the sign of each corner is
// known: whether a plane cuts the region, and where, is decided exactly, and the cap that closes a
// half is what its other faces leave open.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "engine/bsp/cell_geometry.h"

namespace csgrun {

/// Points of the geometry by the planes that meet in them, so that no point is made twice.
class NamedPoints {
 public:
  explicit NamedPoints(CellGeometry& geometry) : geometry_(geometry) {}
  uint32_t at(std::array<uint32_t, 3> planes);
  CellGeometry& geometry() { return geometry_; }

 private:
  CellGeometry& geometry_;
  std::map<std::array<uint32_t, 3>, uint32_t> numbers_;
};

class ConvexRegion {
 public:
  /// One side of the region: a strictly convex loop, counter-clockwise from outside. Edge i runs
  /// from point i to the next; neighbour i is the plane of the face behind it.
  struct Face {
    uint32_t plane = kNone;
    std::vector<uint32_t> points, neighbours;
  };

  ConvexRegion() = default;
  /// The box between the walls x_lo, x_hi, y_lo, y_hi, z_lo, z_hi.
  ConvexRegion(NamedPoints& points, const std::array<uint32_t, 6>& walls);

  /// Where the region lies: kSplit when the plane passes through its interior, else kFront or
  /// kBack.
  [[nodiscard]] Side classify(NamedPoints& points, uint32_t plane) const;
  /// The two parts of a region that the plane cuts. REQUIRES: classify gives kSplit.
  void split(NamedPoints& points, uint32_t plane, ConvexRegion& front, ConvexRegion& back) const;
  /// The face in a plane. REQUIRES: there is one.
  [[nodiscard]] const Face& face_in(uint32_t plane) const;

 private:
  using Signs = std::map<uint32_t, int>;

  [[nodiscard]] Signs signs(NamedPoints& points, uint32_t plane) const;
  /// What lies on the side `keep` (+1 or -1) of the plane.
  [[nodiscard]] ConvexRegion half(NamedPoints& points, uint32_t plane, int keep,
                                  const Signs& signs) const;

  std::vector<Face> faces_;
};

}  // namespace csgrun
