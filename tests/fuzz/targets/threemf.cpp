// 3MF files: the archive as it comes, and the XML in an archive that is sound.
#include <csgrun/primitives/model_file.h>

#include "export/zip_file.h"
#include "lua_bindings/measure/triangle_mesh.h"
#include "tests/fuzz/mesh_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace csgrun;
  std::string bytes(fuzz::text_of(data, size));
  if (bytes.starts_with('<')) {
    auto archive = zip_file({{"_rels/.rels",
                              "<Relationships><Relationship Target=\"/m\" "
                              "Type=\"x/3dmodel\"/></Relationships>"},
                             {"m", bytes}});
    if (!archive) return 0;
    bytes = *std::move(archive);
  }
  auto parts = parse_3mf("part.3mf", bytes);
  if (!parts) {
    fuzz::expect_users_fault(parts.error());
    return 0;
  }
  for (const ModelPart& part : *parts) fuzz::measure_as_info_does(triangulated(part.mesh, false));
  return 0;
}
