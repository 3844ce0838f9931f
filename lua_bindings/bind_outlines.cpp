// What makes new outlines of shapes, and what reads them: offset, hull, minkowski, fill, resize,
// perimeter, points, paths, outlines, decompose.
#include <fmt/format.h>

#include <csgrun/primitives/shape_operations.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/operands.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr Option kOffsetOptions[] = {
    {"r", T::kNumber, "1", "distance, outwards (negative: inwards), with round corners", true},
    {"delta", T::kNumber, "", "distance with sharp corners; r counts if both are given", false},
    {"chamfer", T::kBoolean, "false", "with delta: corners are cut square at that distance", false},
};
constexpr FunctionSpec kOffset{"offset",
                               "The shape with its outline moved.",
                               kOffsetOptions,
                               true,
                               "square(10):offset{delta = 2, chamfer = true}",
                               "shape",
                               kShapeDoc};

int offset(lua_State* L) {
  take_subject_out_of_list(L);
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
  return 1;
}

constexpr Option kShapesOptions[] = {
    {"operands", T::kValue, "", "shapes, one after another or as lists", true},
};
constexpr FunctionSpec kHull{"hull", "The smallest convex shape that contains all of them.",
                             kShapesOptions, false, "hull(circle(2), circle(4):translate(20, 0))"};
constexpr FunctionSpec kMinkowski{
    "minkowski",
    "All sums of a point of each: the first, swept by the others. Empty ones count for nothing.",
    kShapesOptions, false, "minkowski(square(10), circle(1))"};

template <const FunctionSpec& Spec, Result<Shape2D> (*Make)(const std::vector<Shape2D>&)>
int combine_shapes(lua_State* L) {
  const Operands operands = read_operands(L, Spec);
  if (operands.shapes.empty() && operands.solids.empty()) fail_in(Spec, "needs a shape");
  if (!operands.solids.empty()) fail_in(Spec, "an operand must be a 2D shape, got solid");
  push_shape(L, value_or_fail(Spec, Make(operands.shapes)), operands.appearance);
  return 1;
}

constexpr FunctionSpec kFill{"fill",   "The shape without its holes.",   {},
                             false,    "(circle(5) - circle(3)):fill()", "shape",
                             kShapeDoc};

int fill(lua_State* L) {
  take_subject_out_of_list(L);
  const ShapeValue& shape = shape_argument(L, kFill);
  const Arguments arguments(L, kFill, 2);
  push_shape(L, value_or_fail(kFill, fill_shape(shape.shape)), shape.appearance);
  return 1;
}

constexpr Option kResizeOptions[] = {
    {"newsize", T::kVector2Or3, "", "lengths along X and Y; 0 leaves that axis as it is", true,
     Range::kNotNegative, "size"},
    {"auto", T::kBooleans2, "false",
     "axes of length 0 take the factor of the longest one that is given", true},
};
constexpr FunctionSpec kResize{"resize",
                               "Scales about the origin until the bounding box has these lengths.",
                               kResizeOptions,
                               false,
                               "circle(5):resize({20, 0}, {auto = true})",
                               "shape",
                               kShapeDoc};

int resize(lua_State* L) {
  take_subject_out_of_list(L);
  const ShapeValue& shape = shape_argument(L, kResize);
  const Arguments arguments(L, kResize, 2);
  const auto wanted = arguments.vector("newsize");
  if (!wanted) fail_in(kResize, "needs the new lengths: (20, 10), or 0 where nothing changes");
  if (shape.shape.empty()) {
    push_shape(L, shape.shape, shape.appearance);
    return 1;
  }
  const auto automatic = arguments.booleans("auto");
  const auto [low, high] = shape.shape.bounds();
  const auto factors = resize_factors({high.x - low.x, high.y - low.y}, {wanted->v.x, wanted->v.y},
                                      {automatic[0], automatic[1]});
  Affine map;
  map.m[0][0] = factors[0];
  map.m[1][1] = factors[1];
  push_shape(L, value_or_fail(kResize, shape.shape.transformed(map)), shape.appearance);
  return 1;
}

const ShapeValue& bare_shape(lua_State* L, const FunctionSpec& spec) {
  const ShapeValue& value = shape_argument(L, spec);
  if (lua_gettop(L) > 1) fail_in(spec, "takes no arguments");
  return value;
}

constexpr FunctionSpec kPerimeter{"perimeter", "The length of all outlines, holes included.", {}};
constexpr FunctionSpec kPoints{"points",
                               "The corners {{x, y}, ...}, as polygon takes them.",
                               {},
                               false,
                               "polygon(shape:points(), shape:paths())"};
constexpr FunctionSpec kPaths{
    "paths",
    "The outlines, by indices of points() from 0: outer ones counter-clockwise, holes clockwise.",
    {}};
constexpr FunctionSpec kOutlines{
    "outlines", "The outlines as lists of points {x, y}, in the order of paths().", {}};
constexpr FunctionSpec kDecompose{
    "decompose", "Its connected pieces, a list.", {}, false, "#shape:decompose()"};

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

int decompose(lua_State* L) {
  const ShapeValue& value = bare_shape(L, kDecompose);
  lua_newtable(L);
  lua_Integer count = 0;
  for (Shape2D& piece : pieces_of_shape(value.shape)) {
    push_shape(L, std::move(piece), value.appearance);
    lua_rawseti(L, -2, ++count);
  }
  return 1;
}

constexpr Binding kBindings[] = {
    {&kOffset, guarded<offset>, nullptr, guarded<offset>},
    {&kHull, guarded<combine_shapes<kHull, hull_of_shapes>>, nullptr,
     guarded<combine_shapes<kHull, hull_of_shapes>>},
    {&kMinkowski, guarded<combine_shapes<kMinkowski, minkowski_of_shapes>>, nullptr,
     guarded<combine_shapes<kMinkowski, minkowski_of_shapes>>},
    {&kFill, guarded<fill>, nullptr, guarded<fill>},
    {&kResize, guarded<resize>, nullptr, guarded<resize>},
    {&kPerimeter, nullptr, nullptr, guarded<perimeter>},
    {&kPoints, nullptr, nullptr, guarded<points>},
    {&kPaths, nullptr, nullptr, guarded<paths>},
    {&kOutlines, nullptr, nullptr, guarded<outlines>},
    {&kDecompose, nullptr, nullptr, guarded<decompose>},
};

}  // namespace

std::span<const Binding> outline_bindings() { return kBindings; }

}  // namespace csgrun
