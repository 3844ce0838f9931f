// rotate_extrude: the shape's x becomes the radius and its y becomes z.
//
// Points on the axis are one vertex each, so bands end there in triangles and a profile edge along
// the axis makes no face: nothing degenerate is ever made.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/trig.h>

#include "primitives/base/text.h"
#include "primitives/shape2d/profile.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

constexpr const char* kRotateExtrude = "rotate_extrude";

class RotateExtruder {
 public:
  /// `beyond`: by how much of a step the first and the last facets go on, straight, beyond the
  /// start and the end.
  RotateExtruder(const Shape2D& shape, double angle, double start, int steps,
                 const std::array<double, 2>& beyond)
      : loops_(shape.loops()),
        profile_(make_profile(shape, loops_)),
        angle_(angle),
        start_(start),
        steps_(steps),
        full_(angle == 360),
        inverted_((angle < 0) != (shape.bounds()[0].x < 0)),
        beyond_(beyond) {}

  PolygonMesh build() {
    mesh_.kind = kRotateExtrude;
    const int rings = full_ ? steps_ : steps_ + 1;
    on_axis_.resize(profile_.points.size());
    for (int j = 0; j < rings; ++j) add_ring(j);
    uint32_t surface = 0;
    for (size_t l = 0; l < profile_.loops.size(); ++l) add_sides(l, surface);
    if (!full_) {
      add_cap(0, inverted_);
      add_cap(steps_, !inverted_);
    }
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] glm::dvec2 direction(int j) const {
    const double at = j == steps_ ? start_ + angle_ : start_ + angle_ * j / steps_;
    return {cos_deg(at), sin_deg(at)};
  }

  /// Where the ring is, for a radius of 1.
  [[nodiscard]] glm::dvec2 place(int j) const {
    const bool first = j == 0 && beyond_[0] > 0, last = j == steps_ && beyond_[1] > 0;
    const glm::dvec2 there = direction(j);
    if (!first && !last) return there;
    return there + beyond_[last ? 1 : 0] * (there - direction(last ? j - 1 : 1));
  }

  void add_ring(int j) {
    const glm::dvec2 at = place(j);
    std::vector<uint32_t>& ring = rings_.emplace_back();
    for (size_t i = 0; i < profile_.points.size(); ++i) {
      const glm::dvec2 p = profile_.points[i];
      const bool axis = p.x == 0;
      if (j > 0 && axis) {
        ring.push_back(on_axis_[i]);
        continue;
      }
      on_axis_[i] = static_cast<uint32_t>(mesh_.points.size());
      ring.push_back(on_axis_[i]);
      mesh_.points.emplace_back(p.x * at.x + 0.0, p.x * at.y + 0.0, p.y);
    }
  }

  void add_sides(size_t l, uint32_t& surface) {
    const std::vector<uint32_t>& loop = profile_.loops[l];
    const size_t n = loop.size();
    uint32_t chains = 0;
    const std::vector<uint32_t> chain = smooth_chains(loops_[l], chains);
    const bool round = std::fabs(angle_) / steps_ < kSmoothTurnDegrees;
    for (size_t k = 0; k < n; ++k) {
      const uint32_t p = loop[k], q = loop[(k + 1) % n];
      const bool flat = profile_.points[p].y == profile_.points[q].y;
      for (int j = 0; j < steps_; ++j) {
        add_side(rings_[j], rings_[(j + 1) % rings_.size()], p, q,
                 round && !flat ? surface + 1 + chain[k] : 0);
      }
    }
    surface += chains;
  }

  /// Between two rings; p to q is an edge of the profile with the solid on its left.
  void add_side(const std::vector<uint32_t>& ring, const std::vector<uint32_t>& next, uint32_t p,
                uint32_t q, uint32_t surface) {
    std::vector<uint32_t> face{ring[p]};
    for (const uint32_t corner : {next[p], next[q], ring[q]}) {
      if (corner != face.back() && corner != face.front()) face.push_back(corner);
    }
    if (face.size() < 3) return;  // along the axis
    if (inverted_) std::reverse(face.begin(), face.end());
    mesh_.add_face(face, surface);
  }

  void add_cap(int j, bool reversed) {
    for (const Shape2D::Region& region : profile_.regions) {
      std::vector<std::vector<uint32_t>> loops;
      auto add = [&](uint32_t l) {
        std::vector<uint32_t>& loop = loops.emplace_back();
        for (const uint32_t p : profile_.loops[l]) loop.push_back(rings_[j][p]);
        if (reversed) std::reverse(loop.begin(), loop.end());
      };
      add(region.outer);
      for (const uint32_t hole : region.holes) add(hole);
      add_face_with_holes(mesh_, loops);
    }
  }

  const std::vector<Shape2D::Loop>& loops_;
  Profile profile_;
  double angle_, start_;
  int steps_;
  bool full_;
  bool inverted_;  // faces run the other way: a negative angle, or a profile on the negative side
  std::array<double, 2> beyond_;
  std::vector<uint32_t> on_axis_;
  std::vector<std::vector<uint32_t>> rings_;
  PolygonMesh mesh_;
};

struct Turn {
  double angle;  ///< degrees; 360 is a full turn
  int steps;
};

Result<Turn> turn_of(const Shape2D& shape, const RotateExtrudeOptions& options) {
  if (shape.empty()) return invalid_argument("rotate_extrude: the shape is empty");
  if (!std::isfinite(options.angle)) return not_finite(kRotateExtrude, "angle", options.angle);
  if (!std::isfinite(options.start)) return not_finite(kRotateExtrude, "start", options.start);
  for (const auto& [name, value] :
       {std::pair{"fn", options.facets.fn}, std::pair{"fa", options.facets.fa},
        std::pair{"fs", options.facets.fs}}) {
    if (!std::isfinite(value)) return not_finite(kRotateExtrude, name, value);
  }
  if (options.angle == 0) return invalid_argument("rotate_extrude: angle must not be 0");
  const double angle = options.angle <= -360 || options.angle > 360 ? 360 : options.angle;
  const auto [low, high] = shape.bounds();
  if (low.x < 0 && high.x > 0) {
    return invalid_argument(
        "rotate_extrude: the shape must lie on one side of the Y axis, its x runs from " +
        number_text(low.x) + " to " + number_text(high.x));
  }
  const int steps = options.facets.fragments(std::max(-low.x, high.x), angle);
  const double points = static_cast<double>(steps) *
                        static_cast<double>(make_profile(shape, shape.loops()).points.size());
  if (points > kMostPoints) return too_many_points(kRotateExtrude, steps, points);
  return Turn{angle, steps};
}

/// How far the ends of a turn go on, and which wedge about the axis holds what is beyond.
struct Beyond {
  double part;   ///< of a step
  double reach;  ///< the farthest corner there, by that of the profile
  double wedge;  ///< degrees
};

/// Nothing where the ends are too near to one another, or a step is none in doubles.
std::optional<Beyond> beyond(const Turn& turn) {
  constexpr double kLeastGap = 0.1, kMost = 10, kMostWedge = 30;  // degrees
  // A step is 120 degrees at most.
  const double gap = 360 - std::fabs(turn.angle), step = std::fabs(turn.angle) / turn.steps;
  if (gap < kLeastGap) return std::nullopt;
  for (double part = 1;; part /= 2) {
    const double x = 1 + part * (1 - cos_deg(step)), y = part * sin_deg(step);
    if (!(y > 0)) return std::nullopt;
    if (atan2_deg(y, x) <= std::min(gap / 8, kMost)) {
      return Beyond{part, std::sqrt(x * x + y * y), std::min(gap / 4, kMostWedge)};
    }
  }
}

/// From the axis on, between the angles 0 and `wedge`.
PolygonMesh wedge_mesh(double radius, double low, double high, double wedge) {
  PolygonMesh mesh;
  mesh.kind = kRotateExtrude;
  for (const double z : {low, high}) {
    mesh.points.emplace_back(0, 0, z);
    mesh.points.emplace_back(radius, 0, z);
    mesh.points.emplace_back(radius * cos_deg(wedge), radius * sin_deg(wedge), z);
  }
  mesh.hull_of_points = true;
  return mesh;
}

}  // namespace

MeshResult rotate_extrude(const Shape2D& shape, const RotateExtrudeOptions& options) {
  const Result<Turn> turn = turn_of(shape, options);
  if (!turn) return turn.error();
  return RotateExtruder(shape, turn->angle, options.start, turn->steps, {}).build();
}

// Corners of a cap that is not across an axis would be rounded one by one, and caps of different
// profiles at one angle be apart by less than a step. So the last facets go on straight, and a
// wedge about the axis takes off what is beyond: its side is turned by the angle as a plane.
Result<NodePtr> rotate_extrude_solid(const Shape2D& shape, const RotateExtrudeOptions& options,
                                     const SourceRef& where, const MakeLeaf& make_leaf) {
  const auto leaf = [&](PolygonMesh mesh) {
    return make_leaf ? make_leaf(std::move(mesh))
                     : Node::leaf(std::make_shared<const PolygonMesh>(std::move(mesh)), where);
  };
  const Result<Turn> turn = turn_of(shape, options);
  if (!turn) return turn.error();
  const auto is_upright = [](double angle) { return std::fmod(angle, 90) == 0; };
  const double end = options.start + turn->angle;
  const std::optional<Beyond> room = beyond(*turn);
  std::array<double, 2> parts{};  // of a step
  if (room && turn->angle != 360) {
    parts = {is_upright(options.start) ? 0 : room->part, is_upright(end) ? 0 : room->part};
  }
  RotateExtruder extruder(shape, turn->angle, options.start, turn->steps, parts);
  std::vector<NodePtr> operands{leaf(extruder.build())};
  const auto [low, high] = shape.bounds();
  const bool is_left = low.x < 0;
  const double radius = std::max(-low.x, high.x), margin = (radius + high.y - low.y) / 64;
  for (const int side : {0, 1}) {
    if (parts[side] == 0) continue;
    const bool is_forward = (side == 1) == (turn->angle > 0);
    const double at = (side == 1 ? end : options.start) + (is_left ? 180 : 0);
    const NodePtr wedge =
        leaf(wedge_mesh((radius * room->reach + margin) / cos_deg(room->wedge / 2), low.y - margin,
                        high.y + margin, is_forward ? room->wedge : -room->wedge));
    Affine map;
    map.m[0] = {cos_deg(at), -sin_deg(at), 0, 0};
    map.m[1] = {sin_deg(at), cos_deg(at), 0, 0};
    operands.push_back(Node::transformed(map, wedge, where));
  }
  if (operands.size() == 1) return operands[0];
  RotateExtruder plain(shape, turn->angle, options.start, turn->steps, {});
  return Node::difference_as(std::move(operands), leaf(plain.build()), where);
}

}  // namespace csgrun
