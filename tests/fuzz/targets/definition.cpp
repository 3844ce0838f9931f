// Values of -D name=value, for a parameter of each type.
#include <cmath>
#include <string>

#include "lua_bindings/parameters.h"
#include "lua_bindings/script.h"
#include "tests/fuzz/script_session.h"

namespace {

/// The first byte chooses the parameter, the rest is the value.
constexpr const char* kModels[] = {
    "local v = param('x', 2.5) assert(math.type(v) and v == v and v < math.huge and v > "
    "-math.huge)",
    "local v = param('x', 5, {min = 1, max = 10, step = 1}) assert(v >= 1 and v <= 10)",
    "local v = param('x', true) assert(v == true or v == false)",
    "local v = param('x', 'text') assert(type(v) == 'string')",
    "local v = param('x', 'b', {choices = {'a', 'b'}}) assert(v == 'a' or v == 'b')",
    "local v = param('x', {1, 2, 3}) for i = 1, #v do assert(v[i] == v[i] + 0) end",
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace csgrun;
  if (size == 0) return 0;
  const std::string model = kModels[data[0] % std::size(kModels)];
  SessionOptions options = fuzz::small_session();
  options.definitions = {{"x", std::string(fuzz::text_of(data + 1, size - 1))}};
  Session session(std::move(options));
  const ScriptOutcome outcome = run_script(session, "model.lua", model + " return cube(1)");
  const bool fine = outcome.status == ScriptStatus::kGood || outcome.status == ScriptStatus::kUsage;
  fuzz::expect(fine, "a value that breaks the script: " + outcome.message);
  return 0;
}
