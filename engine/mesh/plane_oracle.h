// Exact answers about the points of one face, for triangulation: a projection along the axis on
// which the face's normal is longest, doubles first and integers where they are unsure.
#pragma once

#include "engine/bsp/point_view.h"
#include "engine/mesh/triangulate.h"

namespace csgrun {

class PlaneOracle final : public PlanarOracle {
 public:
  /// `support` faces outwards. The first `in_order` points are numbered in lexicographic order of
  /// their rounded coordinates.
  PlaneOracle(PointView& points, const PlaneTable& planes, PlaneId support, size_t in_order);

  int orient(uint32_t a, uint32_t b, uint32_t c) const override;
  int compare(uint32_t a, uint32_t b) const override;
  double along(uint32_t a) const override { return points_.rounded(a)[u_]; }

 private:
  int exact_orient(uint32_t a, uint32_t b, uint32_t c) const;

  PointView& points_;
  size_t in_order_;
  int u_, v_;  ///< the axes of the projection
  int sign_;   ///< +1 when (u, v) is right-handed seen from outside
};

}  // namespace csgrun
