#include "engine/bsp/crossing_points.h"

#include <array>
#include <span>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"

namespace csgrun {

void CrossingPoints::make_points() {
  const size_t before = points_.size(), count = crossings_.size() - before;
  RawVector<PolygonEdge> edges(count);
  RawVector<uint32_t> met(2 * count);
  for_each_range(count, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const Place& c = crossings_[before + i];
      edges[i] = {c.polygon, c.edge};
      met[2 * i] = c.polygon;
      met[2 * i + 1] = c.through;
    }
  });
  job_.ensure_supports(met);
  job_.ensure_edges(edges);
  const auto& polygons = job_.polygons();
  const uint32_t first_point = geometry_.add_points(count);
  points_.resize(crossings_.size());
  const auto make = [&](size_t i) {
    const Place& c = crossings_[before + i];
    const JobPolygon& own = polygons[c.polygon];
    const std::array<uint32_t, 3> planes{own.support.index(), job_.edge_planes(own)[c.edge],
                                         polygons[c.through].support.index()};
    const auto plane = [&](int k) -> const Plane& { return job_.planes().plane(planes[k]); };
    points_[before + i] = first_point + static_cast<uint32_t>(i);
    geometry_.set_point(points_[before + i], planes,
                        rounded(intersect(plane(0), plane(1), plane(2))));
  };
  constexpr size_t kEach = 512;
  for_each_part(count, kEach, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) make(i);
  });
  index_.make_unique(std::span(points_).subspan(before));
  for_each_range(count, [&](size_t begin, size_t end) {
    for (size_t i = before + begin; i < before + end; ++i) points_[i] = index_.known(points_[i]);
  });
}

}  // namespace csgrun
