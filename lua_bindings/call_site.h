// Where in the script are we? Places for nodes and messages, and the traceback.
#pragma once

#include <string>
#include <vector>

#include <lua.hpp>

namespace csgrun {

/// The innermost Lua function of the stack that is not the program's own library (whose calls stand
/// where the model called it), or the innermost one: fills `source`, `short_src` and `currentline`.
/// Allocates nothing, so that the allocator and the watchdog may ask. False when no Lua function
/// runs.
bool innermost_lua_frame(lua_State* L, lua_Debug& frame);

/// The file name of a chunk: the whole path, where Lua's short_src cuts it after 60 characters.
const char* chunk_file(const lua_Debug& frame);

/// "FILE:line" of the innermost Lua function, or an empty string.
std::string place_of_call(lua_State* L);

/// Lua cuts paths of 60 characters and more in its own messages ("...of/path.lua:3: what"); puts
/// the whole one back.
std::string with_whole_path(const std::string& message, const std::string& path);

/// A message handler for lua_pcall: message, "stack traceback:", one line a frame. Without
/// addresses, and with whole paths.
int add_traceback(lua_State* L);

/// Where a function of Lua stands: the line that it is at, and the one where it begins (0: a
/// chunk).
struct StackLine {
  int line, function_line;
};

/// Where the functions of a chunk stand that are running, innermost first; of a deep stack the
/// innermost ones. For a message handler, before the stack is unwound.
std::vector<StackLine> stack_lines(lua_State* L, const std::string& path);

/// The file whose code is running, as messages name it: chunks made by load() do not count.
std::string calling_file(lua_State* L);

}  // namespace csgrun
