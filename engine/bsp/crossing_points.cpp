#include "engine/bsp/crossing_points.h"

#include <array>

#include "engine/base/in_order.h"

namespace csgrun {

void CrossingPoints::make_points() {
  struct Made {
    std::array<uint32_t, 3> planes;
    std::array<double, 3> rounded;
  };
  const size_t first = points_.size(), count = crossings_.size() - first;
  std::vector<PolygonEdge> edges;
  edges.reserve(count);
  for (size_t i = first; i < crossings_.size(); ++i) edges.push_back(crossings_[i].edge);
  job_.ensure_edges(edges);
  const auto& polygons = job_.polygons();
  const auto make = [&](size_t i) {
    const Crossing& c = crossings_[first + i];
    const JobPolygon& own = polygons[c.edge.polygon];
    const std::array<uint32_t, 3> planes{own.support.index(), job_.edge_planes(own)[c.edge.edge],
                                         polygons[c.name.through].support.index()};
    const auto plane = [&](int k) -> const Plane& { return job_.planes().plane(planes[k]); };
    return Made{planes, rounded(intersect(plane(0), plane(1), plane(2)))};
  };
  make_and_take(
      count, make,
      [&](size_t, const Made& p) {
        points_.push_back(index_.unique(geometry_.add_point(p.planes, p.rounded)));
      },
      [&](const Made& p) { index_.expect(p.rounded); });
}

}  // namespace csgrun
