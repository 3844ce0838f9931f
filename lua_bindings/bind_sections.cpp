// Solids cut and taken apart: project, slice, split, trim, decompose.
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <csgrun/primitives/projection.h>
#include <csgrun/primitives/shape_operations.h>
#include <csgrun/primitives/solid_parts.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/operands.h"
#include "lua_bindings/repaint.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr const char* kSolidDoc = "the solid; as a method, solid:f(...), it is left out";

/// The value, or the failure of the evaluation.
template <class V>
V made_or_fail(Session& session, Result<V> result) {
  if (!result) session.fail_evaluation(result.error());
  return *std::move(result);
}

constexpr Option kProjectionOptions[] = {
    {"cut", T::kBoolean, "false", "the section at z = 0 instead of the shadow", true},
    kConvexityOption,
};
constexpr FunctionSpec kProjection{"projection",
                                   "The shadow of a solid on the plane z = 0, a 2D shape.",
                                   kProjectionOptions,
                                   false,
                                   "part:projection{cut = true}",
                                   "solid",
                                   kSolidDoc};
constexpr Option kProjectOptions[] = {
    {"direction", T::kVector3, "{0, 0, 1}",
     "where the shadow is looked at from, of any length: it falls on the plane across it through "
     "the "
     "origin,\n          with axes as slice has them",
     true, Range::kAny, "normal"},
};
constexpr FunctionSpec kProject{"project",
                                "The shadow of a solid on a plane, z = 0 by default, a 2D shape.",
                                kProjectOptions,
                                false,
                                "linear_extrude(part:project(), 2)",
                                "solid",
                                kSolidDoc};

/// The solid turned about the origin: a normal z onto Z, and upwards (of a plane that lies flat: Y)
/// onto Y.
NodePtr laid_flat(const NodePtr& solid, const glm::dvec3& z, const SourceRef& where) {
  const bool is_flat = z.x == 0 && z.y == 0;
  const glm::dvec3 up = is_flat ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
  const glm::dvec3 across = up - z * glm::dot(up, z);
  const glm::dvec3 y = is_flat ? up : across / std::sqrt(glm::dot(across, across));
  const glm::dvec3 x = glm::cross(y, z);
  Affine map;
  for (int i = 0; i < 3; ++i) {
    map.m[0][i] = x[i];
    map.m[1][i] = y[i];
    map.m[2][i] = z[i];
  }
  return Node::transformed(map, solid, where);
}

void push_shadow(lua_State* L, const FunctionSpec& spec, SolidValue& solid) {
  const Solid& evaluated = session_of(L).evaluated(solid);
  push_shape(L, value_or_fail(spec, project_solid(evaluated, solid.grid_mm)),
             one_appearance_of(solid.node));
}

void push_section(lua_State* L, const NodePtr& solid, const CutPlane& plane) {
  Session& session = session_of(L);
  const EvaluationScope scope(session.budget());
  // The same tree for all planes along one another.
  const bool is_level = plane.normal == glm::dvec3(0, 0, 1);
  const NodePtr laid = is_level ? solid : laid_flat(solid, plane.normal, session.source_ref(L));
  push_shape(L, made_or_fail(session, slice_solid(session.evaluator(), laid, plane.offset)),
             one_appearance_of(solid));
}

int projection(lua_State* L) {
  SolidValue& solid = final_solid_argument(L, kProjection);
  const Arguments arguments(L, kProjection, 2);
  if (arguments.boolean("cut", false)) {
    push_section(L, solid.node, CutPlane{});
  } else {
    push_shadow(L, kProjection, solid);
  }
  keep_marks(L, 1);
  return 1;
}

int project(lua_State* L) {
  SolidValue& solid = final_solid_argument(L, kProject);
  // One number is no direction, three of them are.
  if ((lua_type(L, 2) == LUA_TNUMBER && lua_type(L, 3) != LUA_TNUMBER) ||
      lua_type(L, 2) == LUA_TBOOLEAN)
    fail_in(kProject,
            "wants a direction {x, y, z}, got " + describe_value(L, 2) + "; slice(z) cuts");
  const Arguments arguments(L, kProject, 2);
  const auto direction = arguments.vector("direction");
  const CutPlane plane =
      value_or_fail(kProject, make_cut_plane(direction ? direction->v : glm::dvec3(0, 0, 1), 0));
  if (plane.normal == glm::dvec3(0, 0, 1)) {
    push_shadow(L, kProject, solid);
  } else {
    Session& session = session_of(L);
    const NodePtr laid = laid_flat(solid.node, plane.normal, session.source_ref(L));
    const SolidPtr turned = session.evaluate(laid);
    const double grid_mm = session.evaluator().stats().grid_mm;
    push_shape(L, value_or_fail(kProject, project_solid(*turned, grid_mm)),
               one_appearance_of(solid.node));
  }
  keep_marks(L, 1);
  return 1;
}

constexpr Option kPlaneOptions[] = {
    {"normal", T::kVector3, "{0, 0, 1}", "a direction across the plane, of any length", true},
    {"offset", T::kNumber, "0", "where the plane is: its distance from the origin along the normal",
     true},
    {"point", T::kVector3, "", "instead of the offset: a point of the plane", false},
};
constexpr FunctionSpec kSlicePlane{"slice", "", kPlaneOptions, false, ""};

CutPlane plane_argument(const Arguments& arguments, const FunctionSpec& spec) {
  const auto given = arguments.vector("normal");
  const glm::dvec3 normal = given ? given->v : glm::dvec3(0, 0, 1);
  const auto point = arguments.vector("point");
  if (point && arguments.has("offset")) {
    fail_in(spec, "give either 'offset' or 'point', not both");
  }
  return value_or_fail(spec, point ? make_cut_plane(normal, point->v)
                                   : make_cut_plane(normal, arguments.number("offset", 0)));
}

constexpr Option kSliceOptions[] = {
    {"z", T::kNumber, "0", "the height of the cut", true},
    {"normal", T::kVector3, "{0, 0, 1}",
     "instead of a height: a direction across the plane, of any length; slice({1, 0, 0}, 5) as "
     "well",
     false},
    {"offset", T::kNumber, "0", "where the plane is: its distance from the origin along the normal",
     false},
    {"point", T::kVector3, "", "instead of the offset: a point of the plane", false},
};
constexpr FunctionSpec kSlice{
    "slice",
    "What a plane cuts of a solid, a 2D shape, seen from where the normal points: its Y is upwards "
    "(Z; Y where the normal is along Z), its origin the point of the plane nearest to the origin. "
    "Where the solid has a face in the plane, what is in front of it counts.",
    kSliceOptions,
    false,
    "sphere(10):slice(5):area()",
    "solid",
    kSolidDoc};

/// slice({1, 0, 0}, 5): as split and trim are called.
bool is_called_with_normal(lua_State* L) {
  return lua_istable(L, 2) && lua_rawlen(L, 2) == 3 && list_length(L, 2) == 3;
}

/// What is said of a solid goes for its slices, but for its name: a solid has many of them.
void keep_marks_of_sliced(lua_State* L) {
  keep_marks(L, 1);
  marks_of(L, -1)->name.clear();
}

int slice(lua_State* L) {
  const SolidValue& solid = final_solid_argument(L, kSlice);
  if (is_called_with_normal(L)) {
    push_section(L, solid.node, plane_argument(Arguments(L, kSlicePlane, 2), kSlice));
    keep_marks_of_sliced(L);
    return 1;
  }
  const Arguments arguments(L, kSlice, 2);
  const CutPlane plane = plane_argument(arguments, kSlice);
  if (arguments.has("z") &&
      (arguments.has("normal") || arguments.has("offset") || arguments.has("point")))
    fail_in(kSlice, "give either the height 'z' or a plane, not both");
  push_section(L, solid.node,
               arguments.has("z")
                   ? value_or_fail(kSlice, make_cut_plane({0, 0, 1}, arguments.number("z", 0)))
                   : plane);
  keep_marks_of_sliced(L);
  return 1;
}

constexpr FunctionSpec kSplit{
    "split",
    "The two parts of a solid on either side of a plane: first what is in front of it, where the "
    "normal points, then what is behind. The cut has the colour of the solid (of its first leaf, "
    "where it has several). It lies in the plane exactly where the normal is a multiple of small "
    "whole numbers and the point one of the grid.",
    kPlaneOptions,
    false,
    "local top, bottom = part:split({0, 0, 1}, 5)",
    "solid",
    kSolidDoc};
constexpr FunctionSpec kTrim{"trim",
                             "What of a solid is in front of a plane, where the normal points; as "
                             "split.",
                             kPlaneOptions,
                             false,
                             "part:trim{normal = {1, 0, 1}, point = {0, 0, 5}}",
                             "solid",
                             kSolidDoc};

template <const FunctionSpec& Spec, bool kBoth>
int cut(lua_State* L) {
  const NodePtr solid = solid_argument(L, Spec).node;
  const Arguments arguments(L, Spec, 2);
  const CutPlane plane = plane_argument(arguments, Spec);
  Session& session = session_of(L);
  const SourceRef where = session.source_ref(L);
  NodePtr front;
  {
    const EvaluationScope scope(session.budget());
    front = made_or_fail(session, half_space(session.evaluator(), solid, plane, where));
  }
  // Nobody gave the half-space a colour.
  const Appearance body = first_appearance(solid);
  if (!body.is_default) front = Node::painted(body, front, where);
  // One part may be what was named; two are not.
  const auto push_part = [&](BooleanOp op) {
    push_solid(L, Node::boolean(op, {solid, front}, where));
    keep_marks(L, 1);
    if (kBoth) marks_of(L, -1)->name.clear();
  };
  push_part(BooleanOp::kIntersection);
  if (!kBoth) return 1;
  push_part(BooleanOp::kDifference);
  return 2;
}

constexpr FunctionSpec kDecompose{
    "decompose",
    "A list of the connected solids, or shapes, of which it consists.",
    {},
    false,
    "for i, piece in ipairs(part:decompose()) do print(piece) end",
    "part",
    "a solid or a shape; part:decompose() leaves it out"};

int decompose(lua_State* L) {
  part_argument(L, kDecompose);
  const ShapeValue* shape = to_shape(L, 1);
  if (lua_gettop(L) > 1) fail_in(kDecompose, "takes no arguments");
  lua_Integer count = 0;
  if (shape != nullptr) {
    lua_newtable(L);
    for (Shape2D& piece : pieces_of_shape(shape->shape)) {
      push_shape(L, std::move(piece), shape->appearance);
      lua_rawseti(L, -2, ++count);
    }
    return 1;
  }
  const NodePtr solid = to_solid(L, 1)->node;
  Session& session = session_of(L);
  Components pieces;
  {
    const EvaluationScope scope(session.budget());
    pieces =
        made_or_fail(session, decompose_solid(session.evaluator(), solid, session.source_ref(L)));
  }
  lua_newtable(L);
  if (pieces.rounded_corners > 0) {
    session.warn(L, fmt::format("decompose: {} corners of components that no boxes part lie off "
                                "the grid and are rounded to it",
                                pieces.rounded_corners));
  }
  for (NodePtr& piece : pieces.parts) {
    push_solid(L, std::move(piece));
    lua_rawseti(L, -2, ++count);
  }
  return 1;
}

constexpr Binding kSectionsBindings[] = {
    {&kProjection, guarded<projection>, guarded<projection>, nullptr},
    {&kProject, guarded<project>, guarded<project>, nullptr},
    {&kSlice, guarded<slice>, guarded<slice>, nullptr},
    {&kSplit, guarded<cut<kSplit, true>>, guarded<cut<kSplit, true>>, nullptr},
    {&kTrim, guarded<cut<kTrim, false>>, guarded<cut<kTrim, false>>, nullptr},
    {&kDecompose, guarded<decompose>, guarded<decompose>, guarded<decompose>},
};

}  // namespace

std::span<const Binding> section_bindings() { return kSectionsBindings; }

}  // namespace csgrun
