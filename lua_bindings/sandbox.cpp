#include "lua_bindings/sandbox.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <vector>

#include "lua_bindings/arguments.h"
#include "lua_bindings/call_site.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/nearest.h"
#include "lua_bindings/openscad_hints.h"
#include "lua_bindings/ordered.h"
#include "lua_bindings/shipped_calls.h"
#include "lua_bindings/text.h"

namespace csgrun {
namespace {

/// The same random numbers on every run, unless the script asks for others.
constexpr lua_Integer kRandomSeed = 20100501;
constexpr char kBytecodeMark = '\x1b';

/// Names of Lua that models cannot have, and why.
const char* missing_name_reason(const std::string& name) {
  if (name == "io" || name == "os" || name == "dofile" || name == "loadfile") {
    return "models cannot reach files or the system; import() and require() read below the model's "
           "folder";
  }
  if (name == "debug") return "it is not part of the language that models have";
  return nullptr;
}

/// Appends the names of the local variables that the Lua function which called us has there, and of
/// those around it that it uses.
void add_visible_locals(lua_State* L, std::vector<std::string>& names) {
  lua_Debug caller;
  if (lua_getstack(L, 1, &caller) == 0) return;
  const auto add = [&](const char* name) {
    lua_pop(L, 1);
    if (*name != '(' && *name != '\0') names.emplace_back(name);  // others have none in the script
  };
  for (int i = 1; const char* name = lua_getlocal(L, &caller, i); ++i) add(name);
  lua_getinfo(L, "f", &caller);
  const int function = lua_gettop(L);
  for (int i = 1; const char* name = lua_getupvalue(L, function, i); ++i) add(name);
  lua_pop(L, 1);
}

int undefined_global(lua_State* L) {
  if (lua_type(L, 2) != LUA_TSTRING) throw ScriptError("undefined global variable");
  const std::string name = lua_tostring(L, 2);
  if (const char* reason = missing_name_reason(name)) {
    throw ScriptError("'" + name + "' is not available: " + reason);
  }
  std::vector<std::string> names;
  add_visible_locals(L, names);
  if (const char* hint = name_hint(name)) {
    const std::string local = nearest_name(name, names);
    throw ScriptError("undefined variable '" + name + "' (" +
                      (local.empty() ? "in" : "did you mean '" + local + "'? otherwise, in") +
                      " Lua " + hint + ")");
  }
  lua_pushnil(L);
  while (lua_next(L, 1) != 0) {
    lua_pop(L, 1);
    if (lua_type(L, -1) == LUA_TSTRING) names.emplace_back(lua_tostring(L, -1));
  }
  throw ScriptError("undefined variable '" + name + "'" + did_you_mean(name, names));
}

/// A new global. OpenSCAD's facets are special variables, and these are not.
int new_global(lua_State* L) {
  const std::string name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "";
  if ((name == "fn" || name == "fa" || name == "fs") && lua_type(L, 3) == LUA_TNUMBER) {
    session_of(L).warn(L, "'" + name + "' is a variable like any other; csg." + name + " = " +
                              describe_value(L, 3) + " sets the facets");
  }
  lua_rawset(L, 1);
  return 0;
}

/// Where modules are looked for first; "./" is the model's folder.
constexpr char kPackagePath[] =
    "./?.lua;./?/init.lua;./csgrun_modules/?.lua;./csgrun_modules/?/init.lua";

/// package.X: of Lua's own table there is nothing but `path`.
int undefined_package_field(lua_State* L) {
  const std::string name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "?";
  throw ScriptError("'package." + name +
                    "' is not available: models have package.path only, for more folders below "
                    "the model's own or -L");
}

/// Runs upvalue 1, a function of Lua's own without upvalues, in our place: so its errors name the
/// caller.
int original(lua_State* L) { return lua_tocfunction(L, lua_upvalueindex(1))(L); }

/// Upvalue 1: the original. The collector of the host language would run script code at times that
/// depend on the machine.
int set_metatable(lua_State* L) {
  luaL_checktype(L, 1, LUA_TTABLE);
  if (lua_istable(L, 2)) {
    lua_pushliteral(L, "__gc");
    if (lua_rawget(L, 2) != LUA_TNIL)
      throw ScriptError("setmetatable: '__gc' is not available to models");
    lua_pop(L, 1);
  }
  note_creation(L, 1);
  return original(L);
}

/// Upvalue 1: the original. Text only, whatever mode is asked for.
int load_text(lua_State* L) {
  if (lua_gettop(L) < 3) lua_settop(L, 3);
  lua_pushliteral(L, "t");
  lua_replace(L, 3);
  return original(L);
}

/// How much memory is in use depends on the machine, so that is not told either.
int collect_garbage(lua_State* L) {
  luaL_optstring(L, 1, "collect");
  lua_pushinteger(L, 0);
  return 1;
}

/// Upvalue 1: the original, which without a number would take the clock and an address.
int random_seed(lua_State* L) {
  luaL_checknumber(L, 1);
  const int count = lua_gettop(L);
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  lua_call(L, count, 0);
  return 0;
}

int add_warning(lua_State* L) {
  std::string text;
  for (int i = 1; i <= lua_gettop(L); ++i) text += luaL_checkstring(L, i);
  session_of(L).warn(L, text);
  return 0;
}

/// `table.name = function(table.name)`: the table is on the top of the stack.
void wrap_field(lua_State* L, const char* name, lua_CFunction function) {
  lua_getfield(L, -1, name);
  lua_pushcclosure(L, function, 1);
  lua_setfield(L, -2, name);
}

void set_field(lua_State* L, const char* name, lua_CFunction function) {
  if (function != nullptr) {
    lua_pushcfunction(L, function);
  } else {
    lua_pushnil(L);
  }
  lua_setfield(L, -2, name);
}

}  // namespace

void open_sandbox(lua_State* L, Session& session) {
  attach_session(L, session);
  constexpr luaL_Reg kLibraries[] = {
      {LUA_GNAME, luaopen_base},        {LUA_TABLIBNAME, luaopen_table},
      {LUA_STRLIBNAME, luaopen_string}, {LUA_MATHLIBNAME, luaopen_math},
      {LUA_UTF8LIBNAME, luaopen_utf8},  {LUA_COLIBNAME, luaopen_coroutine},
  };
  for (const luaL_Reg& library : kLibraries) {
    luaL_requiref(L, library.name, library.func, 1);
    lua_pop(L, 1);
  }

  lua_pushglobaltable(L);
  set_field(L, "dofile", nullptr);
  set_field(L, "loadfile", nullptr);
  set_field(L, "error", guarded<lua_error_at_model>);
  set_field(L, "print", guarded<lua_print_to_stderr>);
  set_field(L, "tostring", guarded<lua_tostring_without_addresses>);
  set_field(L, "pairs", guarded<ordered_pairs>);
  set_field(L, "next", guarded<ordered_next>);
  set_field(L, "collectgarbage", guarded<collect_garbage>);
  set_field(L, "warn", guarded<add_warning>);
  wrap_field(L, "setmetatable", guarded<set_metatable>);
  wrap_field(L, "load", guarded<load_text>);
  lua_getfield(L, -1, LUA_STRLIBNAME);
  set_field(L, "dump", nullptr);
  wrap_field(L, "format", guarded<lua_format_without_addresses>);
  lua_pop(L, 1);
  lua_getfield(L, -1, LUA_MATHLIBNAME);
  wrap_field(L, "randomseed", guarded<random_seed>);
  lua_getfield(L, -1, "randomseed");
  lua_pushinteger(L, kRandomSeed);
  lua_call(L, 1, 0);
  lua_pop(L, 1);

  lua_createtable(L, 0, 1);  // package
  lua_pushstring(L, kPackagePath);
  lua_setfield(L, -2, "path");
  lua_createtable(L, 0, 3);
  set_field(L, "__index", guarded<undefined_package_field>);
  set_field(L, "__newindex", guarded<undefined_package_field>);
  lua_pushboolean(L, 0);
  lua_setfield(L, -2, "__metatable");
  lua_setmetatable(L, -2);
  lua_setfield(L, -2, "package");

  lua_createtable(L, 0, 3);
  set_field(L, "__index", guarded<undefined_global>);
  set_field(L, "__newindex", guarded<new_global>);
  lua_pushboolean(L, 0);
  lua_setfield(L, -2, "__metatable");
  lua_setmetatable(L, -2);
  lua_pop(L, 1);
}

std::string package_path(lua_State* L) {
  lua_getglobal(L, "package");
  if (lua_istable(L, -1)) {
    lua_pushliteral(L, "path");
    lua_rawget(L, -2);
  } else {
    lua_pushnil(L);
  }
  if (lua_type(L, -1) != LUA_TSTRING)
    throw ScriptError("package.path must be a string of templates such as \"./lib/?.lua\"");
  std::string path = lua_tostring(L, -1);
  lua_settop(L, lua_gettop(L) - 2);
  return path;
}

namespace {

/// The line of the text that a message "path:12: ..." is about, without the end of the line; of a
/// blank one, as after the last, the one before it that is not.
std::string_view line_of(std::string_view message, const std::string& path, std::string_view text) {
  size_t line = 0;
  if (message.size() > path.size() + 1) {
    const char* digits = message.data() + path.size() + 1;
    std::from_chars(digits, message.data() + message.size(), line);
  }
  size_t end = std::min(text.find('\n'), text.size());
  for (; line > 1 && end < text.size(); --line)
    end = std::min(text.find('\n', end + 1), text.size());
  const size_t last = text.substr(0, end).find_last_not_of(" \t\r\n");
  if (last == std::string_view::npos) return {};
  const size_t begin = text.substr(0, last).find_last_of('\n') + 1;  // 0 if there is none
  return text.substr(begin, last + 1 - begin);
}

}  // namespace

void load_chunk(lua_State* L, const std::string& path, const std::string& text) {
  size_t start = text.rfind("\xEF\xBB\xBF", 0) == 0 ? 3 : 0;
  if (start < text.size() && text[start] == kBytecodeMark) {
    throw PlacedScriptError(path + ":1: this is Lua bytecode; only text is accepted");
  }
  if (start < text.size() && text[start] == '#')
    start = std::min(text.find('\n', start), text.size());
  const std::string name = "@" + path;
  const int status =
      luaL_loadbufferx(L, text.data() + start, text.size() - start, name.c_str(), "t");
  if (status == LUA_ERRMEM) throw std::bad_alloc();
  if (status != LUA_OK) {
    const std::string message = with_whole_path(lua_tostring(L, -1), path);
    throw PlacedScriptError(message + syntax_hint(line_of(message, path, text), message));
  }
}

}  // namespace csgrun
