// rotate_extrude: the shape's x becomes the radius and its y becomes z.
//
// Points on the axis are one vertex each, so bands end there in triangles and a profile edge along
// the axis makes no face: nothing degenerate is ever made.
#include <algorithm>
#include <cmath>
#include <utility>

#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/trig.h>

#include "primitives/base/text.h"
#include "primitives/shape2d/profile.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

constexpr const char* kName = "rotate_extrude";

class RotateExtruder {
 public:
  RotateExtruder(const Shape2D& shape, double angle, double start, int steps, bool left_of_axis)
      : loops_(shape.loops()),
        profile_(make_profile(shape, loops_)),
        angle_(angle),
        start_(start),
        steps_(steps),
        full_(angle == 360),
        inverted_((angle < 0) != left_of_axis) {}

  PolygonMesh build() {
    mesh_.kind = kName;
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
  void add_ring(int j) {
    const double at = j == steps_ ? start_ + angle_ : start_ + angle_ * j / steps_;
    const double c = cos_deg(at), s = sin_deg(at);
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
      mesh_.points.emplace_back(p.x * c + 0.0, p.x * s + 0.0, p.y);
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
  std::vector<uint32_t> on_axis_;
  std::vector<std::vector<uint32_t>> rings_;
  PolygonMesh mesh_;
};

}  // namespace

MeshResult rotate_extrude(const Shape2D& shape, const RotateExtrudeOptions& options) {
  if (shape.empty()) return invalid_argument("rotate_extrude: the shape is empty");
  if (!std::isfinite(options.angle)) return not_finite(kName, "angle", options.angle);
  if (!std::isfinite(options.start)) return not_finite(kName, "start", options.start);
  for (const auto& [name, value] :
       {std::pair{"fn", options.facets.fn}, std::pair{"fa", options.facets.fa},
        std::pair{"fs", options.facets.fs}}) {
    if (!std::isfinite(value)) return not_finite(kName, name, value);
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
  if (points > kMostPoints) return too_many_points(kName, steps, points);
  return RotateExtruder(shape, angle, options.start, steps, low.x < 0).build();
}

}  // namespace csgrun
