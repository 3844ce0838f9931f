#include "primitives/shape2d/convolution.h"

#include <utility>

namespace csgrun {
namespace {

bool is_same_way(const Point2D& a, const Point2D& b) { return cross(a, b) == 0 && dot(a, b) > 0; }

/// Whether a direction is between two others, which are passed from the first one to the left by
/// less than a full half turn, or by just that.
bool is_between(const Point2D& first, const Point2D& d, const Point2D& last) {
  return cross(first, d) > 0 && cross(d, last) > 0;
}

/// By how often `vertices` turns past the direction of an edge at a vertex: 1 to the left, -1 to
/// the right, else 0. Where both run the same way, the edges of one loop are taken to be a little
/// to the left of those of the other, so that the curves stay closed.
int turns_past(const Point2D& before, const Point2D& after, const Point2D& edge,
               bool edge_is_left) {
  const int turn = sign(cross(before, after));
  if (turn == 0 && dot(before, after) > 0) return 0;
  const Point2D &first = turn >= 0 ? before : after, &last = turn >= 0 ? after : before;
  const bool passes =
      is_between(first, edge, last) || is_same_way(edge, edge_is_left ? first : last);
  return !passes ? 0 : turn >= 0 ? 1 : -1;
}

void add_edges_at_vertices(const GridLoop& edges, const GridLoop& vertices, bool edge_is_left,
                           std::vector<Segment2D>& segments) {
  const size_t n = edges.size(), m = vertices.size();
  for (size_t j = 0; j < m; ++j) {
    const Point2D at = vertices[j], before = at - vertices[(j + m - 1) % m],
                  after = vertices[(j + 1) % m] - at;
    for (size_t i = 0; i < n; ++i) {
      const Point2D &p = edges[i], &q = edges[(i + 1) % n];
      const int turns = turns_past(before, after, q - p, edge_is_left);
      if (turns == 0) continue;
      Point2D from{p.x + at.x, p.y + at.y}, to{q.x + at.x, q.y + at.y};
      if (turns < 0) std::swap(from, to);
      add_segment(from, to, kRestOfOperands, segments);
    }
  }
}

}  // namespace

void add_convolution(const GridLoop& a, const GridLoop& b, std::vector<Segment2D>& segments) {
  if (a.size() < 2 || b.size() < 2) return;
  add_edges_at_vertices(a, b, true, segments);
  add_edges_at_vertices(b, a, false, segments);
}

}  // namespace csgrun
