// Parameters of a model: param() in the script, -D on the command line.
#pragma once

#include <optional>
#include <string>

#include <lua.hpp>

namespace csgrun {

/// Pushes the value that `text` means for a parameter whose default is at `index`: numbers, true or
/// false, strings raw or in quotes, lists {1, 2} or [1, 2]. False when it does not fit the type;
/// then nothing is pushed.
bool push_definition(lua_State* L, int index, const std::string& text);

/// "a number", "true or false" ...: what the type of the default takes; empty: no parameter's type.
std::string parameter_type(lua_State* L, int index);

}  // namespace csgrun
