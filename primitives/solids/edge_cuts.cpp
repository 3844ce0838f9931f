// Bodies that are taken away along edges. All of them reach a little beyond the surface, so that
// no face of theirs lies in one of the solid's: along an edge a prism over the triangle between the
// edge and the two lines on its sides, for a fillet less the cylinder.
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
#include "primitives/solids/edge_frames.h"

namespace csgrun {
namespace {

/// How far bodies reach beyond the surface, and into one another: this part of the setback.
constexpr double kReach = 1e-3;

std::string point_text(const glm::dvec3& p) {
  return "{" + number_text(p.x) + ", " + number_text(p.y) + ", " + number_text(p.z) + "}";
}

std::string edge_text(const SolidEdge& edge) {
  return "the edge from " + point_text(edge.from) + " to " + point_text(edge.to);
}

bool is_along_axis(const glm::dvec3& n) {
  return std::fabs(n.x) + std::fabs(n.y) + std::fabs(n.z) == 1;
}

class Cutter {
 public:
  Cutter(const char* name, const Solid& solid, const EdgeFrames& frames, double radius,
         const Facets& facets, SourceRef where)
      : name_(name),
        solid_(solid),
        frames_(frames),
        radius_(radius),
        facets_(facets),
        where_(std::move(where)) {}

  Result<std::vector<NodePtr>> cuts() {
    find_corners();
    choose_turns();
    const size_t count = frames_.frames().size();
    bodies_.resize(count);
    for (size_t i = 0; i < count; ++i) {
      if (auto error = make_bodies(i)) return *std::move(error);
    }
    if (is_fillet()) {
      for (Corner& corner : corners_) corner.ball = ball_of(corner);
    }
    for (size_t i = 0; i < count; ++i) cut_edge(i);
    for (const Corner& corner : corners_) cut_corner(corner);
    return std::move(cuts_);
  }

 private:
  /// A vertex all three edges of which are chosen.
  struct Corner {
    uint32_t vertex;
    std::array<uint32_t, 3> frames;
    glm::dvec3 centre{0};  ///< of the ball, for fillets
    NodePtr ball{};        ///< the part of it that stays
  };
  /// What is made of one edge: prisms towards its two ends (mostly the same one), which round
  /// corners end at the middle, and the cylinder.
  struct Bodies {
    std::array<NodePtr, 2> prism;
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
    for (const Corner& corner : corners_) {
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

  void find_corners() {
    std::vector<std::pair<uint32_t, uint32_t>> ends;
    for (uint32_t i = 0; i < frames_.frames().size(); ++i) {
      for (const uint32_t v : edge(frames_.frames()[i]).vertex) ends.emplace_back(v, i);
    }
    std::sort(ends.begin(), ends.end());
    for (size_t i = 0; i + 2 < ends.size(); ++i) {
      const uint32_t v = ends[i].first;
      if (ends[i + 2].first != v || frames_.graph().degree(v) != 3) continue;
      Corner corner{v, {ends[i].second, ends[i + 1].second, ends[i + 2].second}};
      // Three convex edges may still turn inwards in one of the sides.
      bool is_convex = true;
      for (const uint32_t k : corner.frames) {
        const EdgeFrame& f = frames_.frames()[k];
        const int end = edge(f).vertex[0] == v ? 0 : 1;
        for (int side = 0; side < 2; ++side) {
          is_convex &= frames_.kind(f, end, side) == EdgeEnd::kMitre;
        }
      }
      if (!is_convex) continue;
      corner.centre = in_front(corner, -radius_);
      corners_.push_back(corner);
    }
  }

  /// The two sides of the first edge, and the one that both others have.
  [[nodiscard]] std::array<glm::dvec3, 3> normals_at(const Corner& corner) const {
    const EdgeGraph::Edge& first = edge(frames_.frames()[corner.frames[0]]);
    const EdgeGraph::Edge& second = edge(frames_.frames()[corner.frames[1]]);
    const int other = second.side[0] == first.side[0] || second.side[0] == first.side[1] ? 1 : 0;
    return {first.line.normals[0], first.line.normals[1], second.line.normals[other]};
  }

  [[nodiscard]] glm::dvec3 position(uint32_t vertex) const { return solid_.positions[vertex]; }

  /// The point that is as far in front of all three sides at a corner.
  [[nodiscard]] glm::dvec3 in_front(const Corner& corner, double distance) const {
    const auto n = normals_at(corner);
    const double volume = glm::dot(n[0], glm::cross(n[1], n[2]));
    const glm::dvec3 sum = glm::cross(n[1], n[2]) + glm::cross(n[2], n[0]) + glm::cross(n[0], n[1]);
    return position(corner.vertex) + distance / volume * sum;
  }

  [[nodiscard]] const Corner* corner_at(const EdgeFrame& f, int end) const {
    const uint32_t v = edge(f).vertex[end];
    for (const Corner& c : corners_) {
      if (c.vertex == v) return &c;
    }
    return nullptr;
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
  [[nodiscard]] int parts_of(double turn) const {
    return std::max(1, static_cast<int>(std::ceil(facets_.fragments(radius_) * turn / 360 - 1e-9)));
  }
  [[nodiscard]] std::vector<glm::dvec3> arc_of(const EdgeFrame& f) const {
    const SolidEdge& line = edge(f).line;
    return arc(line.normals[0], line.normals[1], parts_of(line.turn));
  }

  /// Where the three lines of a prism end: those on the sides and the one outside of the edge.
  struct PrismEnd {
    std::array<double, 3> at{};
  };

  std::optional<Error> end_prism(const EdgeFrame& f, int end,
                                 const std::array<glm::dvec3, 3>& offsets, PrismEnd& result,
                                 std::vector<NodePtr>& walls) {
    const double outwards = end == 0 ? -1 : 1, more = outwards * kReach * f.setback;
    const auto farther = [&](double a, double b) {
      return end == 0 ? std::min(a, b) : std::max(a, b);
    };
    const auto nearer = [&](double a, double b) {
      return end == 0 ? std::max(a, b) : std::min(a, b);
    };
    if (const Corner* corner = corner_at(f, end); corner != nullptr && is_fillet()) {
      result.at.fill(glm::dot(corner->centre - f.start, f.along) + more);
      return std::nullopt;
    }
    const double here = EdgeFrames::at_end(f, end);
    std::array<EdgeEnd, 2> kinds;
    for (int side = 0; side < 2; ++side) kinds[side] = frames_.kind(f, end, side);
    if (kinds[0] == EdgeEnd::kInside || kinds[1] == EdgeEnd::kInside) {
      if (frames_.graph().degree(edge(f).vertex[end]) != 3) {
        return invalid_argument(fmt::format(
            "the cuts of the edges that meet at {} cannot be joined: other edges end there, too",
            point_text(position(edge(f).vertex[end]))));
      }
      const int side = kinds[0] == EdgeEnd::kInside ? 0 : 1;
      const Mitre mitre = mitre_at(f, end, side);
      result.at.fill(frames_.at_next_cut(f, end, side) + 8 * more);
      walls.push_back(slab(f, mitre, -mitre.gap, mitre.reach));
      return std::nullopt;
    }
    std::optional<double> cap, barrier;
    double aslant = 0;
    for (int side = 0; side < 2; ++side) {
      double& at = result.at[side];
      at = here;
      if (kinds[side] == EdgeEnd::kGoesOn) continue;
      if (kinds[side] == EdgeEnd::kMitre) {
        at = frames_.at_next_cut(f, end, side) + more;
      } else {
        at = frames_.at_plane(f, end, side, offsets[side]);
        if (kinds[side] == EdgeEnd::kCap) {
          // Outside of the solid the plane may be met earlier than on the side.
          at = farther(at, frames_.at_plane(f, end, side, f.in[side] * f.setback)) + more;
        }
      }
      const double outer = frames_.at_plane(f, end, side, offsets[2]);
      if (kinds[side] == EdgeEnd::kWall) {
        barrier = barrier ? nearer(*barrier, outer) : outer;
      } else {
        cap = cap ? farther(*cap, outer) : outer;
      }
      // The plane of a mitre is farther out there by as much as it is farther in on the side.
      aslant += kReach * std::fabs(at - here);
    }
    result.at[2] =
        barrier ? *barrier : farther(cap.value_or(here), here) + more + outwards * aslant;
    return std::nullopt;
  }

  /// The plane in which the cuts of two edges meet at a corner that points inwards: through the
  /// corner, the point where their lines on the common side meet, and the third edge.
  struct Mitre {
    glm::dvec3 corner{0}, normal{0};  ///< the normal points away from the edge
    double reach = 0;                 ///< more than what the cuts need around the corner
    double gap = 0;  ///< so far from the plane a cut ends, less than it reaches out of the solid
  };
  [[nodiscard]] Mitre mitre_at(const EdgeFrame& f, int end, int side) const {
    const uint32_t vertex = edge(f).vertex[end];
    Mitre result;
    result.corner = position(vertex);
    const double at = frames_.at_next_cut(f, end, side), here = EdgeFrames::at_end(f, end);
    const glm::dvec3 inwards = (at - here) * f.along + f.setback * f.in[side];
    const EdgeGraph::Edge& third = frames_.graph().edges()[edge(f).next[end][1 - side]];
    result.normal = glm::normalize(glm::cross(inwards, third.line.to - third.line.from));
    if (glm::dot(result.normal, f.along) * (end == 0 ? -1 : 1) < 0) result.normal = -result.normal;
    const glm::dvec3& down = f.in[static_cast<size_t>(1 - side)];
    const double below = frames_.at_plane(f, end, 1 - side, down * f.setback) - here;
    result.reach =
        1.25 * std::max(glm::length(inwards), glm::length(below * f.along + f.setback * down));
    result.gap = kReach / 4 * f.setback * std::fabs(glm::dot(result.normal, f.along));
    return result;
  }

  /// A body between two planes along that of a mitre.
  NodePtr slab(const EdgeFrame& f, const Mitre& mitre, double low, double high) const {
    const glm::dvec3 u = glm::normalize(glm::cross(mitre.normal, f.in[0]));
    const glm::dvec3 v = glm::cross(mitre.normal, u);
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 8; ++i) {
      points.push_back(mitre.corner + (i & 1 ? mitre.reach : -mitre.reach) * u +
                       (i & 2 ? mitre.reach : -mitre.reach) * v +
                       (i & 4 ? high : low) * mitre.normal);
    }
    return hull(std::move(points), f);
  }

  std::optional<Error> make_bodies(size_t i) {
    const EdgeFrame& f = frames_.frames()[i];
    Bodies& made = bodies_[i];
    const double a = f.setback;
    const std::array<glm::dvec3, 3> offsets{a * f.in[0] + kReach * a * (f.in[0] - f.in[1]),
                                            a * f.in[1] + kReach * a * (f.in[1] - f.in[0]),
                                            -kReach * a * (f.in[0] + f.in[1])};
    std::array<PrismEnd, 2> ends;
    for (int end = 0; end < 2; ++end) {
      if (auto error = end_prism(f, end, offsets, ends[end], made.walls[end])) return error;
    }
    const auto prism = [&](const PrismEnd& from, const PrismEnd& to) {
      std::vector<glm::dvec3> points;
      for (size_t k = 0; k < 3; ++k) {
        points.push_back(f.start + offsets[k] + from.at[k] * f.along);
        points.push_back(f.start + offsets[k] + to.at[k] * f.along);
      }
      return hull_along(std::move(points), f);
    };
    const std::array<const Corner*, 2> corners{corner_at(f, 0), corner_at(f, 1)};
    if (!is_fillet() || (corners[0] == nullptr && corners[1] == nullptr)) {
      made.prism[0] = made.prism[1] = prism(ends[0], ends[1]);
    } else {
      // Each end has what is to stay of its own, so each has its own half.
      PrismEnd low, high;
      const double middle = (ends[0].at[0] + ends[1].at[0]) / 2;
      low.at.fill(middle - kReach * a);
      high.at.fill(middle + kReach * a);
      made.prism = {prism(ends[0], high), prism(low, ends[1])};
    }
    if (is_fillet()) made.round = round_body(f, ends, corners);
    return std::nullopt;
  }

  /// The part of the cylinder that stays: between its axis and its surface, as long as the prisms
  /// and longer; at a ball up to it. Null where nothing is between two balls.
  NodePtr round_body(const EdgeFrame& f, const std::array<PrismEnd, 2>& ends,
                     const std::array<const Corner*, 2>& corners) const {
    const SolidEdge& line = edge(f).line;
    const glm::dvec3 axis = f.start + f.setback * f.in[0] - radius_ * line.normals[0];
    const std::vector<glm::dvec3> directions = arc_of(f);
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
        middle = axis + at[end] * f.along;
      }
      points.push_back(middle);
      for (const glm::dvec3& d : directions) points.push_back(middle + radius_ * d);
      // A side that is aslant has no corners of the grid in its plane: there the last facet goes
      // on beyond it.
      const size_t last = directions.size() - 1;
      if (!is_along_axis(line.normals[0])) {
        points.push_back(middle + radius_ * (2.0 * directions[0] - directions[1]));
      }
      if (!is_along_axis(line.normals[1])) {
        points.push_back(middle + radius_ * (2.0 * directions[last] - directions[last - 1]));
      }
    }
    if (at[1] - at[0] <= 1e-9 * (f.length + f.setback)) return nullptr;
    return hull_along(std::move(points), f);
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
      if (is_fillet() && corner_at(f, end) != nullptr) continue;  // with the corner
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
        const Mitre mitre = mitre_at(f, end, side);
        const NodePtr middle = slab(f, mitre, -2 * mitre.gap, 2 * mitre.gap);
        cuts_.push_back(Node::boolean(BooleanOp::kIntersection,
                                      {rounded(i, end), rounded(k, its_end), middle}, where_));
      }
    }
  }

  [[nodiscard]] NodePtr rounded(size_t i, int end) const {
    const Bodies& b = bodies_[i];
    return b.round ? less(b.prism[end], {b.round}, where_) : b.prism[end];
  }

  NodePtr ball_of(const Corner& corner) const {
    std::vector<glm::dvec3> points{corner.centre};
    for (const uint32_t k : corner.frames) {
      for (const glm::dvec3& d : arc_of(frames_.frames()[k])) {
        points.push_back(corner.centre + radius_ * d);
      }
    }
    add_ball(normals_at(corner), corner.centre, points);
    return hull_along(std::move(points), frames_.frames()[corner.frames[0]]);
  }

  void cut_corner(const Corner& corner) {
    const auto n = normals_at(corner);
    const EdgeFrame& first = frames_.frames()[corner.frames[0]];
    const double reach = kReach * first.setback;
    const glm::dvec3 outside = in_front(corner, reach);
    if (!is_fillet()) {
      // The points in which the lines meet on the three sides.
      std::vector<glm::dvec3> points;
      for (const uint32_t k : corner.frames) {
        const EdgeFrame& f = frames_.frames()[k];
        const int end = edge(f).vertex[0] == corner.vertex ? 0 : 1;
        for (int side = 0; side < 2; ++side) {
          points.push_back(f.start + f.setback * f.in[side] +
                           frames_.at_next_cut(f, end, side) * f.along);
        }
      }
      // Each is there twice, from both edges of its side. A little larger, in the same plane.
      glm::dvec3 sum(0);
      for (const glm::dvec3& p : points) sum += p;
      for (glm::dvec3& p : points) p += kReach * (3.0 * p - sum / 2.0);
      points.push_back(outside);
      cuts_.push_back(hull(std::move(points), first));
      return;
    }
    const glm::dvec3& c = corner.centre;
    std::vector<glm::dvec3> around{c, outside};
    for (const glm::dvec3& m : n) around.push_back(c + (radius_ + reach) * m);
    std::vector<NodePtr> prisms, kept{corner.ball};
    for (const uint32_t k : corner.frames) {
      const EdgeFrame& f = frames_.frames()[k];
      const SolidEdge& line = edge(f).line;
      const double at = glm::dot(c - f.start, f.along);
      const glm::dvec3 outwards = line.normals[0] + line.normals[1];
      around.push_back(f.start + at * f.along +
                       reach / glm::dot(outwards, line.normals[0]) * outwards);
      const int end = edge(f).vertex[0] == corner.vertex ? 0 : 1;
      prisms.push_back(bodies_[k].prism[end]);
      // Where nothing is between two balls, a half reaches a little into the other one.
      const Corner* far = corner_at(f, 1 - end);
      if (bodies_[k].round) {
        kept.push_back(bodies_[k].round);
      } else if (far != nullptr) {
        kept.push_back(far->ball);
      }
    }
    prisms.push_back(hull_along(std::move(around), first));
    cuts_.push_back(
        less(Node::boolean(BooleanOp::kUnion, std::move(prisms), where_), std::move(kept), where_));
  }

  /// Points of the sphere between three directions, in rows from the steepest of them.
  void add_ball(const std::array<glm::dvec3, 3>& n, const glm::dvec3& centre,
                std::vector<glm::dvec3>& points) const {
    size_t pole = 0;
    for (size_t i = 1; i < 3; ++i) {
      if (std::fabs(n[i].z) > std::fabs(n[pole].z)) pole = i;
    }
    const glm::dvec3 &a = n[(pole + 1) % 3], &b = n[(pole + 2) % 3];
    const auto turn = [](const glm::dvec3& p, const glm::dvec3& q) {
      return atan2_deg(glm::length(glm::cross(p, q)), glm::dot(p, q));
    };
    const int rows = parts_of(std::max(turn(n[pole], a), turn(n[pole], b)));
    const int columns = parts_of(turn(a, b));
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
  const double radius_;
  const Facets& facets_;
  const SourceRef where_;
  std::vector<Corner> corners_;
  std::vector<uint32_t> turned_with_;
  std::vector<Bodies> bodies_;
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
  double fits = 0, fails = size;
  for (int i = 0; i < 50; ++i) {
    const double middle = (fits + fails) / 2;
    frames.set_size(middle, is_radius);
    (frames.has_room(frames.frames()[*narrow]) ? fits : fails) = middle;
  }
  // Rounded down to something short that fits.
  const double unit = std::pow(10, std::floor(std::log10(fails)) - 3);
  double shown = std::floor(fits / unit * (1 + 1e-6)) * unit;
  frames.set_size(shown, is_radius);
  if (!frames.has_room(frames.frames()[*narrow])) shown = fits;
  const SolidEdge& line = frames.graph().edges()[frames.frames()[*narrow].edge].line;
  return invalid_argument(
      fmt::format("{} is too much for {}: {:.4g} fits", number_text(size), edge_text(line), shown));
}

Result<NodePtr> cut_edges(const char* name, const NodePtr& solid, const Solid& evaluated,
                          std::span<const uint32_t> chosen, double size, double radius,
                          const Facets& facets) {
  const EdgeGraph graph(evaluated);
  EdgeFrames frames(graph, chosen);
  if (auto error = check(frames, size, radius > 0)) return *std::move(error);
  auto cuts = Cutter(name, evaluated, frames, radius, facets, solid->where()).cuts();
  if (!cuts) return cuts.error();
  cuts->insert(cuts->begin(), solid);
  return Node::boolean(BooleanOp::kDifference, *std::move(cuts), solid->where());
}

}  // namespace

Result<NodePtr> chamfer_edges(const NodePtr& solid, const Solid& evaluated,
                              std::span<const uint32_t> chosen, double distance) {
  return cut_edges("chamfer", solid, evaluated, chosen, distance, 0, {});
}

Result<NodePtr> fillet_edges(const NodePtr& solid, const Solid& evaluated,
                             std::span<const uint32_t> chosen, double radius,
                             const Facets& facets) {
  return cut_edges("fillet", solid, evaluated, chosen, radius, radius, facets);
}

}  // namespace csgrun
