// surface: solids under tables of heights, from files or lists.
#include <fmt/format.h>

#include <csgrun/primitives/height_map.h>

#include "lua_bindings/api.h"
#include "lua_bindings/call_site.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr Option kSurfaceOptions[] = {
    {"file", T::kString, "", "a PNG, or a text of numbers with one row a line", true},
    {"center", T::kBoolean, "false", "the middle of the table stands on the Z axis", true},
    {"invert", T::kBoolean, "false", "of a PNG: what is dark is high", false},
    {"heights", T::kValue, "",
     "instead of a file: a list of rows, each a list of numbers; the first row is at y = 0", false},
};
constexpr FunctionSpec kSurface{
    "surface",
    "The solid under heights 1 mm apart along X and Y, down to 1 mm below the least of them.",
    kSurfaceOptions, false, "surface{heights = {{0, 1, 0}, {1, 3, 1}, {0, 1, 0}}, center = true}"};

HeightMap read_heights(lua_State* L, int index) {
  HeightMap map;
  const lua_Integer rows = lua_istable(L, index) ? list_length(L, index) : -1;
  if (rows < 2) {
    fail_in(kSurface,
            "option 'heights' must be a list of two or more rows, got " + describe_value(L, index));
  }
  map.rows = static_cast<size_t>(rows);
  for (lua_Integer r = 1; r <= rows; ++r) {
    lua_rawgeti(L, index, r);
    const lua_Integer columns = lua_istable(L, -1) ? list_length(L, -1) : -1;
    if (r == 1 && columns >= 2) map.columns = static_cast<size_t>(columns);
    if (columns != static_cast<lua_Integer>(map.columns)) {
      fail_in(kSurface, fmt::format("row {} of option 'heights' must be a list of {}, got {}", r,
                                    r == 1 ? std::string("two or more numbers")
                                           : fmt::format("{} numbers, as the first", map.columns),
                                    describe_value(L, -1)));
    }
    for (lua_Integer c = 1; c <= columns; ++c) {
      if (lua_rawgeti(L, -1, c) != LUA_TNUMBER) {
        fail_in(kSurface, fmt::format("row {} of option 'heights' must be numbers, got {}", r,
                                      describe_value(L, -1)));
      }
      map.heights.push_back(lua_tonumber(L, -1));
      lua_pop(L, 1);
    }
    lua_pop(L, 1);
  }
  return map;
}

int surface(lua_State* L) {
  const Arguments arguments(L, kSurface, 1);
  const int heights = arguments.stack_index("heights");
  if (arguments.has("file") == (heights != 0)) {
    fail_in(kSurface, heights != 0 ? "give either 'file' or 'heights', not both"
                                   : "needs a file, or 'heights'");
  }
  HeightMap map;
  if (heights != 0) {
    if (arguments.has("invert")) fail_in(kSurface, "option 'invert' is for files");
    map = read_heights(L, heights);
  } else {
    Files::Opened file;
    try {
      file = session_of(L).files().open(calling_file(L), arguments.string("file", ""));
    } catch (const ScriptError& error) {
      fail_in(kSurface, error.what());
    }
    map = value_or_fail(
        kSurface, parse_height_map(file.display, file.bytes, arguments.boolean("invert", false)));
  }
  push_leaf(L, value_or_fail(kSurface, make_surface(map, arguments.boolean("center", false))));
  return 1;
}

constexpr Binding kBindings[] = {{&kSurface, guarded<surface>, nullptr, nullptr}};

}  // namespace

std::span<const Binding> surface_bindings() { return kBindings; }

}  // namespace csgrun
