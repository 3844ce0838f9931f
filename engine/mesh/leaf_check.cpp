#include "engine/mesh/leaf_check.h"

#include <algorithm>

#include "engine/mesh/box_tree.h"
#include "engine/mesh/face_pair.h"

namespace csgrun {

std::optional<SelfIntersection> find_self_intersection(const LeafGeometry& leaf) {
  FacePairs pairs(leaf);
  const BoxTree tree(pairs.boxes());
  SelfIntersection found;
  for (uint32_t f = 0; f < leaf.face_count() && found.count < SelfIntersection::kMaxCount; ++f) {
    const uint64_t before = found.count;
    uint32_t partner = UINT32_MAX;
    tree.visit_later(f, [&](uint32_t g) {
      if (!pairs.conflict(f, g)) return;
      ++found.count;
      partner = std::min(partner, g);
    });
    if (before == 0 && found.count > 0) {
      found.face_a = f;
      found.face_b = partner;
      found.place = pairs.place(f, partner);
    }
  }
  if (found.count == 0) return std::nullopt;
  return found;
}

}  // namespace csgrun
