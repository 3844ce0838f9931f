// Solids cut and taken apart: project, slice, split, trim, decompose.
#include <cmath>

#include <glm/geometric.hpp>

#include <csgrun/primitives/projection.h>
#include <csgrun/primitives/shape_operations.h>
#include <csgrun/primitives/solid_parts.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/operands.h"
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
constexpr FunctionSpec kProject{"project",
                                "The shadow of a solid on the plane z = 0, a 2D shape.",
                                {},
                                false,
                                "linear_extrude(part:project(), 2)",
                                "solid",
                                kSolidDoc};

void push_shadow(lua_State* L, const FunctionSpec& spec, SolidValue& solid) {
  push_shape(L, value_or_fail(spec, project_solid(session_of(L).evaluated(solid))),
             one_appearance_of(solid.node));
}

void push_section(lua_State* L, const NodePtr& solid, double z) {
  Session& session = session_of(L);
  const EvaluationScope scope(session.budget());
  push_shape(
      L, made_or_fail(session, slice_solid(session.evaluator(), solid, z, session.source_ref(L))),
      one_appearance_of(solid));
}

int projection(lua_State* L) {
  take_subject_out_of_list(L);
  SolidValue& solid = solid_argument(L, kProjection);
  const Arguments arguments(L, kProjection, 2);
  if (arguments.boolean("cut", false)) {
    push_section(L, solid.node, 0);
  } else {
    push_shadow(L, kProjection, solid);
  }
  return 1;
}

int project(lua_State* L) {
  SolidValue& solid = solid_argument(L, kProject);
  if (lua_gettop(L) > 1) fail_in(kProject, "takes no arguments; slice(z) cuts");
  push_shadow(L, kProject, solid);
  return 1;
}

constexpr Option kSliceOptions[] = {
    {"z", T::kNumber, "0", "the height of the cut", true},
};
constexpr FunctionSpec kSlice{
    "slice",
    "What a horizontal plane cuts of a solid, a 2D shape. Where the solid has a face in the "
    "plane, what is above it counts.",
    kSliceOptions,
    false,
    "sphere(10):slice(5):area()",
    "solid",
    kSolidDoc};

int slice(lua_State* L) {
  take_subject_out_of_list(L);
  const SolidValue& solid = solid_argument(L, kSlice);
  const Arguments arguments(L, kSlice, 2);
  push_section(L, solid.node, arguments.number("z", 0));
  return 1;
}

constexpr Option kPlaneOptions[] = {
    {"normal", T::kVector3, "{0, 0, 1}", "a direction across the plane, of any length", true},
    {"offset", T::kNumber, "0", "where the plane is: its distance from the origin along the normal",
     true},
    {"point", T::kVector3, "", "instead of the offset: a point of the plane", false},
};
constexpr FunctionSpec kSplit{
    "split",
    "The two parts of a solid on either side of a plane: first what is in front of it, where the "
    "normal points, then what is behind.",
    kPlaneOptions,
    false,
    "local top, bottom = part:split({0, 0, 1}, 5)",
    "solid",
    kSolidDoc};
constexpr FunctionSpec kTrim{"trim",
                             "What of a solid is in front of a plane, where the normal points.",
                             kPlaneOptions,
                             false,
                             "part:trim{normal = {1, 0, 1}, point = {0, 0, 5}}",
                             "solid",
                             kSolidDoc};

CutPlane plane_argument(const Arguments& arguments, const FunctionSpec& spec) {
  const auto given = arguments.vector("normal");
  const glm::dvec3 normal = given ? given->v : glm::dvec3(0, 0, 1);
  CutPlane plane = value_or_fail(spec, make_cut_plane(normal, arguments.number("offset", 0)));
  if (const auto point = arguments.vector("point")) {
    if (arguments.has("offset")) fail_in(spec, "give either 'offset' or 'point', not both");
    plane.offset = glm::dot(plane.normal, point->v);
  }
  return plane;
}

template <const FunctionSpec& Spec, bool kBoth>
int cut(lua_State* L) {
  take_subject_out_of_list(L);
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
  push_solid(L, Node::boolean(BooleanOp::kIntersection, {solid, front}, where));
  keep_marks(L, 1);
  if (!kBoth) return 1;
  push_solid(L, Node::boolean(BooleanOp::kDifference, {solid, front}, where));
  keep_marks(L, 1);
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
  const ShapeValue* shape = to_shape(L, 1);
  if (shape == nullptr) solid_argument(L, kDecompose);
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
  std::vector<NodePtr> pieces;
  {
    const EvaluationScope scope(session.budget());
    pieces =
        made_or_fail(session, decompose_solid(session.evaluator(), solid, session.source_ref(L)));
  }
  lua_newtable(L);
  for (NodePtr& piece : pieces) {
    push_solid(L, std::move(piece));
    lua_rawseti(L, -2, ++count);
  }
  return 1;
}

constexpr Binding kBindings[] = {
    {&kProjection, guarded<projection>, guarded<projection>, nullptr},
    {&kProject, guarded<project>, guarded<project>, nullptr},
    {&kSlice, guarded<slice>, guarded<slice>, nullptr},
    {&kSplit, guarded<cut<kSplit, true>>, guarded<cut<kSplit, true>>, nullptr},
    {&kTrim, guarded<cut<kTrim, false>>, guarded<cut<kTrim, false>>, nullptr},
    {&kDecompose, guarded<decompose>, guarded<decompose>, guarded<decompose>},
};

}  // namespace

std::span<const Binding> section_bindings() { return kBindings; }

}  // namespace csgrun
