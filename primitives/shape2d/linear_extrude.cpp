// linear_extrude: slices of the shape, turned and scaled, with bands between them.
//
// All bands share points by index, so the result is closed by construction, also where loops touch
// and where the top collapses to a point or an edge: bands end in triangles there.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include <csgrun/primitives/shape2d.h>

#include "primitives/base/text.h"
#include "primitives/shape2d/edge_top.h"
#include "primitives/shape2d/extrude_facets.h"
#include "primitives/shape2d/profile.h"
#include "primitives/shape2d/rounded_extrude.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

constexpr const char* kLinearExtrude = "linear_extrude";

Result<glm::dvec3> height_vector(const LinearExtrudeOptions& o) {
  if (!o.direction || o.height_given) {
    if (!std::isfinite(o.height)) return not_finite(kLinearExtrude, "height", o.height);
    if (!(o.height > 0)) return not_positive(kLinearExtrude, "height", o.height);
  }
  if (!o.direction) return glm::dvec3(0, 0, o.height);
  const glm::dvec3 v = *o.direction;
  const double length = std::sqrt(glm::dot(v, v));
  if (!std::isfinite(length)) return invalid_argument("linear_extrude: v must be finite");
  if (!(v.z > 0)) return not_positive(kLinearExtrude, "v.z", v.z);
  return o.height_given ? v * (o.height / length) : v;
}

std::optional<Error> check(const LinearExtrudeOptions& o) {
  for (const auto& [name, value] :
       {std::pair{"scale.x", o.scale.x}, std::pair{"scale.y", o.scale.y}}) {
    if (!std::isfinite(value)) return not_finite(kLinearExtrude, name, value);
    if (value < 0) {
      return invalid_argument(std::string(kLinearExtrude) + ": " + name +
                              " must not be negative, got " + number_text(value));
    }
  }
  if (!std::isfinite(o.twist)) return not_finite(kLinearExtrude, "twist", o.twist);
  if (o.slices && *o.slices < 1) return not_positive(kLinearExtrude, "slices", *o.slices);
  if (o.segments && *o.segments < 0) {
    return invalid_argument("linear_extrude: segments must not be negative, got " +
                            std::to_string(*o.segments));
  }
  for (const double r : o.round) {
    if (!std::isfinite(r)) return not_finite(kLinearExtrude, "round", r);
    if (r < 0)
      return invalid_argument("linear_extrude: round must not be negative, got " + number_text(r));
  }
  for (const auto& [name, value] :
       {std::pair{"fn", o.facets.fn}, std::pair{"fa", o.facets.fa}, std::pair{"fs", o.facets.fs}}) {
    if (!std::isfinite(value)) return not_finite(kLinearExtrude, name, value);
  }
  return std::nullopt;
}

class LinearExtruder {
 public:
  LinearExtruder(const Shape2D& shape, const LinearExtrudeOptions& options, glm::dvec3 height,
                 int slices)
      : options_(options), slices_(slices), loops_(split_outlines(shape, options, slices)) {
    if (top_collapses() && options.scale != glm::dvec2(0))
      edge_top_.emplace(loops_, options, slices);
    profile_ = make_profile(shape, loops_);
    bottom_ = options.center ? height * -0.5 : glm::dvec3(0);
    top_ = options.center ? height * 0.5 : height;
  }

  [[nodiscard]] double point_count() const {
    return static_cast<double>(profile_.points.size()) * (slices_ + 1.0);
  }

  PolygonMesh build() {
    mesh_.kind = kLinearExtrude;
    for (int i = 0; i < slices_; ++i) add_ring(i);
    if (top_collapses()) {
      add_collapsed_ring();
    } else {
      add_ring(slices_);
    }
    add_cap(0, true);
    uint32_t surface = 0;
    for (size_t l = 0; l < profile_.loops.size(); ++l) add_sides(l, surface);
    if (!top_collapses()) add_cap(slices_, false);
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] bool top_collapses() const {
    return options_.scale.x == 0 || options_.scale.y == 0;
  }
  /// Sides are planar: parallelograms and trapezoids.
  [[nodiscard]] bool planar_sides() const {
    return options_.twist == 0 && options_.scale.x == options_.scale.y;
  }

  /// Where the axis is at slice i.
  [[nodiscard]] glm::dvec3 height_of(int i) const {
    return i == slices_ ? top_ : bottom_ + (top_ - bottom_) * (double(i) / slices_);
  }

  void add_ring(int i) {
    const glm::dvec3 at = height_of(i);
    const Slice slice(options_, i, slices_);
    std::vector<uint32_t>& ring = rings_.emplace_back();
    for (const glm::dvec2& p : profile_.points) {
      const glm::dvec2 q = slice.point(p);
      ring.push_back(static_cast<uint32_t>(mesh_.points.size()));
      mesh_.points.emplace_back(q.x + at.x, q.y + at.y, at.z);
    }
  }

  /// The top as one point, or as the places along an edge.
  void add_collapsed_ring() {
    top_first_ = static_cast<uint32_t>(mesh_.points.size());
    std::vector<uint32_t>& ring = rings_.emplace_back();
    for (const glm::dvec2& p : profile_.points) {
      ring.push_back(top_first_ + (edge_top_ ? edge_top_->place_of(p) : 0));
    }
    for (uint32_t i = 0; i < (edge_top_ ? edge_top_->size() : 1); ++i) {
      const glm::dvec2 p = edge_top_ ? edge_top_->point(i) : glm::dvec2(0);
      mesh_.points.emplace_back(p.x + top_.x, p.y + top_.y, top_.z);
    }
  }

  void add_cap(int slice, bool downwards) {
    const std::vector<uint32_t>& ring = rings_[slice];
    for (const Shape2D::Region& region : profile_.regions) {
      std::vector<std::vector<uint32_t>> loops;
      auto add = [&](uint32_t l) {
        std::vector<uint32_t>& loop = loops.emplace_back();
        for (const uint32_t p : profile_.loops[l]) loop.push_back(ring[p]);
        if (downwards) std::reverse(loop.begin(), loop.end());
      };
      add(region.outer);
      for (const uint32_t hole : region.holes) add(hole);
      add_face_with_holes(mesh_, loops);
    }
  }

  /// `surface` is the last number given to a curved surface.
  void add_sides(size_t l, uint32_t& surface) {
    const std::vector<uint32_t>& loop = profile_.loops[l];
    const size_t n = loop.size();
    uint32_t chains = 0;
    std::vector<uint32_t> chain = smooth_chains(loops_[l], chains);
    const bool round = !planar_sides() || is_round_loop(n, chains);
    for (int i = 0; i < slices_; ++i) {
      for (size_t k = 0; k < n; ++k) {
        add_side(i, loop[k], loop[(k + 1) % n], profile_.is_hole[l],
                 round ? surface + 1 + chain[k] : 0);
      }
    }
    if (round) surface += chains;
  }

  /// The piece of wall over the edge from p to q between slices i and i + 1.
  void add_side(int i, uint32_t p, uint32_t q, bool hole, uint32_t surface) {
    const uint32_t a = rings_[i][p], b = rings_[i][q];
    const uint32_t c = rings_[i + 1][q], d = rings_[i + 1][p];
    if (c == d) {
      mesh_.add_face(std::array<uint32_t, 3>{a, b, c}, surface);
      return;
    }
    if (planar_sides()) {
      mesh_.add_face(std::array<uint32_t, 4>{a, b, c, d}, surface);
      return;
    }
    // Where an extent goes to nothing the longer diagonal is taken: the shorter ones would make
    // walls of no thickness there.
    const bool at_edge = edge_top_ && i + 1 == slices_;
    const bool from_a = at_edge != cut_from_a(i, {a, b, c, d}, hole);
    mesh_.add_face(std::array<uint32_t, 3>{a, b, from_a ? c : d}, surface);
    const uint32_t foot = from_a ? a : b;
    if (!at_edge) {
      mesh_.add_face(std::array<uint32_t, 3>{c, d, foot}, surface);
      return;
    }
    const uint32_t step = c < d ? 1 : UINT32_MAX;  // from place to place along the edge
    for (uint32_t from = c; from != d; from += step)
      mesh_.add_face(std::array<uint32_t, 3>{from, from + step, foot}, surface);
  }

  /// Whether the quadrilateral a b c d above slice i is cut from a to c: along the diagonal that is
  /// shorter seen from above, were the extrusion upright; of two equal ones the one that the twist
  /// leans to.
  [[nodiscard]] bool cut_from_a(int i, const std::array<uint32_t, 4>& abcd, bool hole) const {
    std::array<glm::dvec3, 4> flat;
    for (size_t k = 0; k < 4; ++k) {
      flat[k] = mesh_.points[abcd[k]] - height_of(k < 2 ? i : i + 1);
      flat[k].z = 0;
    }
    return is_cut_from_first(flat[0], flat[1], flat[2], flat[3], (options_.twist > 0) != hole);
  }

  const LinearExtrudeOptions& options_;
  int slices_;
  std::vector<Shape2D::Loop> loops_;
  std::optional<EdgeTop> edge_top_;  // when exactly one scale is 0
  Profile profile_;
  glm::dvec3 bottom_{}, top_{};
  uint32_t top_first_ = 0;                    // the first mesh point of a collapsed top
  std::vector<std::vector<uint32_t>> rings_;  // per slice and point of the profile: a mesh point
  PolygonMesh mesh_;
};

}  // namespace

MeshResult linear_extrude(const Shape2D& shape, const LinearExtrudeOptions& options) {
  if (shape.empty()) return invalid_argument("linear_extrude: the shape is empty");
  if (auto error = check(options)) return *error;
  const Result<glm::dvec3> height = height_vector(options);
  if (!height) return height.error();
  if (options.round != std::array<double, 2>{0, 0}) return rounded_extrude(shape, options, *height);
  const bool straight = options.twist == 0 && options.scale.x == options.scale.y;
  // Slices of planar sides would be pieces of the same faces.
  const double slices = straight ? 1 : slices_of(shape, options, height->z);
  if (slices > kMostPoints) return too_many_points(kLinearExtrude, slices, slices);
  if (options.segments && *options.segments > kMostPoints) {
    return too_many_points(kLinearExtrude, *options.segments, *options.segments);
  }
  LinearExtruder extruder(shape, options, *height, static_cast<int>(slices));
  if (extruder.point_count() > kMostPoints) {
    return too_many_points(kLinearExtrude, slices, extruder.point_count());
  }
  return extruder.build();
}

}  // namespace csgrun
