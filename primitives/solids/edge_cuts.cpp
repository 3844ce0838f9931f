// Bodies that are taken away along edges. Mostly they reach a little beyond the surface, so that
// no face of theirs lies in one of the solid's (see edge_reach.h): along an edge a prism over the
// triangle between the edge and the two lines on its sides, for a fillet less the cylinder.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <csgrun/primitives/trig.h>

#include "primitives/base/text.h"
#include "primitives/solids/edge_ends.h"
#include "primitives/solids/edge_reach.h"
#include "primitives/solids/edge_rims.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

class Cutter {
 public:
  Cutter(const char* name, const Solid& solid, const EdgeFrames& frames, const EdgeEnds& ends,
         double radius, const Facets& facets, double grid_step_mm, SourceRef where)
      : name_(name),
        solid_(solid),
        frames_(frames),
        ends_(ends),
        radius_(radius),
        facets_(facets),
        grid_step_mm_(grid_step_mm),
        where_(std::move(where)) {}

  Result<std::vector<NodePtr>> cuts() {
    if (const double points = count_points(); points > kMostPoints) {
      return too_many_points(name_, facets_.fragments(radius_), points);
    }
    choose_turns();
    const size_t count = frames_.frames().size();
    bodies_.resize(count);
    std::vector<bool> is_of_rim(count, false);
    if (is_fillet()) {
      for (const std::vector<uint32_t>& rim : hole_rims(frames_)) {
        cut_rim(rim);
        for (const uint32_t i : rim) is_of_rim[i] = true;
      }
    }
    for (size_t i = 0; i < count; ++i) {
      if (is_of_rim[i]) continue;
      if (auto error = make_bodies(i)) return *std::move(error);
    }
    if (is_fillet()) {
      for (const EdgeCorner& corner : ends_.corners()) balls_.push_back(ball_of(corner));
    }
    for (size_t i = 0; i < count; ++i) {
      if (!is_of_rim[i]) cut_edge(i);
    }
    for (const EdgeCorner& corner : ends_.corners()) cut_corner(corner);
    for (const EdgeTip& tip : ends_.tips()) cut_tip(tip);
    return std::move(cuts_);
  }

 private:
  using PrismEnd = EdgeEnds::PrismEnd;
  /// What is made of one edge: prisms towards its two ends (mostly the same one), which round
  /// corners end at the middle, and the cylinder.
  struct Bodies {
    std::array<NodePtr, 2> prism;
    std::array<double, 2> half{};  ///< where they end between balls, from the start of the edge
    NodePtr round;
    std::array<std::vector<NodePtr>, 2> walls;  ///< where a prism goes too far, at its ends
  };

  [[nodiscard]] bool is_fillet() const { return radius_ > 0; }
  [[nodiscard]] const EdgeGraph::Edge& edge(const EdgeFrame& f) const {
    return frames_.graph().edges()[f.edge];
  }

  NodePtr hull(std::vector<glm::dvec3> points, const EdgeFrame& f) const {
    auto mesh = std::make_shared<PolygonMesh>();
    mesh->points = std::move(points);
    mesh->hull_of_points = true;
    mesh->kind = name_;
    const NodePtr leaf = Node::leaf(std::move(mesh), where_);
    const Appearance* colour = colour_beside(f);
    return colour == nullptr ? leaf : Node::painted(*colour, leaf, where_);
  }

  [[nodiscard]] static std::array<glm::dvec3, 3> axes_of(const EdgeFrame& f) {
    return {f.along, f.in[0], glm::cross(f.along, f.in[0])};
  }
  [[nodiscard]] static bool is_upright(const EdgeFrame& f) {
    return is_along_axis(f.along) && is_along_axis(f.in[0]);
  }

  /// The chosen edge with which the bodies of another one are turned: itself, but where edges meet
  /// at balls, whose bodies share points, one for all of them.
  [[nodiscard]] uint32_t turned_with(uint32_t i) const {
    while (turned_with_[i] != i) i = turned_with_[i];
    return i;
  }
  [[nodiscard]] const EdgeFrame& turn_of(const EdgeFrame& f) const {
    return frames_.frames()[turned_with(static_cast<uint32_t>(&f - frames_.frames().data()))];
  }
  void choose_turns() {
    turned_with_.resize(frames_.frames().size());
    std::iota(turned_with_.begin(), turned_with_.end(), 0u);
    if (!is_fillet()) return;
    for (const EdgeCorner& corner : ends_.corners()) {
      for (size_t k = 1; k < 3; ++k) {
        uint32_t a = turned_with(corner.frames[0]), b = turned_with(corner.frames[k]);
        const bool a_first = is_upright(frames_.frames()[a]) == is_upright(frames_.frames()[b])
                                 ? a < b
                                 : is_upright(frames_.frames()[a]);
        if (!a_first) std::swap(a, b);
        turned_with_[b] = a;
      }
      for (const uint32_t k : corner.frames) turned_with_[k] = turned_with(k);
    }
  }

  /// The same of a body along a chosen edge: in a frame that is turned with it, so that its long
  /// faces are flat on the grid, and those that meet in a line are the same all along.
  NodePtr hull_along(std::vector<glm::dvec3> points, const EdgeFrame& f) const {
    const EdgeFrame& with = turn_of(f);
    if (is_upright(with)) return hull(std::move(points), f);
    const std::array<glm::dvec3, 3> axes = axes_of(with);
    for (glm::dvec3& p : points) {
      p = {glm::dot(p, axes[0]), glm::dot(p, axes[1]), glm::dot(p, axes[2])};
    }
    Affine turn;
    for (int i = 0; i < 3; ++i) turn.m[i] = {axes[0][i], axes[1][i], axes[2][i], 0};
    return Node::transformed(turn, hull(std::move(points), f), where_);
  }

  /// The appearance of the left side, if it has one of its own.
  [[nodiscard]] const Appearance* colour_beside(const EdgeFrame& f) const {
    const Appearance& found =
        solid_.appearances[solid_.faces[frames_.graph().face(edge(f).side[0])].appearance];
    return found.is_default ? nullptr : &found;
  }

  /// The unit vectors from the first normal of an edge to the second, at equal angles.
  [[nodiscard]] std::vector<glm::dvec3> arc(const glm::dvec3& a, const glm::dvec3& b,
                                            int parts) const {
    const double turn = atan2_deg(glm::length(glm::cross(a, b)), glm::dot(a, b));
    std::vector<glm::dvec3> result{a};
    for (int i = 1; i < parts; ++i) {
      const double part = turn * i / parts;
      result.push_back((sin_deg(turn - part) * a + sin_deg(part) * b) / sin_deg(turn));
    }
    result.push_back(b);
    return result;
  }
  /// Angles are measured between sides on the grid: what is a whole number of facets but for that
  /// must give it at every corner.
  [[nodiscard]] int parts_of(double turn) const {
    constexpr double kWhole = 1e-3;
    const double parts = facets_.fragments(radius_) * turn / 360;
    return std::max(1, static_cast<int>(std::ceil(parts - kWhole)));
  }
  [[nodiscard]] std::vector<glm::dvec3> arc_of(const EdgeFrame& f) const {
    const SolidEdge& line = edge(f).line;
    return arc(line.normals[0], line.normals[1], parts_of(line.turn));
  }

  /// What a prism that goes beyond a mitre is to be less: all from a little before it on.
  NodePtr wall_at(const EdgeFrame& f, const Mitre& mitre) const {
    const glm::dvec3 u = glm::normalize(glm::cross(mitre.normal, f.in[0]));
    const glm::dvec3 v = glm::cross(mitre.normal, u);
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 8; ++i) {
      points.push_back(mitre.corner + (i & 1 ? mitre.reach : -mitre.reach) * u +
                       (i & 2 ? mitre.reach : -mitre.reach) * v +
                       (i & 4 ? mitre.reach : -mitre.gap) * mitre.normal);
    }
    return hull(std::move(points), f);
  }

  [[nodiscard]] NodePtr prism_between(const EdgeFrame& f, const PrismEnd& from,
                                      const PrismEnd& to) const {
    const EdgeEnds::Lines offsets = EdgeEnds::lines(f);
    std::vector<glm::dvec3> points;
    for (size_t k = 0; k < 3; ++k) {
      points.push_back(f.start + offsets[k] + from.at[k] * f.along);
      points.push_back(f.start + offsets[k] + to.at[k] * f.along);
    }
    for (const PrismEnd* end : {&from, &to})
      points.insert(points.end(), end->bends.begin(), end->bends.end());
    return hull_along(std::move(points), f);
  }

  std::optional<Error> make_bodies(size_t i) {
    const EdgeFrame& f = frames_.frames()[i];
    Bodies& made = bodies_[i];
    std::array<PrismEnd, 2> ends;
    for (int end = 0; end < 2; ++end) {
      auto found = ends_.end_of(f, end);
      if (!found) return found.error();
      ends[end] = *std::move(found);
      if (const auto& wall = ends[end].wall) {
        made.walls[end].push_back(wall_at(f, *wall));
      }
    }
    const std::array<const EdgeCorner*, 2> corners{ends_.corner_at(f, 0), ends_.corner_at(f, 1)};
    if (!is_fillet() || (corners[0] == nullptr && corners[1] == nullptr)) {
      made.prism[0] = made.prism[1] = prism_between(f, ends[0], ends[1]);
    } else {
      // Each end has what is to stay of its own, so each has its own half.
      PrismEnd low, high;
      const double middle = (ends[0].at[0] + ends[1].at[0]) / 2;
      low.at.fill(middle - f.reach);
      high.at.fill(middle + f.reach);
      made.prism = {prism_between(f, ends[0], high), prism_between(f, low, ends[1])};
      made.half = {middle + f.reach, middle - f.reach};
    }
    if (is_fillet()) made.round = round_body(f, ends, corners);
    return std::nullopt;
  }

  /// Where the axis of the cylinder along an edge begins.
  [[nodiscard]] glm::dvec3 axis_of(const EdgeFrame& f) const {
    return f.start + f.setback * f.in[0] - radius_ * edge(f).line.normals[0];
  }

  /// How far above a side that is aslant its facet is where it would touch it: enough that it meets
  /// the side before the prism ends there, wherever both are rounded to. Else they leave a step,
  /// with an edge that is shorter than those of the grid. Less where facets are of few grid steps:
  /// the next corner must stay one. `cosine`: of the angle that a facet spans.
  [[nodiscard]] double lift(double cosine) const {
    constexpr double kSteps = 8;
    const double drop = radius_ * (1 - cosine);  // of the facet's other end, below the side
    return std::min(kSteps * grid_step_mm_, drop / 4);
  }

  enum class ArcEnds : uint8_t { kOnSides, kOfBall, kOfRim };

  /// Adds the corners of the arc that touches both sides of an edge. A side that is aslant has no
  /// corners of the grid in its plane: there the last facet goes on beyond it, in place of the
  /// corner on it. Balls share that, and have no lift. What stays of a rim goes on at all sides, by
  /// `least` or more.
  void add_arc(const EdgeFrame& f, const glm::dvec3& middle, ArcEnds kind, double least,
               std::vector<glm::dvec3>& points) const {
    const std::vector<glm::dvec3> directions = arc_of(f);
    const size_t first = points.size(), last = directions.size() - 1;
    const double cosine = glm::dot(directions[0], directions[1]);
    for (const glm::dvec3& d : directions) points.push_back(middle + radius_ * d);
    const auto go_on = [&](size_t i, size_t before, const glm::dvec3& normal) {
      const glm::dvec3 corner = points[first + i];
      glm::dvec3 along = radius_ * (directions[i] - directions[before]);
      const double times = std::max(1.0, least / glm::length(along));
      along *= times;
      if (!is_along_axis(normal)) {
        if (kind == ArcEnds::kOfBall) {
          points.push_back(corner + along);
        } else {
          points[first + i] = corner + along + (1 + times) * lift(cosine) * normal;
        }
      } else if (kind == ArcEnds::kOfRim) {
        // Less steep than the facet: the corner stays one.
        points.push_back(corner + along - glm::dot(along, normal) / 2 * normal);
      }
    };
    go_on(0, 1, edge(f).line.normals[0]);
    go_on(last, last - 1, edge(f).line.normals[1]);
  }

  /// The part of the cylinder that stays: between its axis and its surface, as long as the prisms
  /// and longer; at a ball up to it. Null where nothing is between two balls.
  NodePtr round_body(const EdgeFrame& f, const std::array<PrismEnd, 2>& ends,
                     const std::array<const EdgeCorner*, 2>& corners) const {
    const glm::dvec3 axis = axis_of(f);
    const bool has_ball = corners[0] != nullptr || corners[1] != nullptr;
    std::array<double, 2> at{};
    std::vector<glm::dvec3> points;
    for (int end = 0; end < 2; ++end) {
      glm::dvec3 middle;
      if (corners[end] != nullptr) {
        middle = corners[end]->centre;
        at[end] = glm::dot(middle - f.start, f.along);
      } else {
        const auto [low, high] = std::minmax_element(ends[end].at.begin(), ends[end].at.end());
        at[end] = end == 0 ? *low - f.setback : *high + f.setback;
        // Beyond the points in which cuts meet at a tip it would be left beside that.
        if (ends_.is_tip(f, end)) {
          const double left = frames_.at_next_cut(f, end, 0),
                       right = frames_.at_next_cut(f, end, 1);
          at[end] = end == 0 ? std::max(left, right) : std::min(left, right);
        }
        middle = axis + at[end] * f.along;
      }
      points.push_back(middle);
      add_arc(f, middle, has_ball ? ArcEnds::kOfBall : ArcEnds::kOnSides, 0, points);
    }
    if (at[1] - at[0] <= 1e-9 * (f.length + f.setback)) return nullptr;
    return hull_along(std::move(points), f);
  }

  /// Around a hole all prisms go at once, less all that stays: what stays along an edge is farther
  /// in, seen from the hole, than what goes, so that it may reach beyond its mitres, and what it
  /// leaves there of its neighbours' prisms stays beside them, too.
  void cut_rim(const std::vector<uint32_t>& rim) {
    double more = 0;
    for (const uint32_t i : rim) {
      more = std::max(more, 2 * EdgeEnds::kBeyondMitres * frames_.frames()[i].reach);
    }
    std::vector<NodePtr> prisms, kept;
    for (const uint32_t i : rim) {
      const EdgeFrame& f = frames_.frames()[i];
      const std::array<PrismEnd, 2> ends{ends_.end_beyond_mitre(f, 0),
                                         ends_.end_beyond_mitre(f, 1)};
      prisms.push_back(prism_between(f, ends[0], ends[1]));
      const auto& [from, to] = ends;
      const std::array<double, 2> at{*std::min_element(from.at.begin(), from.at.end()) - more,
                                     *std::max_element(to.at.begin(), to.at.end()) + more};
      const glm::dvec3 axis = axis_of(f);
      std::vector<glm::dvec3> points;
      for (const double end : at) {
        const glm::dvec3 middle = axis + end * f.along;
        points.push_back(middle + more * (f.in[0] + f.in[1]));
        add_arc(f, middle, ArcEnds::kOfRim, 2 * more, points);
      }
      kept.push_back(hull_along(std::move(points), f));
    }
    cuts_.push_back(
        less(Node::boolean(BooleanOp::kUnion, std::move(prisms), where_), std::move(kept), where_));
  }

  static NodePtr less(NodePtr from, std::vector<NodePtr> what, const SourceRef& where) {
    what.insert(what.begin(), std::move(from));
    return Node::boolean(BooleanOp::kDifference, std::move(what), where);
  }

  void cut_edge(size_t i) {
    const EdgeFrame& f = frames_.frames()[i];
    const Bodies& own = bodies_[i];
    for (int end = 0; end < 2; ++end) {
      if (own.prism[0] == own.prism[1] && end == 1) break;
      if (is_fillet() && ends_.corner_at(f, end) != nullptr) continue;  // with the corner
      std::vector<NodePtr> kept;
      if (own.round) kept.push_back(own.round);
      for (int k = 0; k < 2; ++k) {
        if (k != end && own.prism[0] != own.prism[1]) continue;
        kept.insert(kept.end(), own.walls[k].begin(), own.walls[k].end());
      }
      cuts_.push_back(less(own.prism[end], std::move(kept), where_));
    }
    // At a corner that points inwards each cut ends a little before the mitre: around it goes what
    // both have, so that their faces meet where they cross.
    for (int end = 0; end < 2; ++end) {
      for (int side = 0; side < 2; ++side) {
        if (frames_.kind(f, end, side) != EdgeEnd::kInside) continue;
        const EdgeFrame& other = *frames_.frame_of(edge(f).next[end][side]);
        const auto k = static_cast<size_t>(&other - frames_.frames().data());
        if (k < i) continue;
        const int its_end = edge(other).vertex[0] == edge(f).vertex[end] ? 0 : 1;
        cuts_.push_back(Node::boolean(BooleanOp::kIntersection,
                                      {rounded(i, end), rounded(k, its_end)}, where_));
      }
    }
  }

  [[nodiscard]] NodePtr rounded(size_t i, int end) const {
    const Bodies& b = bodies_[i];
    return b.round ? less(b.prism[end], {b.round}, where_) : b.prism[end];
  }

  NodePtr ball_of(const EdgeCorner& corner) const {
    std::vector<glm::dvec3> points{corner.centre};
    for (const uint32_t k : corner.frames) {
      for (const glm::dvec3& d : arc_of(frames_.frames()[k])) {
        points.push_back(corner.centre + radius_ * d);
      }
    }
    add_ball(ends_.normals_at(corner), corner.centre, points);
    return hull_along(std::move(points), frames_.frames()[corner.frames[0]]);
  }

  [[nodiscard]] const NodePtr& ball_at(const EdgeCorner& corner) const {
    return balls_[static_cast<size_t>(&corner - ends_.corners().data())];
  }

  /// The cuts along four edges and more leave a needle between them: the hull of the corner and the
  /// points in which they meet on the sides. It goes, and a little of what the cuts take.
  void cut_tip(const EdgeTip& tip) {
    const EdgeFrame& first = frames_.frames()[tip.frames[0]];
    const glm::dvec3 corner = solid_.positions[tip.vertex];
    glm::dvec3 axis(0);  // inwards: all of a convex corner is behind all its sides
    std::vector<glm::dvec3> points;
    double reach = 0;
    for (const uint32_t k : tip.frames) {
      const EdgeFrame& f = frames_.frames()[k];
      for (const glm::dvec3& n : edge(f).line.normals) axis -= n;
      reach = std::max(reach, f.outwards());
      const auto [left, right] = ends_.meeting_points(f, ends_.end_at(f, tip.vertex));
      glm::dvec3 outwards = glm::normalize(glm::cross(left - corner, right - corner));
      if (glm::dot(outwards, f.in[0] + f.in[1]) > 0) outwards = -outwards;
      const glm::dvec3 overlap = 2 * f.outwards() * outwards;
      for (const glm::dvec3& p : {left, right, corner}) points.push_back(p + overlap);
      points.push_back(left);
      points.push_back(right);
    }
    points.push_back(corner - 4 * reach * glm::normalize(axis));
    cuts_.push_back(hull(std::move(points), first));
  }

  void cut_corner(const EdgeCorner& corner) {
    const auto n = ends_.normals_at(corner);
    const EdgeFrame& first = frames_.frames()[corner.frames[0]];
    double reach = first.outwards();
    for (const uint32_t k : corner.frames) reach = std::min(reach, frames_.frames()[k].outwards());
    const glm::dvec3 outside = ends_.in_front(corner, reach);
    if (!is_fillet()) {
      std::vector<glm::dvec3> points;
      for (const uint32_t k : corner.frames) {
        const EdgeFrame& f = frames_.frames()[k];
        for (const glm::dvec3& p : ends_.meeting_points(f, ends_.end_at(f, corner.vertex)))
          points.push_back(p);
      }
      // Each is there twice, from both edges of its side. A little larger, in the same plane.
      glm::dvec3 sum(0);
      for (const glm::dvec3& p : points) sum += p;
      for (glm::dvec3& p : points) p += reach / first.setback * (3.0 * p - sum / 2.0);
      points.push_back(outside);
      cuts_.push_back(hull(std::move(points), first));
      return;
    }
    const glm::dvec3& c = corner.centre;
    std::vector<glm::dvec3> around{c, outside};
    for (const glm::dvec3& m : n) around.push_back(c + (radius_ + reach) * m);
    std::vector<NodePtr> prisms, kept{ball_at(corner)};
    for (const uint32_t k : corner.frames) {
      const EdgeFrame& f = frames_.frames()[k];
      const SolidEdge& line = edge(f).line;
      const double at = glm::dot(c - f.start, f.along);
      const glm::dvec3 outwards = line.normals[0] + line.normals[1];
      around.push_back(f.start + at * f.along +
                       reach / glm::dot(outwards, line.normals[0]) * outwards);
      const int end = ends_.end_at(f, corner.vertex);
      prisms.push_back(bodies_[k].prism[end]);
      if (bodies_[k].round) kept.push_back(bodies_[k].round);
      // Where little or nothing is between two balls, a half reaches into the other one.
      const EdgeCorner* far = ends_.corner_at(f, 1 - end);
      if (far == nullptr) continue;
      const double beyond = bodies_[k].half[end] - glm::dot(far->centre - f.start, f.along);
      if (!bodies_[k].round || (end == 0 ? beyond : -beyond) > 0) kept.push_back(ball_at(*far));
    }
    prisms.push_back(hull_along(std::move(around), first));
    cuts_.push_back(
        less(Node::boolean(BooleanOp::kUnion, std::move(prisms), where_), std::move(kept), where_));
  }

  /// The steepest of three directions, and the rows from there and columns between the others.
  struct BallGrid {
    size_t pole = 0;
    int rows = 0, columns = 0;
  };
  [[nodiscard]] BallGrid grid_of_ball(const std::array<glm::dvec3, 3>& n) const {
    BallGrid result;
    for (size_t i = 1; i < 3; ++i) {
      if (std::fabs(n[i].z) > std::fabs(n[result.pole].z)) result.pole = i;
    }
    const auto turn = [](const glm::dvec3& p, const glm::dvec3& q) {
      return atan2_deg(glm::length(glm::cross(p, q)), glm::dot(p, q));
    };
    const glm::dvec3 &top = n[result.pole], &a = n[(result.pole + 1) % 3],
                     &b = n[(result.pole + 2) % 3];
    result.rows = parts_of(std::max(turn(top, a), turn(top, b)));
    result.columns = parts_of(turn(a, b));
    return result;
  }

  /// Of all that is round, more or less.
  [[nodiscard]] double count_points() const {
    if (!is_fillet()) return 0;
    double points = 0;
    for (const EdgeFrame& f : frames_.frames()) points += 2.0 * parts_of(edge(f).line.turn);
    for (const EdgeCorner& corner : ends_.corners()) {
      const BallGrid grid = grid_of_ball(ends_.normals_at(corner));
      points += static_cast<double>(grid.rows) * grid.columns;
    }
    return points;
  }

  /// Points of the sphere between three directions, in rows from the steepest of them.
  void add_ball(const std::array<glm::dvec3, 3>& n, const glm::dvec3& centre,
                std::vector<glm::dvec3>& points) const {
    const auto [pole, rows, columns] = grid_of_ball(n);
    const glm::dvec3 &a = n[(pole + 1) % 3], &b = n[(pole + 2) % 3];
    const std::vector<glm::dvec3> foot = arc(a, b, columns);
    for (int k = 1; k < columns; ++k) {
      const std::vector<glm::dvec3> row = arc(foot[static_cast<size_t>(k)], n[pole], rows);
      for (int i = 1; i < rows; ++i) {
        points.push_back(centre + radius_ * row[static_cast<size_t>(i)]);
      }
    }
  }

  const char* name_;
  const Solid& solid_;
  const EdgeFrames& frames_;
  const EdgeEnds& ends_;
  const double radius_;
  const Facets& facets_;
  const double grid_step_mm_;
  const SourceRef where_;
  std::vector<uint32_t> turned_with_;
  std::vector<Bodies> bodies_;
  std::vector<NodePtr> balls_;  ///< by corner: the part of each that stays
  std::vector<NodePtr> cuts_;
};

/// An error when an edge is concave, or the cut of one has no room.
std::optional<Error> check(EdgeFrames& frames, double size, bool is_radius) {
  for (const EdgeFrame& f : frames.frames()) {
    const SolidEdge& line = frames.graph().edges()[f.edge].line;
    if (!line.is_convex) {
      return invalid_argument(edge_text(line) + " is concave; only convex edges can be cut");
    }
  }
  frames.set_size(size, is_radius);
  const auto narrow = frames.first_without_room();
  if (!narrow) return std::nullopt;
  const EdgeFrame& f = frames.frames()[*narrow];
  // What a notch leaves of a facet is short, and shorter the finer the circle is.
  const std::string how_short =
      f.length < size ? fmt::format(", which is {:.4g} long", f.length) : std::string();
  return invalid_argument(fmt::format("{} is too much for {}{}: {:.4g} fits", number_text(size),
                                      edge_text(frames.graph().edges()[f.edge].line), how_short,
                                      frames.size_that_fits(size, is_radius)));
}

Result<NodePtr> cut_edges(const char* name, const EdgeCut& cut, double size, double radius,
                          const Facets& facets) {
  const EdgeGraph graph(cut.evaluated, cut.grid_step_mm);
  EdgeFrames frames(graph, cut.chosen);
  if (auto error = check(frames, size, radius > 0)) return *std::move(error);
  const EdgeEnds ends(cut.evaluated, frames, radius);
  if (auto error = choose_reaches(cut.evaluated, frames, ends, cut.grid_step_mm)) {
    return *std::move(error);
  }
  auto cuts =
      Cutter(name, cut.evaluated, frames, ends, radius, facets, cut.grid_step_mm, cut.where).cuts();
  if (!cuts) return cuts.error();
  cuts->insert(cuts->begin(), cut.solid);
  return Node::boolean(BooleanOp::kDifference, *std::move(cuts), cut.where);
}

}  // namespace

Result<NodePtr> chamfer_edges(const EdgeCut& cut, double distance) {
  return cut_edges("chamfer", cut, distance, 0, {});
}

Result<NodePtr> fillet_edges(const EdgeCut& cut, double radius, const Facets& facets) {
  return cut_edges("fillet", cut, radius, radius, facets);
}

}  // namespace csgrun
