#include "engine/csg/convexity.h"

#include <algorithm>
#include <array>
#include <vector>

#include "engine/exact/predicates.h"

namespace csgrun {

bool bounds_convex(const BoundaryMesh& mesh) {
  std::vector<PlaneId> planes;
  for (const BoundaryMesh::Face& face : mesh.faces) planes.push_back(face.plane);
  std::sort(planes.begin(), planes.end());
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  for (const PlaneId id : planes) {
    const Plane& stored = mesh.planes[id.index()];
    const Plane plane = id.flipped() ? stored.reversed() : stored;
    const std::array<double, 4> rough{to_double(plane.a), to_double(plane.b), to_double(plane.c),
                                      to_double(plane.d)};
    for (uint32_t p = 0; p < mesh.point_rounded.size(); ++p) {
      int side = filter_side(rough, mesh.point_rounded[p]);
      if (side == 0) side = exact_side(plane, mesh.exact_point(p));
      if (side > 0) return false;
    }
  }
  return !planes.empty();
}

}  // namespace csgrun
