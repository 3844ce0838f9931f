// Repair of holes: the loops of edges that are missing, and the triangles that close them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "engine/base/none.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/mesh_text.h"
#include "engine/mesh/repair_steps.h"

namespace csgrun {
namespace {

/// Longer loops are closed by one polygon: n^3 / 6 triangles are looked at.
constexpr size_t kLongestByArea = 256;

/// The directed edges that faces must still run through, and how often, by where they start and
/// then by where they end.
class MissingEdges {
 public:
  explicit MissingEdges(const RepairMesh& mesh) : starts_(mesh.points.size() + 1, 0) {
    struct Missing {
      EdgeUse use;
      uint32_t left;
    };
    std::vector<Missing> missing;
    EdgeUses(mesh.faces, mesh.points.size()).for_each_edge([&](std::span<const EdgeUse> uses) {
      const int64_t sum = excess(uses);
      const EdgeUse reverse{uses[0].low, uses[0].high, 0, sum < 0};
      if (sum != 0) missing.push_back({reverse, static_cast<uint32_t>(std::abs(sum))});
    });
    for (const Missing& edge : missing) ++starts_[edge.use.from() + 1];
    for (size_t v = 1; v < starts_.size(); ++v) starts_[v] += starts_[v - 1];
    edges_.resize(missing.size());
    std::vector<size_t> next = starts_;
    for (const Missing& edge : missing)
      edges_[next[edge.use.from()]++] = {edge.use.to(), edge.left};
    for (size_t v = 0; v + 1 < starts_.size(); ++v) {
      std::sort(edges_.begin() + static_cast<std::ptrdiff_t>(starts_[v]),
                edges_.begin() + static_cast<std::ptrdiff_t>(starts_[v + 1]),
                [](const Edge& a, const Edge& b) { return a.to < b.to; });
    }
    first_left_.assign(starts_.begin(), starts_.end() - 1);
    previous_.resize(mesh.points.size(), kNone);
  }

  /// The vertices where missing edges start, those with most of them first: around them searches
  /// are short, while a search that came through one would have to look at all of its edges.
  [[nodiscard]] std::vector<uint32_t> busiest_first() const {
    const auto edges_at = [&](uint32_t v) { return starts_[v + 1] - starts_[v]; };
    std::vector<uint32_t> order;
    for (uint32_t v = 0; v + 1 < starts_.size(); ++v) {
      if (edges_at(v) > 0) order.push_back(v);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return edges_at(a) > edges_at(b); });
    return order;
  }

  /// Takes the shortest loop out that starts with the first edge left at `v`; empty when there is
  /// none.
  HoleLoop take_loop(uint32_t v) {
    const size_t first = first_left(v);
    if (first == starts_[v + 1]) return {};
    // Breadth first, back to v. The missing edges that leave a vertex are as many as those that
    // reach it, so v is found.
    std::vector<uint32_t> reached;
    const auto reach = [&](uint32_t u, uint32_t from) {
      previous_[u] = from;
      reached.push_back(u);
      if (is_left(u, v)) previous_[v] = u;
      return previous_[v] != kNone;
    };
    bool is_found = reach(edges_[first].to, v);
    for (size_t i = 0; i < reached.size() && !is_found; ++i) {
      for (size_t e = first_left(reached[i]); e < starts_[reached[i] + 1] && !is_found; ++e) {
        if (edges_[e].left == 0 || previous_[edges_[e].to] != kNone) continue;
        is_found = reach(edges_[e].to, reached[i]);
      }
    }
    HoleLoop loop;
    if (previous_[v] != kNone) {
      for (uint32_t at = previous_[v]; at != v; at = previous_[at]) loop.push_back(at);
      loop.push_back(v);
      std::reverse(loop.begin(), loop.end());
      for (size_t i = 0; i < loop.size(); ++i) use(loop[i], loop[(i + 1) % loop.size()]);
    }
    previous_[v] = kNone;
    for (const uint32_t u : reached) previous_[u] = kNone;
    return loop;
  }

 private:
  struct Edge {
    uint32_t to;
    uint32_t left;  ///< how often it is still missing
  };

  /// The first edge from `v` that is still missing, or the end of its edges.
  size_t first_left(uint32_t v) {
    size_t& e = first_left_[v];
    while (e < starts_[v + 1] && edges_[e].left == 0) ++e;
    return e;
  }
  /// The edge by its ends, or the first one behind it.
  [[nodiscard]] size_t find(uint32_t from, uint32_t to) const {
    const auto begin = edges_.begin() + static_cast<std::ptrdiff_t>(starts_[from]);
    const auto end = edges_.begin() + static_cast<std::ptrdiff_t>(starts_[from + 1]);
    return static_cast<size_t>(
        std::lower_bound(begin, end, to, [](const Edge& e, uint32_t v) { return e.to < v; }) -
        edges_.begin());
  }
  [[nodiscard]] bool is_left(uint32_t from, uint32_t to) const {
    const size_t e = find(from, to);
    return e < starts_[from + 1] && edges_[e].to == to && edges_[e].left > 0;
  }
  void use(uint32_t from, uint32_t to) { --edges_[find(from, to)].left; }

  std::vector<size_t> starts_;
  std::vector<Edge> edges_;
  std::vector<size_t> first_left_;  ///< by vertex: edges before it are used up
  std::vector<uint32_t> previous_;  ///< of the search; kNone: not reached
};

double square_of(const glm::dvec3& v) { return v.x * v.x + v.y * v.y + v.z * v.z; }

double triangle_cost(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  // Loops in a plane have many triangulations of least area: short edges are nicer.
  constexpr double kWeightOfEdges = 0x1p-10;
  const glm::dvec3 u = b - a, v = c - a;
  const glm::dvec3 cross(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
  return std::sqrt(square_of(cross)) +
         kWeightOfEdges * (square_of(u) + square_of(v) + square_of(c - b));
}

}  // namespace

std::vector<HoleLoop> find_holes(const RepairMesh& mesh) {
  MissingEdges missing(mesh);
  std::vector<HoleLoop> holes;
  for (const uint32_t v : missing.busiest_first()) {
    for (HoleLoop loop = missing.take_loop(v); !loop.empty(); loop = missing.take_loop(v)) {
      std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
      holes.push_back(std::move(loop));
    }
  }
  std::stable_sort(holes.begin(), holes.end(), [](const HoleLoop& a, const HoleLoop& b) {
    return a[0] != b[0] ? a[0] < b[0] : a[1] < b[1];
  });
  return holes;
}

std::vector<std::vector<uint32_t>> triangulate_hole(const std::vector<glm::dvec3>& points,
                                                    const HoleLoop& hole) {
  // best[i * n + j]: the least cost of the part of the loop from i to j; middle: the third corner
  // of the triangle on the chord (Barequet and Sharir 1995).
  const size_t n = hole.size();
  std::vector<double> best(n * n, 0);
  std::vector<uint32_t> middle(n * n, 0);
  for (size_t length = 2; length < n; ++length) {
    for (size_t i = 0; i + length < n; ++i) {
      const size_t j = i + length;
      best[i * n + j] = std::numeric_limits<double>::infinity();
      middle[i * n + j] = static_cast<uint32_t>(i + 1);
      for (size_t k = i + 1; k < j; ++k) {
        const double cost = best[i * n + k] + best[k * n + j] +
                            triangle_cost(points[hole[i]], points[hole[k]], points[hole[j]]);
        if (!(cost < best[i * n + j])) continue;
        best[i * n + j] = cost;
        middle[i * n + j] = static_cast<uint32_t>(k);
      }
    }
  }
  std::vector<std::vector<uint32_t>> triangles;
  std::vector<std::pair<size_t, size_t>> chords{{0, n - 1}};
  while (!chords.empty()) {
    const auto [i, j] = chords.back();
    chords.pop_back();
    if (j - i < 2) continue;
    const size_t k = middle[i * n + j];
    triangles.push_back({hole[i], hole[k], hole[j]});
    chords.emplace_back(k, j);
    chords.emplace_back(i, k);
  }
  return triangles;
}

std::string hole_text(const RepairMesh& mesh, const HoleLoop& hole) {
  glm::dvec3 lo = mesh.points[hole[0]], hi = lo;
  for (const uint32_t v : hole) {
    for (int i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], mesh.points[v][i]);
      hi[i] = std::max(hi[i], mesh.points[v][i]);
    }
  }
  return std::to_string(hole.size()) + " edges at " + rough_place_text(lo + (hi - lo) * 0.5);
}

void fill_holes(RepairMesh& mesh, const std::vector<HoleLoop>& holes, StepNote& note) {
  std::vector<uint32_t> face_at(mesh.points.size(), kNone);
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    for (const auto& loop : mesh.faces[f].loops) {
      for (const uint32_t v : loop) face_at[v] = std::min(face_at[v], f);
    }
  }
  for (const HoleLoop& hole : holes) {
    note.add(hole_text(mesh, hole));
    const LoopFace& beside = mesh.faces[face_at[hole[0]]];
    LoopFace filler{{}, 0, 0, beside.appearance};
    std::vector<std::vector<uint32_t>> pieces{hole};
    if (hole.size() <= kLongestByArea) pieces = triangulate_hole(mesh.points, hole);
    for (std::vector<uint32_t>& piece : pieces) {
      filler.loops = {std::move(piece)};
      mesh.faces.push_back(filler);
      ++note.step().faces;
    }
  }
}

}  // namespace csgrun
