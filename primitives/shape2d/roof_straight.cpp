// The roof over the straight skeleton: the face of each edge, at the height of the time when the
// wavefront came by.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <glm/geometric.hpp>

#include "primitives/base/text.h"
#include "primitives/shape2d/roof_outline.h"
#include "primitives/shape2d/wavefront.h"

namespace csgrun {
namespace {

using Border = Skeleton::Border;

/// More edges take minutes.
constexpr size_t kMostEdges = 10000;

Error not_found() {
  return Error{ErrorCode::kInternal,
               "roof: rounding leaves no straight skeleton of this shape; method \"voronoi\" may "
               "do",
               {}};
}

class FaceMaker {
 public:
  FaceMaker(const RoofOutline& outline, const Skeleton& skeleton)
      : outline_(outline), skeleton_(skeleton) {}

  /// Appends the faces of the edge whose borders these are. False when they do not bound a part of
  /// its plane that runs along it.
  bool add(const Border* begin, const Border* end, PolygonMesh& mesh) const {
    std::vector<Border> open(begin, end);
    while (!open.empty()) {
      std::vector<uint32_t> loop;
      const Border first = open.back();
      Border at = first;
      open.pop_back();
      loop.push_back(at.from);
      while (at.to != first.from) {
        size_t next = open.size();
        for (size_t i = 0; i < open.size(); ++i) {
          if (open[i].from != at.to) continue;
          if (next == open.size() || clockwise_before(at, open[i], open[next])) next = i;
        }
        if (next == open.size()) return false;
        at = open[next];
        open.erase(open.begin() + static_cast<std::ptrdiff_t>(next));
        loop.push_back(at.from);
      }
      if (loop.size() < 3 || !is_good(begin->edge, loop)) return false;
      mesh.add_face(loop);
    }
    return true;
  }

 private:
  [[nodiscard]] glm::dvec2 way(const Border& b) const {
    return skeleton_.nodes[b.to].at - skeleton_.nodes[b.from].at;
  }

  [[nodiscard]] bool clockwise_before(const Border& in, const Border& c, const Border& d) const {
    const glm::dvec2 back = -way(in), to_c = way(c), to_d = way(d);
    const auto across = [](const glm::dvec2& a, const glm::dvec2& b) {
      return a.x * b.y - a.y * b.x;
    };
    const bool left_c = across(back, to_c) > 0, left_d = across(back, to_d) > 0;
    if (left_c != left_d) return left_d;
    return across(to_c, to_d) < 0;
  }

  /// A face lies in its edge's plane, and goes forth along the edge once and back above. All faces
  /// together go around every point of the shape once; so when each is good none lies on another.
  [[nodiscard]] bool is_good(uint32_t edge, const std::vector<uint32_t>& loop) const {
    const glm::dvec2 start = skeleton_.nodes[outline_.from[edge]].at;
    glm::dvec2 along = skeleton_.nodes[outline_.to[edge]].at - start;
    along /= std::sqrt(glm::dot(along, along));
    const glm::dvec2 normal(-along.y, along.x);
    std::vector<glm::dvec2> places;  // along the edge, and away from it
    for (const uint32_t n : loop) {
      const glm::dvec2 r = skeleton_.nodes[n].at - start;
      const double time = skeleton_.nodes[n].time;
      if (std::fabs(glm::dot(r, normal) - time) > kNoise) return false;
      places.emplace_back(glm::dot(r, along), time);
    }
    // From the farthest place the way leads back to the nearest, above, and then forth, below.
    const auto left_of = [](const glm::dvec2& p, const glm::dvec2& q) { return p.x < q.x; };
    std::rotate(places.begin(), std::max_element(places.begin(), places.end(), left_of),
                places.end());
    const auto near = std::min_element(places.begin(), places.end(), left_of);
    std::vector<glm::dvec2> above(std::make_reverse_iterator(near + 1), places.rend());
    std::vector<glm::dvec2> below(near, places.end());
    below.push_back(places.front());
    return runs_forth(above) && runs_forth(below) && is_above(above, below, 1) &&
           is_above(below, above, -1);
  }

  static bool runs_forth(const std::vector<glm::dvec2>& chain) {
    double most = chain.front().x;
    for (const glm::dvec2& p : chain) {
      if (p.x < most - kNoise) return false;
      most = std::max(most, p.x);
    }
    return true;
  }

  /// Whether the corners of one chain are above the other, times `side`.
  static bool is_above(const std::vector<glm::dvec2>& corners, const std::vector<glm::dvec2>& chain,
                       double side) {
    size_t i = 0;
    for (const glm::dvec2& p : corners) {
      while (i + 2 < chain.size() && chain[i + 1].x < p.x) ++i;
      const glm::dvec2 &a = chain[i], &b = chain[i + 1];
      if (b.x - a.x < kNoise) continue;  // as good as upright
      const double part = std::clamp((p.x - a.x) / (b.x - a.x), 0.0, 1.0);
      if (side * (p.y - (a.y + part * (b.y - a.y))) < -kNoise) return false;
    }
    return true;
  }

  static constexpr double kNoise = 4;  ///< steps; events of fast corners are that exact
  const RoofOutline& outline_;
  const Skeleton& skeleton_;
};

Result<PolygonMesh> roof_over(const RoofOutline& outline, Skeleton skeleton) {
  PolygonMesh mesh = roof_floor(outline);
  for (size_t n = mesh.points.size(); n < skeleton.nodes.size(); ++n) {
    const Skeleton::Node& node = skeleton.nodes[n];
    mesh.points.emplace_back(node.at.x * outline.step, node.at.y * outline.step,
                             node.time * outline.step);
  }
  std::stable_sort(skeleton.borders.begin(), skeleton.borders.end(),
                   [](const Border& a, const Border& b) { return a.edge < b.edge; });
  const FaceMaker maker(outline, skeleton);
  const Border *begin = skeleton.borders.data(), *const last = begin + skeleton.borders.size();
  while (begin != last) {
    const Border* end = begin;
    while (end != last && end->edge == begin->edge) ++end;
    if (!maker.add(begin, end, mesh)) return not_found();
    begin = end;
  }
  return closed_roof(outline, std::move(mesh));
}

}  // namespace

Result<PolygonMesh> straight_roof(const RoofOutline& outline) {
  if (outline.edge_count() > kMostEdges) {
    return Error{ErrorCode::kLimit,
                 "roof: method \"straight\" takes up to " + std::to_string(kMostEdges) +
                     " edges, got " + std::to_string(outline.edge_count()),
                 {}};
  }
  // First with the corners as they were given, so that what is regular meets in one place; but
  // walls that are parallel on the grid may miss each other then.
  std::vector<glm::dvec2> given, on_grid;
  for (const glm::dvec2& p : outline.places) given.push_back(p / outline.step);
  for (const Point2D& p : outline.points)
    on_grid.emplace_back(static_cast<double>(p.x), static_cast<double>(p.y));
  Result<PolygonMesh> roof = not_found();
  for (const std::vector<glm::dvec2>& corners : {given, on_grid}) {
    std::optional<Skeleton> skeleton = shrink(outline, corners);
    if (skeleton) roof = roof_over(outline, *std::move(skeleton));
    if (roof) break;
  }
  return roof;
}

}  // namespace csgrun
