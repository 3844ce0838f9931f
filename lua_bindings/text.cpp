#include "lua_bindings/text.h"

#include <cstdio>
#include <cstring>

#include "lua_bindings/guard.h"

namespace csgrun {

std::string display_text(lua_State* L, int index) {
  index = lua_absindex(L, index);
  size_t length = 0;
  if (luaL_callmeta(L, index, "__tostring") != 0) {
    if (lua_type(L, -1) != LUA_TSTRING) throw ScriptError("'__tostring' must return a string");
    const char* bytes = lua_tolstring(L, -1, &length);
    std::string text(bytes, length);
    lua_pop(L, 1);
    return text;
  }
  switch (lua_type(L, index)) {
    case LUA_TNUMBER:
    case LUA_TSTRING: {
      lua_pushvalue(L, index);  // lua_tolstring would change the number in place
      const char* bytes = lua_tolstring(L, -1, &length);
      std::string text(bytes, length);
      lua_pop(L, 1);
      return text;
    }
    case LUA_TBOOLEAN:
      return lua_toboolean(L, index) != 0 ? "true" : "false";
    case LUA_TNIL:
      return "nil";
    default: {
      std::string text = luaL_typename(L, index);
      const int type = luaL_getmetafield(L, index, "__name");
      if (type == LUA_TSTRING) text = lua_tostring(L, -1);
      if (type != LUA_TNIL) lua_pop(L, 1);
      return text;
    }
  }
}

int lua_tostring_without_addresses(lua_State* L) {
  luaL_checkany(L, 1);
  const std::string text = display_text(L, 1);
  lua_pushlstring(L, text.data(), text.size());
  return 1;
}

int lua_print_to_stderr(lua_State* L) {
  std::string line;
  const int count = lua_gettop(L);
  for (int i = 1; i <= count; ++i) {
    if (i > 1) line += '\t';
    line += display_text(L, i);
  }
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
  return 0;
}

int lua_format_without_addresses(lua_State* L) {
  size_t length = 0;
  const char* format = luaL_checklstring(L, 1, &length);
  const int count = lua_gettop(L);
  int argument = 1;
  for (size_t i = 0; i < length; ++i) {
    if (format[i] != '%') continue;
    if (++i < length && format[i] == '%') continue;
    while (i < length && std::strchr("-+ #0123456789.", format[i]) != nullptr && format[i] != '\0')
      ++i;
    ++argument;
    if (i >= length || argument > count) break;  // string.format itself reports this
    if (format[i] == 'p')
      throw ScriptError("string.format: '%p' is not available: addresses differ from run to run");
    if (format[i] == 's' && lua_type(L, argument) != LUA_TSTRING) {
      const std::string text = display_text(L, argument);
      lua_pushlstring(L, text.data(), text.size());
      lua_replace(L, argument);
    }
  }
  return lua_tocfunction(
      L, lua_upvalueindex(1))(L);  // in our place, so that its errors name the caller
}

}  // namespace csgrun
