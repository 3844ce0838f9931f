#include "primitives/shape2d/slits.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace csgrun {
namespace {

/// Whether a direction at the i-th corner of a loop leads into what is on the loop's left.
bool leads_inside(const GridLoop& loop, size_t i, const Point2D& way) {
  const size_t n = loop.size();
  const Point2D after = loop[(i + 1) % n] - loop[i], back = loop[(i + n - 1) % n] - loop[i];
  // The inside is passed from `after` to the left until `back`.
  const int turn = sign(cross(after, back));
  if (turn > 0) return cross(after, way) > 0 && cross(way, back) > 0;
  if (turn < 0) return !(cross(back, way) >= 0 && cross(way, after) >= 0);
  return dot(after, back) < 0 && cross(after, way) > 0;
}

bool strictly_between(const Point2D& p, const Point2D& a, const Point2D& b) {
  return orient(a, b, p) == 0 && dot(a - p, b - p) < 0;
}

/// Whether two segments have a point in common that is no end of both.
bool meet(const Point2D& p, const Point2D& q, const Point2D& a, const Point2D& b) {
  if (strictly_between(a, p, q) || strictly_between(b, p, q) || strictly_between(p, a, b) ||
      strictly_between(q, a, b)) {
    return true;
  }
  return orient(p, q, a) * orient(p, q, b) < 0 && orient(a, b, p) * orient(a, b, q) < 0;
}

bool meets_any_edge(const Point2D& p, const Point2D& q, const GridLoop& loop) {
  for (size_t i = 0; i < loop.size(); ++i) {
    if (meet(p, q, loop[i], loop[i + 1 < loop.size() ? i + 1 : 0])) return true;
  }
  return false;
}

/// The corner of `outline` from which a slit may run to the first corner of `hole`; nothing when
/// none sees it. `others` are holes that may be in the way.
std::optional<size_t> seen_corner(const GridLoop& outline, const GridLoop& hole,
                                  const std::vector<GridLoop>& others) {
  const Point2D& end = hole[0];
  std::vector<size_t> order(outline.size());
  std::iota(order.begin(), order.end(), size_t{0});
  const auto distance = [&](size_t i) { return dot(outline[i] - end, outline[i] - end); };
  std::sort(order.begin(), order.end(), [&](size_t i, size_t j) {
    const int128 a = distance(i), b = distance(j);
    return a != b ? a < b : i < j;
  });
  for (const size_t i : order) {
    const Point2D& start = outline[i];
    if (start == end) {
      if (leads_inside(outline, i, hole[1] - end)) return i;
      continue;
    }
    if (!leads_inside(outline, i, end - start) || !leads_inside(hole, 0, start - end)) continue;
    if (meets_any_edge(start, end, outline) || meets_any_edge(start, end, hole)) continue;
    if (std::none_of(others.begin(), others.end(),
                     [&](const GridLoop& other) { return meets_any_edge(start, end, other); })) {
      return i;
    }
  }
  return std::nullopt;
}

/// `hole` put into `outline` behind its i-th corner, and the slit back.
GridLoop joined(const GridLoop& outline, size_t i, const GridLoop& hole) {
  const auto at = outline.begin() + static_cast<std::ptrdiff_t>(i);
  GridLoop loop(outline.begin(), at + 1);
  const bool touches = outline[i] == hole[0];
  loop.insert(loop.end(), hole.begin() + (touches ? 1 : 0), hole.end());
  if (!touches) loop.push_back(hole[0]);
  loop.insert(loop.end(), at, outline.end());
  return loop;
}

}  // namespace

std::optional<GridLoop> cut_open(const std::vector<GridLoop>& loops) {
  GridLoop outline = loops[0];
  std::vector<GridLoop> holes(loops.begin() + 1, loops.end());
  // From its smallest corner a hole sees one of what lies to the left of it: of the outline, or of
  // holes with smaller corners, which are joined before.
  for (GridLoop& hole : holes)
    std::rotate(hole.begin(), std::min_element(hole.begin(), hole.end()), hole.end());
  std::sort(holes.begin(), holes.end(), std::greater<>());
  while (!holes.empty()) {
    const GridLoop hole = std::move(holes.back());
    holes.pop_back();
    const auto corner = seen_corner(outline, hole, holes);
    if (!corner) return std::nullopt;
    outline = joined(outline, *corner, hole);
  }
  return outline;
}

}  // namespace csgrun
