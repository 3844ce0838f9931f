// The result of a script: which parts it gave, in which order, under which names.
#pragma once

#include <string>

#include <lua.hpp>

namespace csgrun {

/// Adds what is at `index`: a solid, a shape, or a table of these: first the list entries in order,
/// then the named ones by bytes; a table in a table is a group "a/b". `name` may be empty. Throws
/// ScriptError.
void add_parts(lua_State* L, int index, const std::string& name);

}  // namespace csgrun
