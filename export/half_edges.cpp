#include "export/half_edges.h"

#include <algorithm>

#include "export/none.h"

namespace csgrun {
namespace {

/// A half-edge in the list of the lower one of its vertices.
struct Spoke {
  uint32_t higher, half_edge;
  bool operator<(const Spoke& other) const { return higher < other.higher; }
};

/// The half-edges between each vertex and higher ones, of one direction.
class Spokes {
 public:
  explicit Spokes(size_t vertex_count) : starts_(vertex_count + 2, 0) {}

  void count(uint32_t lower) { ++starts_[lower + 2]; }
  void make_room() {
    for (size_t v = 2; v < starts_.size(); ++v) starts_[v] += starts_[v - 1];
    spokes_.resize(starts_.back());
  }
  /// REQUIRES: counted, and there is room.
  void add(uint32_t lower, uint32_t higher, uint32_t half_edge) {
    spokes_[starts_[lower + 1]++] = {higher, half_edge};
  }
  /// Those of a vertex, when all were added.
  std::span<Spoke> of(uint32_t lower) {
    return std::span(spokes_).subspan(starts_[lower], starts_[lower + 1] - starts_[lower]);
  }

 private:
  /// By vertex; while spokes are added, where the next one goes is one further on.
  std::vector<uint32_t> starts_;
  std::vector<Spoke> spokes_;
};

Error not_manifold(const std::string& what) {
  return {ErrorCode::kInternal, "the mesh to be written is not a closed manifold: " + what, {}};
}

std::string edge_name(uint32_t from, uint32_t to) {
  return std::to_string(from) + "->" + std::to_string(to);
}

/// Glues the half-edges that run up from a vertex to those that come down to it; what is wrong, if
/// they do not fit.
std::string glue(uint32_t vertex, std::span<Spoke> up, std::span<Spoke> down,
                 std::vector<uint32_t>& twins) {
  std::sort(up.begin(), up.end());
  std::sort(down.begin(), down.end());
  for (size_t i = 1; i < up.size(); ++i) {
    if (up[i].higher == up[i - 1].higher) return edge_name(vertex, up[i].higher) + " occurs twice";
  }
  for (size_t i = 1; i < down.size(); ++i) {
    if (down[i].higher == down[i - 1].higher) {
      return edge_name(down[i].higher, vertex) + " occurs twice";
    }
  }
  for (size_t i = 0; i < std::max(up.size(), down.size()); ++i) {
    if (i == down.size() || (i < up.size() && up[i].higher < down[i].higher)) {
      return edge_name(vertex, up[i].higher) + " has no reverse";
    }
    if (i == up.size() || down[i].higher < up[i].higher) {
      return edge_name(down[i].higher, vertex) + " has no reverse";
    }
    twins[up[i].half_edge] = down[i].half_edge;
    twins[down[i].half_edge] = up[i].half_edge;
  }
  return {};
}

}  // namespace

Result<std::vector<uint32_t>> manifold_twins(std::span<const Triangle> triangles,
                                             size_t vertex_count) {
  Spokes up(vertex_count), down(vertex_count);
  std::vector<uint32_t> degree(vertex_count, 0);
  for (const Triangle& t : triangles) {
    for (const uint32_t v : t) {
      if (v >= vertex_count) return not_manifold("vertex " + std::to_string(v) + " does not exist");
    }
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t from = t[i], to = t[(i + 1) % 3];
      if (from == to) {
        return not_manifold("a triangle uses vertex " + std::to_string(to) + " twice");
      }
      ++degree[from];
      from < to ? up.count(from) : down.count(to);
    }
  }
  up.make_room();
  down.make_room();
  std::vector<uint32_t> leaving(vertex_count, kNone);  // a half-edge per vertex
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t from = triangles[t][i], to = triangles[t][(i + 1) % 3], h = 3 * t + i;
      from < to ? up.add(from, to, h) : down.add(to, from, h);
      leaving[from] = h;
    }
  }
  std::vector<uint32_t> twins(3 * triangles.size());
  for (uint32_t v = 0; v < vertex_count; ++v) {
    const std::string wrong = glue(v, up.of(v), down.of(v), twins);
    if (!wrong.empty()) return not_manifold("edge " + wrong);
  }
  for (uint32_t v = 0; v < vertex_count; ++v) {
    if (leaving[v] == kNone) continue;
    uint32_t fan = 0;
    uint32_t h = leaving[v];
    do {
      h = twins[previous_in_triangle(h)];
      ++fan;
    } while (h != leaving[v]);
    if (fan != degree[v]) return not_manifold("vertex " + std::to_string(v) + " has several fans");
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
