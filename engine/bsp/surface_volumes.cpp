#include "engine/bsp/surface_volumes.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "engine/bsp/line_key.h"
#include "engine/bsp/union_find.h"

namespace csgrun {
namespace {

/// Sees to it that all that is said of a patch agrees.
bool label_patches(const std::vector<SurfaceCells>& runs, InsideLabels& labels) {
  for (size_t r = 0; r < runs.size(); ++r) {
    for (const SurfaceCells::PatchSides& s : runs[r].patches) {
      const bool front = labels.volumes[r][s.front] != 0, back = labels.volumes[r][s.back] != 0;
      InsideLabels::Patch& patch = labels.patches[s.patch];
      if (patch.known && (patch.front != front || patch.back != back)) return false;
      patch = {true, front, back};
    }
  }
  return true;
}

/// The lines in which the planes of polygons meet walls.
class WallLines {
 public:
  using Planes = std::pair<uint32_t, uint32_t>;  ///< support and wall

  /// Those of all wall edges, each once.
  WallLines(const Job& job, const std::vector<SurfaceCells>& runs) {
    for (const SurfaceCells& run : runs) {
      for (const SurfaceCells::WallEdge& e : run.wall_edges)
        planes_.emplace_back(e.support, e.wall);
    }
    std::sort(planes_.begin(), planes_.end());
    planes_.erase(std::unique(planes_.begin(), planes_.end()), planes_.end());
    std::vector<LineNamer::PlanePair> pairs;
    for (const auto& [support, wall] : planes_) pairs.push_back({wall, support});
    LineNamer(job.planes()).keys(pairs, keys_);
  }

  [[nodiscard]] const std::vector<Planes>& planes() const { return planes_; }
  [[nodiscard]] const std::vector<LineKey>& keys() const { return keys_; }
  [[nodiscard]] const LineKey& key(const SurfaceCells::WallEdge& e) const {
    const auto at = std::lower_bound(planes_.begin(), planes_.end(), Planes(e.support, e.wall));
    return keys_[static_cast<size_t>(std::distance(planes_.begin(), at))];
  }

 private:
  std::vector<Planes> planes_;  ///< sorted
  std::vector<LineKey> keys_;   ///< one for one
};

/// Joins the volumes of neighbouring cells along the edges in which pieces of a plane meet a wall.
class WallJoiner {
 public:
  WallJoiner(const Job& job, const std::vector<SurfaceCells>& runs,
             const std::vector<uint32_t>& first_volume, UnionFind& volumes)
      : job_(job), geometry_(job.planes(), &job), volumes_(volumes) {
    const WallLines lines(job, runs);
    for (size_t r = 0; r < runs.size(); ++r) {
      const auto& points = runs[r].set.points;
      std::vector<uint32_t> number(points.size(), kNone);
      const auto point = [&](uint32_t p) {
        if (number[p] == kNone) {
          number[p] = points[p].vertex != kNone
                          ? geometry_.vertex_point(points[p].vertex)
                          : geometry_.add_point(points[p].planes, points[p].rounded);
        }
        return number[p];
      };
      for (const SurfaceCells::WallEdge& e : runs[r].wall_edges) {
        edges_.push_back({e.support, e.wall, lines.key(e), is_first_side(e), point(e.from),
                          point(e.to), first_volume[r] + e.front, first_volume[r] + e.back});
      }
    }
  }

  void join() {
    // A line has one support: else polygons would cross in it.
    std::stable_sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) {
      return std::tie(a.key, b.is_first_side) < std::tie(b.key, a.is_first_side);
    });
    for (auto begin = edges_.begin(); begin != edges_.end();) {
      const auto end =
          std::find_if_not(begin, edges_.end(), [&](const Edge& e) { return e.key == begin->key; });
      join_line(begin, std::find_if_not(begin, end, [](const Edge& e) { return e.is_first_side; }),
                end);
      begin = end;
    }
  }

 private:
  struct Edge {
    uint32_t support, wall;
    LineKey key;
    bool is_first_side;  ///< of the line, in the plane
    uint32_t from, to;   ///< points of the geometry, in the order along the axis once joined
    uint32_t front, back;
  };
  using Iterator = std::vector<Edge>::iterator;

  /// On which side of its line a piece lies: below the wall, or, where two walls meet in the plane
  /// and an edge may be in either, so that both agree.
  [[nodiscard]] bool is_first_side(const SurfaceCells::WallEdge& e) const {
    const Plane plane = job_.planes().plane(e.support), wall = job_.planes().plane(e.wall);
    const std::array<Int128, 3> n{plane.a, plane.b, plane.c};
    const int k = wall.a != 0 ? 0 : wall.b != 0 ? 1 : 2;
    // The line runs along an axis if the plane does. Across it, in the plane, one goes up the axis
    // k where the product of the normal and that axis does.
    for (int along = 0; along < 3; ++along) {
      if (along == k || n[along] != 0) continue;
      const int other = 3 - k - along;
      const bool rises = ((along + 1) % 3 == k) == (n[other] > 0);
      return e.is_below == rises;
    }
    return e.is_below;
  }

  /// The edges of either side do not overlap among themselves; where one of each do, the surface
  /// runs on from one to the other.
  void join_line(Iterator begin, Iterator middle, Iterator end) {
    const int axis =
        line_axis(job_.planes().plane(begin->support), job_.planes().plane(begin->wall)).axis;
    const auto before = [&](uint32_t p, uint32_t q) {
      return geometry_.compare_along(p, q, axis) < 0;
    };
    for (auto e = begin; e != end; ++e) {
      if (before(e->to, e->from)) std::swap(e->from, e->to);
    }
    std::sort(middle, end, [&](const Edge& a, const Edge& b) { return before(a.from, b.from); });
    for (auto a = begin; a != middle; ++a) {
      const auto first =
          std::partition_point(middle, end, [&](const Edge& b) { return !before(a->from, b.to); });
      const auto last =
          std::partition_point(first, end, [&](const Edge& b) { return before(b.from, a->to); });
      for (auto b = first; b != last; ++b) {
        volumes_.join(a->front, b->front);
        volumes_.join(a->back, b->back);
      }
    }
  }

  const Job& job_;
  CellGeometry geometry_;
  UnionFind& volumes_;
  std::vector<Edge> edges_;
};

/// All volumes of all runs, in sets of those that are one volume.
class VolumeSets {
 public:
  /// Joined from cell to cell.
  VolumeSets(const Job& job, const std::vector<SurfaceCells>& runs) : first_{0} {
    for (const SurfaceCells& run : runs) {
      first_.push_back(first_.back() + static_cast<uint32_t>(run.windings.size()));
    }
    sets_.reset(first_.back());
    WallJoiner(job, runs, first_, sets_).join();
  }

  UnionFind& sets() { return sets_; }
  [[nodiscard]] uint32_t count() const { return first_.back(); }
  [[nodiscard]] uint32_t number(size_t run, uint32_t volume) const { return first_[run] + volume; }
  uint32_t find(size_t run, uint32_t volume) { return sets_.find(number(run, volume)); }

  template <class IsInside>
  InsideLabels labels(IsInside&& is_inside) {
    InsideLabels labels;
    for (size_t r = 0; r + 1 < first_.size(); ++r) {
      std::vector<uint8_t>& inside = labels.volumes.emplace_back();
      for (uint32_t v = first_[r]; v < first_[r + 1]; ++v)
        inside.push_back(is_inside(sets_.find(v)));
    }
    return labels;
  }

 private:
  std::vector<uint32_t> first_;  ///< per run: the number of its first volume
  UnionFind sets_;
};

}  // namespace

bool is_inside(int32_t winding, InsideRule rule) {
  switch (rule) {
    case InsideRule::kNonZero:
      return winding != 0;
    case InsideRule::kPositive:
      return winding > 0;
    default:
      return winding % 2 != 0;
  }
}

std::optional<InsideLabels> label_by_winding(const std::vector<SurfaceCells>& runs,
                                             size_t patch_count, InsideRule rule) {
  InsideLabels labels;
  labels.patches.resize(patch_count);
  for (const SurfaceCells& run : runs) {
    std::vector<uint8_t>& inside = labels.volumes.emplace_back();
    for (const int32_t w : run.windings) inside.push_back(is_inside(w, rule));
  }
  if (!label_patches(runs, labels)) return std::nullopt;
  return labels;
}

bool crosses_in_wall(const Job& job, const std::vector<SurfaceCells>& runs) {
  const WallLines in_walls(job, runs);
  std::vector<std::pair<LineKey, uint32_t>> lines;  // with the support
  for (size_t i = 0; i < in_walls.keys().size(); ++i) {
    lines.emplace_back(in_walls.keys()[i], in_walls.planes()[i].first);
  }
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return std::adjacent_find(lines.begin(), lines.end(), [](const auto& a, const auto& b) {
           return a.first == b.first;
         }) != lines.end();
}

std::optional<InsideLabels> label_by_filling(const Job& job,
                                             const std::vector<SurfaceCells>& runs) {
  VolumeSets volumes(job, runs);
  // Of each set of volumes: the lowest point of its surface, which is no crossing of a wall, and
  // the set below it, which is another one unless it reaches to infinity.
  struct Lowest {
    const FragmentSet::NamedPoint* point = nullptr;
    uint32_t below = kNone;
  };
  std::vector<Lowest> lowest(volumes.count());
  const auto exact = [&](const FragmentSet::NamedPoint& p) {
    const auto plane = [&](int i) -> const Plane& { return job.planes().plane(p.planes[i]); };
    return intersect(plane(0), plane(1), plane(2));
  };
  for (size_t r = 0; r < runs.size(); ++r) {
    const SurfaceCells& run = runs[r];
    for (size_t i = 0; i < run.sides.size(); ++i) {
      const FragmentSet::Piece& piece = run.set.pieces[i];
      for (const uint32_t volume : {run.sides[i].front, run.sides[i].back}) {
        Lowest& least = lowest[volumes.find(r, volume)];
        for (uint32_t c = piece.first; c < piece.first + piece.count; ++c) {
          const uint32_t number = run.set.corner_point[c];
          const FragmentSet::NamedPoint& point = run.set.points[number];
          if (least.point) {
            // Rounding keeps the order along each axis.
            const double step = point.rounded[0] - least.point->rounded[0];
            if (step > 0 || (step == 0 && compare(exact(point), exact(*least.point)) >= 0))
              continue;
          }
          const uint32_t below = run.below_point[number];
          least = {&point, below == kNone ? kNone : volumes.find(r, below)};
        }
      }
    }
  }
  std::vector<uint8_t> outside(volumes.count(), 0);
  for (uint32_t set = 0; set < lowest.size(); ++set) {
    if (!lowest[set].point) continue;
    if (lowest[set].below == kNone) return std::nullopt;
    outside[set] = lowest[set].below == set;
  }
  return volumes.labels([&](uint32_t set) { return !outside[set]; });
}

std::optional<InsideLabels> label_by_reach(const Job& job, const std::vector<SurfaceCells>& runs,
                                           size_t patch_count, uint32_t lowest, InsideRule rule) {
  VolumeSets volumes(job, runs);
  // The volumes on the two sides of each patch, where it was first seen.
  std::vector<std::array<uint32_t, 2>> sides_of_patch(patch_count, {kNone, kNone});
  uint32_t start = kNone;
  for (size_t r = 0; r < runs.size(); ++r) {
    for (const SurfaceCells::PatchSides& s : runs[r].patches) {
      auto& sides = sides_of_patch[s.patch];
      const uint32_t front = volumes.number(r, s.front), back = volumes.number(r, s.back);
      if (sides[0] == kNone) sides = {front, back};
      volumes.sets().join(sides[0], front);
      volumes.sets().join(sides[1], back);
    }
    for (const SurfaceCells::VertexVolume& v : runs[r].vertex_volumes) {
      if (v.vertex == lowest) start = volumes.number(r, v.volume);
    }
  }
  if (start == kNone) return std::nullopt;

  // What lets one through: pieces that face nobody who comes from that side.
  std::vector<uint8_t> reached(volumes.count(), 0);
  start = volumes.sets().find(start);
  reached[start] = 1;
  if (rule == InsideRule::kOrientedHull) {
    std::vector<std::array<uint32_t, 2>> free;  ///< from one volume to another
    const auto add = [&](uint32_t from, uint32_t to) {
      free.push_back({volumes.sets().find(from), volumes.sets().find(to)});
    };
    for (size_t r = 0; r < runs.size(); ++r) {
      for (const SurfaceCells::Sides& s : runs[r].sides) {
        const uint32_t front = volumes.number(r, s.front), back = volumes.number(r, s.back);
        if (!s.has_up) add(front, back);
        if (!s.has_down) add(back, front);
      }
    }
    for (const auto& [front, back] : sides_of_patch) {
      if (front != kNone) add(back, front);
    }
    std::sort(free.begin(), free.end());
    free.erase(std::unique(free.begin(), free.end()), free.end());
    free.push_back({kNone, kNone});  // of no volume: ends what the last one's ways are
    std::vector<uint32_t> open{start};
    while (!open.empty()) {
      const uint32_t from = open.back();
      open.pop_back();
      auto way = std::lower_bound(free.begin(), free.end(), std::array<uint32_t, 2>{from, 0});
      for (; (*way)[0] == from; ++way) {
        const uint32_t to = (*way)[1];
        if (reached[to]) continue;
        reached[to] = 1;
        open.push_back(to);
      }
    }
  }
  InsideLabels labels = volumes.labels([&](uint32_t set) { return !reached[set]; });
  labels.patches.resize(patch_count);
  if (!label_patches(runs, labels)) return std::nullopt;
  return labels;
}

}  // namespace csgrun
