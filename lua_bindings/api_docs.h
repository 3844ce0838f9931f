// The language as pages: docs/lua-api.md, the definitions that editors complete from, and data for
// other programs. All are made of the tables that check arguments, so they cannot say anything
// else.
#pragma once

#include <string>

namespace csgrun {

/// docs/lua-api.md.
std::string api_markdown();

/// {"functions": [{name, group, doc, function, methods, subject, options, example}, ...]}.
std::string api_json();

/// lua_bindings/meta/csgrun.lua, for the Lua language server (LuaLS).
std::string api_definitions();

}  // namespace csgrun
