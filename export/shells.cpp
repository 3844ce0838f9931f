#include "export/shells.h"

#include <algorithm>
#include <utility>

#include "export/none.h"

namespace csgrun {
namespace {

/// Per half-edge 3 t + i: the one other triangle at that edge, kNone where there are more.
std::vector<uint32_t> lone_neighbours(std::span<const std::array<uint32_t, 3>> triangles) {
  std::vector<std::pair<uint64_t, uint32_t>> edges;  // ends -> half-edge
  edges.reserve(3 * triangles.size());
  for (uint32_t h = 0; h < 3 * triangles.size(); ++h) {
    const uint64_t a = triangles[h / 3][h % 3], b = triangles[h / 3][(h + 1) % 3];
    edges.emplace_back(std::min(a, b) << 32 | std::max(a, b), h);
  }
  std::sort(edges.begin(), edges.end());
  std::vector<uint32_t> neighbours(edges.size(), kNone);
  for (size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && edges[end].first == edges[i].first) ++end;
    if (end != i + 2) continue;
    neighbours[edges[i].second] = edges[i + 1].second / 3;
    neighbours[edges[i + 1].second] = edges[i].second / 3;
  }
  return neighbours;
}

/// The first triangle with area of each sheet.
std::vector<uint32_t> firsts_of_sheets(const TriangleView& mesh) {
  const std::vector<uint32_t> neighbours = lone_neighbours(mesh.triangles);
  std::vector<bool> seen(mesh.triangles.size(), false);
  std::vector<uint32_t> firsts, queue;
  for (uint32_t t = 0; t < seen.size(); ++t) {
    if (seen[t]) continue;
    seen[t] = true;
    queue.assign(1, t);
    uint32_t first = kNone;
    while (!queue.empty()) {
      const uint32_t at = queue.back();
      queue.pop_back();
      if (at < first && !is_degenerate(mesh, at)) first = at;
      for (uint32_t h = 3 * at; h < 3 * at + 3; ++h) {
        const uint32_t next = neighbours[h];
        if (next == kNone || seen[next]) continue;
        seen[next] = true;
        queue.push_back(next);
      }
    }
    if (first != kNone) firsts.push_back(first);
  }
  std::sort(firsts.begin(), firsts.end());
  return firsts;
}

}  // namespace

std::vector<uint32_t> inverted_sheets(const TriangleView& mesh) {
  const std::vector<uint32_t> firsts = firsts_of_sheets(mesh);
  const std::vector<int> windings = windings_in_front(mesh, firsts);
  std::vector<uint32_t> inverted;
  for (size_t i = 0; i < firsts.size(); ++i) {
    if (windings[i] != 0) inverted.push_back(firsts[i]);
  }
  return inverted;
}

}  // namespace csgrun
