#include "lua_bindings/parameters.h"

#include <cmath>
#include <string_view>
#include <vector>

namespace csgrun {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Pushes a finite number written as Lua writes them.
bool push_number(lua_State* L, std::string_view text) {
  const std::string copy(trimmed(text));
  if (lua_stringtonumber(L, copy.c_str()) != copy.size() + 1) return false;
  if (std::isfinite(lua_tonumber(L, -1))) return true;
  lua_pop(L, 1);
  return false;
}

bool push_list_of_numbers(lua_State* L, std::string_view text) {
  text = trimmed(text);
  if (text.size() < 2) return false;
  const bool braces = text.front() == '{' && text.back() == '}';
  const bool brackets = text.front() == '[' && text.back() == ']';
  if (!braces && !brackets) return false;
  text = trimmed(text.substr(1, text.size() - 2));
  lua_newtable(L);
  lua_Integer count = 0;
  while (!text.empty()) {
    const size_t comma = text.find(',');
    if (!push_number(L, text.substr(0, comma))) {
      lua_pop(L, 1);
      return false;
    }
    lua_rawseti(L, -2, ++count);
    text = comma == std::string_view::npos ? std::string_view() : trimmed(text.substr(comma + 1));
  }
  return true;
}

}  // namespace

std::string parameter_type(lua_State* L, int index) {
  switch (lua_type(L, index)) {
    case LUA_TNUMBER:
      return "a number";
    case LUA_TBOOLEAN:
      return "true or false";
    case LUA_TSTRING:
      return "a string";
    case LUA_TTABLE:
      return "a list of numbers";
    default:
      return {};
  }
}

bool push_definition(lua_State* L, int index, const std::string& text) {
  switch (lua_type(L, index)) {
    case LUA_TNUMBER:
      return push_number(L, text);
    case LUA_TBOOLEAN: {
      const std::string_view word = trimmed(text);
      if (word != "true" && word != "false") return false;
      lua_pushboolean(L, word == "true" ? 1 : 0);
      return true;
    }
    case LUA_TSTRING: {
      std::string_view value = text;
      const bool quoted = value.size() >= 2 && (value.front() == '"' || value.front() == '\'') &&
                          value.back() == value.front();
      if (quoted) value = value.substr(1, value.size() - 2);
      lua_pushlstring(L, value.data(), value.size());
      return true;
    }
    case LUA_TTABLE:
      return push_list_of_numbers(L, text);
    default:
      return false;
  }
}

}  // namespace csgrun
