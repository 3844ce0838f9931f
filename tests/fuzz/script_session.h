// A session for scripts of unknown intent: little time, little memory, no files.
#pragma once

#include "lua_bindings/session.h"
#include "tests/fuzz/checks.h"

namespace csgrun::fuzz {

inline SessionOptions small_session() {
  SessionOptions options;
  options.model = "model.lua";
  options.model_folder = "/nonexistent";
  options.evaluate.threads = 1;
  options.evaluate.cache_bytes = 16 << 20;
  options.limits.total_seconds = 2;
  options.limits.heap_bytes = size_t{32} << 20;
  options.limits.end_process = false;
  return options;
}

}  // namespace csgrun::fuzz
