// faces, ray, gap: what of a solid is where. In doubles, of the exact result.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <csgrun/primitives/trig.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/measure/triangle_distance.h"
#include "lua_bindings/session.h"
#include "lua_bindings/tolerances.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr Option kFacesOptions[] = {
    {"normal", T::kVector3, "any", "which way they look, outwards", true},
    {"angle", T::kNumber, "0.01", "how far from that, in degrees", false, Range::kNotNegative},
    {"through", T::kVector3, "any", "a point of their plane, to a millionth of a mm", false},
};
constexpr FunctionSpec kFaces{
    "faces",
    "Its flat faces, each {normal, area, center, loops}: loops are lists of points, the outer one "
    "first and counter-clockwise, then holes.",
    kFacesOptions, false, "part:faces({0, 0, 1})[1].area"};

struct FaceSum {
  double area = 0;
  /// About the first corner of the face, where it is 0 across what is flat; thrice, which needs no
  /// thirds.
  glm::dvec3 moments{0, 0, 0};
};

const glm::dvec3& first_corner(const Solid& solid, const Solid::Face& face) {
  return solid.positions[solid.loop_vertices[solid.loop_starts[face.first_loop]]];
}

void push_face(lua_State* L, const Solid& solid, const Solid::Face& face, const glm::dvec3& normal,
               const FaceSum& sum) {
  lua_createtable(L, 0, 4);
  push_point(L, normal);
  lua_setfield(L, -2, "normal");
  lua_pushnumber(L, sum.area);
  lua_setfield(L, -2, "area");
  push_point(L, first_corner(solid, face) + sum.moments / (3 * sum.area));
  lua_setfield(L, -2, "center");
  lua_createtable(L, static_cast<int>(face.loop_count), 0);
  for (uint32_t l = 0; l < face.loop_count; ++l) {
    const uint32_t begin = solid.loop_starts[face.first_loop + l];
    const uint32_t end = solid.loop_starts[face.first_loop + l + 1];
    lua_createtable(L, static_cast<int>(end - begin), 0);
    for (uint32_t i = begin; i < end; ++i) {
      push_point(L, solid.positions[solid.loop_vertices[i]]);
      lua_rawseti(L, -2, static_cast<lua_Integer>(i - begin + 1));
    }
    lua_rawseti(L, -2, static_cast<lua_Integer>(l + 1));
  }
  lua_setfield(L, -2, "loops");
}

int faces(lua_State* L) {
  SolidValue& value = solid_argument(L, kFaces);
  const Arguments arguments(L, kFaces, 2);
  const auto wanted = arguments.vector("normal"), through = arguments.vector("through");
  if (wanted && wanted->v == glm::dvec3(0, 0, 0)) fail_in(kFaces, "option 'normal' must not be 0");
  const double angle = arguments.number("angle", kDirectionDegrees);
  if (angle > 180)
    fail_in(kFaces, fmt::format("option 'angle' must be at most 180, got {:.14g}", angle));
  const double least = cos_deg(angle);
  const Solid& solid = session_of(L).evaluated(value);
  std::vector<FaceSum> sums(solid.faces.size());
  for (size_t t = 0; t < solid.triangles.size(); ++t) {
    const auto& corners = solid.triangles[t];
    const glm::dvec3 &a = solid.positions[corners[0]], &b = solid.positions[corners[1]],
                     &c = solid.positions[corners[2]];
    const double area = glm::length(glm::cross(b - a, c - a)) / 2;
    sums[solid.triangle_face[t]].area += area;
    const glm::dvec3 corner = first_corner(solid, solid.faces[solid.triangle_face[t]]);
    sums[solid.triangle_face[t]].moments += area * ((a - corner) + (b - corner) + (c - corner));
  }
  lua_newtable(L);
  lua_Integer count = 0;
  for (size_t f = 0; f < solid.faces.size(); ++f) {
    if (!(sums[f].area > 0)) continue;
    const glm::dvec3 normal = glm::normalize(solid.face_normals[f]);
    if (wanted && glm::dot(normal, glm::normalize(wanted->v)) < least) continue;
    const glm::dvec3& corner = first_corner(solid, solid.faces[f]);
    if (through && std::abs(glm::dot(normal, through->v - corner)) > kNearPlane) continue;
    push_face(L, solid, solid.faces[f], normal, sums[f]);
    lua_rawseti(L, -2, ++count);
  }
  return 1;
}

constexpr Option kRayOptions[] = {
    {"from", T::kVector3, "", "where it starts", true},
    {"direction", T::kVector3, "", "where it goes", true},
};
constexpr FunctionSpec kRay{
    "ray",
    "Where a ray passes its surface, from the start on: each {distance, point, normal, entering}.",
    kRayOptions, false, "part:ray({-5, 5, 5}, {1, 0, 0})[1].distance"};

/// Where the line of the ray meets a triangle.
struct Hit {
  double distance = 0;
  glm::dvec3 normal{0};
  double facing = 0;      ///< the normal along the ray: below 0 where the ray enters
  bool is_clear = false;  ///< doubles tell that it is within the triangle and not along it
};

/// So near to one another hits are at one place.
bool is_one_place(double distance, double next) {
  constexpr double kOnePlace = 1e-9;
  return next - distance <= kOnePlace * (1 + distance);
}

/// A triangle is a little larger than it is, so that no ray slips through between two.
constexpr double kMargin = 1e-12;

/// No less than that of the vector.
double length(const glm::dvec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

enum class Meeting : uint8_t { kNone, kNearly, kHit };

/// Moeller and Trumbore (1997); edges belong to both triangles. kNearly: doubles do not tell.
Meeting meet(const glm::dvec3& from, const glm::dvec3& along, const glm::dvec3& a,
             const glm::dvec3& b, const glm::dvec3& c, Hit& hit) {
  const glm::dvec3 p = glm::cross(along, c - a);
  const double det = glm::dot(b - a, p);
  if (det == 0) return Meeting::kNone;  // beside it, or in its plane
  const glm::dvec3 s = from - a;
  const double u = glm::dot(s, p) / det;
  const glm::dvec3 q = glm::cross(s, b - a);
  const double v = glm::dot(along, q) / det;
  const double least = std::min({u, v, 1 - u - v});
  // Of u and v: a few roundings of products of these lengths, far below this.
  const double error = 1e-14 * (length(a) + length(s)) * (length(b - a) + length(c - a));
  const double clear = 1e-6 + error / std::fabs(det);
  if (!(least >= -clear)) return Meeting::kNone;
  hit.distance = glm::dot(c - a, q) / det;
  hit.is_clear = least > clear;
  if (least < -kMargin) return Meeting::kNearly;
  if (hit.distance >= 0) return Meeting::kHit;
  return is_one_place(0, -hit.distance) ? Meeting::kNearly : Meeting::kNone;
}

struct Hits {
  std::vector<Hit> found;  ///< by distance
  bool is_any_near = false;
};

Hits all_hits(const Solid& solid, const glm::dvec3& from, const glm::dvec3& along) {
  Hits hits;
  for (size_t t = 0; t < solid.triangles.size(); ++t) {
    const auto& corners = solid.triangles[t];
    Hit hit;
    const Meeting how = meet(from, along, solid.positions[corners[0]], solid.positions[corners[1]],
                             solid.positions[corners[2]], hit);
    hits.is_any_near |= how == Meeting::kNearly;
    if (how != Meeting::kHit) continue;
    hit.normal = glm::normalize(solid.face_normals[solid.triangle_face[t]]);
    hit.facing = glm::dot(hit.normal, along);
    constexpr double kLeastFacing = 1e-6;
    hit.is_clear = hit.is_clear && std::fabs(hit.facing) > kLeastFacing;
    hits.found.push_back(hit);
  }
  std::stable_sort(hits.found.begin(), hits.found.end(),
                   [](const Hit& a, const Hit& b) { return a.distance < b.distance; });
  return hits;
}

/// That of the hits, which are at one place, which faces most as the ray passes; null if none does.
const Hit* passed(std::span<const Hit> place, bool entering) {
  const Hit* best = nullptr;
  for (const Hit& hit : place) {
    const bool fits = entering ? hit.facing < 0 : hit.facing > 0;
    if (fits && (best == nullptr || std::fabs(hit.facing) > std::fabs(best->facing))) best = &hit;
  }
  return best;
}

/// Whether the ray passes the surface in one triangle at each place, in and out by turns: then the
/// way these face says all. The last one is passed outwards, as all solids end somewhere.
bool are_plain(const Hits& hits) {
  const std::vector<Hit>& found = hits.found;
  if (hits.is_any_near) return false;
  for (size_t i = 0; i < found.size(); ++i) {
    const double before = i > 0 ? found[i - 1].distance : 0;
    const bool leaves = (found.size() - i) % 2 != 0;
    if (!found[i].is_clear || is_one_place(before, found[i].distance) ||
        leaves != (found[i].facing > 0)) {
      return false;
    }
  }
  return true;
}

int ray(lua_State* L) {
  SolidValue& value = solid_argument(L, kRay);
  const Arguments arguments(L, kRay, 2);
  const auto from = arguments.vector("from"), direction = arguments.vector("direction");
  if (!from || !direction) fail_in(kRay, "needs where it starts and where it goes");
  if (direction->v == glm::dvec3(0, 0, 0)) fail_in(kRay, "option 'direction' must not be 0");
  const glm::dvec3 along = glm::normalize(direction->v);
  Session& session = session_of(L);
  const Hits hits = all_hits(session.evaluated(value), from->v, along);
  const std::vector<Hit>& found = hits.found;
  // What the triangles of a place say where an edge or a corner is met is anything: whether the ray
  // enters or leaves there is told by what it is in before and after.
  const bool is_plain = are_plain(hits);
  const auto is_inside = [&](double distance) {
    if (is_plain) {
      const auto next = std::find_if(found.begin(), found.end(),
                                     [&](const Hit& hit) { return hit.distance > distance; });
      return (found.end() - next) % 2 != 0;
    }
    const EvaluationScope scope(session.budget());
    const auto side = session.evaluator().contains(value.node, from->v + distance * along);
    if (!side) session.fail_evaluation(side.error());
    return *side >= 0;
  };
  lua_newtable(L);
  lua_Integer count = 0;
  bool was_inside = false;
  for (size_t begin = 0, end = 0; begin < found.size(); begin = end) {
    const double distance = found[begin].distance;
    while (end < found.size() && is_one_place(distance, found[end].distance)) ++end;
    const auto place = std::span(found).subspan(begin, end - begin);
    const bool starts_here = begin == 0 && is_one_place(0, distance);
    // What runs in a face's plane may come in unseen.
    if (begin == 0 && !starts_here) was_inside = is_inside(distance / 2) && is_inside(0);
    const bool is_in =
        end < found.size() && is_inside((found[end - 1].distance + found[end].distance) / 2);
    // A start on the surface is passed as the ray goes on.
    const bool is_passed =
        starts_here ? is_in || passed(place, false) != nullptr : is_in != was_inside;
    was_inside = is_in;
    if (!is_passed) continue;
    const Hit* hit = passed(place, is_in);
    if (hit == nullptr) hit = &place.front();
    lua_createtable(L, 0, 4);
    lua_pushnumber(L, hit->distance + 0.0);  // never -0
    lua_setfield(L, -2, "distance");
    push_point(L, from->v + hit->distance * along);
    lua_setfield(L, -2, "point");
    push_point(L, hit->normal);
    lua_setfield(L, -2, "normal");
    lua_pushboolean(L, is_in ? 1 : 0);
    lua_setfield(L, -2, "entering");
    lua_rawseti(L, -2, ++count);
  }
  return 1;
}

constexpr Option kGapOptions[] = {{"other", T::kValue, "", "the other solid", true}};
constexpr FunctionSpec kGap{"gap",
                            "How far it is from another solid: 0 where they touch or overlap.",
                            kGapOptions, false, "part:gap(cube(1):translate(20, 0, 0))"};

int gap(lua_State* L) {
  SolidValue& value = solid_argument(L, kGap);
  const Arguments arguments(L, kGap, 2);
  const int index = arguments.stack_index("other");
  SolidValue* other = index == 0 ? nullptr : to_solid(L, index);
  if (index == 0) fail_in(kGap, "needs the other solid");
  if (other == nullptr)
    fail_in(kGap, "option 'other' must be a solid, got " + describe_value(L, index));
  Session& session = session_of(L);
  const Solid &a = session.evaluated(value), &b = session.evaluated(*other);
  if (a.empty() || b.empty()) fail_in(kGap, "there is nothing in one of them");
  // What is inside of the other crosses nothing; the Boolean knows.
  const NodePtr common = Node::boolean(BooleanOp::kIntersection, {value.node, other->node});
  double length = 0;
  if (session.extent(SolidValue(common)).empty) {
    length = surface_distance({a.positions, a.triangles}, {b.positions, b.triangles}).length;
  }
  // Corners are rounded: what is nearer than they tell touches.
  double reach = 0;
  for (const Solid* solid : {&a, &b}) {
    for (const glm::dvec3& p : solid->positions) {
      reach = std::max({reach, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    }
  }
  lua_pushnumber(L, length <= 8 * std::numeric_limits<double>::epsilon() * reach ? 0 : length);
  return 1;
}

constexpr Binding kSelectingBindings[] = {
    {&kFaces, nullptr, guarded<faces>, nullptr},
    {&kRay, nullptr, guarded<ray>, nullptr},
    {&kGap, nullptr, guarded<gap>, nullptr},
};

}  // namespace

std::span<const Binding> selecting_bindings() { return kSelectingBindings; }

}  // namespace csgrun
