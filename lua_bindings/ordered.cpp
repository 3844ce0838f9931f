#include "lua_bindings/ordered.h"

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "lua_bindings/guard.h"
#include "lua_bindings/session.h"
#include "lua_bindings/values.h"

namespace csgrun {
namespace {

// Keys of registry entries: their addresses.
const char kSerials = 0;    // weak table: value -> number of its making
const char kNextTable = 0;  // the table that `next` walks, and
const char kNextKeys = 0;   // its keys in order

enum Rank : int { kNumberKey, kStringKey, kBooleanKey, kMadeKey, kFunctionKey, kUnordered };

struct Key {
  int rank = kUnordered;
  long double number = 0;  // exact for integers and doubles; a serial; a line
  std::string text;        // only for functions
  std::string_view bytes;
  lua_Integer slot = 0;  // where it stands in the unsorted list

  [[nodiscard]] int compare(const Key& other) const {
    if (rank != other.rank) return rank < other.rank ? -1 : 1;
    if (const int c = bytes.compare(other.bytes); c != 0) return c;
    if (const int c = text.compare(other.text); c != 0) return c;
    return number < other.number ? -1 : number > other.number ? 1 : 0;
  }
};
static_assert(std::numeric_limits<long double>::digits >= 64,
              "integer and float keys compare exactly");

void push_serials(lua_State* L) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &kSerials) == LUA_TTABLE) return;
  lua_pop(L, 1);
  lua_newtable(L);
  lua_newtable(L);
  lua_pushliteral(L, "k");
  lua_setfield(L, -2, "__mode");
  lua_setmetatable(L, -2);
  lua_pushvalue(L, -1);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &kSerials);
}

Key describe_key(lua_State* L, int index) {
  Key key;
  switch (lua_type(L, index)) {
    case LUA_TNUMBER:
      key.rank = kNumberKey;
      key.number = lua_isinteger(L, index) != 0 ? static_cast<long double>(lua_tointeger(L, index))
                                                : static_cast<long double>(lua_tonumber(L, index));
      break;
    case LUA_TSTRING: {
      size_t length = 0;
      const char* bytes = lua_tolstring(L, index, &length);
      key.rank = kStringKey;
      key.bytes = {bytes, length};
      break;
    }
    case LUA_TBOOLEAN:
      key.rank = kBooleanKey;
      key.number = lua_toboolean(L, index);
      break;
    default:
      index = lua_absindex(L, index);
      if (const uint64_t serial = value_serial(L, index); serial != 0) {
        key.rank = kMadeKey;
        key.number = static_cast<long double>(serial);
        break;
      }
      push_serials(L);
      lua_pushvalue(L, index);
      if (lua_rawget(L, -2) == LUA_TNUMBER) {
        key.rank = kMadeKey;
        key.number = static_cast<long double>(lua_tointeger(L, -1));
      } else if (lua_isfunction(L, index) != 0 && lua_iscfunction(L, index) == 0) {
        lua_Debug place{};
        lua_pushvalue(L, index);
        lua_getinfo(L, ">S", &place);
        key.rank = kFunctionKey;
        key.text = place.source;
        key.number = place.linedefined;
      }
      lua_pop(L, 2);
  }
  return key;
}

/// Pushes a list of the keys of the table at `table`, in order.
void push_ordered_keys(lua_State* L, int table) {
  std::vector<Key> keys;
  lua_newtable(L);
  const int unsorted = lua_gettop(L);
  bool sorted = true;
  lua_pushnil(L);
  while (lua_next(L, table) != 0) {
    lua_pop(L, 1);
    Key key = describe_key(L, -1);
    key.slot = static_cast<lua_Integer>(keys.size()) + 1;
    if (sorted && !keys.empty()) sorted = keys.back().compare(key) < 0;
    lua_pushvalue(L, -1);
    lua_rawseti(L, unsorted, key.slot);
    keys.push_back(std::move(key));
  }
  if (sorted) return;
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) { return a.compare(b) < 0; });
  lua_createtable(L, static_cast<int>(std::min<size_t>(keys.size(), 1u << 30)), 0);
  for (size_t i = 0; i < keys.size(); ++i) {
    lua_rawgeti(L, unsorted, keys[i].slot);
    if (i > 0 && keys[i - 1].compare(keys[i]) == 0) {
      throw ScriptError(std::string("pairs: the order of keys of type ") + luaL_typename(L, -1) +
                        " would differ from run to run; use numbers or strings as keys");
    }
    lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
  lua_remove(L, unsorted);
}

/// The iterator of pairs: upvalues are the ordered keys and how many were taken.
int step(lua_State* L) {
  luaL_checktype(L, 1, LUA_TTABLE);
  lua_Integer taken = lua_tointeger(L, lua_upvalueindex(2));
  while (lua_rawgeti(L, lua_upvalueindex(1), ++taken) != LUA_TNIL) {
    lua_pushvalue(L, -1);
    if (lua_rawget(L, 1) != LUA_TNIL) {  // removed meanwhile: skip
      lua_pushinteger(L, taken);
      lua_replace(L, lua_upvalueindex(2));
      return 2;
    }
    lua_pop(L, 2);
  }
  return 1;
}

/// The smallest key of the table at 1, and its value: O(n), without a list of all keys.
int first_entry(lua_State* L) {
  lua_settop(L, 1);
  lua_pushnil(L);  // 2: the key found so far
  Key best;
  bool found = false;
  lua_pushnil(L);
  while (lua_next(L, 1) != 0) {
    lua_pop(L, 1);
    Key key = describe_key(L, -1);
    if (!found || key.compare(best) < 0) {
      best = std::move(key);
      found = true;
      lua_pushvalue(L, -1);
      lua_replace(L, 2);
    }
  }
  if (!found) return 1;
  lua_pushvalue(L, 2);
  lua_rawget(L, 1);
  return 2;
}

}  // namespace

void note_creation(lua_State* L, int index) {
  index = lua_absindex(L, index);
  push_serials(L);
  lua_pushvalue(L, index);
  if (lua_rawget(L, -2) == LUA_TNIL) {
    lua_pushvalue(L, index);
    lua_pushinteger(L, static_cast<lua_Integer>(session_of(L).next_serial()));
    lua_rawset(L, -4);
  }
  lua_pop(L, 2);
}

int ordered_pairs(lua_State* L) {
  luaL_checkany(L, 1);
  if (luaL_getmetafield(L, 1, "__pairs") != LUA_TNIL) {
    lua_pushvalue(L, 1);
    lua_call(L, 1, 3);
    return 3;
  }
  luaL_checktype(L, 1, LUA_TTABLE);
  push_ordered_keys(L, 1);
  lua_pushinteger(L, 0);
  lua_pushcclosure(L, guarded<step>, 2);
  lua_pushvalue(L, 1);
  lua_pushnil(L);
  return 3;
}

int ordered_next(lua_State* L) {
  luaL_checktype(L, 1, LUA_TTABLE);
  lua_settop(L, 2);
  if (lua_isnil(L, 2)) return first_entry(L);
  // Walks by `next` keep one list of keys: that of the table that was walked last.
  lua_rawgetp(L, LUA_REGISTRYINDEX, &kNextTable);
  const bool known = lua_rawequal(L, -1, 1) != 0;
  lua_pop(L, 1);
  if (known) {
    lua_rawgetp(L, LUA_REGISTRYINDEX, &kNextKeys);
  }
  const Key wanted = describe_key(L, 2);
  for (int attempt = known ? 0 : 1; attempt < 2; ++attempt) {
    if (attempt == 1) {
      lua_settop(L, 2);
      push_ordered_keys(L, 1);
      lua_pushvalue(L, 1);
      lua_rawsetp(L, LUA_REGISTRYINDEX, &kNextTable);
      lua_pushvalue(L, -1);
      lua_rawsetp(L, LUA_REGISTRYINDEX, &kNextKeys);
    }
    lua_Integer low = 1, high = static_cast<lua_Integer>(lua_rawlen(L, 3)) + 1;
    while (low < high) {  // the first key that is not before the wanted one
      const lua_Integer middle = low + (high - low) / 2;
      lua_rawgeti(L, 3, middle);
      const Key key = describe_key(L, -1);
      const bool before = key.compare(wanted) < 0;
      lua_pop(L, 1);
      (before ? low : high) = before ? middle + 1 : middle;
    }
    lua_rawgeti(L, 3, low);
    const bool here = lua_rawequal(L, -1, 2) != 0;
    lua_pop(L, 1);
    // Not in the list: it is stale, so list the keys again. Not in the table: it was removed while
    // it was the current one, so go on with what comes after its place.
    if (!here && attempt == 0) continue;
    for (low += here ? 1 : 0; lua_rawgeti(L, 3, low) != LUA_TNIL; ++low) {
      lua_pushvalue(L, -1);
      if (lua_rawget(L, 1) != LUA_TNIL) return 2;
      lua_pop(L, 2);
    }
    break;
  }
  lua_pushnil(L);
  return 1;
}

}  // namespace csgrun
