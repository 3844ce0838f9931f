// square, circle, regular_polygon, polygon, linear_extrude, rotate_extrude.
#include <algorithm>

#include <fmt/format.h>

#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/trig.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/operands.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr Option kSquareOptions[] = {
    {"size", T::kSize2, "1", "edge length, or lengths along X and Y", true, Range::kPositive},
    {"center", T::kBooleans2, "false", "centred in the origin, or along these axes", true},
    {"r", T::kNumber, "0", "radius of the corners", false, Range::kNotNegative},
};
constexpr FunctionSpec kSquare{"square",
                               "A rectangle; a corner lies in the origin unless it is centred.",
                               kSquareOptions, true, "square{20, 10, center = true, r = 2}"};

constexpr FunctionSpec kRect{"rect", "A rectangle: another name of square.", kSquareOptions, true,
                             "rect(20, 10)"};

template <const FunctionSpec& Spec>
int square(lua_State* L) {
  const Arguments arguments(L, Spec, 1);
  glm::dvec2 size(1, 1);
  if (const auto given = arguments.vector("size")) {
    size = given->count == 1 ? glm::dvec2(given->v.x) : glm::dvec2(given->v.x, given->v.y);
  }
  const auto center = arguments.booleans("center");
  const Facets facets = arguments.facets();
  const double r = arguments.number("r", 0);
  push_shape(
      L,
      value_or_fail(Spec, r > 0 ? make_rounded_square(size, r, facets, {center[0], center[1]})
                                : make_square(size, {center[0], center[1]})),
      {});
  return 1;
}

constexpr Option kCircleOptions[] = {
    {"r", T::kNumber, "1", "radius", true, Range::kPositive},
    {"d", T::kNumber, "", "diameter, instead of r", false, Range::kPositive},
};
constexpr FunctionSpec kCircle{"circle", "A disc about the origin.", kCircleOptions, true,
                               "circle(5, {fn = 48})"};

int circle(lua_State* L) {
  const Arguments arguments(L, kCircle, 1);
  if (arguments.has("r") && arguments.has("d"))
    fail_in(kCircle, "give either 'r' or 'd', not both");
  const double r = arguments.has("d") ? arguments.number("d", 0) / 2 : arguments.number("r", 1);
  push_shape(L, value_or_fail(kCircle, make_circle(r, arguments.facets())), {});
  return 1;
}

constexpr Option kRegularPolygonOptions[] = {
    {"n", T::kInteger, "", "number of corners, at least 3", true, Range::kPositive},
    {"r", T::kNumber, "1", "radius of the corners", true, Range::kPositive},
    {"d", T::kNumber, "", "twice that", false, Range::kPositive},
    {"side", T::kNumber, "", "length of a side, instead of r", false, Range::kPositive},
    {"across", T::kNumber, "",
     "twice the distance of a side from the centre, instead of r: the size of a spanner", false,
     Range::kPositive},
};
constexpr FunctionSpec kRegularPolygon{
    "regular_polygon", "A polygon of equal sides about the origin; its first corner lies on +X.",
    kRegularPolygonOptions, false, "regular_polygon(6, {across = 10})"};

int regular_polygon(lua_State* L) {
  const Arguments arguments(L, kRegularPolygon, 1);
  if (!arguments.has("n")) fail_in(kRegularPolygon, "needs the number of corners");
  const double n = arguments.number("n", 0);
  if (n < 3) fail_in(kRegularPolygon, fmt::format("option 'n' must be at least 3, got {}", n));
  int given = 0;
  for (const char* name : {"r", "d", "side", "across"}) given += arguments.has(name) ? 1 : 0;
  if (given > 1) fail_in(kRegularPolygon, "give only one of 'r', 'd', 'side' and 'across'");
  double r = arguments.number("r", 1);
  if (arguments.has("d")) r = arguments.number("d", 0) / 2;
  if (arguments.has("side")) r = arguments.number("side", 0) / (2 * sin_deg(180 / n));
  if (arguments.has("across")) r = arguments.number("across", 0) / (2 * cos_deg(180 / n));
  Facets facets;
  facets.fn = n;
  push_shape(L, value_or_fail(kRegularPolygon, make_circle(r, facets)), {});
  return 1;
}

constexpr Option kPolygonOptions[] = {
    {"points", T::kPoints2, "", "the corners; the first is point 0, in paths and messages", true},
    {"paths", T::kIndexLists, "one outline of all points",
     "outlines and holes, as indices of points from 0", true},
    kConvexityOption,
};
constexpr FunctionSpec kPolygon{"polygon",
                                "A shape of its own outlines, filled by the even-odd rule.",
                                kPolygonOptions, false, "polygon{{0, 0}, {20, 0}, {0, 10}}"};

int polygon(lua_State* L) {
  const Arguments arguments(L, kPolygon, 1);
  if (!arguments.has("points")) fail_in(kPolygon, "needs points");
  push_shape(L,
             value_or_fail(kPolygon, make_polygon(arguments.points2("points"),
                                                  arguments.index_lists("paths"))),
             {});
  return 1;
}

constexpr Option kLinearExtrudeOptions[] = {
    {"height", T::kNumber, "100, or the length of v",
     "height; or a vector {x, y, z}: where the shape is moved, as v alone says it", true,
     Range::kPositive, "h"},
    {"v", T::kVector3, "{0, 0, 1}", "direction", false},
    {"center", T::kBoolean, "false", "centred along the direction", false},
    {"twist", T::kNumber, "0", "turn over the whole height, clockwise seen from above, degrees",
     false},
    {"scale", T::kSize2, "1",
     "factor at the top, or factors along X and Y; 0 gives a point or an edge", false,
     Range::kNotNegative},
    {"round", T::kSize2, "0",
     "radius of the edges at the bottom and at the top, or {bottom, top}, mm: at most what the\n"
     "          widest place of each piece has room for",
     false, Range::kNotNegative},
    {"slices", T::kInteger, "from the facets", "number of layers", false, Range::kPositive},
    {"segments", T::kInteger, "from the facets", "number of pieces of the outline; 0: never split",
     false, Range::kNotNegative},
    kConvexityOption,
};
constexpr FunctionSpec kLinearExtrude{"linear_extrude",
                                      "A solid: the shape moved along Z (or v).",
                                      kLinearExtrudeOptions,
                                      true,
                                      "circle(5):linear_extrude(20, {twist = 90})",
                                      "shape",
                                      kShapeDoc};

bool is_vector(lua_State* L, int index) {
  bool good = lua_istable(L, index) && lua_rawlen(L, index) == 3;
  for (lua_Integer i = 1; good && i <= 3; ++i) {
    good = lua_rawgeti(L, index, i) == LUA_TNUMBER;
    lua_pop(L, 1);
  }
  return good;
}

/// Pushes the vector that stands where the height would, and says under which name; false when
/// there is none.
bool push_vector_for_height(lua_State* L, int table, const char*& name) {
  name = "";
  lua_pushvalue(L, table);
  if (is_vector(L, lua_gettop(L))) return true;
  lua_pop(L, 1);
  if (lua_rawlen(L, table) == 1 && lua_rawgeti(L, table, 1) == LUA_TTABLE)
    return is_vector(L, lua_gettop(L));
  for (const char* const height : {"height", "h"}) {
    name = height;
    lua_getfield(L, table, name);
    if (is_vector(L, lua_gettop(L))) return true;
  }
  return false;
}

/// A vector where the height stands is option v: linear_extrude(shape, {0, 3, 10}), {{0, 3, 10},
/// ...}, {height = {0, 3, 10}}. The arguments from stack index 2 on become one table of options
/// then.
void take_vector_for_height(lua_State* L) {
  constexpr int kGiven = 2;
  const int last = lua_gettop(L);
  if (last < kGiven || !lua_istable(L, kGiven)) return;
  const char* name = "";
  const bool found = push_vector_for_height(L, kGiven, name);
  const bool is_alone = found && lua_rawequal(L, -1, kGiven) != 0;
  const int options = is_alone && last > kGiven && lua_istable(L, last) ? last : kGiven;
  if (!found || last > (is_alone ? kGiven + 1 : kGiven)) {
    lua_settop(L, last);
    return;
  }
  const int vector = lua_gettop(L);
  lua_createtable(L, 0, 4);
  lua_createtable(L, 3, 0);
  for (lua_Integer i = 1; i <= 3; ++i) {
    lua_rawgeti(L, vector, i);
    lua_rawseti(L, -2, i);
  }
  lua_setfield(L, -2, "v");
  lua_pushnil(L);
  while (lua_next(L, options) != 0) {
    const std::string key = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : "";
    if (key == "v") fail_in(kLinearExtrude, "a vector as the height is option 'v', given as well");
    if (key.empty() || key == name) {
      lua_pop(L, 1);
      continue;
    }
    lua_setfield(L, -3, key.c_str());
  }
  lua_replace(L, kGiven);
  lua_settop(L, kGiven);
}

int linear_extrude_shape(lua_State* L) {
  const ShapeValue& shape = shape_argument(L, kLinearExtrude);
  take_vector_for_height(L);
  const Arguments arguments(L, kLinearExtrude, 2);
  LinearExtrudeOptions options;
  options.height_given = arguments.has("height");
  if (const auto v = arguments.vector("v")) {
    if (!(v->v.z > 0)) fail_in(kLinearExtrude, "option 'v' must point upwards (z positive)");
    options.direction = v->v;
    options.height = 1;
  }
  options.height = arguments.number("height", options.height);
  options.center = arguments.boolean("center", false);
  options.twist = arguments.number("twist", 0);
  if (const auto scale = arguments.vector("scale")) {
    options.scale = scale->count == 1 ? glm::dvec2(scale->v.x) : glm::dvec2(scale->v.x, scale->v.y);
  }
  if (arguments.has("slices")) options.slices = static_cast<int>(arguments.number("slices", 1));
  if (arguments.has("segments"))
    options.segments = static_cast<int>(arguments.number("segments", 0));
  if (const auto round = arguments.vector("round"))
    options.round = {round->v.x, round->count == 1 ? round->v.x : round->v.y};
  options.facets = arguments.facets();
  if (shape.shape.empty()) {
    push_solid(L, Node::empty(session_of(L).source_ref(L)));  // what a Boolean may well give
  } else {
    push_leaf(L, value_or_fail(kLinearExtrude, linear_extrude(shape.shape, options)),
              shape.appearance);
  }
  keep_marks(L, 1);
  return 1;
}

constexpr Option kRotateExtrudeOptions[] = {
    {"angle", T::kNumber, "360", "how far to turn, counter-clockwise seen from above, degrees",
     true, Range::kAny, "a"},
    {"start", T::kNumber, "0; 180 when no angle is given", "where to start, degrees from X", false},
    kConvexityOption,
};
constexpr FunctionSpec kRotateExtrude{
    "rotate_extrude",
    "A solid: the shape turned about Z, its Y upwards. It must lie on one side of Y.",
    kRotateExtrudeOptions,
    true,
    "circle(2):translate(10, 0):rotate_extrude()",
    "shape",
    kShapeDoc};

int rotate_extrude_shape(lua_State* L) {
  const ShapeValue& shape = shape_argument(L, kRotateExtrude);
  const Arguments arguments(L, kRotateExtrude, 2);
  RotateExtrudeOptions options;
  options.angle = arguments.number("angle", 360);
  if (options.angle == 0) fail_in(kRotateExtrude, "option 'angle' must not be 0");
  if (options.angle > 360 || options.angle <= -360) options.angle = 360;
  options.start = arguments.number("start", arguments.has("angle") ? 0 : 180);
  options.facets = arguments.facets();
  if (shape.shape.empty()) {
    push_solid(L, Node::empty(session_of(L).source_ref(L)));
  } else {
    const SourceRef where = session_of(L).source_ref(L);
    const auto counted = [L](PolygonMesh mesh) { return counted_leaf(L, std::move(mesh)); };
    NodePtr solid =
        value_or_fail(kRotateExtrude, rotate_extrude_solid(shape.shape, options, where, counted));
    if (shape.appearance) solid = Node::painted(*shape.appearance, solid, where);
    push_solid(L, std::move(solid));
  }
  keep_marks(L, 1);
  return 1;
}

constexpr Binding kShapesBindings[] = {
    {&kSquare, guarded<square<kSquare>>, nullptr, nullptr},
    {&kRect, guarded<square<kRect>>, nullptr, nullptr},
    {&kCircle, guarded<circle>, nullptr, nullptr},
    {&kRegularPolygon, guarded<regular_polygon>, nullptr, nullptr},
    {&kPolygon, guarded<polygon>, nullptr, nullptr},
    {&kLinearExtrude, guarded<linear_extrude_shape>, nullptr, guarded<linear_extrude_shape>},
    {&kRotateExtrude, guarded<rotate_extrude_shape>, nullptr, guarded<rotate_extrude_shape>},
};

}  // namespace

std::span<const Binding> shape_bindings() { return kShapesBindings; }

}  // namespace csgrun
