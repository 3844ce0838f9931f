#include "lua_bindings/guard.h"

#include "lua_bindings/call_site.h"

namespace csgrun {

void push_error(lua_State* L, const char* message) {
  const std::string place = place_of_call(L);
  if (place.empty()) {
    lua_pushstring(L, message);
  } else {
    lua_pushfstring(L, "%s: %s", place.c_str(), message);
  }
}

int raise_pushed_error(lua_State* L) { return lua_error(L); }

}  // namespace csgrun
