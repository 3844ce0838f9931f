// Text of Lua values without addresses: the same on every run.
#pragma once

#include <string>

#include <lua.hpp>

namespace csgrun {

/// What `tostring` gives: numbers and strings as Lua has them, __tostring and __name are respected,
/// tables, functions and threads are their type's name.
std::string display_text(lua_State* L, int index);

/// tostring, print and string.format for the sandbox.
int lua_tostring_without_addresses(lua_State* L);
int lua_print_to_stderr(lua_State* L);
/// Upvalue 1 is the original string.format. `%p` is refused; `%s` goes through display_text.
int lua_format_without_addresses(lua_State* L);

}  // namespace csgrun
