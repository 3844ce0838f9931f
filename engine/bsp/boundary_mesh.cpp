#include "engine/bsp/boundary_mesh.h"

namespace csgrun {

Plane translate_plane(const Plane& p, const IVec3& t) {
  return {p.a, p.b, p.c, p.d - (p.a * t[0] + p.b * t[1] + p.c * t[2])};
}

BoundaryMesh translated(const BoundaryMesh& mesh, const IVec3& t) {
  BoundaryMesh moved = mesh;
  for (Plane& plane : moved.planes) plane = translate_plane(plane, t);
  for (uint32_t p = 0; p < moved.point_planes.size(); ++p) {
    moved.point_rounded[p] = rounded(moved.exact_point(p));
  }
  return moved;
}

}  // namespace csgrun
