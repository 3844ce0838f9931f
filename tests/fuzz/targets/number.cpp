// Numbers of the command line: the grid's step.
#include <cmath>

#include <csgrun/engine/evaluate.h>

#include "engine/csg/grid.h"
#include "tests/fuzz/checks.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace csgrun;
  const auto step = GridStep::parse(std::string(fuzz::text_of(data, size)));
  if (!step) {
    fuzz::expect_users_fault(step.error());
    return 0;
  }
  const double mm = step->millimetres();
  fuzz::expect(step->numerator > 0 && step->denominator > 0, "a step that is not positive");
  fuzz::expect(std::isfinite(mm) && mm > 0, "a step that is no length");
  const Quantiser quantise(*step);
  for (const double steps : {0.0, 1.0, -1.0, 0x1p26, -0x1p39, 0.3}) {
    const double x = steps * mm;
    const auto q = quantise(x);
    fuzz::expect(q && std::fabs(static_cast<double>(*q) - steps) <= 1, "a length far off its step");
  }
  return 0;
}
