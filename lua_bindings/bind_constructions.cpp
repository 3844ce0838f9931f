// What is made of whole solids or shapes: hull, minkowski, resize.
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include <csgrun/primitives/shape_operations.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/operands.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr Option kConstructionOptions[] = {
    {"operands", T::kValue, "", "solids or shapes, one after another or as lists", true},
};
constexpr Option kHullOptions[] = {
    {"operands", T::kValue, "",
     "solids or shapes, one after another or as lists; or a list of points {x, y, z} (a solid) or "
     "{x, y}\n          (a shape)",
     true},
};
constexpr FunctionSpec kHull{"hull", "The least convex solid or shape that contains all of them.",
                             kHullOptions, false, "hull(sphere(4), cube(2):up(10))"};
constexpr FunctionSpec kMinkowski{
    "minkowski",
    "All sums of a point of each: the first, swept by the others. Empty ones count for nothing.",
    kConstructionOptions, false, "minkowski{cube{20, 20, 5}, sphere(1)}"};

template <const FunctionSpec& Spec, NodePtr (*OfSolids)(std::vector<NodePtr>, SourceRef),
          Result<Shape2D> (*OfShapes)(const std::vector<Shape2D>&)>
int combine(lua_State* L) {
  Operands operands = read_operands(L, Spec);
  operands.warn_of_colours(L, Spec.name);
  if (operands.has_shapes) {
    if (!operands.push_only_shapes(L, Spec.name))
      push_shape(L, value_or_fail(Spec, OfShapes(operands.shapes)), operands.appearance);
  } else if (operands.has_solids) {
    push_solid(L, OfSolids(std::move(operands.solids), session_of(L).source_ref(L)));
  } else {
    fail_in(Spec, "needs a solid or a shape");
  }
  marks_of(L, -1)->name = operands.name;
  return 1;
}

/// Whether the only argument is a list of lists of numbers: of points.
bool is_list_of_points(lua_State* L) {
  if (lua_gettop(L) != 1 || !lua_istable(L, 1)) return false;
  const bool is_point = lua_rawgeti(L, 1, 1) == LUA_TTABLE && lua_rawgeti(L, -1, 1) == LUA_TNUMBER;
  lua_settop(L, 1);
  return is_point;
}

/// The points of the list at index 1, all with as many numbers as the first.
std::vector<glm::dvec3> hull_points(lua_State* L, lua_Integer& numbers) {
  const lua_Integer count = list_length(L, 1);
  if (count < 0) fail_in(kHull, "takes lists of points without holes and names in them");
  std::vector<glm::dvec3> points;
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_rawgeti(L, 1, i);
    const lua_Integer length = lua_istable(L, -1) ? list_length(L, -1) : -1;
    if (i == 1) numbers = length == 2 ? 2 : 3;
    bool good = length == numbers;
    glm::dvec3 p(0);
    for (int k = 0; good && k < length; ++k) {
      good = lua_rawgeti(L, -1, k + 1) == LUA_TNUMBER && std::isfinite(lua_tonumber(L, -1));
      p[k] = lua_tonumber(L, -1);
      lua_pop(L, 1);
    }
    if (!good) {
      fail_in(kHull, fmt::format("point {} must be {} finite numbers{}, got {}", i,
                                 numbers == 2 ? "two" : "three", i == 1 ? "" : " as the first",
                                 describe_value(L, -1)));
    }
    points.push_back(p);
    lua_pop(L, 1);
  }
  return points;
}

int hull(lua_State* L) {
  if (!is_list_of_points(L)) return combine<kHull, Node::convex_hull, hull_of_shapes>(L);
  lua_Integer numbers = 3;
  const std::vector<glm::dvec3> points = hull_points(L, numbers);
  if (numbers == 2) {
    const std::vector<glm::dvec2> flat(points.begin(), points.end());
    Shape2D shape = value_or_fail(kHull, hull_of_points(flat));
    if (shape.empty()) fail_in(kHull, "the points lie on one line");
    push_shape(L, std::move(shape), {});
    return 1;
  }
  PolygonMesh mesh;
  mesh.kind = "hull";
  mesh.hull_of_points = true;
  mesh.points = points;
  push_leaf(L, std::move(mesh));
  if (session_of(L).extent(*to_solid(L, -1)).empty) fail_in(kHull, "the points lie in one plane");
  return 1;
}

constexpr Option kResizeOptions[] = {
    {"newsize", T::kVector2Or3, "",
     "lengths along X, Y and (of a solid) Z; 0 leaves that axis as it is", true,
     Range::kNotNegative, "size"},
    {"auto", T::kBooleans2Or3, "false",
     "whether axes of length 0 take the factor of the longest one that is given; or which do",
     true},
};
constexpr FunctionSpec kResize{"resize",
                               "Scales about the origin until the bounding box has these lengths.",
                               kResizeOptions,
                               false,
                               "part:resize({20, 0, 0}, {auto = true})",
                               "part",
                               "a solid or a shape; part:resize(...) leaves it out"};

void resize_shape(lua_State* L, const ShapeValue& shape, const glm::dvec3& size,
                  const std::array<bool, 3>& automatic) {
  if (shape.shape.empty()) {
    push_shape(L, shape.shape, shape.appearance);
    return;
  }
  const auto [low, high] = shape.shape.bounds();
  const auto factors = resize_factors<2>({high.x - low.x, high.y - low.y}, {size.x, size.y},
                                         {automatic[0], automatic[1]});
  Affine map;
  map.m[0][0] = factors[0];
  map.m[1][1] = factors[1];
  push_shape(L, value_or_fail(kResize, shape.shape.transformed(map)), shape.appearance);
}

int resize(lua_State* L) {
  part_argument(L, kResize);
  const ShapeValue* shape = to_shape(L, 1);
  const SolidValue* solid = to_solid(L, 1);
  const Arguments arguments(L, kResize, 2);
  const auto wanted = arguments.vector("newsize");
  if (!wanted) fail_in(kResize, "needs the new lengths: (20, 10), or 0 where nothing changes");
  const std::array<bool, 3> automatic = arguments.booleans("auto");
  if (shape != nullptr) {
    resize_shape(L, *shape, wanted->v, automatic);
  } else {
    const Resize resize{{wanted->v.x, wanted->v.y, wanted->v.z}, automatic};
    push_solid(L, Node::resized(resize, solid->node, session_of(L).source_ref(L)));
  }
  keep_marks(L, 1);
  return 1;
}

constexpr lua_CFunction kHullFunction = guarded<hull>;
constexpr lua_CFunction kMinkowskiFunction =
    guarded<combine<kMinkowski, Node::minkowski_sum, minkowski_of_shapes>>;

constexpr Binding kConstructionsBindings[] = {
    {&kHull, kHullFunction, kHullFunction, kHullFunction},
    {&kMinkowski, kMinkowskiFunction, kMinkowskiFunction, kMinkowskiFunction},
    {&kResize, guarded<resize>, guarded<resize>, guarded<resize>},
};

}  // namespace

std::span<const Binding> construction_bindings() { return kConstructionsBindings; }

}  // namespace csgrun
