#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <csgrun/engine/validate.h>
#include <csgrun/primitives/freeform.h>

#include "primitives/base/text.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

using Triangle = std::array<uint32_t, 3>;

/// Numbers for edges, whichever way they are run.
class EdgeNumbers {
 public:
  explicit EdgeNumbers(size_t expected) { numbers_.reserve(expected); }
  /// The value of an edge, made by `make` the first time.
  template <class Make>
  uint32_t get(uint32_t a, uint32_t b, Make make) {
    const uint64_t key = uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    const auto [entry, is_new] = numbers_.try_emplace(key, 0);
    if (is_new) entry->second = make(std::min(a, b), std::max(a, b));
    return entry->second;
  }

 private:
  std::unordered_map<uint64_t, uint32_t> numbers_;  // only looked up
};

Triangle triangle(const PolygonMesh& mesh, size_t face) {
  return {mesh.corners[3 * face], mesh.corners[3 * face + 1], mesh.corners[3 * face + 2]};
}

/// Refining makes no more points than this: with their triangles they take a minute to be evaluated.
constexpr double kMostRefined = 1 << 22;

/// Whether halving edges until none is longer makes more than kMostRefined: each triangle is divided
/// as often as its shortest edge must be halved, at least, and each time all three are it has four
/// for one.
bool halvings_make_too_many(const PolygonMesh& mesh, double length) {
  double triangles = 0;
  for (size_t f = 0; f < mesh.face_count(); ++f) {
    const Triangle t = triangle(mesh, f);
    double shortest = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < 3; ++i)
      shortest = std::min(shortest, glm::length(mesh.points[t[(i + 1) % 3]] - mesh.points[t[i]]));
    double parts = 1;
    for (; shortest > length; shortest /= 2) parts *= 4;
    triangles += parts;
  }
  return triangles / 2 > kMostRefined;  // a closed mesh has half as many points as triangles
}

/// The mesh without its faces.
PolygonMesh without_faces(const PolygonMesh& mesh) {
  PolygonMesh result;
  result.points = mesh.points;
  result.appearances = mesh.appearances;
  result.fill = mesh.fill;
  result.kind = mesh.kind;
  result.keep_facets = true;
  return result;
}

void add_part(PolygonMesh& mesh, const Triangle& t, const PolygonMesh& from, size_t face) {
  mesh.add_face(t, from.surface[face]);
  mesh.appearance_of.push_back(from.appearance_of[face]);
}

}  // namespace

PolygonMesh mesh_of_solid(const Solid& solid, std::span<const uint32_t> triangles,
                          std::string kind) {
  PolygonMesh mesh;
  mesh.kind = std::move(kind);
  mesh.appearances = solid.appearances;
  std::vector<uint32_t> number(solid.positions.size(), UINT32_MAX);
  for (const uint32_t t : triangles) {
    Triangle face{};
    for (size_t i = 0; i < 3; ++i) {
      uint32_t& n = number[solid.triangles[t][i]];
      if (n == UINT32_MAX) {
        n = static_cast<uint32_t>(mesh.points.size());
        mesh.points.push_back(solid.positions[solid.triangles[t][i]]);
      }
      face[i] = n;
    }
    const Solid::Face& from = solid.faces[solid.triangle_face[t]];
    mesh.add_face(face, from.surface);
    mesh.appearance_of.push_back(from.appearance);
  }
  return mesh;
}

PolygonMesh mesh_of_solid(const Solid& solid, std::string kind) {
  std::vector<uint32_t> all(solid.triangles.size());
  for (uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  return mesh_of_solid(solid, all, std::move(kind));
}

MeshResult refine_mesh(PolygonMesh mesh, double length) {
  if (!std::isfinite(length)) return not_finite("refine", "length", length);
  if (!(length > 0)) return not_positive("refine", "length", length);
  mesh.keep_facets = true;
  const Error too_many{ErrorCode::kLimit, "refine: makes more than 4194304 points", {}};
  // A triangle without longer edges has at most the area of the one with all edges of that length.
  double area = 0;
  for (size_t f = 0; f < mesh.face_count(); ++f) {
    const Triangle t = triangle(mesh, f);
    area += glm::length(glm::cross(mesh.points[t[1]] - mesh.points[t[0]],
                                   mesh.points[t[2]] - mesh.points[t[0]])) /
            2;
  }
  if (area / (std::sqrt(3.0) / 4 * length * length) > 2 * kMostRefined) return too_many;
  if (halvings_make_too_many(mesh, length)) return too_many;
  while (true) {
    PolygonMesh next = without_faces(mesh);
    bool is_done = true;
    // An edge is halved or not whichever triangle looks at it, so that they still fit together.
    EdgeNumbers middles(mesh.corners.size());
    const auto middle = [&](uint32_t a, uint32_t b) {
      return middles.get(a, b, [&](uint32_t low, uint32_t high) {
        const glm::dvec3 p = mesh.points[low], q = mesh.points[high];
        if (glm::length(q - p) <= length) return UINT32_MAX;
        next.points.push_back(p + (q - p) / 2.0);
        return static_cast<uint32_t>(next.points.size() - 1);
      });
    };
    for (size_t f = 0; f < mesh.face_count(); ++f) {
      Triangle t = triangle(mesh, f);
      Triangle m{};
      int halved = 0;
      for (size_t i = 0; i < 3; ++i) {
        m[i] = middle(t[i], t[(i + 1) % 3]);
        halved += m[i] != UINT32_MAX ? 1 : 0;
      }
      if (halved > 0) is_done = false;
      if (halved == 3) {
        for (const Triangle& part : {Triangle{t[0], m[0], m[2]}, Triangle{m[0], t[1], m[1]},
                                     Triangle{m[2], m[1], t[2]}, Triangle{m[0], m[1], m[2]}}) {
          add_part(next, part, mesh, f);
        }
        continue;
      }
      // Turned so that the one edge that is halved, or that is not, comes first.
      for (int turn = 0; turn < 2 && (m[0] != UINT32_MAX) != (halved == 1); ++turn) {
        std::rotate(t.begin(), t.begin() + 1, t.end());
        std::rotate(m.begin(), m.begin() + 1, m.end());
      }
      if (halved == 0) {
        add_part(next, t, mesh, f);
      } else if (halved == 1) {
        add_part(next, {t[0], m[0], t[2]}, mesh, f);
        add_part(next, {m[0], t[1], t[2]}, mesh, f);
      } else {
        add_part(next, {m[2], m[1], t[2]}, mesh, f);
        add_part(next, {t[0], t[1], m[1]}, mesh, f);
        add_part(next, {t[0], m[1], m[2]}, mesh, f);
      }
    }
    if (is_done) return mesh;
    if (static_cast<double>(next.points.size()) > kMostRefined) return too_many;
    mesh = std::move(next);
  }
}

MeshResult smooth_mesh(PolygonMesh mesh, int rounds) {
  if (rounds < 1) return invalid_argument("smooth: rounds must be at least 1");
  // Each round adds a point for every two corners of triangles, and makes four corners of one: what
  // will be too many in the end is told before the first takes its time.
  const double corners_at_last =
      static_cast<double>(mesh.corners.size()) * std::ldexp(1.0, 2 * std::min(rounds - 1, 500));
  const Error too_many{ErrorCode::kLimit, "smooth: makes more than 16777216 points", {}};
  if (corners_at_last / 2 > kMostPoints) return too_many;
  // Of nothing no number of rounds makes more, so the limit would never end them.
  for (int round = 0; round < rounds && mesh.face_count() > 0; ++round) {
    const size_t count = mesh.points.size();
    if (static_cast<double>(mesh.points.size() + mesh.corners.size() / 2) > kMostPoints)
      return too_many;
    PolygonMesh next = without_faces(mesh);
    // An edge's point: three eighths of both ends and an eighth of both corners beside it. A
    // corner's: itself and the mean of its neighbours, by how many these are (Warren's weights).
    EdgeNumbers middles(mesh.corners.size());
    std::vector<glm::dvec3> around(count, glm::dvec3(0));
    std::vector<uint32_t> valence(count, 0);
    const auto middle = [&](uint32_t a, uint32_t b) {
      return middles.get(a, b, [&](uint32_t low, uint32_t high) {
        next.points.push_back((mesh.points[low] + mesh.points[high]) * 0.375);
        return static_cast<uint32_t>(next.points.size() - 1);
      });
    };
    for (size_t f = 0; f < mesh.face_count(); ++f) {
      const Triangle t = triangle(mesh, f);
      Triangle m{};
      for (size_t i = 0; i < 3; ++i) {
        const uint32_t a = t[i], b = t[(i + 1) % 3], opposite = t[(i + 2) % 3];
        m[i] = middle(a, b);
        next.points[m[i]] += mesh.points[opposite] * 0.125;
        around[a] += mesh.points[b];  // each neighbour once, over all triangles around
        ++valence[a];
      }
      for (const Triangle& part : {Triangle{t[0], m[0], m[2]}, Triangle{m[0], t[1], m[1]},
                                   Triangle{m[2], m[1], t[2]}, Triangle{m[0], m[1], m[2]}}) {
        next.add_face(part, 1);
        next.appearance_of.push_back(mesh.appearance_of[f]);
      }
    }
    for (size_t v = 0; v < count; ++v) {
      const auto n = static_cast<double>(valence[v]);
      const double beta = valence[v] == 3 ? 3.0 / 16 : 3.0 / (8 * n);
      next.points[v] = mesh.points[v] * (1 - n * beta) + around[v] * beta;
    }
    mesh = std::move(next);
  }
  return mesh;
}

MeshResult warp_mesh(PolygonMesh mesh,
                     const std::function<Result<glm::dvec3>(const glm::dvec3&)>& move) {
  for (glm::dvec3& p : mesh.points) {
    const Result<glm::dvec3> moved = move(p);
    if (!moved) return moved.error();
    for (int i = 0; i < 3; ++i) {
      if (!std::isfinite((*moved)[i])) return not_finite("warp", "a moved point", (*moved)[i]);
    }
    p = *moved;
  }
  // A volume of 0 says nothing: parts that are turned over count against the others.
  if (signed_volume(mesh) < 0) reverse_faces(mesh);
  return mesh;
}

}  // namespace csgrun
