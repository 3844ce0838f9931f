#include "export/clean_triangles.h"

#include <algorithm>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace csgrun {

CleanTriangles::CleanTriangles(const RoundedMesh& mesh,
                               std::span<const TriangleCrossing> crossings) {
  std::vector<bool> crosses(mesh.triangles.size(), false);
  for (const TriangleCrossing& crossing : crossings) {
    for (const uint32_t t : crossing.triangles) crosses[t] = true;
  }
  keys_.reserve(mesh.triangles.size());
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!crosses[t]) keys_.push_back(key(mesh, t));
  }
  std::sort(keys_.begin(), keys_.end());
}

std::vector<uint32_t> CleanTriangles::others(const RoundedMesh& mesh) const {
  struct Keyed {
    Key key;
    uint32_t triangle;
  };
  std::vector<Keyed> own;
  own.reserve(mesh.triangles.size());
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) own.push_back({key(mesh, t), t});
  std::sort(own.begin(), own.end(), [](const Keyed& a, const Keyed& b) { return a.key < b.key; });
  std::vector<uint32_t> result;
  for (size_t i = 0, end = 0; i < own.size(); i = end) {
    while (end < own.size() && own[end].key == own[i].key) ++end;
    if (end - i == 1 && std::binary_search(keys_.begin(), keys_.end(), own[i].key)) continue;
    for (size_t k = i; k < end; ++k) result.push_back(own[k].triangle);
  }
  std::sort(result.begin(), result.end());
  return result;
}

CleanTriangles::Key CleanTriangles::key(const RoundedMesh& mesh, uint32_t triangle) {
  std::array<std::array<double, 3>, 3> corners;
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3& p = mesh.positions[mesh.triangles[triangle][i]];
    corners[i] = {p.x, p.y, p.z};
  }
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  const XXH128_hash_t hash = XXH3_128bits(corners.data(), sizeof corners);
  return {hash.high64, hash.low64};
}

}  // namespace csgrun
