// Moves, turns, scales, mirrors, matrices.
//
// One function serves three forms: on a solid or shape it gives a new one, on a matrix the matrix
// that does both, and without any of these the matrix itself: `rotate(90) * part`.
#include <cmath>

#include <fmt/format.h>

#include "lua_bindings/affine_maps.h"
#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/operands.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

using T = ArgumentType;

/// x, y, z given by name, with `rest` for those that were not; nothing if none was given.
std::optional<glm::dvec3> named_axes(const Arguments& arguments, const FunctionSpec& spec,
                                     const char* main, double rest) {
  if (!arguments.has("x") && !arguments.has("y") && !arguments.has("z")) return std::nullopt;
  if (arguments.has(main))
    fail_in(spec, fmt::format("give either '{}' or x, y and z, not both", main));
  return glm::dvec3(arguments.number("x", rest), arguments.number("y", rest),
                    arguments.number("z", rest));
}

constexpr Option kTranslateOptions[] = {
    {"v", T::kVector2Or3, "", "how far along X, Y and Z", true},
    {"x", T::kNumber, "0", "along X", false},
    {"y", T::kNumber, "0", "along Y", false},
    {"z", T::kNumber, "0", "along Z", false},
};
constexpr FunctionSpec kTranslate{"translate", "Moves.", kTranslateOptions, false,
                                  "part:translate(0, 0, 10)"};
constexpr FunctionSpec kMove{"move", "Moves: another name of translate.", kTranslateOptions, false,
                             "part:move{z = 10}"};

template <const FunctionSpec& Spec>
Affine make_translation(const Arguments& arguments) {
  if (const auto axes = named_axes(arguments, Spec, "v", 0)) return translation(*axes);
  const auto v = arguments.vector("v");
  if (!v) fail_in(Spec, "needs how far to move: (x, y, z) or {z = 10}");
  return translation(v->v);
}

constexpr Option kRotateOptions[] = {
    {"a", T::kAngles, "", "an angle about Z (or v), or angles about X, Y and Z in this order",
     true},
    {"v", T::kVector3, "{0, 0, 1}", "axis to turn about; {0, 0, 0} turns nothing, as in OpenSCAD",
     true},
    {"x", T::kNumber, "0", "about X", false},
    {"y", T::kNumber, "0", "about Y", false},
    {"z", T::kNumber, "0", "about Z", false},
};
constexpr FunctionSpec kRotate{"rotate", "Turns by degrees: about X first, then Y, then Z.",
                               kRotateOptions, false, "part:rotate(0, 90, 45)"};

Affine make_rotation(const Arguments& arguments) {
  auto angles = named_axes(arguments, kRotate, "a", 0);
  const auto axis = arguments.vector("v");
  if (const auto a = arguments.vector("a")) {
    if (a->count == 1) return rotation_about(axis ? axis->v : glm::dvec3(0, 0, 1), a->v.x);
    angles = a->v;
  }
  if (!angles) fail_in(kRotate, "needs an angle: (degrees), (x, y, z) or {z = 45}");
  if (axis) fail_in(kRotate, "an axis 'v' goes with one angle, not with a list");
  return Affine::compose(axis_rotation(2, angles->z),
                         Affine::compose(axis_rotation(1, angles->y), axis_rotation(0, angles->x)));
}

constexpr Option kScaleOptions[] = {
    {"v", T::kSize2Or3, "", "a factor, or factors along X, Y and Z", true},
    {"x", T::kNumber, "1", "along X", false},
    {"y", T::kNumber, "1", "along Y", false},
    {"z", T::kNumber, "1", "along Z", false},
};
constexpr FunctionSpec kScale{"scale", "Scales about the origin.", kScaleOptions, false,
                              "part:scale(1, 1, 2)"};

Affine make_scale(const Arguments& arguments) {
  auto factors = named_axes(arguments, kScale, "v", 1);
  if (const auto v = arguments.vector("v")) {
    factors = v->count == 1   ? glm::dvec3(v->v.x)
              : v->count == 2 ? glm::dvec3(v->v.x, v->v.y, 1)
                              : v->v;
  }
  if (!factors) fail_in(kScale, "needs a factor: (2), (1, 1, 2) or {z = 2}");
  if (factors->x == 0 || factors->y == 0 || factors->z == 0)
    fail_in(kScale, "a factor must not be 0");
  Affine map;
  map.m[0][0] = factors->x;
  map.m[1][1] = factors->y;
  map.m[2][2] = factors->z;
  return map;
}

constexpr Option kMirrorOptions[] = {
    {"v", T::kVector2Or3, "{1, 0, 0}",
     "normal of the plane through the origin; {0, 0, 0} mirrors nothing, as in OpenSCAD", true},
};
constexpr FunctionSpec kMirror{"mirror", "Mirrors at a plane through the origin.", kMirrorOptions,
                               false, "part:mirror(1, 0, 0)"};

Affine make_mirror(const Arguments& arguments) {
  const auto given = arguments.vector("v");
  return reflection(given ? given->v : glm::dvec3(1, 0, 0));
}

constexpr Option kMultmatrixOptions[] = {
    {"m", T::kMatrix, "", "rows of the matrix; what is missing is that of the identity", true},
};
constexpr FunctionSpec kMultmatrix{"multmatrix", "Applies an affine matrix.", kMultmatrixOptions,
                                   false,
                                   "part:multmatrix{{1, 0.5, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}"};

Affine make_multmatrix(const Arguments& arguments) {
  if (!arguments.has("m")) fail_in(kMultmatrix, "needs a matrix");
  return arguments.matrix("m");
}

constexpr Option kDistanceOptions[] = {{"d", T::kNumber, "", "how far", true}};
constexpr Option kAngleOptions[] = {{"a", T::kNumber, "", "degrees", true}};
constexpr FunctionSpec kUp{"up", "Moves along +Z.", kDistanceOptions, false, "part:up(3)"};
constexpr FunctionSpec kDown{"down", "Moves along -Z.", kDistanceOptions, false, "part:down(3)"};
constexpr FunctionSpec kLeft{"left", "Moves along -X.", kDistanceOptions, false, "part:left(3)"};
constexpr FunctionSpec kRight{"right", "Moves along +X.", kDistanceOptions, false, "part:right(3)"};
constexpr FunctionSpec kForward{"forward", "Moves along -Y, towards the viewer.", kDistanceOptions,
                                false, "part:forward(3)"};
constexpr FunctionSpec kFront{"front",
                              "Moves along -Y, towards the viewer: another name of forward.",
                              kDistanceOptions, false, "part:front(3)"};
constexpr FunctionSpec kTx{"tx", "Moves along X.", kDistanceOptions, false, "part:tx(3)"};
constexpr FunctionSpec kTy{"ty", "Moves along Y.", kDistanceOptions, false, "part:ty(3)"};
constexpr FunctionSpec kTz{"tz", "Moves along Z.", kDistanceOptions, false, "part:tz(3)"};
constexpr FunctionSpec kBack{"back", "Moves along +Y.", kDistanceOptions, false, "part:back(3)"};
constexpr FunctionSpec kRx{"rx", "Turns about X.", kAngleOptions, false, "part:rx(90)"};
constexpr FunctionSpec kRy{"ry", "Turns about Y.", kAngleOptions, false, "part:ry(90)"};
constexpr FunctionSpec kRz{"rz", "Turns about Z.", kAngleOptions, false, "part:rz(90)"};

template <const FunctionSpec& Spec, int Axis, int Sign>
Affine make_step(const Arguments& arguments) {
  if (!arguments.has("d")) fail_in(Spec, "needs a distance");
  glm::dvec3 v(0, 0, 0);
  v[Axis] = Sign * arguments.number("d", 0);
  return translation(v);
}

template <const FunctionSpec& Spec, int Axis>
Affine make_turn(const Arguments& arguments) {
  if (!arguments.has("a")) fail_in(Spec, "needs an angle");
  return axis_rotation(Axis, arguments.number("a", 0));
}

/// translate({1, 2, 3}, part), as OpenSCAD and JSCAD have it. A matrix that is moved is no part.
void take_subject_from_the_end(lua_State* L, bool is_of_matrix) {
  for (int index = 1; !is_of_matrix && index <= lua_gettop(L); ++index) {
    if (to_matrix(L, index) != nullptr) return;
  }
  bring_subject_to_front(L);
}

template <const FunctionSpec& Spec, Affine (*Make)(const Arguments&), bool kMethod>
int transform(lua_State* L) {
  if (!kMethod) take_subject_from_the_end(L, &Spec == &kMultmatrix);
  if (const SolidValue* solid = to_solid(L, 1)) {
    const Arguments arguments(L, Spec, 2);
    push_solid(L, Node::transformed(Make(arguments), solid->node, session_of(L).source_ref(L)));
    keep_marks(L, 1);
  } else if (to_shape(L, 1) != nullptr) {
    const Arguments arguments(L, Spec, 2);
    push_moved_shape(L, 1, Make(arguments), Spec.name);
  } else if (const MatrixValue* matrix = to_matrix(L, 1);
             matrix != nullptr && &Spec != &kMultmatrix) {
    const Arguments arguments(L, Spec, 2);
    push_matrix(L, Affine::compose(Make(arguments), matrix->map));
  } else if (kMethod) {
    fail_in(Spec, fmt::format("is called with a colon: part:{}(...)", Spec.name));
  } else {
    const Arguments arguments(L, Spec, 1);
    push_matrix(L, Make(arguments));
  }
  return 1;
}

constexpr FunctionSpec kInverse{
    "inverse", "The matrix that undoes a matrix.", {}, false, "rotate(30):inverse()", "matrix",
    "a matrix"};

int invert(lua_State* L) {
  Affine map;
  if (lua_gettop(L) != 1 || !to_affine(L, 1, map))
    fail_in(kInverse, "needs a matrix, got " + describe_value(L, 1));
  const auto back = inverse(map);
  if (!back) fail_in(kInverse, "the matrix makes solids flat: nothing undoes it");
  push_matrix(L, *back);
  return 1;
}

template <const FunctionSpec& Spec, Affine (*Make)(const Arguments&)>
constexpr Binding transform_binding() {
  return {&Spec, guarded<transform<Spec, Make, false>>, guarded<transform<Spec, Make, true>>,
          guarded<transform<Spec, Make, true>>, guarded<transform<Spec, Make, true>>};
}

constexpr Binding kTransformsBindings[] = {
    transform_binding<kTranslate, make_translation<kTranslate>>(),
    transform_binding<kRotate, make_rotation>(),
    transform_binding<kScale, make_scale>(),
    transform_binding<kMirror, make_mirror>(),
    {&kMultmatrix, guarded<transform<kMultmatrix, make_multmatrix, false>>,
     guarded<transform<kMultmatrix, make_multmatrix, true>>,
     guarded<transform<kMultmatrix, make_multmatrix, true>>},
    {&kInverse, guarded<invert>, nullptr, nullptr, guarded<invert>},
    transform_binding<kMove, make_translation<kMove>>(),
    transform_binding<kUp, make_step<kUp, 2, 1>>(),
    transform_binding<kDown, make_step<kDown, 2, -1>>(),
    transform_binding<kLeft, make_step<kLeft, 0, -1>>(),
    transform_binding<kRight, make_step<kRight, 0, 1>>(),
    transform_binding<kForward, make_step<kForward, 1, -1>>(),
    transform_binding<kFront, make_step<kFront, 1, -1>>(),
    transform_binding<kBack, make_step<kBack, 1, 1>>(),
    transform_binding<kTx, make_step<kTx, 0, 1>>(),
    transform_binding<kTy, make_step<kTy, 1, 1>>(),
    transform_binding<kTz, make_step<kTz, 2, 1>>(),
    transform_binding<kRx, make_turn<kRx, 0>>(),
    transform_binding<kRy, make_turn<kRy, 1>>(),
    transform_binding<kRz, make_turn<kRz, 2>>(),
};

}  // namespace

std::span<const Binding> transform_bindings() { return kTransformsBindings; }

void push_moved_shape(lua_State* L, int index, const Affine& map, const std::string& function) {
  const ShapeValue& shape = *to_shape(L, index);
  const auto& m = map.m;
  if (m[2][0] != 0 || m[2][1] != 0) {
    const bool is_gone = m[0][0] * m[1][1] - m[0][1] * m[1][0] == 0;
    session_of(L).warn(
        L, fmt::format("{}: a 2D shape stays in its plane, so that one which is "
                       "turned out of it {}; extrude it first",
                       function, is_gone ? "is empty" : "becomes narrower, as seen from above"));
  } else if (m[2][3] != 0) {
    session_of(L).warn(L, fmt::format("{}: a 2D shape stays in its plane, so what moves it out has "
                                      "no effect; extrude it first",
                                      function));
  }
  auto moved = shape.shape.transformed(map);
  if (!moved) throw ScriptError(function + ": " + moved.error().message);
  push_shape(L, *std::move(moved), shape.appearance);
  keep_marks(L, index);
}

}  // namespace csgrun
