#include "engine/bsp/literal_region.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace csgrun {

uint32_t NamedPoints::at(std::array<uint32_t, 3> planes) {
  std::sort(planes.begin(), planes.end());
  const auto [it, is_new] = numbers_.try_emplace(planes, kNone);
  if (is_new) it->second = geometry_.add_point(planes);
  return it->second;
}

ConvexRegion::ConvexRegion(NamedPoints& points, const std::array<uint32_t, 6>& walls) {
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    for (int upper = 0; upper < 2; ++upper) {
      // The sides of the square in the plane of axes i and j, counter-clockwise seen from +k.
      std::array<uint32_t, 4> around{walls[2 * j], walls[2 * i + 1], walls[2 * j + 1],
                                     walls[2 * i]};
      if (!upper) std::reverse(around.begin(), around.end());
      Face face;
      face.plane = walls[2 * k + upper];
      for (int e = 0; e < 4; ++e) {
        face.points.push_back(points.at({face.plane, around[(e + 3) % 4], around[e]}));
        face.neighbours.push_back(around[e]);
      }
      faces_.push_back(std::move(face));
    }
  }
}

ConvexRegion::Signs ConvexRegion::signs(NamedPoints& points, uint32_t plane) const {
  Signs result;
  for (const Face& face : faces_) {
    for (const uint32_t p : face.points) {
      const auto [it, is_new] = result.try_emplace(p, 0);
      if (is_new) it->second = points.geometry().side(plane, p);
    }
  }
  return result;
}

Side ConvexRegion::classify(NamedPoints& points, uint32_t plane) const {
  bool front = false, back = false;
  for (const auto& [point, sign] : signs(points, plane)) {
    front |= sign > 0;
    back |= sign < 0;
  }
  // A polyhedron has corners on both sides of a plane exactly when the plane meets its interior.
  return front && back ? Side::kSplit : front ? Side::kFront : Side::kBack;
}

void ConvexRegion::split(NamedPoints& points, uint32_t plane, ConvexRegion& front,
                         ConvexRegion& back) const {
  const Signs corner_signs = signs(points, plane);
  front = half(points, plane, 1, corner_signs);
  back = half(points, plane, -1, corner_signs);
}

ConvexRegion ConvexRegion::half(NamedPoints& points, uint32_t plane, int keep,
                                const Signs& signs) const {
  ConvexRegion result;
  for (const Face& face : faces_) {
    Face piece;
    piece.plane = face.plane;
    bool reaches = false;
    for (size_t i = 0; i < face.points.size(); ++i) {
      const uint32_t p = face.points[i], q = face.points[i + 1 < face.points.size() ? i + 1 : 0];
      const int s = signs.at(p) * keep, t = signs.at(q) * keep;
      reaches |= s > 0;
      if (s >= 0) {
        piece.points.push_back(p);
        piece.neighbours.push_back(s == 0 && t < 0 ? plane : face.neighbours[i]);
      }
      if (s * t < 0) {
        piece.points.push_back(points.at({face.plane, face.neighbours[i], plane}));
        piece.neighbours.push_back(s > 0 ? plane : face.neighbours[i]);
      }
    }
    // Without a corner inside the half, the face touches it in an edge or a point.
    if (reaches) result.faces_.push_back(std::move(piece));
  }
  // Edges without a reverse run around the hole that the cap closes.
  std::map<std::pair<uint32_t, uint32_t>, Face*> directed;
  for (Face& face : result.faces_) {
    for (size_t i = 0; i < face.points.size(); ++i) {
      directed[{face.points[i], face.points[(i + 1) % face.points.size()]}] = &face;
    }
  }
  struct CapEdge {
    uint32_t to, plane;
  };
  std::map<uint32_t, CapEdge> cap_edges;
  for (const auto& [edge, face] : directed) {
    const auto [from, to] = edge;
    if (directed.contains({to, from})) continue;
    cap_edges[to] = {from, face->plane};
    const auto at =
        std::find(face->points.begin(), face->points.end(), from) - face->points.begin();
    face->neighbours[at] = plane;
  }
  assert(cap_edges.size() >= 3);
  Face cap;
  cap.plane = plane;
  uint32_t p = cap_edges.begin()->first;
  for (size_t i = 0; i < cap_edges.size(); ++i) {
    const CapEdge& edge = cap_edges.at(p);
    cap.points.push_back(p);
    cap.neighbours.push_back(edge.plane);
    p = edge.to;
  }
  assert(p == cap.points.front());
  result.faces_.push_back(std::move(cap));
  return result;
}

const ConvexRegion::Face& ConvexRegion::face_in(uint32_t plane) const {
  const auto it = std::find_if(faces_.begin(), faces_.end(),
                               [plane](const Face& f) { return f.plane == plane; });
  assert(it != faces_.end());
  return *it;
}

}  // namespace csgrun
