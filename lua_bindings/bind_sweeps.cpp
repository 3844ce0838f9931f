// sweep, loft, roof.
#include <fmt/format.h>

#include <csgrun/primitives/roof.h>
#include <csgrun/primitives/sweep.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/operands.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr Option kSweepOptions[] = {
    {"path", T::kPoints3, "", "the points that it goes along", true},
    {"closed", T::kBoolean, "false", "joins the last point to the first", false},
    {"twist", T::kNumber, "0",
     "turn over the whole path, counter-clockwise seen against it, degrees", false},
    {"scale", T::kSize2, "1",
     "factor at the end, or factors along X and Y of the shape; 0 comes to a point", false,
     Range::kNotNegative},
    {"up", T::kVector3, "{0, 0, 1}; {0, 1, 0} where the path starts along Z",
     "where the shape's Y points to at the start", false},
    {"upright", T::kBoolean, "false",
     "Y points there along the whole path, as far as that is across it: for a spring or a ramp",
     false},
};
constexpr FunctionSpec kSweep{
    "sweep",
    "A solid: the shape, across the path, moved along it; it turns with the path and no more, or "
    "stays upright.",
    kSweepOptions,
    true,
    "circle(2):sweep{{0, 0, 0}, {0, 0, 20}, {15, 0, 30}}",
    "shape",
    kShapeDoc};

int sweep(lua_State* L) {
  const ShapeValue& shape = shape_argument(L, kSweep);
  const Arguments arguments(L, kSweep, 2);
  if (!arguments.has("path")) fail_in(kSweep, "needs a path, a list of points {x, y, z}");
  SweepOptions options;
  options.path = arguments.points3("path");
  options.closed = arguments.boolean("closed", false);
  // A path that comes home ends in two caps on each other where a ring was meant.
  if (!options.closed && options.path.size() > 3 && options.path.front() == options.path.back())
    session_of(L).warn(L, "sweep: the path ends where it begins; closed = true joins the ends");
  options.twist = arguments.number("twist", 0);
  if (const auto scale = arguments.vector("scale")) {
    options.scale = scale->count == 1 ? glm::dvec2(scale->v.x) : glm::dvec2(scale->v.x, scale->v.y);
  }
  if (const auto up = arguments.vector("up")) {
    if (up->v == glm::dvec3(0, 0, 0)) fail_in(kSweep, "option 'up' must not be 0");
    options.up = up->v;
  }
  options.upright = arguments.boolean("upright", false);
  options.facets = arguments.facets();
  if (shape.shape.empty()) {
    push_solid(L, Node::empty(session_of(L).source_ref(L)));
  } else {
    const SourceRef where = session_of(L).source_ref(L);
    const auto counted = [L](PolygonMesh mesh) { return counted_leaf(L, std::move(mesh)); };
    NodePtr solid = value_or_fail(kSweep, sweep_solid(shape.shape, options, where, counted));
    if (shape.appearance) solid = Node::painted(*shape.appearance, solid, where);
    push_solid(L, std::move(solid));
  }
  keep_marks(L, 1);
  return 1;
}

constexpr Option kLoftOptions[] = {
    {"outlines", T::kValue, "",
     "a list of shapes, from the lowest on; the first or the last may be a point {x, y}", true},
    {"heights", T::kValue, "", "where each lies along Z, a list; or one number: all in even steps",
     true, Range::kAny, "height"},
};
constexpr FunctionSpec kLoft{
    "loft",
    "A solid between shapes, each flat at its height, with straight walls from one to the next.",
    kLoftOptions, false, "loft({square(20, true), circle(6)}, {0, 15})"};

/// A list of two numbers.
std::optional<glm::dvec2> point_of_list(lua_State* L, int index) {
  if (!lua_istable(L, index) || list_length(L, index) != 2) return std::nullopt;
  glm::dvec2 point(0);
  bool good = true;
  for (int i = 0; i < 2; ++i) {
    good = lua_rawgeti(L, index, i + 1) == LUA_TNUMBER && good;
    point[i] = lua_tonumber(L, -1);
    lua_pop(L, 1);
  }
  return good ? std::optional(point) : std::nullopt;
}

int loft(lua_State* L) {
  if (to_shape(L, 1) != nullptr)
    fail_in(kLoft, "its outlines are one list, and their heights follow: loft({a, b}, 10)");
  name_list_part(L, "outlines");
  const Arguments arguments(L, kLoft, 1);
  const int outlines = arguments.stack_index("outlines"), given = arguments.stack_index("heights");
  if (outlines == 0 || given == 0) fail_in(kLoft, "needs a list of shapes and their heights");
  const lua_Integer count = lua_istable(L, outlines) ? list_length(L, outlines) : -1;
  if (count < 2) {
    fail_in(kLoft, "option 'outlines' must be a list of two or more shapes, got " +
                       describe_value(L, outlines));
  }
  std::vector<LoftOutline> shapes;
  std::optional<Appearance> appearance;
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_rawgeti(L, outlines, i);
    const ShapeValue* shape = to_shape(L, -1);
    if (const auto point = point_of_list(L, lua_gettop(L))) {
      shapes.emplace_back(*point);
    } else if (shape == nullptr) {
      fail_in(kLoft, fmt::format("outline {} must be a 2D shape or a point {{x, y}}, got {}", i,
                                 describe_value(L, -1)));
    } else {
      if (shapes.empty() || (i == 2 && shapes[0].point)) appearance = shape->appearance;
      shapes.emplace_back(shape->shape);
    }
    lua_pop(L, 1);
  }
  std::vector<double> heights;
  if (lua_type(L, given) == LUA_TNUMBER) {
    const double height = lua_tonumber(L, given);
    if (!(height > 0))
      fail_in(kLoft, "option 'heights' must be positive, got " + describe_value(L, given));
    for (lua_Integer i = 0; i < count; ++i)
      heights.push_back(height * static_cast<double>(i) / static_cast<double>(count - 1));
  } else {
    const lua_Integer length = lua_istable(L, given) ? list_length(L, given) : -1;
    if (length < 0) {
      fail_in(kLoft, "option 'heights' must be a number or a list of numbers, got " +
                         describe_value(L, given));
    }
    for (lua_Integer i = 1; i <= length; ++i) {
      if (lua_rawgeti(L, given, i) != LUA_TNUMBER) {
        fail_in(kLoft, fmt::format("height {} must be a number, got {}", i, describe_value(L, -1)));
      }
      heights.push_back(lua_tonumber(L, -1));
      lua_pop(L, 1);
    }
  }
  push_leaf(L, value_or_fail(kLoft, loft_shapes(shapes, heights)), appearance);
  return 1;
}

constexpr Option kRoofOptions[] = {
    {"method", T::kString, "\"voronoi\"",
     "\"voronoi\": as high as the outline is far, with cones around corners that point inwards; or "
     "\"straight\": planes only",
     true},
    kConvexityOption,
};
constexpr FunctionSpec kRoof{
    "roof",
    "A solid: a roof over the shape, with planes that rise inwards from its edges at 45 degrees.",
    kRoofOptions,
    true,
    "square(30, 20):roof()",
    "shape",
    kShapeDoc};

int roof(lua_State* L) {
  const ShapeValue& shape = shape_argument(L, kRoof);
  const Arguments arguments(L, kRoof, 2);
  RoofOptions options;
  const std::string method = arguments.string("method", "voronoi");
  if (method != "voronoi" && method != "straight") {
    fail_in(kRoof,
            fmt::format("option 'method' must be \"voronoi\" or \"straight\", got \"{}\"", method));
  }
  if (method == "straight") options.method = RoofMethod::kStraight;
  options.facets = arguments.facets();
  if (shape.shape.empty()) {
    push_solid(L, Node::empty(session_of(L).source_ref(L)));
  } else {
    push_leaf(L, value_or_fail(kRoof, make_roof(shape.shape, options)), shape.appearance);
  }
  keep_marks(L, 1);
  return 1;
}

constexpr Binding kSweepsBindings[] = {
    {&kSweep, guarded<sweep>, nullptr, guarded<sweep>},
    {&kLoft, guarded<loft>, nullptr, nullptr},
    {&kRoof, guarded<roof>, nullptr, guarded<roof>},
};

}  // namespace

std::span<const Binding> sweep_bindings() { return kSweepsBindings; }

}  // namespace csgrun
