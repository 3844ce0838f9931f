#include "tests/support/boundary_compare.h"

#include <sstream>

#include "engine/bsp/boundary_mesh.h"

namespace csgrun::test {

std::string first_difference(const BoundaryMesh& a, const BoundaryMesh& b) {
  std::ostringstream out;
  out.precision(17);
  if (a.faces.size() != b.faces.size()) {
    out << "faces: " << a.faces.size() << " and " << b.faces.size();
    return out.str();
  }
  if (a.point_rounded.size() != b.point_rounded.size()) {
    out << "points: " << a.point_rounded.size() << " and " << b.point_rounded.size();
    return out.str();
  }
  for (uint32_t p = 0; p < a.point_rounded.size(); ++p) {
    if (a.point_rounded[p] != b.point_rounded[p] || compare(a.exact_point(p), b.exact_point(p))) {
      out << "point " << p << " near " << a.point_rounded[p][0] << ' ' << a.point_rounded[p][1]
          << ' ' << a.point_rounded[p][2];
      return out.str();
    }
  }
  const auto oriented = [](const BoundaryMesh& m, PlaneId id) {
    const Plane& p = m.planes[id.index()];
    return id.flipped() ? p.reversed() : p;
  };
  for (size_t f = 0; f < a.faces.size(); ++f) {
    const BoundaryMesh::Face &s = a.faces[f], &t = b.faces[f];
    out << "face " << f << ": ";
    if (oriented(a, s.plane) != oriented(b, t.plane)) return out.str() + "plane";
    if (s.label != t.label) {
      out << "label, source " << s.label.source << " and " << t.label.source << ", facet "
          << s.label.facet << " and " << t.label.facet;
      return out.str();
    }
    if (s.whole != t.whole) return out.str() + "whole";
    if (s.complete != t.complete) return out.str() + "complete";
    if (s.loop_count != t.loop_count) return out.str() + "number of loops";
    for (uint32_t l = 0; l < s.loop_count; ++l) {
      const uint32_t i = a.loop_starts[s.first_loop + l], j = b.loop_starts[t.first_loop + l];
      const uint32_t count = a.loop_starts[s.first_loop + l + 1] - i;
      if (b.loop_starts[t.first_loop + l + 1] - j != count) return out.str() + "corners of a loop";
      for (uint32_t c = 0; c < count; ++c) {
        if (a.corners[i + c].point != b.corners[j + c].point) return out.str() + "loop";
      }
    }
    out.str("");
  }
  return "";
}

}  // namespace csgrun::test
