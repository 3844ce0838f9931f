// OpenSCAD's .csg files, and the evaluation of what they describe.
#include <memory>
#include <string>

#include <csgrun/primitives/csg_file.h>

#include "primitives/files/csg_parser.h"
#include "tests/fuzz/evaluate_small.h"

namespace {

/// Whether no number of facets or layers is so large that the solid takes long to make, as it must.
bool is_small(std::string_view text) {
  csgrun::CsgParser parser(std::make_shared<const std::string>("model.csg"), text);
  for (auto event = parser.next(); event && *event != csgrun::CsgParser::Event::kEnd;
       event = parser.next()) {
    if (*event == csgrun::CsgParser::Event::kClose) continue;
    const auto within = [&](const char* name, double low, double high) {
      const csgrun::CsgValue* value = parser.call().find(name);
      return value == nullptr || (value->number >= low && value->number <= high);
    };
    if (!within("$fn", -1e300, 60) || !within("$fa", 6, 1e300) || !within("$fs", 0.5, 1e300) ||
        !within("slices", -1e300, 60) || !within("segments", -1e300, 60) ||
        !within("twist", -3600, 3600)) {
      return false;
    }
  }
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace csgrun;
  if (!is_small(fuzz::text_of(data, size))) return 0;
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
