#include "lua_bindings/parts.h"

#include <algorithm>
#include <vector>

#include "lua_bindings/arguments.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/session.h"
#include "lua_bindings/values.h"

namespace csgrun {
namespace {

/// Groups in groups deeper than this are a table that contains itself.
constexpr int kDeepestGroup = 64;

bool is_empty_table(lua_State* L, int table) {
  lua_pushnil(L);
  const bool any = lua_next(L, table) != 0;
  if (any) lua_pop(L, 2);
  return !any;
}

void add(lua_State* L, int index, const std::string& group, const std::string& name, int depth);

void add_table(lua_State* L, int table, const std::string& group, int depth) {
  if (depth > kDeepestGroup)
    throw ScriptError("groups of parts are nested too deep (does a table contain itself?)");
  luaL_checkstack(L, 8, "groups of parts");
  const auto length = static_cast<lua_Integer>(lua_rawlen(L, table));
  std::vector<std::string> names;
  lua_Integer entries = 0;
  lua_pushnil(L);
  while (lua_next(L, table) != 0) {
    lua_pop(L, 1);
    if (lua_type(L, -1) == LUA_TSTRING) {
      size_t length_of_name = 0;
      const char* const name = lua_tolstring(L, -1, &length_of_name);
      names.emplace_back(name, length_of_name);
    } else if (lua_isinteger(L, -1) != 0 && lua_tointeger(L, -1) >= 1 &&
               lua_tointeger(L, -1) <= length) {
      ++entries;
    } else {
      throw ScriptError("a table of parts has names and a list from 1 on as keys, got the key " +
                        describe_value(L, -1));
    }
  }
  if (entries != length) throw ScriptError("a list of parts has a hole: one of its entries is nil");
  for (lua_Integer i = 1; i <= length; ++i) {
    lua_rawgeti(L, table, i);
    add(L, lua_gettop(L), group, "", depth);
    lua_pop(L, 1);
  }
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) {
    if (name.empty()) throw ScriptError("'' cannot be a part's name: leave it out, or say one");
    lua_pushlstring(L, name.data(), name.size());
    lua_rawget(L, table);
    add(L, lua_gettop(L), group, name, depth);
    lua_pop(L, 1);
  }
}

void add(lua_State* L, int index, const std::string& group, const std::string& name, int depth) {
  Session& session = session_of(L);
  if (const Marks* marks = marks_of(L, index)) {
    if (marks->absent) {
      session.has_absent_parts = true;
      return;
    }
    const std::string& own = name.empty() ? marks->name : name;
    if (const SolidValue* solid = to_solid(L, index)) {
      session.add_part({own, solid->node, {}, solid->node->where()}, group);
    } else {
      const ShapeValue& shape = *to_shape(L, index);
      session.add_part({own, nullptr, shape.shape, shape.where, marks->only, shape.appearance},
                       group);
    }
  } else if (lua_istable(L, index)) {
    // A list without a name of its own is no group.
    const std::string inner = name.empty() ? group : group.empty() ? name : group + "/" + name;
    if (!name.empty() && is_empty_table(L, index)) {
      session.warn(L, "part '" + inner + "' is an empty list: nothing is written for it");
    }
    add_table(L, index, inner, depth + 1);
  } else {
    throw ScriptError("a part must be a solid, a shape or a table of them, got " +
                      describe_value(L, index) + (name.empty() ? "" : " for '" + name + "'") +
                      (lua_isfunction(L, index) ? "; what it returns is a part: call it" : "") +
                      (name == "name" ? "; a name of a part is {NAME = part}, or "
                                        "emit(part, {name = \"NAME\"})"
                                      : ""));
  }
}

}  // namespace

void add_parts(lua_State* L, int index, const std::string& name) {
  add(L, lua_absindex(L, index), "", name, 0);
}

}  // namespace csgrun
