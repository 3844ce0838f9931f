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

/// The edges of a collinear loop that run over other vertices of it, with these in their order: the
/// lexicographic one, which is the order along any line. (One order for all loops, so that
/// splitting ends also where a loop is collinear up to rounding only.)
template <class Point>
void find_splits(const std::vector<Point>& vertices, const std::vector<uint32_t>& loop,
                 EdgeSplits& splits) {
  std::vector<uint32_t> line = loop;
  const auto before = [&](uint32_t a, uint32_t b) {
    for (int i = 0; i < 3; ++i) {
      if (vertices[a][i] != vertices[b][i]) return vertices[a][i] < vertices[b][i];
    }
    return false;
  };
  std::sort(line.begin(), line.end(), before);
  line.erase(std::unique(line.begin(), line.end()), line.end());
  for (size_t i = 0; i < loop.size(); ++i) {
    uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
    if (a > b) std::swap(a, b);
    const bool forward = before(a, b);
    const auto from = std::upper_bound(line.begin(), line.end(), forward ? a : b, before);
    const auto to = std::lower_bound(line.begin(), line.end(), forward ? b : a, before);
    if (from >= to) continue;
    std::vector<uint32_t> inner(from, to);
    if (!forward) std::reverse(inner.begin(), inner.end());
    splits[{a, b}] = std::move(inner);
  }
}

/// Drops the loops that lie on a line, as `is_collinear` has it. With every edge split at the
/// loop's vertices on it, the loop is a cycle of elementary segments of a line, each run through as
/// often one way as the other. Whether there was any.
template <class Point, class IsCollinear>
bool drop_collinear_loops(const std::vector<Point>& vertices, std::vector<LoopFace>& faces,
                          const IsCollinear& is_collinear) {
  bool any = false;
  while (true) {
    EdgeSplits splits;
    std::vector<std::pair<size_t, size_t>> collinear;
    for (size_t f = 0; f < faces.size(); ++f) {
      for (size_t l = 0; l < faces[f].loops.size(); ++l) {
        if (!is_collinear(faces[f].loops[l])) continue;
        collinear.emplace_back(f, l);
        find_splits(vertices, faces[f].loops[l], splits);
      }
    }
    any |= !collinear.empty();
    if (splits.empty()) {
      for (const auto& [f, l] : collinear) faces[f].loops[l].clear();
      drop_empty_loops(faces);
      return any;
    }
    for (LoopFace& face : faces) {
      for (std::vector<uint32_t>& loop : face.loops) apply_splits(splits, loop);
    }
  }
}

}  // namespace csgrun
