// The language as pages: docs/lua-api.md, and the definitions that editors complete from. Both are
// made of the tables that check arguments, so they cannot say anything else.
#pragma once

#include <string>

namespace csgrun {

/// docs/lua-api.md.
std::string api_markdown();

/// lua_bindings/meta/csgrun.lua, for the Lua language server (LuaLS).
std::string api_definitions();

}  // namespace csgrun
