// Moves, turns, scales, mirrors, matrices.
//
// One function serves three forms: on a solid or shape it gives a new one, on a matrix the matrix
// that does both, and without any of these the matrix itself: `rotate(90) * part`.
#include <cmath>

#include <fmt/format.h>

#include <csgrun/primitives/trig.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
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

Affine translation(const glm::dvec3& v) {
  Affine map;
  map.m[0][3] = v.x;
  map.m[1][3] = v.y;
  map.m[2][3] = v.z;
  return map;
}

/// About X, Y or Z (0, 1, 2).
Affine axis_rotation(int axis, double degrees) {
  const double c = cos_deg(degrees), s = sin_deg(degrees);
  const auto i = static_cast<size_t>((axis + 1) % 3), j = static_cast<size_t>((axis + 2) % 3);
  Affine map;
  map.m[i][i] = c;
  map.m[i][j] = -s;
  map.m[j][i] = s;
  map.m[j][j] = c;
  return map;
}

Affine rotation_about(const glm::dvec3& axis, double degrees) {
  const double length = std::sqrt(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
  if (length == 0) return {};
  // Along a coordinate axis the matrix is exact; the general formula would round it.
  for (int i = 0; i < 3; ++i) {
    if (std::abs(axis[i]) == length) return axis_rotation(i, axis[i] > 0 ? degrees : -degrees);
  }
  const glm::dvec3 u(axis.x / length, axis.y / length, axis.z / length);
  const double c = cos_deg(degrees), s = sin_deg(degrees), t = 1 - c;
  Affine map;
  map.m[0] = {t * u.x * u.x + c, t * u.x * u.y - s * u.z, t * u.x * u.z + s * u.y, 0};
  map.m[1] = {t * u.x * u.y + s * u.z, t * u.y * u.y + c, t * u.y * u.z - s * u.x, 0};
  map.m[2] = {t * u.x * u.z - s * u.y, t * u.y * u.z + s * u.x, t * u.z * u.z + c, 0};
  return map;
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
    {"v", T::kVector3, "{0, 0, 1}", "axis to turn about", true},
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
    {"v", T::kVector2Or3, "{1, 0, 0}", "normal of the plane through the origin", true},
};
constexpr FunctionSpec kMirror{"mirror", "Mirrors at a plane through the origin.", kMirrorOptions,
                               false, "part:mirror(1, 0, 0)"};

Affine make_mirror(const Arguments& arguments) {
  const auto given = arguments.vector("v");
  const glm::dvec3 n = given ? given->v : glm::dvec3(1, 0, 0);
  const double square = n.x * n.x + n.y * n.y + n.z * n.z;
  Affine map;
  if (square == 0) return map;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      map.m[static_cast<size_t>(i)][static_cast<size_t>(j)] =
          (i == j ? 1.0 : 0.0) - 2 * n[i] * n[j] / square;
    }
  }
  return map;
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
constexpr FunctionSpec kUp{"up", "Moves along +Z.", kDistanceOptions};
constexpr FunctionSpec kDown{"down", "Moves along -Z.", kDistanceOptions};
constexpr FunctionSpec kLeft{"left", "Moves along -X.", kDistanceOptions};
constexpr FunctionSpec kRight{"right", "Moves along +X.", kDistanceOptions};
constexpr FunctionSpec kForward{"forward", "Moves along -Y, towards the viewer.", kDistanceOptions};
constexpr FunctionSpec kBack{"back", "Moves along +Y.", kDistanceOptions};
constexpr FunctionSpec kRx{"rx", "Turns about X.", kAngleOptions};
constexpr FunctionSpec kRy{"ry", "Turns about Y.", kAngleOptions};
constexpr FunctionSpec kRz{"rz", "Turns about Z.", kAngleOptions};

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

template <const FunctionSpec& Spec, Affine (*Make)(const Arguments&), bool kMethod>
int transform(lua_State* L) {
  if (const SolidValue* solid = to_solid(L, 1)) {
    const Arguments arguments(L, Spec, 2);
    push_solid(L, Node::transformed(Make(arguments), solid->node, session_of(L).source_ref(L)));
    keep_marks(L, 1);
  } else if (const ShapeValue* shape = to_shape(L, 1)) {
    const Arguments arguments(L, Spec, 2);
    push_shape(L, value_or_fail(Spec, shape->shape.transformed(Make(arguments))),
               shape->appearance);
    keep_marks(L, 1);
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

template <const FunctionSpec& Spec, Affine (*Make)(const Arguments&)>
constexpr Binding transform_binding() {
  return {&Spec, guarded<transform<Spec, Make, false>>, guarded<transform<Spec, Make, true>>,
          guarded<transform<Spec, Make, true>>};
}

constexpr Binding kBindings[] = {
    transform_binding<kTranslate, make_translation<kTranslate>>(),
    transform_binding<kRotate, make_rotation>(),
    transform_binding<kScale, make_scale>(),
    transform_binding<kMirror, make_mirror>(),
    transform_binding<kMultmatrix, make_multmatrix>(),
    transform_binding<kMove, make_translation<kMove>>(),
    transform_binding<kUp, make_step<kUp, 2, 1>>(),
    transform_binding<kDown, make_step<kDown, 2, -1>>(),
    transform_binding<kLeft, make_step<kLeft, 0, -1>>(),
    transform_binding<kRight, make_step<kRight, 0, 1>>(),
    transform_binding<kForward, make_step<kForward, 1, -1>>(),
    transform_binding<kBack, make_step<kBack, 1, 1>>(),
    transform_binding<kRx, make_turn<kRx, 0>>(),
    transform_binding<kRy, make_turn<kRy, 1>>(),
    transform_binding<kRz, make_turn<kRz, 2>>(),
};

}  // namespace

std::span<const Binding> transform_bindings() { return kBindings; }

}  // namespace csgrun
