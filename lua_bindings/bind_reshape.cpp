// levelset, warp, refine, smooth: solids from functions, and solids whose points move.
#include <cmath>

#include <fmt/format.h>

#include <csgrun/primitives/level_set.h>
#include <csgrun/primitives/reshape.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/nearest.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr char kSolidDoc[] = "the solid; as a method, solid:f(...), it is left out";

std::string point_text(const glm::dvec3& p) { return fmt::format("({}, {}, {})", p.x, p.y, p.z); }

/// The stack index of a function that was given as option `name`.
int function_argument(lua_State* L, const Arguments& arguments, const FunctionSpec& spec,
                      const char* name) {
  const int index = arguments.stack_index(name);
  if (index == 0) fail_in(spec, fmt::format("option '{}' is missing: a function of x, y, z", name));
  if (!lua_isfunction(L, index)) {
    fail_in(spec, fmt::format("option '{}' must be a function of x, y, z, got {}", name,
                              describe_value(L, index)));
  }
  return index;
}

void push_call(lua_State* L, int function, const glm::dvec3& p) {
  lua_pushvalue(L, function);
  for (int k = 0; k < 3; ++k) lua_pushnumber(L, p[k]);
}

constexpr Option kLevelsetOptions[] = {
    {"f", T::kValue, "", "a function of x, y, z: the signed distance, or any number like it", true},
    {"bounds", T::kValue, "",
     "the box to look in, {{x, y, z}, {x, y, z}} or {min = {...}, max = {...}}; it cuts off what\n"
     "          reaches out of it",
     true},
    {"step", T::kNumber, "", "distance of the points that are looked at, mm", true,
     Range::kPositive},
    {"inside", T::kString, "\"negative\"", "where the function is \"negative\" or \"positive\"",
     false},
};
constexpr FunctionSpec kLevelset{
    "levelset", "The solid in which a function of space is negative.", kLevelsetOptions, false,
    "levelset(function(x, y, z) return norm{x, y, z} - 5 end, {{-6, -6, -6}, {6, 6, 6}}, 0.5)"};

/// The list of three numbers on the top of the stack, which is taken off.
glm::dvec3 pop_corner(lua_State* L) {
  glm::dvec3 p{};
  const bool is_list = lua_istable(L, -1) && list_length(L, lua_gettop(L)) == 3;
  bool good = is_list;
  for (int k = 0; is_list && k < 3; ++k) {
    lua_rawgeti(L, -1, k + 1);
    good &= lua_type(L, -1) == LUA_TNUMBER && std::isfinite(lua_tonumber(L, -1));
    p[k] = lua_tonumber(L, -1);
    lua_pop(L, 1);
  }
  if (!good) {
    fail_in(kLevelset,
            "option 'bounds' must be {{x, y, z}, {x, y, z}} or {min = {x, y, z}, max = {x, y, z}}, "
            "got " +
                describe_value(L, lua_gettop(L)) + " for a corner");
  }
  lua_pop(L, 1);
  return p;
}

std::array<glm::dvec3, 2> bounds_argument(lua_State* L, const Arguments& arguments) {
  const int index = arguments.stack_index("bounds");
  if (index == 0 || !lua_istable(L, index)) {
    fail_in(kLevelset,
            "option 'bounds' must be {{x, y, z}, {x, y, z}} or {min = {x, y, z}, max = {x, y, z}}" +
                (index == 0 ? std::string() : ", got " + describe_value(L, index)));
  }
  std::array<glm::dvec3, 2> bounds{};
  const bool by_name = lua_getfield(L, index, "min") != LUA_TNIL;
  lua_pop(L, 1);
  for (size_t i = 0; i < 2; ++i) {
    if (by_name) {
      lua_getfield(L, index, i == 0 ? "min" : "max");
    } else {
      lua_rawgeti(L, index, static_cast<lua_Integer>(i + 1));
    }
    bounds[i] = pop_corner(L);
  }
  return bounds;
}

int levelset(lua_State* L) {
  const Arguments arguments(L, kLevelset, 1);
  const int function = function_argument(L, arguments, kLevelset, "f");
  const auto bounds = bounds_argument(L, arguments);
  if (!arguments.has("step")) fail_in(kLevelset, "option 'step' is missing: a number");
  const std::string inside = arguments.string("inside", "negative");
  if (inside != "negative" && inside != "positive") {
    fail_in(kLevelset,
            fmt::format("option 'inside' must be \"negative\" or \"positive\", got \"{}\"{}",
                        inside, did_you_mean(inside, {"negative", "positive"})));
  }
  const double sign = inside == "positive" ? -1 : 1;
  const auto field = [&](const glm::dvec3& p) {
    push_call(L, function, p);
    lua_call(L, 3, 1);
    const double value = lua_tonumber(L, -1);
    if (lua_type(L, -1) != LUA_TNUMBER || !std::isfinite(value)) {
      fail_in(kLevelset, "the function must give a finite number, but at " + point_text(p) +
                             " it gave " + describe_value(L, lua_gettop(L)));
    }
    lua_pop(L, 1);
    return sign * value;
  };
  push_leaf(L,
            value_or_fail(kLevelset, make_level_set(field, bounds, arguments.number("step", 0))));
  return 1;
}

/// Pushes what became of the triangles of the solid at index 1.
void push_reshaped(lua_State* L, const FunctionSpec& spec, MeshResult mesh) {
  push_leaf(L, value_or_fail(spec, std::move(mesh)));
  keep_marks(L, 1);
}

/// The triangles of the solid at index 1. False when there are none: then an empty solid is pushed.
bool read_triangles(lua_State* L, const FunctionSpec& spec, PolygonMesh& mesh) {
  SolidValue& value = solid_argument(L, spec);
  const Solid& solid = session_of(L).evaluated(value);
  if (solid.empty()) {
    push_solid(L, Node::empty(session_of(L).source_ref(L)));
    return false;
  }
  mesh = triangle_mesh(solid);
  return true;
}

constexpr Option kRefineOptions[] = {
    {"length", T::kNumber, "", "no edge is longer, mm", true, Range::kPositive},
};
constexpr FunctionSpec kRefine{"refine",
                               "The same solid with its triangles cut into smaller ones, for warp.",
                               kRefineOptions,
                               false,
                               "cube(10):refine(2)",
                               "solid",
                               kSolidDoc};

int refine(lua_State* L) {
  const Arguments arguments(L, kRefine, 2);
  if (!arguments.has("length")) fail_in(kRefine, "option 'length' is missing: a number");
  PolygonMesh mesh;
  if (!read_triangles(L, kRefine, mesh)) return 1;
  mesh.kind = "refine";
  mesh.keep_facets = true;
  push_reshaped(L, kRefine, refine_edges(std::move(mesh), arguments.number("length", 0), "refine"));
  return 1;
}

constexpr Option kSmoothOptions[] = {
    {"steps", T::kInteger, "2", "how often each triangle becomes four, 1 to 8", true,
     Range::kPositive},
    {"length", T::kNumber, "", "edges are cut to this first, mm: corners are kept closer", false,
     Range::kPositive},
};
constexpr FunctionSpec kSmooth{"smooth",
                               "The solid without edges: its triangles are subdivided by Loop's "
                               "scheme, which rounds corners off inwards.",
                               kSmoothOptions,
                               false,
                               "cube(10):smooth(2, {length = 4})",
                               "solid",
                               kSolidDoc};

int smooth(lua_State* L) {
  const Arguments arguments(L, kSmooth, 2);
  const double steps = arguments.number("steps", 2);
  if (steps > 8) fail_in(kSmooth, fmt::format("option 'steps' must be at most 8, got {}", steps));
  PolygonMesh mesh;
  if (!read_triangles(L, kSmooth, mesh)) return 1;
  if (arguments.has("length")) {
    mesh = value_or_fail(kSmooth,
                         refine_edges(std::move(mesh), arguments.number("length", 0), "smooth"));
  }
  push_reshaped(L, kSmooth, smooth_mesh(std::move(mesh), static_cast<int>(steps)));
  return 1;
}

constexpr Option kWarpOptions[] = {
    {"f", T::kValue, "", "a function of x, y, z that gives the new x, y, z", true},
    {"length", T::kNumber, "", "edges are cut to this first, mm, so that they can bend", false,
     Range::kPositive},
};
constexpr FunctionSpec kWarp{
    "warp",
    "The solid with each corner of its triangles where a function sends it.",
    kWarpOptions,
    false,
    "cube(30, 4, 4):warp(function(x, y, z) return x, y + sin(x * 12), z end, {length = 1})",
    "solid",
    kSolidDoc};

int warp(lua_State* L) {
  const Arguments arguments(L, kWarp, 2);
  const int function = function_argument(L, arguments, kWarp, "f");
  PolygonMesh mesh;
  if (!read_triangles(L, kWarp, mesh)) return 1;
  if (arguments.has("length")) {
    mesh =
        value_or_fail(kWarp, refine_edges(std::move(mesh), arguments.number("length", 0), "warp"));
  }
  const auto map = [&](const glm::dvec3& p) {
    const int before = lua_gettop(L);
    push_call(L, function, p);
    lua_call(L, 3, LUA_MULTRET);
    if (lua_gettop(L) == before + 1 && lua_istable(L, -1)) {  // a list of three
      const int list = lua_gettop(L);
      for (int k = 1; k <= 3; ++k) lua_rawgeti(L, list, k);
      lua_remove(L, list);
    }
    glm::dvec3 moved{};
    bool good = lua_gettop(L) == before + 3;
    for (int k = 0; good && k < 3; ++k) {
      good = lua_type(L, before + 1 + k) == LUA_TNUMBER &&
             std::isfinite(lua_tonumber(L, before + 1 + k));
      moved[k] = lua_tonumber(L, before + 1 + k);
    }
    if (!good) {
      fail_in(kWarp,
              "the function must give three finite numbers, which it did not at " + point_text(p));
    }
    lua_settop(L, before);
    return moved;
  };
  std::string note;
  MeshResult warped = warp_mesh(std::move(mesh), map, &note);
  if (!note.empty()) session_of(L).warn(L, note);
  push_reshaped(L, kWarp, std::move(warped));
  return 1;
}

constexpr Binding kBindings[] = {
    {&kLevelset, guarded<levelset>, nullptr, nullptr},
    {&kWarp, guarded<warp>, guarded<warp>, nullptr},
    {&kRefine, guarded<refine>, guarded<refine>, nullptr},
    {&kSmooth, guarded<smooth>, guarded<smooth>, nullptr},
};

}  // namespace

std::span<const Binding> reshape_bindings() { return kBindings; }

}  // namespace csgrun
