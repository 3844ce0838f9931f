#include "primitives/text/harfbuzz.h"

#include <stdexcept>
#include <string>

#include <dlfcn.h>

#include <csgrun/primitives/text.h>

namespace csgrun {
namespace {

[[noreturn]] void fail_to_load() {
  const char* why = dlerror();
  throw std::runtime_error(
      std::string("text needs the library HarfBuzz, which cannot be loaded: ") +
      (why != nullptr ? why : "a function is missing"));
}

/// Stays loaded to the end: fonts and their static tables of functions point into it.
HarfBuzz load() {
  void* library = dlopen("libharfbuzz.so.0", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) fail_to_load();
  HarfBuzz calls;
#define CSGRUN_CALL(name)                                                           \
  calls.name = reinterpret_cast<decltype(calls.name)>(dlsym(library, "hb_" #name)); \
  if (calls.name == nullptr) fail_to_load();
  CSGRUN_HARFBUZZ_CALLS(CSGRUN_CALL)
#undef CSGRUN_CALL
  return calls;
}

}  // namespace

const HarfBuzz& hb() {
  static const HarfBuzz calls = load();
  return calls;
}

std::optional<Error> text_failure() {
  try {
    hb();
    return std::nullopt;
  } catch (const std::runtime_error& error) {
    return Error{ErrorCode::kCannotRead, error.what(), {}};
  }
}

}  // namespace csgrun
