// The Lua state in which models run: no files, no clock, no addresses, no bytecode, fixed order.
#pragma once

#include <lua.hpp>

#include "lua_bindings/session.h"

namespace csgrun {

/// Opens the libraries that a model may use into a state made with Budget::allocate, and attaches
/// the session. Runs protected by the caller.
void open_sandbox(lua_State* L, Session& session);

/// The templates that the script has set as package.path. Throws ScriptError if it is no string.
std::string package_path(lua_State* L);

/// Loads text (never bytecode) as the chunk of `path` and pushes the function. A first line that
/// starts with '#' and a byte order mark are skipped. Throws PlacedScriptError.
void load_chunk(lua_State* L, const std::string& path, const std::string& text);

}  // namespace csgrun
