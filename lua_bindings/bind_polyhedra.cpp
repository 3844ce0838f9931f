// torus, ellipsoid, pyramid, octahedron, icosahedron.
#include <algorithm>
#include <cmath>

#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/solids.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr Option kTorusOptions[] = {
    {"R", T::kNumber, "2", "radius of the ring, to the middle of its tube", true, Range::kPositive,
     "major"},
    {"r", T::kNumber, "0.5", "radius of the tube", true, Range::kPositive, "minor"},
    {"segments_minor", T::kNumber, "fn", "fn of the tube", false, Range::kPositive},
};
constexpr FunctionSpec kTorus{"torus", "A ring about Z: a circle that is turned.", kTorusOptions,
                              true, "torus{R = 20, r = 5, fn = 48}"};

int torus(lua_State* L) {
  const Arguments arguments(L, kTorus, 1);
  const double major = arguments.number("R", 2), minor = arguments.number("r", 0.5);
  if (minor > major)
    fail_in(kTorus, "'r', the radius of the tube, must not be larger than 'R', that of the ring");
  Facets tube = arguments.facets();
  RotateExtrudeOptions turn;
  turn.facets = tube;
  tube.fn = arguments.number("segments_minor", tube.fn);
  if (const std::string problem = check_facets(tube); !problem.empty())
    fail_in(kTorus, "option 'segments_minor': " + problem);
  turn.start = 0;
  const Shape2D circle = value_or_fail(kTorus, make_circle(minor, tube));
  Affine map;
  map.m[0][3] = major;
  const Shape2D placed = value_or_fail(kTorus, circle.transformed(map));
  PolygonMesh mesh = value_or_fail(kTorus, rotate_extrude(placed, turn));
  mesh.kind = "torus";
  push_leaf(L, std::move(mesh));
  return 1;
}

constexpr Option kEllipsoidOptions[] = {
    {"r", T::kSize3, "1", "radii along X, Y and Z, or one for all", true, Range::kPositive},
    {"rx", T::kNumber, "1", "radius along X", false, Range::kPositive},
    {"ry", T::kNumber, "1", "radius along Y", false, Range::kPositive},
    {"rz", T::kNumber, "1", "radius along Z", false, Range::kPositive},
};
constexpr FunctionSpec kEllipsoid{
    "ellipsoid", "A sphere that is scaled; fa and fs are those of a sphere of the largest radius.",
    kEllipsoidOptions, true, "ellipsoid(20, 10, 5, {fn = 48})"};

int ellipsoid(lua_State* L) {
  const Arguments arguments(L, kEllipsoid, 1);
  glm::dvec3 radii(arguments.number("rx", 1), arguments.number("ry", 1), arguments.number("rz", 1));
  if (const auto given = arguments.vector("r")) {
    if (arguments.has("rx") || arguments.has("ry") || arguments.has("rz"))
      fail_in(kEllipsoid, "give either 'r' or rx, ry and rz, not both");
    radii = given->count == 1 ? glm::dvec3(given->v.x) : given->v;
  }
  const double largest = std::max({radii.x, radii.y, radii.z});
  PolygonMesh mesh = value_or_fail(kEllipsoid, make_sphere(largest, arguments.facets()));
  for (glm::dvec3& p : mesh.points)
    p = {p.x * (radii.x / largest), p.y * (radii.y / largest), p.z * (radii.z / largest)};
  mesh.kind = "ellipsoid";
  push_leaf(L, std::move(mesh));
  return 1;
}

/// A solid of faces that are clockwise seen from outside.
void push_polyhedron(lua_State* L, const FunctionSpec& spec, const std::vector<glm::dvec3>& points,
                     const std::vector<std::vector<uint32_t>>& faces) {
  std::string note;
  PolygonMesh mesh = value_or_fail(spec, make_polyhedron(points, faces, &note));
  mesh.kind = spec.name;
  push_leaf(L, std::move(mesh));
}

constexpr Option kRadiusOptions[] = {
    {"r", T::kNumber, "1", "distance of the corners from the origin", true, Range::kPositive,
     "radius"},
};
constexpr FunctionSpec kOctahedron{"octahedron", "Eight triangles; the corners lie on the axes.",
                                   kRadiusOptions, false, "octahedron(10)"};

int octahedron(lua_State* L) {
  const Arguments arguments(L, kOctahedron, 1);
  const double r = arguments.number("r", 1);
  push_polyhedron(
      L, kOctahedron, {{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}},
      {{0, 4, 2}, {2, 4, 1}, {1, 4, 3}, {3, 4, 0}, {2, 5, 0}, {1, 5, 2}, {3, 5, 1}, {0, 5, 3}});
  return 1;
}

constexpr FunctionSpec kIcosahedron{"icosahedron",
                                    "Twenty triangles; each corner lies in a plane of two axes.",
                                    kRadiusOptions, false, "icosahedron(10)"};

int icosahedron(lua_State* L) {
  const Arguments arguments(L, kIcosahedron, 1);
  // Corners of three golden rectangles: sides in the ratio of (1 + sqrt 5) / 2.
  const double golden = (1 + std::sqrt(5.0)) / 2;
  const double a = arguments.number("r", 1) / std::sqrt(1 + golden * golden), b = a * golden;
  push_polyhedron(
      L, kIcosahedron,
      {{-a, b, 0},
       {a, b, 0},
       {-a, -b, 0},
       {a, -b, 0},
       {0, -a, b},
       {0, a, b},
       {0, -a, -b},
       {0, a, -b},
       {b, 0, -a},
       {b, 0, a},
       {-b, 0, -a},
       {-b, 0, a}},
      {{0, 5, 11},  {0, 1, 5},  {0, 7, 1},  {0, 10, 7}, {0, 11, 10}, {1, 9, 5}, {5, 4, 11},
       {11, 2, 10}, {10, 6, 7}, {7, 8, 1},  {3, 4, 9},  {3, 2, 4},   {3, 6, 2}, {3, 8, 6},
       {3, 9, 8},   {4, 5, 9},  {2, 11, 4}, {6, 10, 2}, {8, 7, 6},   {9, 1, 8}});
  return 1;
}

constexpr Option kPyramidOptions[] = {
    {"x", T::kNumber, "0", "where its first corner is", true},
    {"y", T::kNumber, "0", "likewise", true},
    {"z", T::kNumber, "0", "likewise", true},
    {"length", T::kNumber, "1", "side of the square below", true, Range::kPositive},
    {"height", T::kNumber, "1", "height", true, Range::kPositive},
};
constexpr FunctionSpec kPyramid{
    "pyramid", "A square pyramid, its tip over the middle; a corner stands at (x, y, z).",
    kPyramidOptions, false, "pyramid(0, 0, 0, 10, 8)"};

int pyramid(lua_State* L) {
  const Arguments arguments(L, kPyramid, 1);
  const double x = arguments.number("x", 0), y = arguments.number("y", 0),
               z = arguments.number("z", 0), length = arguments.number("length", 1);
  push_polyhedron(L, kPyramid,
                  {{x, y, z},
                   {x + length, y, z},
                   {x + length, y + length, z},
                   {x, y + length, z},
                   {x + length / 2, y + length / 2, z + arguments.number("height", 1)}},
                  {{0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}, {0, 1, 2, 3}});
  return 1;
}

constexpr Binding kPolyhedraBindings[] = {
    {&kTorus, guarded<torus>, nullptr, nullptr},
    {&kEllipsoid, guarded<ellipsoid>, nullptr, nullptr},
    {&kOctahedron, guarded<octahedron>, nullptr, nullptr},
    {&kIcosahedron, guarded<icosahedron>, nullptr, nullptr},
    {&kPyramid, guarded<pyramid>, nullptr, nullptr},
};

}  // namespace

std::span<const Binding> polyhedron_bindings() { return kPolyhedraBindings; }

}  // namespace csgrun
