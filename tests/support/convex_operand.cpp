#include "tests/support/convex_operand.h"

#include "engine/mesh/opposite_edges.h"
#include "tests/support/kernel_case.h"

namespace csgrun::test {

Operand convex_operand(const std::vector<Loop>& loops) {
  auto leaf = std::make_shared<LeafGeometry>(*make_leaf(loops));
  leaf->opposite = pair_edges(*leaf).opposite;
  leaf->convex = true;
  leaf->may_touch = false;
  return operand_of(std::move(leaf));
}

Operand octahedron(const IVec3& middle, int64_t radius) {
  std::vector<IVec3> points;
  for (size_t k = 0; k < 3; ++k) {
    for (const int64_t r : {-radius, radius}) {
      points.push_back(middle);
      points.back()[k] += r;
    }
  }
  return convex_operand(hull_loops(points));
}

}  // namespace csgrun::test
