#include "lua_bindings/guard.h"

#include "lua_bindings/call_site.h"
#include "lua_bindings/session.h"

namespace csgrun {

void push_error(lua_State* L, const char* message) {
  // Nothing here but Lua allocates: memory may be what has just run out.
  lua_Debug frame{};
  if (innermost_lua_frame(L, frame)) {
    lua_pushfstring(L, "%s:%d: %s", chunk_file(frame), frame.currentline, message);
  } else {
    lua_pushstring(L, message);
  }
}

void push_memory_error(lua_State* L) {
  Session& session = session_of(L);
  session.budget().note_out_of_memory();
  session.drop_evaluator();
  push_error(L, "not enough memory");
}

int raise_pushed_error(lua_State* L) { return lua_error(L); }

}  // namespace csgrun
