// GLB files, which `csgrun info` reads.
#include "lua_bindings/measure/read_glb.h"
#include "tests/fuzz/mesh_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace csgrun;
  auto meshes = parse_glb("part.glb", fuzz::text_of(data, size));
  if (!meshes) {
    fuzz::expect_users_fault(meshes.error());
    return 0;
  }
  for (TriangleMesh& mesh : *meshes) fuzz::measure_as_info_does(std::move(mesh));
  return 0;
}
