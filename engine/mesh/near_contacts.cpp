#include "engine/mesh/near_contacts.h"

#include <numeric>

#include "engine/base/parallel.h"
#include "engine/mesh/box_tree.h"

namespace csgrun {

std::vector<uint32_t> faces_near(std::span<const GridBox> touches,
                                 const std::vector<MergedFace>& faces,
                                 const CellGeometry& geometry) {
  if (touches.empty()) {
    std::vector<uint32_t> all(faces.size());
    std::iota(all.begin(), all.end(), 0u);
    return all;
  }
  std::vector<Box> boxes;
  boxes.reserve(touches.size());
  for (const GridBox& b : touches) {
    Box& box = boxes.emplace_back();
    for (int k = 0; k < 3; ++k) {
      box.lo[k] = static_cast<double>(b.lo[k]), box.hi[k] = static_cast<double>(b.hi[k]);
    }
  }
  const BoxTree tree(boxes);
  return numbers_where(faces.size(), [&](uint32_t f) {
    // Rounding is monotone, and whole numbers are not rounded: boxes that overlap still do.
    const auto& first = geometry.point(faces[f].loops[0][0].from).rounded;
    Box box{first, first};
    for (const auto& loop : faces[f].loops) {
      for (const DirectedEdge& e : loop) {
        const auto& p = geometry.point(e.from).rounded;
        box.include({p, p});
      }
    }
    bool meets = false;
    tree.visit_all(box, [&](uint32_t) { meets = true; });
    return meets;
  });
}

}  // namespace csgrun
