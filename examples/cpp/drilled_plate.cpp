// A plate with a row of holes by csgrun's C++ libraries: drilled_plate OUT.glb HOLES
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/evaluate.h>
#include <csgrun/export/write.h>
#include <csgrun/primitives/solids.h>

using namespace csgrun;

namespace {

/// Everything that can fail gives a value or an Error.
template <class T>
T value_or_exit(Result<T> result) {
  if (!result) {
    std::fprintf(stderr, "drilled_plate: %s\n", result.error().message.c_str());
    std::exit(1);
  }
  return *std::move(result);
}

NodePtr leaf(PolygonMesh mesh) {
  return Node::leaf(std::make_shared<const PolygonMesh>(std::move(mesh)));
}

NodePtr moved(NodePtr solid, double x, double y, double z) {
  Affine map;
  map.m[0][3] = x;
  map.m[1][3] = y;
  map.m[2][3] = z;
  return Node::transformed(map, std::move(solid));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: drilled_plate OUT.glb HOLES\n");
    return 2;
  }
  const int holes = std::atoi(argv[2]);

  // A tree of leaves, transforms and Booleans. Nothing is computed yet.
  const NodePtr plate = leaf(value_or_exit(make_cube({10.0 * holes + 10, 20, 5})));
  Facets facets;
  facets.fn = 64;
  const NodePtr hole = leaf(value_or_exit(make_cylinder(5, 3, 3, false, facets)));
  std::vector<NodePtr> operands{plate};
  for (int i = 1; i <= holes; ++i) operands.push_back(moved(hole, 10.0 * i, 10, 0));
  const NodePtr part = Node::boolean(BooleanOp::kDifference, operands);

  // The evaluator caches what it makes: keep one for as long as you ask about related trees.
  Evaluator evaluator({});
  const Extent extent = value_or_exit(evaluator.extent(part));
  const SolidPtr solid = value_or_exit(evaluator.evaluate(part));
  for (const auto& warning : evaluator.warnings()) std::fprintf(stderr, "%s\n", warning.c_str());
  std::printf("volume %.9g of %.9g mm^3, area %.9g mm^2, genus %lld, %zu triangles\n",
              extent.volume, (10.0 * holes + 10) * 20 * 5, solid->measures.area,
              static_cast<long long>(solid->measures.genus), solid->triangles.size());

  const WriteReport report = value_or_exit(write_model(argv[1], {{"plate", solid, {}}}));
  for (const auto& warning : report.warnings) std::fprintf(stderr, "%s\n", warning.c_str());
  return 0;
}
