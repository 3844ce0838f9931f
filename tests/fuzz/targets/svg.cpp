// SVG drawings.
#include "tests/fuzz/flat_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return csgrun::fuzz::read_drawing("drawing.svg", data, size);
}
