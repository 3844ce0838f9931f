// OBJ files.
#include "tests/fuzz/mesh_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return csgrun::fuzz::read_mesh("part.obj", data, size);
}
