#include "engine/mesh/divide_edges.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace csgrun {
namespace {

constexpr int kMostPlaces = 20;

/// A plane across an edge, near its middle; kNone when there is none with so few binary places.
uint32_t plane_across(CellGeometry& geometry, PlaneTable& planes, uint32_t p, uint32_t q) {
  const std::array<double, 3> a = geometry.point(p).rounded, b = geometry.point(q).rounded;
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::fabs(a[k] - b[k]) > std::fabs(a[axis] - b[axis])) axis = k;
  }
  for (int places = 0; places <= kMostPlaces; ++places) {
    const double scale = std::ldexp(1.0, places);
    const auto at = static_cast<int64_t>(std::floor((a[axis] / 2 + b[axis] / 2) * scale));
    Plane plane;
    (axis == 0 ? plane.a : axis == 1 ? plane.b : plane.c) = int64_t{1} << places;
    plane.d = -at;
    const uint32_t index = planes.intern(plane).index();
    if (geometry.side(index, p) * geometry.side(index, q) < 0) return index;
  }
  return kNone;
}

}  // namespace

bool divide_edges(std::vector<MergedFace>& faces, CellGeometry& geometry, PlaneTable& planes,
                  std::span<const std::array<uint32_t, 2>> edges) {
  std::map<std::array<uint32_t, 2>, uint32_t> across, middle;
  for (const auto& [p, q] : edges) {
    const uint32_t plane = plane_across(geometry, planes, p, q);
    if (plane != kNone) across[{p, q}] = plane;
  }
  std::vector<DirectedEdge> divided;
  for (MergedFace& face : faces) {
    for (auto& loop : face.loops) {
      divided.clear();
      for (const DirectedEdge& e : loop) {
        const std::array<uint32_t, 2> ends{std::min(e.from, e.to), std::max(e.from, e.to)};
        const auto found = across.find(ends);
        if (found == across.end()) {
          divided.push_back(e);
          continue;
        }
        const auto [point, is_new] = middle.try_emplace(ends, kNone);
        if (is_new) {
          point->second = geometry.add_point({face.plane.index(), e.plane, found->second});
        }
        divided.push_back({e.from, point->second, e.plane});
        divided.push_back({point->second, e.to, e.plane});
      }
      if (divided.size() != loop.size()) loop = divided;
    }
  }
  return !middle.empty();
}

}  // namespace csgrun
