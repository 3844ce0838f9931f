// Greatest common divisors take nearly all of the time, waiting for one step after another: those
// of a few triangles are found side by side.
#include "engine/mesh/triangle_normals.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "engine/bsp/grid_planes.h"

namespace csgrun {
namespace {

constexpr size_t kLanes = 4;
using Lanes = std::array<uint64_t, kLanes>;
using Normal = std::array<int64_t, 3>;

/// gcd(a[i], b[i]), Stein's way; gcd(0, b) is b.
Lanes divisors(Lanes a, Lanes b) {
  Lanes shift{};
  for (size_t i = 0; i < kLanes; ++i) {
    if (a[i] == 0) std::swap(a[i], b[i]);
    shift[i] = a[i] | b[i] ? static_cast<uint64_t>(std::countr_zero(a[i] | b[i])) : 0;
    if (a[i] != 0) a[i] >>= std::countr_zero(a[i]);
  }
  for (uint64_t left = 1; left != 0;) {
    left = 0;
    for (size_t i = 0; i < kLanes; ++i) {
      // A lane that is done has b = 0 and stays as it is.
      uint64_t odd = b[i] != 0 ? b[i] : a[i];
      odd >>= std::countr_zero(odd | uint64_t{1} << 63);
      b[i] = a[i] > odd ? a[i] - odd : odd - a[i];
      a[i] = std::min(a[i], odd);
      left |= b[i];
    }
  }
  for (size_t i = 0; i < kLanes; ++i) a[i] <<= shift[i];
  return a;
}

/// Stored planes have their first component positive, and the rest of them is turned with it.
bool is_turned(const Normal& n) { return n[0] != 0 ? n[0] < 0 : n[1] != 0 ? n[1] < 0 : n[2] < 0; }

glm::dvec3 reduced(const Normal& n, int64_t divisor) {
  const bool turned = is_turned(n);
  glm::dvec3 normal;
  for (int k = 0; k < 3; ++k) {
    int64_t stored = turned ? -n[k] : n[k];
    if (divisor != 1) stored /= divisor;
    normal[k] = turned ? -static_cast<double>(stored) : static_cast<double>(stored);
  }
  return normal;
}

/// Of a triangle whose normal may need more than 64 bits.
glm::dvec3 wide_normal(const IVec3& p, const IVec3& q, const IVec3& r) {
  PlaneTable table;
  const PlaneId plane = table.intern(plane_through(p, q, r));
  const auto& n = table.approximate(plane.index());
  const glm::dvec3 normal(n[0], n[1], n[2]);
  return plane.flipped() ? -normal : normal;
}

/// Whether corners are near enough to the first one for a normal below 2^63.
bool is_compact(const IVec3& p, const IVec3& q, const IVec3& r) {
  constexpr int64_t kNear = int64_t{1} << 30;
  bool all = true;
  for (size_t k = 0; k < 3; ++k) {
    all = all && std::abs(q[k] - p[k]) < kNear && std::abs(r[k] - p[k]) < kNear;
  }
  return all;
}

}  // namespace

std::vector<glm::dvec3> outward_normals(const BoundaryMesh& boundary,
                                        std::span<const UntouchedTriangle> triangles) {
  std::vector<glm::dvec3> normals(triangles.size());
  for (size_t first = 0; first < triangles.size(); first += kLanes) {
    const size_t count = std::min(kLanes, triangles.size() - first);
    std::array<Normal, kLanes> normal{};
    Lanes a{}, b{};
    for (size_t i = 0; i < count; ++i) {
      const UntouchedTriangle& t = triangles[first + i];
      const UntouchedPart& part = boundary.parts[t.part];
      const auto corners = part.triangle(t.face);
      // Moving a triangle does not turn it.
      const IVec3 &p = part.leaf->vertices[corners[0]], &q = part.leaf->vertices[corners[1]],
                  &r = part.leaf->vertices[corners[2]];
      if (!is_compact(p, q, r)) {
        normals[first + i] = wide_normal(p, q, r);
        continue;
      }
      const int64_t ux = q[0] - p[0], uy = q[1] - p[1], uz = q[2] - p[2];
      const int64_t vx = r[0] - p[0], vy = r[1] - p[1], vz = r[2] - p[2];
      normal[i] = {uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
      a[i] = static_cast<uint64_t>(std::abs(normal[i][0]));
      b[i] = static_cast<uint64_t>(std::abs(normal[i][1]));
    }
    const Lanes divisor = divisors(a, b);
    for (size_t i = 0; i < count; ++i) {
      if (normal[i] == Normal{}) continue;  // it was wide
      auto whole = static_cast<int64_t>(divisor[i]);
      if (whole != 1) whole = std::gcd(whole, normal[i][2]);
      normals[first + i] = reduced(normal[i], whole);
    }
  }
  return normals;
}

}  // namespace csgrun
