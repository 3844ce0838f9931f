// (1) A sweep adds up winding numbers from below: every segment learns those of both its sides.
// (2) Segments with the inside on one side only are the boundary, directed so that it is on the
// left. (3) At a point where several boundaries meet, a walk takes the next one clockwise, that is,
// it stays
//     in the same wedge of the inside; a walk that comes back to a point is split there. So loops
//     touch, but never cross and never visit a point twice.
// (4) A second sweep finds for each hole what lies below its smallest point: its outer loop, or
//     another hole of the same region.
#include "primitives/shape2d/regions.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "primitives/shape2d/sweep2d.h"

namespace csgrun {
namespace {

struct Directed {
  Point2D from, to;
};

std::vector<Directed> find_boundary(const std::vector<Segment2D>& segments,
                                    const std::function<bool(int32_t, int32_t)>& inside) {
  struct Winding {
    int32_t first = 0, rest = 0;
  };
  std::vector<Winding> above(segments.size());
  std::vector<Directed> boundary;
  sweep_segments(segments, [&](uint32_t i, uint32_t below) {
    const Winding right = below == kNoSegment ? Winding{} : above[below];
    above[i] = {right.first + segments[i].first, right.rest + segments[i].rest};
    const bool inside_left = inside(above[i].first, above[i].rest);
    if (inside_left == inside(right.first, right.rest)) return;
    if (inside_left) {
      boundary.push_back({segments[i].a, segments[i].b});
    } else {
      boundary.push_back({segments[i].b, segments[i].a});
    }
  });
  std::sort(boundary.begin(), boundary.end(), [](const Directed& s, const Directed& t) {
    return std::tie(s.from, s.to) < std::tie(t.from, t.to);
  });
  return boundary;
}

/// Whether direction c comes before d when turning clockwise from `back`.
bool turns_before(const Point2D& back, const Point2D& c, const Point2D& d) {
  const int half_c = sign(cross(back, c)), half_d = sign(cross(back, d));
  if (half_c != half_d) return half_c < half_d;
  return cross(c, d) < 0;
}

/// The boundary sorted by its starting points, with the steps of a walk along it.
class Walker {
 public:
  explicit Walker(std::vector<Directed> boundary)
      : boundary_(std::move(boundary)), used_(boundary_.size(), false) {}

  struct Loop {
    GridLoop points;
    std::vector<size_t> touches;  ///< for each point that boundaries share, a number
  };

  std::vector<Loop> all_loops() {
    std::vector<Loop> loops;
    for (size_t i = 0; i < boundary_.size(); ++i) {
      if (!used_[i]) walk(i, loops);
    }
    return loops;
  }

 private:
  struct Range {
    size_t begin, end;
  };

  [[nodiscard]] Range leaving(const Point2D& p) const {
    const auto [begin, end] =
        std::equal_range(boundary_.begin(), boundary_.end(), Directed{p, p},
                         [](const Directed& s, const Directed& t) { return s.from < t.from; });
    return {static_cast<size_t>(begin - boundary_.begin()),
            static_cast<size_t>(end - boundary_.begin())};
  }

  void walk(size_t first, std::vector<Loop>& loops) {
    std::vector<size_t> path;  // edges walked and not yet given to a loop
    for (size_t edge = first; !used_[edge];) {
      used_[edge] = true;
      path.push_back(edge);
      const Point2D at = boundary_[edge].to;
      const auto [begin, end] = leaving(at);
      const Point2D back = boundary_[edge].from - at;
      size_t next = begin;
      for (size_t k = begin + 1; k < end; ++k) {
        if (turns_before(back, boundary_[k].to - at, boundary_[next].to - at)) next = k;
      }
      // Only where boundaries touch can the walk have been here before (but at its start).
      if (end - begin > 1 || next == first) split_off_loop(at, end - begin > 1, path, loops);
      edge = next;
    }
  }

  /// If the path visited `at` before, what came since is a loop.
  void split_off_loop(const Point2D& at, bool touching, std::vector<size_t>& path,
                      std::vector<Loop>& loops) const {
    size_t begin = 0;
    if (touching) {
      begin = path.size();
      while (begin > 0 && boundary_[path[begin - 1]].from != at) --begin;
      if (begin == 0) return;
      --begin;
    }
    Loop& loop = loops.emplace_back();
    for (size_t i = begin; i < path.size(); ++i) {
      const Point2D p = boundary_[path[i]].from;
      const Point2D before = boundary_[path[i == begin ? path.size() - 1 : i - 1]].from;
      const auto [first, last] = leaving(p);
      // A straight corner is kept only where another loop touches it.
      if (last - first > 1 || orient(before, p, boundary_[path[i]].to) != 0) {
        loop.points.push_back(p);
      }
      if (last - first > 1) loop.touches.push_back(first);
    }
    path.resize(begin);
  }

  std::vector<Directed> boundary_;
  std::vector<bool> used_;
};

/// GridRegions::group_of: disjoint sets, each with its lowest loop for a name.
std::vector<uint32_t> find_groups(const std::vector<Walker::Loop>& loops) {
  std::vector<uint32_t> group(loops.size());
  std::iota(group.begin(), group.end(), 0u);
  const auto find = [&](uint32_t l) {
    while (group[l] != l) l = group[l] = group[group[l]];
    return l;
  };
  std::map<size_t, uint32_t> loop_at;  // a point that is shared
  for (uint32_t l = 0; l < loops.size(); ++l) {
    for (const size_t point : loops[l].touches) {
      const uint32_t a = find(l), b = find(loop_at.try_emplace(point, l).first->second);
      group[std::max(a, b)] = std::min(a, b);
    }
  }
  for (uint32_t l = 0; l < loops.size(); ++l) group[l] = find(l);
  return group;
}

bool is_outer(const GridLoop& loop) {
  // The loop starts at its smallest point, which is a convex corner.
  return orient(loop.back(), loop[0], loop[1]) > 0;
}

struct LoopSegment {
  Point2D a, b;
  uint32_t loop;
};

}  // namespace

std::vector<uint32_t> find_outer_loops(const std::vector<GridLoop>& loops) {
  std::vector<LoopSegment> segments;
  for (uint32_t l = 0; l < loops.size(); ++l) {
    for (size_t i = 0; i < loops[l].size(); ++i) {
      const auto [a, b] = std::minmax(loops[l][i], loops[l][(i + 1) % loops[l].size()]);
      segments.push_back({a, b, l});
    }
  }
  std::vector<uint32_t> outer(loops.size(), kNoSegment);
  sweep_segments(segments, [&](uint32_t i, uint32_t below) {
    const uint32_t loop = segments[i].loop;
    if (outer[loop] != kNoSegment) return;  // not the first segment of its loop
    outer[loop] = is_outer(loops[loop]) ? loop : outer[segments[below].loop];
  });
  return outer;
}

GridRegions extract_regions(const std::vector<Segment2D>& arrangement,
                            const std::function<bool(int32_t, int32_t)>& inside) {
  GridRegions regions;
  std::vector<Walker::Loop> loops = Walker(find_boundary(arrangement, inside)).all_loops();
  for (Walker::Loop& loop : loops) {
    std::rotate(loop.points.begin(), std::min_element(loop.points.begin(), loop.points.end()),
                loop.points.end());
  }
  std::sort(loops.begin(), loops.end(),
            [](const Walker::Loop& a, const Walker::Loop& b) { return a.points < b.points; });
  regions.group_of = find_groups(loops);
  for (Walker::Loop& loop : loops) regions.loops.push_back(std::move(loop.points));
  regions.outer_of = find_outer_loops(regions.loops);
  return regions;
}

}  // namespace csgrun
