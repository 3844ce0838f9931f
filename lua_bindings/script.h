// Running a model's script from its text to its parts.
#pragma once

#include <string>

#include "lua_bindings/session.h"

namespace csgrun {

enum class ScriptStatus : uint8_t {
  kGood,
  kFailed,    ///< anything that the script raised
  kGeometry,  ///< it measured something that could not be evaluated
  kUsage,     ///< a -D that does not fit
  kOutOfTime,
};

struct ScriptOutcome {
  ScriptStatus status = ScriptStatus::kGood;
  std::string message;  ///< starts with "FILE:line:", and has the traceback on lines that follow
};

/// Runs `text` as the model of the session; its parts, parameters and warnings are in the session
/// afterwards. `name` stands in messages. Never throws.
ScriptOutcome run_script(Session& session, const std::string& name, const std::string& text);

}  // namespace csgrun
