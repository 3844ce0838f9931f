// Solids of free form: surface, refine, smooth, warp, levelset.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>

#include <csgrun/engine/validate.h>
#include <csgrun/primitives/freeform.h>
#include <csgrun/primitives/height_map.h>

#include "lua_bindings/api.h"
#include "lua_bindings/call_site.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/operands.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr const char* kSolidDoc = "the solid; as a method, solid:f(...), it is left out";

constexpr Option kSurfaceOptions[] = {
    {"file", T::kValue, "",
     "the name of a PNG, or of a text of numbers with one row a line; or heights, as that option",
     true},
    {"center", T::kBoolean, "false", "the middle of the table stands on the Z axis", true},
    {"invert", T::kBoolean, "false", "of a PNG: what is dark is high", false},
    {"heights", T::kValue, "",
     "instead of a file: a list of rows, each a list of numbers; the first row is at y = 0", false},
    kConvexityOption,
};
constexpr FunctionSpec kSurface{
    "surface",
    "The solid under heights 1 mm apart along X and Y, down to 1 mm below the least of them; of a "
    "text file down to 0 at least.",
    kSurfaceOptions, false, "surface({{0, 1, 0}, {1, 3, 1}, {0, 1, 0}}, true)"};

HeightMap read_heights(lua_State* L, int index, const char* option) {
  HeightMap map;
  const lua_Integer rows = lua_istable(L, index) ? list_length(L, index) : -1;
  if (rows < 2) {
    fail_in(kSurface, fmt::format("option '{}' must be a list of two or more rows, got {}", option,
                                  describe_value(L, index)));
  }
  map.rows = static_cast<size_t>(rows);
  for (lua_Integer r = 1; r <= rows; ++r) {
    lua_rawgeti(L, index, r);
    const lua_Integer columns = lua_istable(L, -1) ? list_length(L, -1) : -1;
    if (r == 1 && columns >= 2) map.columns = static_cast<size_t>(columns);
    if (columns != static_cast<lua_Integer>(map.columns)) {
      fail_in(kSurface, fmt::format("row {} of option '{}' must be a list of {}, got {}", r, option,
                                    r == 1 ? std::string("two or more numbers")
                                           : fmt::format("{} numbers, as the first", map.columns),
                                    describe_value(L, -1)));
    }
    for (lua_Integer c = 1; c <= columns; ++c) {
      if (lua_rawgeti(L, -1, c) != LUA_TNUMBER) {
        fail_in(kSurface, fmt::format("row {} of option '{}' must be numbers, got {}", r, option,
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
  name_list_part(L, "heights");
  const Arguments arguments(L, kSurface, 1);
  const int named = arguments.stack_index("heights"), first = arguments.stack_index("file");
  if ((first != 0) == (named != 0)) {
    fail_in(kSurface, named != 0 ? "give either 'file' or 'heights', not both"
                                 : "needs a file, or 'heights'");
  }
  if (first != 0 && lua_type(L, first) != LUA_TSTRING && !lua_istable(L, first)) {
    fail_in(kSurface, "option 'file' must be a string, or a list of rows of heights, got " +
                          describe_value(L, first));
  }
  const int heights = first != 0 && lua_istable(L, first) ? first : named;
  HeightMap map;
  if (heights != 0) {
    if (arguments.has("invert")) fail_in(kSurface, "option 'invert' is for a PNG");
    const bool is_file = heights != named && arguments.positional_count() == 0;
    map = read_heights(L, heights, is_file ? "file" : "heights");
  } else {
    Files::Opened file;
    try {
      file = session_of(L).files().open(calling_file(L), lua_tostring(L, first));
    } catch (const ScriptError& error) {
      fail_in(kSurface, error.what());
    }
    const bool invert = arguments.boolean("invert", false);
    if (invert && !is_png(file.bytes)) {
      fail_in(kSurface, "option 'invert' is for a PNG, and " + file.display + " is a text");
    }
    auto read = parse_height_map(file.display, file.bytes, invert);
    if (!read) fail_in(kSurface, read.error().message);  // it begins with the file's name
    map = *std::move(read);
  }
  push_leaf(L, value_or_fail(kSurface, make_surface(map, arguments.boolean("center", false))));
  return 1;
}

constexpr Option kRefineOptions[] = {
    {"length", T::kNumber, "", "the longest edge that is left, mm", true, Range::kPositive},
};
constexpr FunctionSpec kRefine{
    "refine",
    "The same solid with triangles divided until no edge is longer: for warp and smooth.",
    kRefineOptions,
    false,
    "cube(10):refine(2)",
    "solid",
    kSolidDoc};

int refine(lua_State* L) {
  SolidValue& solid = final_solid_argument(L, kRefine);
  const Arguments arguments(L, kRefine, 2);
  if (!arguments.has("length")) fail_in(kRefine, "needs the length of the longest edge");
  PolygonMesh mesh = mesh_of_solid(session_of(L).evaluated(solid), "refine");
  push_leaf(L, value_or_fail(kRefine, refine_mesh(std::move(mesh), arguments.number("length", 1))));
  keep_marks(L, 1);
  return 1;
}

constexpr Option kSmoothOptions[] = {
    {"rounds", T::kInteger, "2", "each makes four triangles of one", true, Range::kPositive},
};
constexpr FunctionSpec kSmooth{
    "smooth",
    "Rounds off the whole solid by subdivision (Loop 1987): it draws near a surface without edges "
    "that lies within its corners. Refine it first to keep it nearer to what it was.",
    kSmoothOptions,
    false,
    "cube(10):refine(4):smooth(2)",
    "solid",
    kSolidDoc};

int smooth(lua_State* L) {
  SolidValue& solid = final_solid_argument(L, kSmooth);
  const Arguments arguments(L, kSmooth, 2);
  PolygonMesh mesh = mesh_of_solid(session_of(L).evaluated(solid), "smooth");
  const auto rounds = static_cast<int>(arguments.number("rounds", 2));
  push_leaf(L, value_or_fail(kSmooth, smooth_mesh(std::move(mesh), rounds)));
  keep_marks(L, 1);
  return 1;
}

/// Whether the function at `index` has one parameter: function(p), where others have x, y, z.
bool takes_a_vector(lua_State* L, int index) {
  lua_Debug facts;
  lua_pushvalue(L, index);
  lua_getinfo(L, ">u", &facts);
  return facts.nparams == 1 && facts.isvararg == 0;
}

/// Calls the function at `index` with a point; its results are left on the stack.
int call_with_point(lua_State* L, int index, const glm::dvec3& p) {
  const int top = lua_gettop(L);
  const bool as_vector = takes_a_vector(L, index);
  lua_pushvalue(L, index);
  if (as_vector) {
    push_point(L, p);
  } else {
    for (int i = 0; i < 3; ++i) lua_pushnumber(L, p[i]);
  }
  lua_call(L, as_vector ? 1 : 3, LUA_MULTRET);
  return lua_gettop(L) - top;
}

int function_argument(lua_State* L, const Arguments& arguments, const FunctionSpec& spec,
                      const char* name) {
  const int index = arguments.stack_index(name);
  if (index == 0) fail_in(spec, "needs a function");
  if (!lua_isfunction(L, index)) {
    fail_in(spec,
            fmt::format("option '{}' must be a function, got {}", name, describe_value(L, index)));
  }
  return index;
}

constexpr Option kWarpOptions[] = {
    {"f", T::kValue, "",
     "a function of x, y, z, or of one vector, that gives the three of the moved point, or a list",
     true},
};
constexpr FunctionSpec kWarp{
    "warp",
    "Moves every corner by a function. Edges stay straight: refine the solid first.",
    kWarpOptions,
    false,
    "cube{40, 4, 4}:refine(2):warp(function(x, y, z) return x, y, z + 5 * sin(9 * x) end)",
    "solid",
    kSolidDoc};

/// Whether what a mesh encloses, parts that are turned over taken off, is little beside its box.
bool is_almost_nothing(const PolygonMesh& mesh) {
  glm::dvec3 low = mesh.points[0], high = low;
  for (const glm::dvec3& p : mesh.points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::dvec3 size = high - low;
  constexpr double kLittle =
      1e-6;  // rounding leaves 1e-15; a thin sheet is evaluated here, not later
  const double side = std::max({size.x, size.y, size.z});
  return std::fabs(signed_volume(mesh)) <= kLittle * side * side * side;
}

int warp(lua_State* L) {
  SolidValue& solid = final_solid_argument(L, kWarp);
  const Arguments arguments(L, kWarp, 2);
  const int function = function_argument(L, arguments, kWarp, "f");
  const Solid& evaluated = session_of(L).evaluated(solid);
  if (evaluated.empty()) fail_in(kWarp, "there is nothing in it");
  const auto move = [&](const glm::dvec3& p) -> Result<glm::dvec3> {
    const int top = lua_gettop(L);
    const int count = call_with_point(L, function, p);
    int first = top + 1;
    if (count == 1 && lua_istable(L, first) && list_length(L, first) == 3) {
      for (int i = 1; i <= 3; ++i) lua_rawgeti(L, top + 1, i);
      first = top + 2;
    }
    if (lua_gettop(L) - first != 2) {
      fail_in(kWarp, fmt::format("the function must give three numbers, got {}",
                                 count == 1 ? "one value, " + describe_given(L, top + 1)
                                            : fmt::format("{} values", count)));
    }
    glm::dvec3 moved(0);
    for (int i = 0; i < 3; ++i) {
      if (lua_type(L, first + i) != LUA_TNUMBER) {
        fail_in(kWarp, fmt::format("the function must give three numbers, but number {} is {}",
                                   i + 1, describe_value(L, first + i)));
      }
      moved[i] = lua_tonumber(L, first + i);
    }
    lua_settop(L, top);
    return moved;
  };
  PolygonMesh mesh = value_or_fail(kWarp, warp_mesh(mesh_of_solid(evaluated, "warp"), move));
  const bool may_be_flat = is_almost_nothing(mesh);
  push_leaf(L, std::move(mesh));
  // Lobes on both sides of where it crosses itself may cancel in the sum, and are there all the
  // same.
  if (may_be_flat && session_of(L).evaluated(*to_solid(L, -1)).empty())
    fail_in(kWarp, "the moved points enclose no volume");
  keep_marks(L, 1);
  return 1;
}

constexpr Option kLevelsetOptions[] = {
    {"f", T::kValue, "", "a function of x, y, z, or of one vector: at most the level inside", true},
    {"bounds", T::kValue, "", "{min = {x, y, z}, max = {x, y, z}}, as bbox() gives them", true},
    {"step", T::kNumber, "1", "mm between samples", true, Range::kPositive},
    {"level", T::kNumber, "0", "the value at the surface", false},
};
constexpr FunctionSpec kLevelset{
    "levelset",
    "The solid where a function (a signed distance, say) is at most the level, cut with the "
    "bounds where it reaches farther.",
    kLevelsetOptions, false,
    "levelset(function(x, y, z) return norm{x, y, z} - 8 end, {{-9, -9, -9}, {9, 9, 9}}, 1)"};

glm::dvec3 bound(lua_State* L, int index, const char* name, int place) {
  glm::dvec3 p(0);
  if (lua_getfield(L, index, name) == LUA_TNIL) {
    lua_pop(L, 1);
    lua_rawgeti(L, index, place);
  }
  bool good = lua_istable(L, -1) && list_length(L, -1) == 3;
  for (int i = 0; good && i < 3; ++i) {
    good = lua_rawgeti(L, -1, i + 1) == LUA_TNUMBER;
    p[i] = lua_tonumber(L, -1);
    lua_pop(L, 1);
  }
  if (!good) {
    fail_in(kLevelset,
            fmt::format("'{}' of option 'bounds' must be a list of three numbers, got {}", name,
                        describe_value(L, -1)));
  }
  lua_pop(L, 1);
  return p;
}

/// levelset(f, part:bbox()): a box at the end is the bounds, not a table of options.
void tell_box_from_options(lua_State* L) {
  if (lua_gettop(L) != 2 || !lua_istable(L, 2)) return;
  for (const char* name : {"min", "max"}) {
    const bool is_there = lua_getfield(L, 2, name) != LUA_TNIL;
    lua_pop(L, 1);
    if (!is_there) return;
  }
  lua_newtable(L);  // no options
}

int levelset(lua_State* L) {
  tell_box_from_options(L);
  const Arguments arguments(L, kLevelset, 1);
  const int function = function_argument(L, arguments, kLevelset, "f");
  const int bounds = arguments.stack_index("bounds");
  if (bounds == 0) fail_in(kLevelset, "needs bounds: {min = {x, y, z}, max = {x, y, z}}");
  if (!lua_istable(L, bounds)) {
    fail_in(kLevelset, "option 'bounds' must be {min = {x, y, z}, max = {x, y, z}}, got " +
                           describe_value(L, bounds));
  }
  LevelSetOptions options;
  options.low = bound(L, bounds, "min", 1);
  options.high = bound(L, bounds, "max", 2);
  options.step = arguments.number("step", 1);
  options.level = arguments.number("level", 0);
  const auto value = [&](const glm::dvec3& p) -> Result<double> {
    const int top = lua_gettop(L);
    const int count = call_with_point(L, function, p);
    if (count != 1 || lua_type(L, top + 1) != LUA_TNUMBER) {
      fail_in(kLevelset, fmt::format("the function must give a number, got {}",
                                     count == 1 ? describe_value(L, top + 1)
                                                : fmt::format("{} values", count)));
    }
    const double result = lua_tonumber(L, top + 1);
    lua_settop(L, top);
    return result;
  };
  PolygonMesh mesh = value_or_fail(kLevelset, make_level_set(value, options));
  if (mesh.face_count() == 0) {
    push_solid(L, Node::empty(session_of(L).source_ref(L)));
    return 1;
  }
  push_leaf(L, std::move(mesh));
  return 1;
}

constexpr Binding kFreeformBindings[] = {
    {&kSurface, guarded<surface>, nullptr, nullptr},
    {&kRefine, guarded<refine>, guarded<refine>, nullptr},
    {&kSmooth, guarded<smooth>, guarded<smooth>, nullptr},
    {&kWarp, guarded<warp>, guarded<warp>, nullptr},
    {&kLevelset, guarded<levelset>, nullptr, nullptr},
};

}  // namespace

std::span<const Binding> surface_bindings() { return kFreeformBindings; }

}  // namespace csgrun
