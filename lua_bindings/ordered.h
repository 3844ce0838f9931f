// Tables are traversed in an order that depends on their contents only, not on addresses or a seed.
//
// Numbers ascending, then strings by bytes, then false and true, then values with an order of their
// own: solids, shapes, matrices and tables with a metatable in the order in which they were made
// (given it), Lua functions by their place. Two keys that have no order, such as two plain tables,
// are an error: a result that differs from run to run would be worse.
#pragma once

#include <lua.hpp>

namespace csgrun {

int ordered_pairs(lua_State* L);
int ordered_next(lua_State* L);

/// Gives the value at `index` its number in the order of making, if it has none yet.
void note_creation(lua_State* L, int index);

}  // namespace csgrun
