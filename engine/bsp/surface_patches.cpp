#include "engine/bsp/surface_patches.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "engine/bsp/line_key.h"
#include "engine/bsp/point_index.h"
#include "engine/bsp/union_find.h"

namespace csgrun {
namespace {

/// Per vertex of the job: a number that equal points share.
std::vector<uint32_t> unique_points(const Job& job) {
  CellGeometry geometry(job.planes(), &job);
  PointIndex index(geometry);
  std::vector<uint32_t> number(job.vertex_count());
  for (uint32_t v = 0; v < number.size(); ++v) number[v] = index.unique(geometry.vertex_point(v));
  return number;
}

struct Edge {
  uint32_t low, high;  ///< points
  uint32_t polygon, position;
};

std::vector<Edge> sorted_edges(const Job& job, const std::vector<uint32_t>& point) {
  std::vector<Edge> edges;
  const auto& polygons = job.polygons();
  for (uint32_t p = 0; p < polygons.size(); ++p) {
    const auto corners = job.corners(polygons[p]);
    for (uint32_t i = 0; i < corners.size(); ++i) {
      const uint32_t a = point[corners[i]], b = point[corners[i + 1 < corners.size() ? i + 1 : 0]];
      edges.push_back({std::min(a, b), std::max(a, b), p, i});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.polygon, a.position) <
           std::tie(b.low, b.high, b.polygon, b.position);
  });
  return edges;
}

/// Lines of edges of a materialised result: edges of different lengths may lie on one line there.
class EdgeLines {
 public:
  EdgeLines(const Job& job, const std::vector<Edge>& edges) : job_(job), edges_(edges) {
    LineNamer namer(job.planes());
    std::vector<LineNamer::PlanePair> lines;
    for (const Edge& e : edges) {
      const JobPolygon& p = job.polygons()[e.polygon];
      lines.push_back({p.support.index(), job.edge_planes(p)[e.position]});
    }
    namer.keys(lines, keys_);
    order_.resize(edges.size());
    std::iota(order_.begin(), order_.end(), 0u);
    std::sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) {
      return std::tie(keys_[a], a) < std::tie(keys_[b], b);
    });
  }

  /// Whether no edge but `first` and the one after it, which has the same ends, reaches far between
  /// these: by rounded coordinates along one axis. What rounding hides at the ends leaves a part of
  /// the edge to the two alone, and a part will do.
  [[nodiscard]] bool are_alone(uint32_t first) const {
    const int axis = longest_axis(first);
    const std::pair<double, double> own = range(first, axis);
    if (own.first == own.second) return false;  // too short to tell
    const auto [begin, end] =
        std::equal_range(order_.begin(), order_.end(), first,
                         [&](uint32_t i, uint32_t j) { return keys_[i] < keys_[j]; });
    return std::none_of(begin, end, [&](uint32_t i) {
      const auto [a, b] = range(i, axis);
      return i != first && i != first + 1 && a < own.second && own.first < b;
    });
  }

 private:
  [[nodiscard]] int longest_axis(uint32_t i) const {
    const auto length = [&](int axis) {
      const auto [lo, hi] = range(i, axis);
      return hi - lo;
    };
    int longest = 0;
    for (int k = 1; k < 3; ++k) {
      if (length(k) > length(longest)) longest = k;
    }
    return longest;
  }
  [[nodiscard]] std::pair<double, double> range(uint32_t i, int axis) const {
    const JobPolygon& p = job_.polygons()[edges_[i].polygon];
    const auto corners = job_.corners(p);
    const uint32_t at = edges_[i].position;
    return std::minmax(job_.rounded(corners[at])[axis],
                       job_.rounded(corners[at + 1 < corners.size() ? at + 1 : 0])[axis]);
  }

  const Job& job_;
  const std::vector<Edge>& edges_;
  std::vector<LineKey> keys_;
  std::vector<uint32_t> order_;
};

/// Numbers the sets that the polygons belong to by their first members.
uint32_t number_sets(UnionFind& sets, std::vector<uint32_t>& number) {
  uint32_t count = 0;
  number.resize(sets.size());
  for (uint32_t i = 0; i < number.size(); ++i) {
    const uint32_t root = sets.find(i);  // not above i
    number[i] = root == i ? count++ : number[root];
  }
  return count;
}

}  // namespace

SurfacePatches find_patches(const Job& job, std::span<const std::array<uint32_t, 2>> crossings,
                            std::span<const uint8_t> crosses) {
  SurfacePatches result;
  const auto& polygons = job.polygons();
  const std::vector<uint32_t> point = unique_points(job);

  // Classes: what shares a point, and what crosses. Polygon f of a leaf is face f.
  UnionFind classes(polygons.size());
  std::vector<uint32_t> user(point.size(), kNone);
  std::vector<uint8_t> touches(point.size(), 0);
  for (uint32_t p = 0; p < polygons.size(); ++p) {
    for (const uint32_t v : job.corners(polygons[p])) {
      touches[point[v]] |= crosses[p];
      if (user[point[v]] == kNone) user[point[v]] = p;
      classes.join(user[point[v]], p);
    }
  }
  for (const auto& [f, g] : crossings) classes.join(f, g);
  result.class_count = number_sets(classes, result.class_of);

  UnionFind patches(polygons.size());
  const std::vector<Edge> edges = sorted_edges(job, point);
  const bool is_leaf = job.is_leaf(0);
  std::optional<EdgeLines> lines;
  if (!is_leaf) lines.emplace(job, edges);
  for (uint32_t i = 0; i < edges.size();) {
    uint32_t j = i + 1;
    while (j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high) ++j;
    // Faces of a leaf whose edges overlap in part are among its crossings.
    if (j - i == 2 && !crosses[edges[i].polygon] && !crosses[edges[i + 1].polygon] &&
        (is_leaf || lines->are_alone(i))) {
      patches.join(edges[i].polygon, edges[i + 1].polygon);
    }
    i = j;
  }
  // Number the patches of polygons that cross nothing.
  std::vector<uint32_t> number(polygons.size(), kNone);
  std::vector<uint8_t> is_good;
  result.patch_of.assign(polygons.size(), kNone);
  for (uint32_t p = 0; p < polygons.size(); ++p) {
    if (crosses[p]) continue;
    uint32_t& patch = number[patches.find(p)];
    const auto corners = job.corners(polygons[p]);
    if (patch == kNone) {
      patch = result.patch_count++;
      result.witness.push_back(corners[0]);
      is_good.push_back(0);
    }
    result.patch_of[p] = patch;
    for (const uint32_t v : corners) {
      if (is_good[patch] || !touches[point[v]]) continue;
      is_good[patch] = 1;
      result.witness[patch] = v;
    }
  }
  result.junctions.resize(result.class_count);
  std::vector<uint32_t> seen(point.size(), kNone);
  for (uint32_t p = 0; p < polygons.size(); ++p) {
    const uint32_t patch = result.patch_of[p];
    if (patch == kNone) continue;
    for (const uint32_t v : job.corners(polygons[p])) {
      uint32_t& first = seen[point[v]];
      if (first == kNone) first = patch;
      if (first != patch) result.junctions[result.class_of[p]].push_back(v);
    }
  }
  return result;
}

}  // namespace csgrun
