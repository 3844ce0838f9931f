// What makes new outlines of shapes, and what reads them: offset, fill, perimeter,
// points, paths, outlines.
#include <cmath>

#include <fmt/format.h>

#include <csgrun/primitives/freeform.h>
#include <csgrun/primitives/shape_operations.h>
#include <csgrun/primitives/solid_parts.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/operands.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr Option kOffsetOptions[] = {
    {"r", T::kNumber, "1",
     "distance, outwards (negative: inwards), with round corners: of a solid by a ball", true},
    {"delta", T::kNumber, "",
     "distance with sharp corners (of a solid by a box along the axes); r counts if both are given",
     false},
    {"chamfer", T::kBoolean, "false", "with delta: corners are cut square at that distance", false},
};
constexpr FunctionSpec kOffset{
    "offset",
    "The shape with its outline moved; or the solid with its surface moved.",
    kOffsetOptions,
    true,
    "square(10):offset{delta = 2, chamfer = true}",
    "shape",
    kShapeDoc};

/// A solid grown, or shrunk, by a ball or a box.
int offset_of_solid(lua_State* L, const SolidValue& solid) {
  const Arguments arguments(L, kOffset, 2);
  if (arguments.has("chamfer")) fail_in(kOffset, "option 'chamfer' is for shapes");
  const bool sharp = arguments.has("delta") && !arguments.has("r");
  const double distance = arguments.number(sharp ? "delta" : "r", 1);
  const double reach = std::fabs(distance);
  if (reach == 0) {
    push_solid(L, solid.node);
  } else {
    const glm::dvec3 size(2 * reach);
    const NodePtr tool = counted_leaf(
        L, value_or_fail(kOffset, sharp ? make_cube(size, {true, true, true})
                                        : make_rounded_cube(size, reach, {true, true, true},
                                                            arguments.facets())));
    Session& session = session_of(L);
    const EvaluationScope scope(session.budget());
    auto moved = offset_solid(session.evaluator(), solid.node, tool, distance);
    if (!moved) session.fail_evaluation(moved.error());
    push_solid(L, *std::move(moved));
  }
  keep_marks(L, 1);
  return 1;
}

int offset(lua_State* L) {
  bring_subject_to_front(L);
  if (const SolidValue* solid = to_solid(L, 1)) return offset_of_solid(L, *solid);
  const ShapeValue& shape = shape_argument(L, kOffset);
  const Arguments arguments(L, kOffset, 2);
  OffsetOptions options;
  options.facets = arguments.facets();
  const bool sharp = arguments.has("delta") && !arguments.has("r");
  options.distance = arguments.number(sharp ? "delta" : "r", 1);
  if (sharp) {
    options.join = arguments.boolean("chamfer", false) ? OffsetJoin::kChamfer : OffsetJoin::kMitre;
  } else if (arguments.has("chamfer") && !arguments.has("delta")) {
    fail_in(kOffset, "option 'chamfer' goes with 'delta', not with 'r'");
  }
  push_shape(L, value_or_fail(kOffset, offset_shape(shape.shape, options)), shape.appearance);
  keep_marks(L, 1);
  return 1;
}

constexpr FunctionSpec kFill{"fill",   "The shape without its holes.",   {},
                             false,    "(circle(5) - circle(3)):fill()", "shape",
                             kShapeDoc};

int fill(lua_State* L) {
  const ShapeValue& shape = shape_argument(L, kFill);
  const Arguments arguments(L, kFill, 2);
  push_shape(L, value_or_fail(kFill, fill_shape(shape.shape)), shape.appearance);
  keep_marks(L, 1);
  return 1;
}

const ShapeValue& bare_shape(lua_State* L, const FunctionSpec& spec) {
  const ShapeValue& value = shape_argument(L, spec);
  if (lua_gettop(L) > 1) fail_in(spec, "takes no arguments");
  return value;
}

constexpr FunctionSpec kPerimeter{
    "perimeter", "The length of all outlines, holes included.", {}, false, "circle(5):perimeter()"};
constexpr FunctionSpec kPoints{"points",
                               "The corners {{x, y}, ...}, as polygon takes them.",
                               {},
                               false,
                               "polygon(shape:points(), shape:paths())"};
constexpr FunctionSpec kPaths{
    "paths",
    "The outlines, by indices of points() from 0: outer ones counter-clockwise, holes clockwise.",
    {},
    false,
    "square(5):paths()"};
constexpr FunctionSpec kOutlines{"outlines",
                                 "The outlines as lists of points {x, y}, in the order of paths().",
                                 {},
                                 false,
                                 "square(5):outlines()"};

int perimeter(lua_State* L) {
  lua_pushnumber(L, perimeter_of(bare_shape(L, kPerimeter).shape));
  return 1;
}

int points(lua_State* L) {
  const Shape2D& shape = bare_shape(L, kPoints).shape;
  lua_newtable(L);
  lua_Integer count = 0;
  for (const Shape2D::Loop& loop : shape.loops()) {
    for (const glm::dvec2& p : loop) {
      push_list(L, {p.x, p.y});
      lua_rawseti(L, -2, ++count);
    }
  }
  return 1;
}

/// A list of one list for each loop; push(point, index of the point in all) pushes an entry.
template <class Push>
int push_loops(lua_State* L, const Shape2D& shape, Push push) {
  lua_createtable(L, static_cast<int>(shape.loops().size()), 0);
  lua_Integer index = 0, loops = 0;
  for (const Shape2D::Loop& loop : shape.loops()) {
    lua_createtable(L, static_cast<int>(loop.size()), 0);
    for (size_t i = 0; i < loop.size(); ++i) {
      push(loop[i], index++);
      lua_rawseti(L, -2, static_cast<lua_Integer>(i + 1));
    }
    lua_rawseti(L, -2, ++loops);
  }
  return 1;
}

int paths(lua_State* L) {
  return push_loops(L, bare_shape(L, kPaths).shape,
                    [L](const glm::dvec2&, lua_Integer index) { lua_pushinteger(L, index); });
}

int outlines(lua_State* L) {
  return push_loops(L, bare_shape(L, kOutlines).shape, [L](const glm::dvec2& p, lua_Integer) {
    push_list(L, {p.x, p.y});
  });
}

constexpr Binding kOutlinesBindings[] = {
    {&kOffset, guarded<offset>, guarded<offset>, guarded<offset>},
    {&kFill, guarded<fill>, nullptr, guarded<fill>},
    {&kPerimeter, nullptr, nullptr, guarded<perimeter>},
    {&kPoints, nullptr, nullptr, guarded<points>},
    {&kPaths, nullptr, nullptr, guarded<paths>},
    {&kOutlines, nullptr, nullptr, guarded<outlines>},
};

}  // namespace

std::span<const Binding> outline_bindings() { return kOutlinesBindings; }

}  // namespace csgrun
