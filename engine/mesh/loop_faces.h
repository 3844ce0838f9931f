// Faces as lists of loops, for steps that change them: cleaning, splitting edges, and dropping what
// lies on a line, so that every directed edge stays as balanced as it was.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace csgrun {

/// A face while it is worked on: an outer loop and holes, by vertex, and its labels.
struct LoopFace {
  std::vector<std::vector<uint32_t>> loops;
  uint32_t facet = 0, surface = 0, appearance = 0;
};

/// Removes repeated neighbours and spikes (a, b, a), whose edges cancel; a loop of fewer than three
/// corners becomes empty.
void clean_loop(std::vector<uint32_t>& loop);

/// Removes empty loops, and faces without loops.
void drop_empty_loops(std::vector<LoopFace>& faces);

/// By an edge's lower and higher vertex: the vertices inside it, from the lower one on.
using EdgeSplits = std::map<std::pair<uint32_t, uint32_t>, std::vector<uint32_t>>;

/// Puts the vertices of the splits into the edges of a loop.
void apply_splits(const EdgeSplits& splits, std::vector<uint32_t>& loop);

/// The edges of collinear loops, and which of these hang together by them, directly or through
/// others.
class CollinearGroups {
 public:
  explicit CollinearGroups(const std::vector<const std::vector<uint32_t>*>& loops);

  /// By group: the vertices of its loops, each once.
  [[nodiscard]] const std::vector<std::vector<uint32_t>>& vertices() const { return vertices_; }
  /// The group that has an edge, of a lower and a higher vertex; none: -1. O(log n).
  [[nodiscard]] int64_t group_of(uint32_t a, uint32_t b) const;

 private:
  struct Edge {
    uint32_t a, b, group;
  };
  std::vector<Edge> edges_;  ///< sorted by a and b
  std::vector<std::vector<uint32_t>> vertices_;
};

/// The lexicographic order of vertices, which is the order along any line. (One order for all
/// loops, so that splitting ends also where a loop is collinear up to rounding only.)
template <class Point>
struct AlongLine {
  const std::vector<Point>& vertices;
  bool operator()(uint32_t a, uint32_t b) const {
    for (int i = 0; i < 3; ++i) {
      if (vertices[a][i] != vertices[b][i]) return vertices[a][i] < vertices[b][i];
    }
    return false;
  }
};

/// Puts vertices in their order along their line, each once.
template <class Point>
void sort_along_line(const std::vector<Point>& vertices, std::vector<uint32_t>& line) {
  const AlongLine<Point> before{vertices};
  std::sort(line.begin(), line.end(),
            [&](uint32_t a, uint32_t b) { return before(a, b) || (!before(b, a) && a < b); });
  line.erase(std::unique(line.begin(), line.end()), line.end());
}

/// Where the edge from a to b (a < b) runs over others of the sorted vertices of its line: these,
/// from a on.
template <class Point>
std::vector<uint32_t> inside_of_edge(const std::vector<Point>& vertices,
                                     const std::vector<uint32_t>& line, uint32_t a, uint32_t b) {
  const AlongLine<Point> before{vertices};
  const bool forward = before(a, b);
  const auto from = std::upper_bound(line.begin(), line.end(), forward ? a : b, before);
  const auto to = std::lower_bound(line.begin(), line.end(), forward ? b : a, before);
  if (from >= to) return {};
  std::vector<uint32_t> inner(from, to);
  if (!forward) std::reverse(inner.begin(), inner.end());
  return inner;
}

/// The edges of a collinear loop that run over other vertices of it. How many vertices were put
/// into `splits`.
template <class Point>
size_t find_splits(const std::vector<Point>& vertices, const std::vector<uint32_t>& loop,
                   EdgeSplits& splits) {
  std::vector<uint32_t> line = loop;
  sort_along_line(vertices, line);
  size_t count = 0;
  for (size_t i = 0; i < loop.size(); ++i) {
    const auto [a, b] = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
    std::vector<uint32_t> inner = inside_of_edge(vertices, line, a, b);
    if (inner.empty()) continue;
    count += inner.size();
    splits[{a, b}] = std::move(inner);
  }
  return count;
}

/// A loop of a face: which one of which.
using LoopPlace = std::pair<size_t, size_t>;

/// Splits the edges that collinear loops share with others at all vertices that their groups have
/// there, and drops them. O(n log n) and what is put into loops that stay.
template <class Point>
void drop_collinear_groups(const std::vector<Point>& vertices, std::vector<LoopFace>& faces,
                           const std::vector<LoopPlace>& collinear) {
  std::vector<const std::vector<uint32_t>*> loops;
  std::vector<bool> is_on_line(vertices.size(), false);
  for (const auto& [f, l] : collinear) {
    loops.push_back(&faces[f].loops[l]);
    for (const uint32_t v : *loops.back()) is_on_line[v] = true;
  }
  const CollinearGroups groups(loops);
  std::vector<std::vector<uint32_t>> lines = groups.vertices();
  for (std::vector<uint32_t>& line : lines) sort_along_line(vertices, line);
  for (const auto& [f, l] : collinear) faces[f].loops[l].clear();
  EdgeSplits splits;
  for (LoopFace& face : faces) {
    for (std::vector<uint32_t>& loop : face.loops) {
      splits.clear();
      for (size_t i = 0; i < loop.size(); ++i) {
        const auto [a, b] = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
        if (!is_on_line[a] || !is_on_line[b]) continue;
        const int64_t group = groups.group_of(a, b);
        if (group < 0) continue;
        std::vector<uint32_t> inner =
            inside_of_edge(vertices, lines[static_cast<size_t>(group)], a, b);
        if (!inner.empty()) splits[{a, b}] = std::move(inner);
      }
      if (!splits.empty()) apply_splits(splits, loop);
    }
  }
  drop_empty_loops(faces);
}

/// Drops the loops that lie on a line, as `is_collinear` has it. With every edge split at the
/// loop's vertices on it, the loop is a cycle of elementary segments of a line, each run through as
/// often one way as the other. Whether there was any.
///
/// In rounds, so that what stays is split where it must be and nowhere else: splits of an edge go
/// on to the collinear loops beside it. A fan of n slivers would take n rounds and the square of
/// its vertices; what is not done after a few goes by groups, where a vertex may split more.
template <class Point, class IsCollinear>
bool drop_collinear_loops(const std::vector<Point>& vertices, std::vector<LoopFace>& faces,
                          const IsCollinear& is_collinear) {
  // What rounds are for: slivers of a few corners, a few beside each other.
  constexpr size_t kMostRounds = 16, kMostCorners = 64, kMostSplits = 16;
  bool any = false;
  for (size_t round = 0;; ++round) {
    EdgeSplits splits;
    std::vector<LoopPlace> collinear;
    size_t longest = 0, count = 0;
    for (size_t f = 0; f < faces.size(); ++f) {
      for (size_t l = 0; l < faces[f].loops.size(); ++l) {
        const std::vector<uint32_t>& loop = faces[f].loops[l];
        if (!is_collinear(loop)) continue;
        collinear.emplace_back(f, l);
        longest = std::max(longest, loop.size());
        if (longest <= kMostCorners) count += find_splits(vertices, loop, splits);
      }
    }
    if (collinear.empty()) return any;
    any = true;
    if (longest > kMostCorners || round >= kMostRounds || count > kMostSplits * collinear.size()) {
      // What is collinear up to rounding only may be so after that as well: once more.
      drop_collinear_groups(vertices, faces, collinear);
      continue;
    }
    if (splits.empty()) {
      for (const auto& [f, l] : collinear) faces[f].loops[l].clear();
      drop_empty_loops(faces);
      return true;
    }
    for (LoopFace& face : faces) {
      for (std::vector<uint32_t>& loop : face.loops) apply_splits(splits, loop);
    }
  }
}

}  // namespace csgrun
