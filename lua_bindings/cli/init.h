// `csgrun --init`: what an editor needs to know of the language, beside the models.
#pragma once

#include "lua_bindings/cli/exit_codes.h"
#include "lua_bindings/cli/run_model.h"

namespace csgrun {

/// Writes .csgrun/library/csgrun.lua and a .luarc.json that names it into the working folder. A
/// .luarc.json that is there already, and another one, is not touched: that is a failure.
Failure init_folder();

}  // namespace csgrun
