#include "engine/bsp/convex_sides.h"

#include <algorithm>
#include <cmath>

#include "engine/bsp/grid_planes.h"

namespace csgrun {

UnitPlane unit_plane(const Operand& operand, const FrameMap& map, size_t face) {
  const LeafGeometry& leaf = *operand.leaf;
  const uint32_t first = leaf.face_starts[face], count = leaf.face_starts[face + 1] - first;
  const Plane plane = map.plane(support_of_loop(count, [&](uint32_t i) {
    const IVec3 &v = leaf.vertices[leaf.corners[first + i % count]], &t = operand.translation;
    return IVec3{v[0] + t[0], v[1] + t[1], v[2] + t[2]};
  }));
  const auto a = static_cast<double>(plane.a), b = static_cast<double>(plane.b),
             c = static_cast<double>(plane.c);
  const double length = std::hypot(a, b, c);
  return {a / length, b / length, c / length, static_cast<double>(plane.d) / length};
}

Inside ConvexSides::side(const std::vector<Operand>& operands, uint32_t operand,
                         const std::array<double, 3>& point) {
  const auto [place, is_new] = place_.find_or_add(operand, static_cast<uint32_t>(planes_.size()));
  if (is_new) {
    const Operand& leaf = operands[operand];
    std::vector<UnitPlane>& planes = planes_.emplace_back();
    planes.reserve(leaf.leaf->face_count());
    const FrameMap map(leaf.frame);
    for (size_t f = 0; f < leaf.leaf->face_count(); ++f) {
      planes.push_back(unit_plane(leaf, map, f));
    }
  }
  constexpr double kMargin = 2;  // a step along each axis is less than that together
  double farthest = -HUGE_VAL;
  for (const UnitPlane& p : planes_[place]) farthest = std::max(farthest, above(p, point));
  return farthest > kMargin ? Inside::kNo : farthest < -kMargin ? Inside::kYes : Inside::kUnknown;
}

}  // namespace csgrun
