// What somebody who writes OpenSCAD's language in a script is told.
#pragma once

#include <string>
#include <string_view>

namespace csgrun {

/// How OpenSCAD's syntax in a line is said in Lua, for the end of a message of a syntax error;
/// empty when the line has none of it.
std::string syntax_hint(std::string_view line, std::string_view message);

/// What a message of Lua's own about a mistake of many means, for the end of it; empty for others.
std::string run_time_hint(std::string_view message);

/// Whether a function is one that OpenSCAD writes before what it changes.
bool is_written_before(std::string_view function);

/// What stands for a function or a variable that OpenSCAD, another program or another language has
/// under this name, however its words are put together; null for others.
const char* name_hint(std::string_view name);

/// The same for methods of solids and shapes.
const char* method_hint(std::string_view name);

}  // namespace csgrun
