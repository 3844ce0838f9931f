// cube, sphere, cylinder, polyhedron.
#include <csgrun/primitives/freeform.h>
#include <csgrun/primitives/solids.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr Option kCubeOptions[] = {
    {"size", T::kSize3, "1", "edge length, or lengths along X, Y and Z", true, Range::kPositive},
    {"center", T::kBooleans3, "false", "centred in the origin, or along these axes", true},
    {"r", T::kNumber, "0", "radius of its edges and corners, at most half of its shortest side",
     false, Range::kNotNegative},
};
constexpr FunctionSpec kCube{"cube", "A box; a corner stands in the origin unless it is centred.",
                             kCubeOptions, true, "cube{size = {60, 40, 5}, center = true}"};

int cube(lua_State* L) {
  const Arguments arguments(L, kCube, 1);
  glm::dvec3 size(1, 1, 1);
  if (const auto given = arguments.vector("size")) {
    size = given->count == 1 ? glm::dvec3(given->v.x) : given->v;
  }
  const double r = arguments.number("r", 0);
  const std::array<bool, 3> center = arguments.booleans("center");
  push_leaf(L, value_or_fail(kCube, r > 0 ? make_rounded_cube(size, r, center, arguments.facets())
                                          : make_cube(size, center)));
  return 1;
}

/// A radius given as `r` or as the diameter `d`; both is an error.
double radius(const Arguments& arguments, const FunctionSpec& spec, const char* r, const char* d,
              double fallback) {
  if (arguments.has(r) && arguments.has(d))
    fail_in(spec, std::string("give either '") + r + "' or '" + d + "', not both");
  return arguments.has(d) ? arguments.number(d, 0) / 2 : arguments.number(r, fallback);
}

constexpr Option kSphereOptions[] = {
    {"r", T::kNumber, "1", "radius", true, Range::kPositive},
    {"d", T::kNumber, "", "diameter, instead of r", false, Range::kPositive},
};
constexpr FunctionSpec kSphere{"sphere", "A ball about the origin, as rings of facets.",
                               kSphereOptions, true, "sphere(10, {fn = 64})"};

int sphere(lua_State* L) {
  const Arguments arguments(L, kSphere, 1);
  const double r = radius(arguments, kSphere, "r", "d", 1);
  push_leaf(L, value_or_fail(kSphere, make_sphere(r, arguments.facets())));
  return 1;
}

constexpr Option kCylinderOptions[] = {
    {"h", T::kNumber, "1", "height", true, Range::kPositive, "height"},
    {"r1", T::kNumber, "1", "radius at the bottom", true, Range::kNotNegative},
    {"r2", T::kNumber, "1", "radius at the top", true, Range::kNotNegative},
    {"center", T::kBoolean, "false", "centred along Z", true},
    {"r", T::kNumber, "", "radius at both ends", false, Range::kPositive},
    {"d", T::kNumber, "", "diameter at both ends", false, Range::kPositive},
    {"d1", T::kNumber, "", "diameter at the bottom", false, Range::kNotNegative},
    {"d2", T::kNumber, "", "diameter at the top", false, Range::kNotNegative},
    {"round", T::kNumber, "0", "radius of both rims, at most r and half of h", false,
     Range::kNotNegative},
};
constexpr FunctionSpec kCylinder{
    "cylinder",
    "A cylinder along Z; cylinder(h, r1, r2) is a cone, cylinder(h, r) is not; "
    "cylinder(h, r, true) is centred.",
    kCylinderOptions, true, "cylinder{h = 20, r = 4, center = true, fn = 64}"};

/// cylinder(h, r, center), as LuaCAD has it, and cylinder{h, r, center}: the radius of the top is
/// that of the bottom.
void put_top_radius_before_center(lua_State* L) {
  if (lua_gettop(L) >= 3 && lua_isnumber(L, 2) && lua_isboolean(L, 3)) {
    lua_pushvalue(L, 2);
    lua_insert(L, 3);
    return;
  }
  if (lua_gettop(L) != 1 || !lua_istable(L, 1)) return;
  const bool has_both = lua_rawgeti(L, 1, 2) == LUA_TNUMBER && lua_rawgeti(L, 1, 3) == LUA_TBOOLEAN;
  lua_settop(L, 1);
  if (!has_both) return;
  lua_newtable(L);  // the model's own stays as it is
  for (lua_pushnil(L); lua_next(L, 1) != 0;) {
    lua_pushvalue(L, -2);
    lua_insert(L, -2);
    lua_rawset(L, 2);
  }
  lua_rawgeti(L, 1, 3);
  lua_rawseti(L, 2, 4);
  lua_rawgeti(L, 1, 2);
  lua_rawseti(L, 2, 3);
  lua_replace(L, 1);
}

int cylinder(lua_State* L) {
  put_top_radius_before_center(L);
  const Arguments arguments(L, kCylinder, 1);
  const double both = radius(arguments, kCylinder, "r", "d", 1);
  const auto has = [&](const char* r, const char* d) {
    return arguments.has(r) || arguments.has(d);
  };
  if (has("r", "d") && has("r1", "d1") && has("r2", "d2")) {
    fail_in(kCylinder, "give either one radius or those of both ends");
  }
  double r1 = radius(arguments, kCylinder, "r1", "d1", both);
  double r2 = radius(arguments, kCylinder, "r2", "d2", both);
  // cylinder(h, r): the second value alone is the radius of both ends.
  if (arguments.positional_count() >= 2 && arguments.has("r1") && !arguments.has("r2") &&
      !arguments.has("d2")) {
    if (arguments.has("r") || arguments.has("d")) fail_in(kCylinder, "the radius is given twice");
    r2 = r1;
  }
  if (r1 == 0 && r2 == 0) fail_in(kCylinder, "one of the radii must be positive");
  const double h = arguments.number("h", 1), round = arguments.number("round", 0);
  const bool center = arguments.boolean("center", false);
  if (round > 0 && r1 != r2) fail_in(kCylinder, "'round' needs both radii to be the same");
  push_leaf(
      L, value_or_fail(kCylinder,
                       round > 0 ? make_rounded_cylinder(h, r1, round, center, arguments.facets())
                                 : make_cylinder(h, r1, r2, center, arguments.facets())));
  return 1;
}

constexpr Option kPolyhedronOptions[] = {
    {"points", T::kPoints3, "", "the corners; the first is point 0, in faces and messages", true},
    {"faces", T::kIndexLists, "",
     "corners of each face, clockwise seen from outside; the first is face 0 in messages", true},
    {"fill", T::kString, "\"nonzero\"", kFillDoc, false},
    kConvexityOption,
};
constexpr FunctionSpec kPolyhedron{"polyhedron",
                                   "A solid of its own corners and faces; it must be closed.",
                                   kPolyhedronOptions, false,
                                   "polyhedron{points = {{0,0,0},{1,0,0},{0,1,0},{0,0,1}}, "
                                   "faces = {{0,1,2},{0,3,1},{0,2,3},{1,3,2}}}"};

int polyhedron(lua_State* L) {
  const Arguments arguments(L, kPolyhedron, 1);
  if (!arguments.has("points") || !arguments.has("faces"))
    fail_in(kPolyhedron, "needs points and faces");
  std::string note;
  PolygonMesh mesh = value_or_fail(
      kPolyhedron, make_polyhedron(arguments.points3("points"), arguments.index_lists("faces"),
                                   &note, fill_argument(arguments, kPolyhedron)));
  if (!note.empty()) session_of(L).warn(L, note);
  push_leaf(L, std::move(mesh));
  return 1;
}

constexpr Binding kSolidsBindings[] = {
    {&kCube, guarded<cube>, nullptr, nullptr},
    {&kSphere, guarded<sphere>, nullptr, nullptr},
    {&kCylinder, guarded<cylinder>, nullptr, nullptr},
    {&kPolyhedron, guarded<polyhedron>, nullptr, nullptr},
};

}  // namespace

std::span<const Binding> solid_bindings() { return kSolidsBindings; }

}  // namespace csgrun
