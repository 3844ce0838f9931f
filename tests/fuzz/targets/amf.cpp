// AMF files: the XML, and the archive where the input starts like one.
#include <csgrun/primitives/model_file.h>

#include "lua_bindings/measure/triangle_mesh.h"
#include "tests/fuzz/mesh_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace csgrun;
  auto parts = parse_amf("part.amf", fuzz::text_of(data, size), nullptr);
  if (!parts) {
    fuzz::expect_users_fault(parts.error());
    return 0;
  }
  for (const ModelPart& part : *parts) fuzz::measure_as_info_does(triangulated(part.mesh, false));
  return 0;
}
