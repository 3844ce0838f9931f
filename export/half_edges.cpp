#include "export/half_edges.h"

#include <algorithm>

#include "export/none.h"

namespace csgrun {
namespace {

struct Spoke {  // a half-edge in the list of its first vertex
  uint32_t target, half_edge;
  bool operator<(const Spoke& other) const {
    return target != other.target ? target < other.target : half_edge < other.half_edge;
  }
};

Error not_manifold(const std::string& what) {
  return {ErrorCode::kInternal, "the mesh to be written is not a closed manifold: " + what, {}};
}

std::string edge_name(uint32_t from, uint32_t to) {
  return std::to_string(from) + "->" + std::to_string(to);
}

}  // namespace

Result<std::vector<uint32_t>> manifold_twins(std::span<const Triangle> triangles,
                                             size_t vertex_count) {
  const size_t count = 3 * triangles.size();
  std::vector<uint32_t> starts(vertex_count + 1, 0);
  for (const Triangle& t : triangles) {
    for (const uint32_t v : t) {
      if (v >= vertex_count) return not_manifold("vertex " + std::to_string(v) + " does not exist");
      ++starts[v + 1];
    }
  }
  for (size_t v = 0; v < vertex_count; ++v) starts[v + 1] += starts[v];

  std::vector<Spoke> spokes(count);
  std::vector<uint32_t> fill(starts.begin(), starts.end() - 1);
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t from = triangles[t][i], to = triangles[t][(i + 1) % 3];
      if (from == to)
        return not_manifold("a triangle uses vertex " + std::to_string(to) + " twice");
      spokes[fill[from]++] = {to, 3 * t + i};
    }
  }
  for (size_t v = 0; v < vertex_count; ++v) {
    std::sort(spokes.begin() + starts[v], spokes.begin() + starts[v + 1]);
    for (uint32_t s = starts[v] + 1; s < starts[v + 1]; ++s) {
      if (spokes[s].target == spokes[s - 1].target) {
        return not_manifold("edge " + edge_name(static_cast<uint32_t>(v), spokes[s].target) +
                            " occurs twice");
      }
    }
  }

  std::vector<uint32_t> twins(count);
  for (uint32_t v = 0; v < vertex_count; ++v) {
    for (uint32_t s = starts[v]; s < starts[v + 1]; ++s) {
      const uint32_t to = spokes[s].target;
      const auto begin = spokes.begin() + starts[to], end = spokes.begin() + starts[to + 1];
      const auto found = std::lower_bound(begin, end, Spoke{v, 0});
      if (found == end || found->target != v) {
        return not_manifold("edge " + edge_name(v, to) + " has no reverse");
      }
      twins[spokes[s].half_edge] = found->half_edge;
    }
  }

  for (uint32_t v = 0; v < vertex_count; ++v) {
    if (starts[v] == starts[v + 1]) continue;
    const uint32_t first = spokes[starts[v]].half_edge;
    uint32_t fan = 0;
    uint32_t h = first;
    do {
      h = twins[previous_in_triangle(h)];
      ++fan;
    } while (h != first);
    if (fan != starts[v + 1] - starts[v]) {
      return not_manifold("vertex " + std::to_string(v) + " has several fans");
    }
  }
  return twins;
}

std::vector<uint32_t> shells_of(std::span<const uint32_t> twins) {
  const size_t triangle_count = twins.size() / 3;
  std::vector<uint32_t> shell(triangle_count, kNone);
  std::vector<uint32_t> stack;
  uint32_t shells = 0;
  for (uint32_t seed = 0; seed < triangle_count; ++seed) {
    if (shell[seed] != kNone) continue;
    shell[seed] = shells;
    stack.push_back(seed);
    while (!stack.empty()) {
      const uint32_t t = stack.back();
      stack.pop_back();
      for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        const uint32_t neighbour = twins[h] / 3;
        if (shell[neighbour] != kNone) continue;
        shell[neighbour] = shells;
        stack.push_back(neighbour);
      }
    }
    ++shells;
  }
  return shell;
}

}  // namespace csgrun
