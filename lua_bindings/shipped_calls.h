// Calls of the program's own library, which is Lua: what goes wrong in it is named at the place in
// the model where it was called, as with functions that are built in.
//
// A function of Lua that the model calls last (`return gears.spur{...}`) takes the place of its
// caller's frame, and the line is lost. A function of C does not. So each function of a shipped
// module stands behind one.
#pragma once

#include <string>

#include <lua.hpp>

namespace csgrun {

/// Whether a frame (filled with "S") is one of the library.
bool is_shipped(const lua_Debug& frame);

/// Whether the function at the index is one that stands before a function of the library.
bool is_shipped_call(lua_State* L, int index);

/// Replaces what a shipped module returned (on the top of the stack) by what models get: the
/// function, or each function of the table, behind one of C; a name that the table lacks is an
/// error, as with csg.
void guard_shipped_module(lua_State* L, const std::string& name);

/// Takes note of what the globals are now, before a model has any of its own.
void keep_globals_for_shipped(lua_State* L);
/// Has the chunk on the top of the stack use those: `sin = math.sin` in a model, which then counts
/// in radians, is not for the library.
void give_kept_globals(lua_State* L);

/// error(message, level) as Lua has it, but levels that are frames of the library mean the place in
/// the model from which it was called.
int lua_error_at_model(lua_State* L);

}  // namespace csgrun
