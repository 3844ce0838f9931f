#include "lua_bindings/shipped_calls.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "lua_bindings/guard.h"
#include "lua_bindings/nearest.h"
#include "lua_bindings/shipped_modules.h"

namespace csgrun {
namespace {

const char kKeptGlobals = 0;  // registry: the globals of shipped modules

/// The call may yield: a callback of the model may be what does.
int finish_call(lua_State* L, int /*status*/, lua_KContext /*context*/) { return lua_gettop(L); }

/// Upvalue 1: the function of the library.
int call_shipped(lua_State* L) {
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  lua_callk(L, lua_gettop(L) - 1, LUA_MULTRET, 0, finish_call);
  return finish_call(L, LUA_OK, 0);
}

/// Pushes "FILE:line: " of the frame at the level, or an empty string; in the library that of the
/// model's frame below.
void push_place_of_level(lua_State* L, int level) {
  lua_Debug frame{};
  for (bool in_library = false; lua_getstack(L, level, &frame) != 0; ++level) {
    lua_getinfo(L, "Slf", &frame);
    const bool is_of_library = is_shipped(frame) || is_shipped_call(L, -1);
    lua_pop(L, 1);
    in_library |= is_of_library;
    if (is_of_library || (in_library && frame.currentline <= 0)) continue;
    if (frame.currentline <= 0) break;
    lua_pushfstring(L, "%s:%d: ", frame.short_src, frame.currentline);
    return;
  }
  lua_pushliteral(L, "");
}

/// Upvalue 1: the module's name.
int fail_on_missing(lua_State* L) {
  if (lua_type(L, 2) != LUA_TSTRING) return 0;  // a list ends in nil: ipairs needs it
  std::vector<std::string> names;
  for (lua_pushnil(L); lua_next(L, 1) != 0; lua_pop(L, 1)) {
    if (lua_type(L, -2) == LUA_TSTRING) names.emplace_back(lua_tostring(L, -2));
  }
  std::sort(names.begin(), names.end());
  throw ScriptError(std::string(lua_tostring(L, lua_upvalueindex(1))) + " has no '" +
                    lua_tostring(L, 2) + "'" + did_you_mean(lua_tostring(L, 2), names));
}

}  // namespace

bool is_shipped(const lua_Debug& frame) {
  return frame.source[0] == '@' && std::string_view(frame.source + 1).starts_with(kShippedPlace);
}

bool is_shipped_call(lua_State* L, int index) { return lua_tocfunction(L, index) == call_shipped; }

void keep_globals_for_shipped(lua_State* L) {
  lua_newtable(L);
  lua_pushglobaltable(L);
  const int globals = lua_gettop(L), kept = globals - 1;
  for (lua_pushnil(L); lua_next(L, globals) != 0;) {
    lua_pushvalue(L, -2);
    lua_insert(L, -2);
    lua_rawset(L, kept);
  }
  if (lua_getmetatable(L, globals) != 0) lua_setmetatable(L, kept);
  lua_pop(L, 1);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &kKeptGlobals);
}

void give_kept_globals(lua_State* L) {
  lua_rawgetp(L, LUA_REGISTRYINDEX, &kKeptGlobals);
  lua_setupvalue(L, -2, 1);  // _ENV, the only one of a chunk
}

void guard_shipped_module(lua_State* L, const std::string& name) {
  if (lua_isfunction(L, -1)) {
    lua_pushcclosure(L, call_shipped, 1);
    return;
  }
  if (!lua_istable(L, -1)) return;
  lua_pushnil(L);
  while (lua_next(L, -2) != 0) {
    if (!lua_isfunction(L, -1) || lua_iscfunction(L, -1)) {
      lua_pop(L, 1);
      continue;
    }
    lua_pushcclosure(L, call_shipped, 1);
    lua_pushvalue(L, -2);
    lua_insert(L, -2);
    lua_rawset(L, -4);  // of a key that is there: lua_next may go on
  }
  if (lua_getmetatable(L, -1) != 0) {
    lua_pop(L, 1);
    return;
  }
  lua_createtable(L, 0, 2);
  lua_pushstring(L, name.c_str());
  lua_pushcclosure(L, guarded<fail_on_missing>, 1);
  lua_setfield(L, -2, "__index");
  lua_pushboolean(L, 0);
  lua_setfield(L, -2, "__metatable");
  lua_setmetatable(L, -2);
}

int lua_error_at_model(lua_State* L) {
  const int level = static_cast<int>(luaL_optinteger(L, 2, 1));
  lua_settop(L, 1);
  if (lua_type(L, 1) == LUA_TSTRING && level > 0) {
    push_place_of_level(L, level);
    lua_insert(L, 1);
    lua_concat(L, 2);
  }
  return raise_pushed_error(L);
}

}  // namespace csgrun
