// Tables of heights: pictures and texts, and the solids under them.
#include <memory>

#include <csgrun/primitives/height_map.h>

#include "tests/fuzz/evaluate_small.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace csgrun;
  const std::string name = "heights.png";
  const auto map = parse_height_map(name, fuzz::text_of(data, size), size % 2 == 0);
  if (!map) {
    fuzz::expect_users_fault(map.error());
    fuzz::expect(map.error().message.rfind(name + ":", 0) == 0, "an error that names no file");
    return 0;
  }
  fuzz::expect(map->heights.size() == map->rows * map->columns, "a table with holes");
  auto solid = make_surface(*map, true);
  if (!solid) {
    fuzz::expect_users_fault(solid.error());
    return 0;
  }
  fuzz::expect_leaf(*solid);
  fuzz::evaluate_small({Node::leaf(std::make_shared<const PolygonMesh>(*std::move(solid)))});
  return 0;
}
