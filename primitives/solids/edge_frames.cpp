#include "primitives/solids/edge_frames.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include <csgrun/primitives/trig.h>

#include "primitives/base/box3_tree.h"

namespace csgrun {
namespace {

/// Directions are good to this.
constexpr double kParallel = 1e-9;
/// Parts of the setback that two cuts may have in common by rounding.
constexpr double kTouch = 1e-7;

using Point = std::array<double, 2>;

/// A convex polygon, clipped with half-planes one after another (Sutherland & Hodgman 1974).
class Clipped {
 public:
  explicit Clipped(std::span<const Point> corners) : corners_(corners.begin(), corners.end()) {}

  /// Keeps what is to the left of the line from a to b, and farther from it than `margin`.
  void keep_left(const Point& a, const Point& b, double margin) {
    const double dx = b[0] - a[0], dy = b[1] - a[1];
    const double length = std::sqrt(dx * dx + dy * dy);
    if (length == 0) return;
    const auto height = [&](const Point& p) {
      return (dx * (p[1] - a[1]) - dy * (p[0] - a[0])) / length - margin;
    };
    rest_.clear();
    for (size_t i = 0; i < corners_.size(); ++i) {
      const Point &p = corners_[i], &q = corners_[i + 1 < corners_.size() ? i + 1 : 0];
      const double at_p = height(p), at_q = height(q);
      if (at_p >= 0) rest_.push_back(p);
      if ((at_p < 0) == (at_q < 0)) continue;
      const double s = at_p / (at_p - at_q);
      rest_.push_back({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])});
    }
    corners_.swap(rest_);
  }
  /// The greatest extent along an axis.
  [[nodiscard]] double size() const {
    double result = 0;
    for (const Point& p : corners_) {
      for (const Point& q : corners_) {
        result = std::max({result, std::fabs(p[0] - q[0]), std::fabs(p[1] - q[1])});
      }
    }
    return result;
  }
  [[nodiscard]] double area() const {
    double twice = 0;
    for (size_t i = 0; i < corners_.size(); ++i) {
      const Point &p = corners_[i], &q = corners_[i + 1 < corners_.size() ? i + 1 : 0];
      twice += p[0] * q[1] - p[1] * q[0];
    }
    return std::fabs(twice) / 2;
  }

 private:
  std::vector<Point> corners_, rest_;
};

}  // namespace

EdgeFrames::EdgeFrames(const EdgeGraph& graph, std::span<const uint32_t> chosen)
    : graph_(graph), number_(graph.edges().size(), UINT32_MAX) {
  for (const uint32_t e : chosen) {
    if (number_[e] != UINT32_MAX) continue;
    number_[e] = static_cast<uint32_t>(frames_.size());
    const SolidEdge& line = graph.edges()[e].line;
    EdgeFrame& f = frames_.emplace_back();
    f.edge = e;
    f.start = line.from;
    f.length = glm::length(line.to - line.from);
    f.along = (line.to - line.from) / f.length;
    f.in = {glm::normalize(glm::cross(line.normals[0], f.along)),
            glm::normalize(glm::cross(f.along, line.normals[1]))};
  }
}

void EdgeFrames::set_size(double size, bool is_radius) {
  for (EdgeFrame& f : frames_) {
    f.setback = is_radius ? size * tan_deg(graph_.edges()[f.edge].line.turn / 2) : size;
  }
}

EdgeFrames::Next EdgeFrames::next(const EdgeFrame& f, int end, int side) const {
  const EdgeGraph::Edge& own = graph_.edges()[f.edge];
  const uint32_t id = own.next[end][side];
  const EdgeGraph::Edge& other = graph_.edges()[id];
  const uint32_t vertex = own.vertex[end];
  glm::dvec3 away = other.line.to - other.line.from;
  if (other.vertex[0] != vertex) away = -away;
  away /= glm::length(away);
  const double towards = end == 0 ? 1 : -1;  // back along the edge
  return {id, glm::dot(away, f.along) * towards, glm::dot(away, f.in[side])};
}

EdgeEnd EdgeFrames::kind(const EdgeFrame& f, int end, int side) const {
  const Next n = next(f, end, side);
  if (std::fabs(n.y) <= kParallel) return EdgeEnd::kGoesOn;
  if (frame_of(n.edge) != nullptr) return n.y > 0 ? EdgeEnd::kMitre : EdgeEnd::kInside;
  const double outwards = end == 0 ? -1 : 1;
  return glm::dot(plane_normal(f, end, side), f.along) * outwards > 0 ? EdgeEnd::kCap
                                                                      : EdgeEnd::kWall;
}

glm::dvec3 EdgeFrames::plane_normal(const EdgeFrame& f, int end, int side) const {
  const EdgeGraph::Edge& own = graph_.edges()[f.edge];
  const EdgeGraph::Edge& other = graph_.edges()[own.next[end][side]];
  return other.line.normals[other.side[0] == own.side[side] ? 1 : 0];
}

double EdgeFrames::at_plane(const EdgeFrame& f, int end, int side, const glm::dvec3& offset) const {
  const glm::dvec3 normal = plane_normal(f, end, side);
  const double slope = glm::dot(normal, f.along);
  if (std::fabs(slope) <= kParallel) return at_end(f, end);
  return at_end(f, end) - glm::dot(normal, offset) / slope;
}

double EdgeFrames::at_next_cut(const EdgeFrame& f, int end, int side) const {
  const Next n = next(f, end, side);
  // At y = setback, and as far from the next edge as its own cut goes.
  const double x = (frame_of(n.edge)->setback + f.setback * n.x) / n.y;
  return end == 0 ? x : f.length - x;
}

EdgeFrames::Strip EdgeFrames::strip(const EdgeFrame& f, int side) const {
  Strip result{{{0, 0}, {f.length, 0}, {f.length, f.setback}, {0, f.setback}}};
  for (int end = 0; end < 2; ++end) {
    double& at = result[end == 0 ? 3 : 2][0];
    switch (kind(f, end, side)) {
      case EdgeEnd::kMitre:
      case EdgeEnd::kInside:
        at = at_next_cut(f, end, side);
        break;
      case EdgeEnd::kCap:
      case EdgeEnd::kWall:
        at = at_plane(f, end, side, f.in[side] * f.setback);
        break;
      case EdgeEnd::kGoesOn:
        break;
    }
  }
  return result;
}

std::array<glm::dvec3, 4> EdgeFrames::strip_in_space(const EdgeFrame& f, int side) const {
  const Strip own = strip(f, side);
  std::array<glm::dvec3, 4> result;
  for (size_t i = 0; i < 4; ++i) {
    result[i] = f.start + own[i][0] * f.along + own[i][1] * f.in[static_cast<size_t>(side)];
  }
  return result;
}

bool EdgeFrames::has_room_beside(const EdgeFrame& f, int side, uint32_t other_id) const {
  const double margin = kTouch * f.setback;
  const Strip own = strip(f, side);
  const auto clip = [&](Clipped& polygon) {
    for (size_t i = 0; i < 4; ++i) polygon.keep_left(own[i], own[(i + 1) % 4], margin);
  };
  const auto seen = [&](const glm::dvec3& p) {
    return Point{glm::dot(p - f.start, f.along), glm::dot(p - f.start, f.in[side])};
  };
  const EdgeGraph::Edge& other = graph_.edges()[other_id];
  const std::array<Point, 2> ends{seen(other.line.from), seen(other.line.to)};
  Clipped segment(ends);
  clip(segment);
  if (segment.size() > margin) return false;
  const EdgeFrame* cut = frame_of(other_id);
  if (cut == nullptr) return true;
  const int its_side = other.side[0] == graph_.edges()[f.edge].side[side] ? 0 : 1;
  std::array<Point, 4> corners;
  const auto theirs = strip_in_space(*cut, its_side);
  for (size_t i = 0; i < 4; ++i) corners[i] = seen(theirs[i]);
  Clipped common(corners);
  clip(common);
  return common.area() <= margin * f.setback;
}

bool EdgeFrames::is_turned_over(const EdgeFrame& f, int side) const {
  const Strip own = strip(f, side);
  return own[3][0] > own[2][0] + kTouch * f.setback;
}

bool EdgeFrames::has_room(const EdgeFrame& f) const {
  for (int side = 0; side < 2; ++side) {
    if (is_turned_over(f, side)) return false;
    for (const uint32_t e : graph_.edges_of(graph_.edges()[f.edge].side[side])) {
      if (e != f.edge && !has_room_beside(f, side, e)) return false;
    }
  }
  return true;
}

std::optional<uint32_t> EdgeFrames::first_without_room() const {
  // Around each edge its strips, if it has any: what is not near to another has room beside it.
  std::vector<Box3> boxes(graph_.edges().size());
  for (uint32_t e = 0; e < boxes.size(); ++e) {
    boxes[e].add(graph_.edges()[e].line.from);
    boxes[e].add(graph_.edges()[e].line.to);
    const EdgeFrame* f = frame_of(e);
    for (int side = 0; f != nullptr && side < 2; ++side) {
      for (const glm::dvec3& p : strip_in_space(*f, side)) boxes[e].add(p);
    }
  }
  const Box3Tree tree(boxes);
  for (uint32_t i = 0; i < frames_.size(); ++i) {
    const EdgeFrame& f = frames_[i];
    bool has_room = !is_turned_over(f, 0) && !is_turned_over(f, 1);
    tree.find(boxes[f.edge], [&](uint32_t e) {
      for (int side = 0; e != f.edge && has_room && side < 2; ++side) {
        const auto& theirs = graph_.edges()[e].side;
        const uint32_t plane = graph_.edges()[f.edge].side[side];
        if (theirs[0] == plane || theirs[1] == plane) has_room = has_room_beside(f, side, e);
      }
      return has_room;
    });
    if (!has_room) return i;
  }
  return std::nullopt;
}

double EdgeFrames::size_that_fits(uint32_t frame, double size, bool is_radius) {
  // Nothing that is larger than the solid fits, and sizes far beyond it would leave the search no
  // digits to find the answer in.
  Box3 box;
  for (const EdgeGraph::Edge& edge : graph_.edges()) {
    box.add(edge.line.from);
    box.add(edge.line.to);
  }
  const glm::dvec3 extent = box.high - box.low;
  double fits = 0, fails = std::min(size, std::max({extent.x, extent.y, extent.z}));
  for (int i = 0; i < 50; ++i) {
    const double middle = (fits + fails) / 2;
    set_size(middle, is_radius);
    (has_room(frames_[frame]) ? fits : fails) = middle;
  }
  // Rounded down to something short that fits.
  const double unit = std::pow(10, std::floor(std::log10(fails)) - 3);
  const double shown = std::floor(fits / unit * (1 + 1e-6)) * unit;
  set_size(shown, is_radius);
  return has_room(frames_[frame]) ? shown : fits;
}

}  // namespace csgrun
