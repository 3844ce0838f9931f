// Measuring: methods that evaluate the solid, once.
#include <cmath>

#include <fmt/format.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/nearest.h"
#include "lua_bindings/session.h"
#include "lua_bindings/text.h"

namespace csgrun {
namespace {

/// The value at index 1, of a method without arguments.
SolidValue& bare_solid(lua_State* L, const FunctionSpec& spec) {
  SolidValue& value = solid_argument(L, spec);
  if (lua_gettop(L) > 1) fail_in(spec, "takes no arguments");
  return value;
}

const Measures& measures_of(lua_State* L, const FunctionSpec& spec, Measuring measuring) {
  return session_of(L).evaluated(bare_solid(L, spec), measuring).measures;
}

/// What the value at index 1 measures, without its triangles.
Extent extent_of(lua_State* L, const FunctionSpec& spec) {
  return session_of(L).extent(bare_solid(L, spec));
}

const Shape2D& bare_shape(lua_State* L, const FunctionSpec& spec) {
  const ShapeValue& value = shape_argument(L, spec);
  if (lua_gettop(L) > 1) fail_in(spec, "takes no arguments");
  return value.shape;
}

constexpr FunctionSpec kBbox{"bbox",
                             "The bounding box: its corners .min and .max, .size and .center, "
                             "vectors as of vec; two numbers "
                             "each for a shape.",
                             {},
                             false,
                             "part:bbox().max.z"};
constexpr FunctionSpec kBounds{
    "bounds", "The bounding box: another name of bbox.", {}, false, "part:bounds().min.x"};
constexpr FunctionSpec kSize{
    "size",
    "The lengths of the bounding box, a vector: .x, .y, .z or [1], [2], [3].",
    {},
    false,
    "part:size().x"};
constexpr FunctionSpec kVolume{
    "volume", "The volume in mm^3, rounded once from the exact value.", {}, false, "part:volume()"};
constexpr FunctionSpec kArea{
    "area", "The area of the surface in mm^2; of a shape its own area.", {}, false, "part:area()"};
constexpr FunctionSpec kCentroid{"centroid",
                                 "The centre of mass, a vector {x, y, z}; of a shape {x, y}.",
                                 {},
                                 false,
                                 "part:centroid().x"};
constexpr FunctionSpec kComponents{
    "components",
    "The number of connected surfaces; of a shape that of connected pieces.",
    {},
    false,
    "part:components()"};
constexpr FunctionSpec kGenus{
    "genus", "The number of handles, over all surfaces.", {}, false, "part:genus()"};
constexpr FunctionSpec kIsEmpty{
    "is_empty", "Whether there is nothing in it.", {}, false, "(part - part):is_empty()"};
constexpr FunctionSpec kMesh{"mesh",
                             "Its triangles: {points = {{x, y, z}, ...}, faces = {{i, j, k}, "
                             "...}}, as polyhedron takes them.",
                             {},
                             false,
                             "polyhedron(part:mesh())"};
constexpr Option kContainsOptions[] = {
    {"p", ArgumentType::kVector2Or3, "", "the point", true},
};
constexpr FunctionSpec kContains{"contains",
                                 "Whether the point is inside or on the boundary, exactly.",
                                 kContainsOptions, false, "part:contains(0, 0, 5)"};

void fail_if_empty(bool empty, const FunctionSpec& spec) {
  if (empty) fail_in(spec, "there is nothing in it, so it has no place");
}

constexpr const char* kBoxName = "box";

/// What a box has is found before; other programs' boxes have box[1], box.x or box.min_x.
int box_index(lua_State* L) {
  const bool is_name = lua_type(L, 2) == LUA_TSTRING;
  const std::string name = is_name ? lua_tostring(L, 2) : "";
  throw ScriptError(is_name ? "a bounding box has no '" + name + "'" +
                                  did_you_mean(name, {"min", "max", "size", "center"}) +
                                  ": it has min, max, size and center, with x, y and z each"
                            : "a bounding box has min, max, size and center, and no [" +
                                  describe_value(L, 2) + "]");
}

int box_text(lua_State* L) {
  std::string text = "{";
  for (const char* name : {"min", "max"}) {
    lua_pushstring(L, name);
    lua_rawget(L, 1);
    text += fmt::format("{}{} = {}", text.size() > 1 ? ", " : "", name, display_text(L, -1));
    lua_pop(L, 1);
  }
  text += "}";
  lua_pushlstring(L, text.data(), text.size());
  return 1;
}

/// `Point`: glm::dvec3 of solids, glm::dvec2 of shapes.
template <class Point>
int push_box(lua_State* L, const std::array<Point, 2>& box) {
  lua_createtable(L, 0, 4);
  push_point(L, box[0]);
  lua_setfield(L, -2, "min");
  push_point(L, box[1]);
  lua_setfield(L, -2, "max");
  push_point(L, box[1] - box[0]);
  lua_setfield(L, -2, "size");
  push_point(L, box[0] + (box[1] - box[0]) * 0.5);
  lua_setfield(L, -2, "center");
  luaL_setmetatable(L, kBoxName);
  return 1;
}

template <const FunctionSpec& Spec>
int solid_bbox(lua_State* L) {
  const Extent solid = extent_of(L, Spec);
  fail_if_empty(solid.empty, Spec);
  return push_box(L, solid.bbox);
}

template <const FunctionSpec& Spec>
int shape_bbox(lua_State* L) {
  const Shape2D& shape = bare_shape(L, Spec);
  fail_if_empty(shape.empty(), Spec);
  return push_box(L, shape.bounds());
}

int solid_size(lua_State* L) {
  const Extent solid = extent_of(L, kSize);
  fail_if_empty(solid.empty, kSize);
  const glm::dvec3 size = solid.bbox[1] - solid.bbox[0];
  push_point(L, size);
  return 1;
}

int shape_size(lua_State* L) {
  const Shape2D& shape = bare_shape(L, kSize);
  fail_if_empty(shape.empty(), kSize);
  const auto bounds = shape.bounds();
  push_point(L, bounds[1] - bounds[0]);
  return 1;
}

int solid_volume(lua_State* L) {
  lua_pushnumber(L, extent_of(L, kVolume).volume);
  return 1;
}

int solid_area(lua_State* L) {
  lua_pushnumber(L, session_of(L).area(bare_solid(L, kArea)));
  return 1;
}

int shape_area(lua_State* L) {
  lua_pushnumber(L, bare_shape(L, kArea).area());
  return 1;
}

int solid_centroid(lua_State* L) {
  const auto centroid = session_of(L).centroid(bare_solid(L, kCentroid));
  fail_if_empty(!centroid, kCentroid);
  push_point(L, *centroid);
  return 1;
}

int shape_centroid(lua_State* L) {
  const Shape2D& shape = bare_shape(L, kCentroid);
  fail_if_empty(shape.empty(), kCentroid);
  // Relative to a corner of the bounding box, where the products stay small.
  const glm::dvec2 origin = shape.bounds()[0];
  double twice_area = 0;
  glm::dvec2 moment(0, 0);
  for (const auto& loop : shape.loops()) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const glm::dvec2 a = loop[i] - origin, b = loop[(i + 1) % loop.size()] - origin;
      const double cross = a.x * b.y - a.y * b.x;
      twice_area += cross;
      moment += cross * (a + b);
    }
  }
  push_point(L, origin + moment / (3 * twice_area));
  return 1;
}

int solid_components(lua_State* L) {
  lua_pushinteger(L, measures_of(L, kComponents, Measuring::kTopology).components);
  return 1;
}

int shape_components(lua_State* L) {
  lua_pushinteger(L, static_cast<lua_Integer>(bare_shape(L, kComponents).regions().size()));
  return 1;
}

int solid_genus(lua_State* L) {
  lua_pushinteger(L, measures_of(L, kGenus, Measuring::kTopology).genus);
  return 1;
}

/// Clockwise seen from outside and counted from 0: what polyhedron takes. In the canonical order.
int solid_mesh(lua_State* L) {
  const Solid& solid = session_of(L).evaluated(bare_solid(L, kMesh));
  lua_createtable(L, 0, 2);
  lua_createtable(L, static_cast<int>(solid.positions.size()), 0);
  for (size_t i = 0; i < solid.positions.size(); ++i) {
    const glm::dvec3& p = solid.positions[i];
    push_list(L, {p.x, p.y, p.z});
    lua_rawseti(L, -2, static_cast<lua_Integer>(i + 1));
  }
  lua_setfield(L, -2, "points");
  lua_createtable(L, static_cast<int>(solid.triangles.size()), 0);
  for (size_t i = 0; i < solid.triangles.size(); ++i) {
    lua_createtable(L, 3, 0);
    for (int k = 0; k < 3; ++k) {
      lua_pushinteger(L, solid.triangles[i][static_cast<size_t>(2 - k)]);
      lua_rawseti(L, -2, k + 1);
    }
    lua_rawseti(L, -2, static_cast<lua_Integer>(i + 1));
  }
  lua_setfield(L, -2, "faces");
  return 1;
}

int solid_is_empty(lua_State* L) {
  lua_pushboolean(L, extent_of(L, kIsEmpty).empty ? 1 : 0);
  return 1;
}

int shape_is_empty(lua_State* L) {
  lua_pushboolean(L, bare_shape(L, kIsEmpty).empty() ? 1 : 0);
  return 1;
}

int solid_contains(lua_State* L) {
  const SolidValue& value = solid_argument(L, kContains);
  const Arguments arguments(L, kContains, 2);
  const auto p = arguments.vector("p");
  if (!p || p->count != 3) fail_in(kContains, "needs a point of three numbers");
  Session& session = session_of(L);
  const EvaluationScope scope(session.budget());
  const auto side = session.evaluator().contains(value.node, p->v);
  if (!side) session.fail_evaluation(side.error());
  lua_pushboolean(L, *side >= 0 ? 1 : 0);
  return 1;
}

int shape_contains(lua_State* L) {
  const ShapeValue& value = shape_argument(L, kContains);
  const Arguments arguments(L, kContains, 2);
  const auto p = arguments.vector("p");
  if (!p || p->count != 2) fail_in(kContains, "needs a point of two numbers");
  lua_pushboolean(L, value.shape.contains(glm::dvec2(p->v.x, p->v.y)) ? 1 : 0);
  return 1;
}

constexpr Binding kMeasuresBindings[] = {
    {&kBbox, nullptr, guarded<solid_bbox<kBbox>>, guarded<shape_bbox<kBbox>>},
    {&kBounds, nullptr, guarded<solid_bbox<kBounds>>, guarded<shape_bbox<kBounds>>},
    {&kSize, nullptr, guarded<solid_size>, guarded<shape_size>},
    {&kVolume, nullptr, guarded<solid_volume>, nullptr},
    {&kArea, nullptr, guarded<solid_area>, guarded<shape_area>},
    {&kCentroid, nullptr, guarded<solid_centroid>, guarded<shape_centroid>},
    {&kComponents, nullptr, guarded<solid_components>, guarded<shape_components>},
    {&kGenus, nullptr, guarded<solid_genus>, nullptr},
    {&kIsEmpty, nullptr, guarded<solid_is_empty>, guarded<shape_is_empty>},
    {&kMesh, nullptr, guarded<solid_mesh>, nullptr},
    {&kContains, nullptr, guarded<solid_contains>, guarded<shape_contains>},
};

}  // namespace

std::span<const Binding> measure_bindings() { return kMeasuresBindings; }

void open_boxes(lua_State* L) {
  luaL_newmetatable(L, kBoxName);
  lua_pushcfunction(L, guarded<box_index>);
  lua_setfield(L, -2, "__index");
  lua_pushcfunction(L, guarded<box_text>);
  lua_setfield(L, -2, "__tostring");
  lua_pushboolean(L, 0);
  lua_setfield(L, -2, "__metatable");
  lua_pop(L, 1);
}

}  // namespace csgrun
