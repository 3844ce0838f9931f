// OpenSCAD's .csg files, and the evaluation of what they describe.
#include <csgrun/primitives/csg_file.h>

#include "tests/fuzz/evaluate_small.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace csgrun;
  const auto model = parse_csg("model.csg", fuzz::text_of(data, size));
  if (!model) {
    fuzz::expect_users_fault(model.error());
    fuzz::expect(model.error().where.line > 0, "an error without a place");
    return 0;
  }
  fuzz::expect(model->solid != nullptr, "no node");
  fuzz::evaluate_small({model->solid});
  return 0;
}
