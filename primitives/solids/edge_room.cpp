// Whether the cuts along chosen edges have room on the sides beside them.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include <csgrun/primitives/trig.h>

#include "primitives/base/box3_tree.h"
#include "primitives/solids/edge_frames.h"

namespace csgrun {
namespace {

/// Parts of the setback that two cuts may have in common by rounding.
constexpr double kTouch = 1e-7;
/// Angles between sides that are the same but for rounding, degrees.
constexpr double kAlikeTurns = 1e-6;
/// Edges may vanish between two that turn by less: else these may not meet, or far away.
constexpr double kMostTurn = 150;
/// So many edges are looked at on either side.
constexpr int kMostVanishing = 64;

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
  [[nodiscard]] const std::vector<Point>& corners() const { return corners_; }
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

/// How far into the side a strip goes.
double height_of(std::span<const Point> strip) {
  double height = 0;
  for (const Point& p : strip) height = std::max(height, p[1]);
  return height;
}

}  // namespace

EdgeFrames::Around EdgeFrames::around(const EdgeFrame& f, int end, int side) const {
  // Bodies at corners of more cuts are made for edges that reach them.
  const EdgeEnd below = kind(f, end, 1 - side);
  if (kind(f, end, side) != EdgeEnd::kMitre || below == EdgeEnd::kMitre ||
      below == EdgeEnd::kInside) {
    return {};
  }
  const Next n = next(f, end, side);
  const EdgeGraph::Edge &own = graph_.edges()[f.edge], &other = graph_.edges()[n.edge];
  // Cuts are as deep as far in only if they stand alike on the side.
  if (std::fabs(other.line.turn - own.line.turn) > kAlikeTurns) return {};
  return {frame_of(n.edge), other.vertex[0] == own.vertex[end] ? 1 : 0,
          other.side[0] == own.side[side] ? 0 : 1, atan2_deg(n.y, -n.x)};
}

template <class Visit>
void EdgeFrames::walk(const EdgeFrame& f, int end, int side, Visit&& visit) const {
  double turn = 0;
  uint32_t at = number_[f.edge];
  for (int i = 0; i < kMostVanishing; ++i) {
    const Around& next = around_[at][static_cast<size_t>(end)][static_cast<size_t>(side)];
    if (next.frame == nullptr || next.frame->edge == f.edge) return;
    turn += next.turn;
    if (turn > kMostTurn || !visit(next)) return;
    at = number_[next.frame->edge], end = next.far_end, side = next.side;
  }
}

void EdgeFrames::find_turned_over() {
  is_turned_over_.assign(frames_.size(), {});
  any_turned_over_ = false;
  for (size_t i = 0; i < frames_.size(); ++i) {
    for (int side = 0; side < 2; ++side) {
      const std::array<Place, 4> own = plain_strip(frames_[i], side);
      const bool is_over = own[3][0] > own[2][0] + kTouch * frames_[i].setback;
      is_turned_over_[i][static_cast<size_t>(side)] = is_over;
      any_turned_over_ |= is_over;
    }
  }
  strips_.assign(any_turned_over_ ? frames_.size() : 0, {});
}

std::vector<EdgeFrames::Place> EdgeFrames::strip(const EdgeFrame& f, int side) const {
  const std::array<Place, 4> plain = plain_strip(f, side);
  if (!any_turned_over_) return {plain.begin(), plain.end()};
  auto& known = strips_[number_[f.edge]][static_cast<size_t>(side)];
  if (!known.empty()) return known;
  bool is_clipped = is_turned_over(f, side);
  for (int end = 0; end < 2 && !is_clipped; ++end) {
    walk(f, end, side, [&](const Around& other) {
      is_clipped = is_turned_over(*other.frame, other.side);
      return !is_clipped;
    });
  }
  known = is_clipped ? clipped_strip(f, side) : std::vector<Place>(plain.begin(), plain.end());
  return known;
}

std::vector<EdgeFrames::Place> EdgeFrames::clipped_strip(const EdgeFrame& f, int side) const {
  std::array<Place, 4> plain = plain_strip(f, side);
  if (is_turned_over(f, side)) plain[2][0] = f.length, plain[3][0] = 0;
  Clipped clipped(plain);
  const glm::dvec3& across = f.in[static_cast<size_t>(side)];
  for (int end = 0; end < 2; ++end) {
    walk(f, end, side, [&](const Around& other) {
      // What is no farther from our line, which is y, than from the other's: u x + v y >= least.
      const glm::dvec3& inwards = other.frame->in[static_cast<size_t>(other.side)];
      const double u = glm::dot(inwards, f.along), v = glm::dot(inwards, across) - 1;
      const double least = glm::dot(other.frame->start - f.start, inwards), size = u * u + v * v;
      const Place on{u * least / size, v * least / size};
      clipped.keep_left(on, {on[0] + v, on[1] - u}, 0);
      return true;
    });
  }
  return clipped.corners();
}

double EdgeFrames::strip_end(const EdgeFrame& f, int end, int side) const {
  const std::vector<Place> own = strip(f, side);
  const double top = height_of(own);
  double at = end == 0 ? HUGE_VAL : -HUGE_VAL;
  for (const Place& p : own) {
    if (p[1] < top - kTouch * f.setback) continue;
    at = end == 0 ? std::min(at, p[0]) : std::max(at, p[0]);
  }
  return at;
}

std::vector<EdgeFrames::Bend> EdgeFrames::bends(const EdgeFrame& f, int end, int side) const {
  const std::vector<Place> own = strip(f, side);
  std::vector<Bend> result;
  const double top = height_of(own);
  const double margin = kTouch * f.setback, middle = strip_end(f, end, side);
  for (const Place& p : own) {
    if (p[1] <= margin || p[1] >= top - margin) continue;
    // The strip narrows: what is on this side of where it ends is on this end's side.
    if (end == 0 ? p[0] > middle : p[0] < middle) continue;
    const glm::dvec3 at = f.start + p[0] * f.along + p[1] * f.in[static_cast<size_t>(side)];
    result.push_back({at, at + (f.setback - p[1]) * f.in[static_cast<size_t>(1 - side)]});
  }
  return result;
}

bool EdgeFrames::reaches_setback(const EdgeFrame& f, int side) const {
  return height_of(strip(f, side)) >= f.setback * (1 - kTouch);
}

std::array<EdgeFrames::Place, 4> EdgeFrames::plain_strip(const EdgeFrame& f, int side) const {
  std::array<Place, 4> result{{{0, 0}, {f.length, 0}, {f.length, f.setback}, {0, f.setback}}};
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

std::vector<glm::dvec3> EdgeFrames::strip_in_space(const EdgeFrame& f, int side) const {
  std::vector<glm::dvec3> result;
  for (const Place& p : strip(f, side))
    result.push_back(f.start + p[0] * f.along + p[1] * f.in[static_cast<size_t>(side)]);
  return result;
}

bool EdgeFrames::has_room_beside(const EdgeFrame& f, int side, uint32_t other_id) const {
  const uint32_t plane = graph_.edges()[f.edge].side[side];
  const double margin = std::max(kTouch * f.setback, graph_.roughness(plane));
  const std::vector<Place> own = strip(f, side);
  const auto clip = [&](Clipped& polygon) {
    for (size_t i = 0; i < own.size(); ++i) {
      polygon.keep_left(own[i], own[i + 1 < own.size() ? i + 1 : 0], margin);
    }
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
  const int its_side = other.side[0] == plane ? 0 : 1;
  std::vector<Point> corners;
  for (const glm::dvec3& p : strip_in_space(*cut, its_side)) corners.push_back(seen(p));
  Clipped common(corners);
  clip(common);
  return common.area() <= margin * f.setback;
}

bool EdgeFrames::has_room_at_ends(const EdgeFrame& f, int side) const {
  // One that is turned over reaches so far only where no neighbour clipped it.
  if (reaches_setback(f, side)) return !is_turned_over(f, side);
  for (int end = 0; end < 2; ++end) {
    bool is_closed = false;
    walk(f, end, side, [&](const Around& other) {
      is_closed = reaches_setback(*other.frame, other.side);
      return !is_closed;
    });
    if (!is_closed) return false;
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
    bool has_room = has_room_at_ends(f, 0) && has_room_at_ends(f, 1);
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

double EdgeFrames::size_that_fits(double size, bool is_radius) {
  const auto fits_all = [&](double s) {
    set_size(s, is_radius);
    return !first_without_room();
  };

  // Nothing that is larger than the solid fits, and sizes far beyond it would leave the search no
  // digits to find the answer in.
  Box3 box;
  for (const EdgeGraph::Edge& edge : graph_.edges()) {
    box.add(edge.line.from);
    box.add(edge.line.to);
  }
  const glm::dvec3 extent = box.high - box.low;
  constexpr int kHalvings = 24;  // the answer has four digits
  double fits = 0, fails = std::min(size, std::max({extent.x, extent.y, extent.z}));
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (fits + fails) / 2;
    (fits_all(middle) ? fits : fails) = middle;
  }
  // Rounded down to something short that fits.
  const double unit = std::pow(10, std::floor(std::log10(fails)) - 3);
  const double shown = std::floor(fits / unit * (1 + 1e-6)) * unit;
  for (const double s : {shown, shown - unit}) {
    if (s > 0 && fits_all(s)) return s;
  }
  return fits;
}

}  // namespace csgrun
