#include "primitives/shape2d/rounded_extrude.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <csgrun/primitives/trig.h>

#include "primitives/base/text.h"
#include "primitives/shape2d/inset_bands.h"
#include "primitives/shape2d/profile.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

using Loop = Shape2D::Loop;

constexpr const char* kRoundedExtrude = "linear_extrude";
/// What is shorter, beside the outline's extent, has vanished: noise of sixteen digits.
constexpr double kExtentNoise = 1e-12;

double length_of(const glm::dvec2& v) { return std::sqrt(glm::dot(v, v)); }

/// The outlines, and where their corners go when all edges move inwards at speed 1.
class ShrinkingOutlines {
 public:
  explicit ShrinkingOutlines(const Shape2D& shape) : shape_(shape) {
    const auto [low, high] = shape.bounds();
    noise_ = kExtentNoise *
             std::max({std::fabs(low.x), std::fabs(low.y), std::fabs(high.x), std::fabs(high.y)});
    for (const Loop& loop : shape.loops()) {
      const size_t n = loop.size();
      std::vector<glm::dvec2> inward(n);  // across the edge from each corner
      for (size_t i = 0; i < n; ++i) {
        const glm::dvec2 way = loop[(i + 1) % n] - loop[i];
        inward[i] = glm::dvec2(-way.y, way.x) / length_of(way);
      }
      std::vector<glm::dvec2>& speed = speeds_.emplace_back(n);
      for (size_t i = 0; i < n; ++i) {
        const glm::dvec2 &a = inward[(i + n - 1) % n], &b = inward[i];
        speed[i] = (a + b) / (1 + glm::dot(a, b));
      }
    }
  }

  [[nodiscard]] Loop at(size_t l, double inset) const {
    Loop moved = shape_.loops()[l];
    for (size_t i = 0; i < moved.size(); ++i) moved[i] += inset * speeds_[l][i];
    return moved;
  }

  /// Whether the outlines have kept their form. Edges shrink and grow evenly, so those that are
  /// there now were there before.
  [[nodiscard]] bool fits(double inset) const {
    std::vector<Loop> moved;
    double area = 0, length = 0;
    for (const Shape2D::Region& region : shape_.regions()) {
      if (region.holes.empty() && !collapsed(region.outer, inset).empty()) continue;
      std::vector<uint32_t> loops{region.outer};
      loops.insert(loops.end(), region.holes.begin(), region.holes.end());
      for (const uint32_t l : loops) {
        if (least_edge(l, inset) <= noise_) return false;
        const Loop& loop = moved.emplace_back(at(l, inset));
        for (size_t i = 0; i < loop.size(); ++i) {
          const glm::dvec2 &p = loop[i], &q = loop[(i + 1) % loop.size()];
          area += (p.x * q.y - p.y * q.x) / 2;
          length += length_of(q - p);
        }
      }
    }
    if (moved.empty()) return true;
    // Loops that cross are more or fewer, or enclose something else than what they sum up to.
    const Result<Shape2D> clean = Shape2D::from_outlines(moved, FillRule::kNonZero);
    constexpr double kGrid = 1e-6;  // mm; what the grid of shapes may move an edge
    return clean && clean->loops().size() == moved.size() &&
           std::fabs(clean->area() - area) <= kGrid * length;
  }

  /// Where a loop has come down to a point or to a ridge, and had its form till then: these one or
  /// two places. Otherwise nothing.
  [[nodiscard]] Loop collapsed(size_t l, double inset) const {
    constexpr double kJustBefore = 1 - 1e-6;
    if (least_edge(l, inset) < -noise_ || !(least_edge(l, inset * kJustBefore) > 0)) return {};
    Loop places;
    for (const glm::dvec2& p : at(l, inset)) {
      if (place_of(places, p) < places.size()) continue;
      if (places.size() == 2) return {};
      places.push_back(p);
    }
    return places;
  }

  /// Which of the places a point is at; their number when it is at none.
  [[nodiscard]] size_t place_of(const Loop& places, const glm::dvec2& p) const {
    size_t i = 0;
    while (i < places.size() && length_of(places[i] - p) > noise_) ++i;
    return i;
  }

 private:
  /// The length of the shortest edge of a loop; below 0 when one has been turned about.
  [[nodiscard]] double least_edge(size_t l, double inset) const {
    const Loop& loop = shape_.loops()[l];
    double least = INFINITY;
    for (size_t i = 0; i < loop.size(); ++i) {
      const size_t j = (i + 1) % loop.size();
      const glm::dvec2 way = loop[j] - loop[i];
      const glm::dvec2 now = way + inset * (speeds_[l][j] - speeds_[l][i]);
      least = std::min(least, glm::dot(now, way) / length_of(way));
    }
    return least;
  }

  const Shape2D& shape_;
  std::vector<std::vector<glm::dvec2>> speeds_;  // per loop and corner
  double noise_ = 0;
};

struct Layer {
  double z, inset;
  uint32_t end;  ///< 0: at the bottom's edge, 1: at the top's
};

int quarter_steps(double r, const Facets& facets) { return (facets.fragments(r) + 3) / 4; }

/// From the bottom to the top. The wall is between the last of the one end and the first of the
/// other.
std::vector<Layer> layers_of(const LinearExtrudeOptions& o, double h) {
  std::vector<Layer> layers;
  const auto [low, high] = o.round;
  const int n = low > 0 ? quarter_steps(low, o.facets) : 0;
  for (int i = n; i > 0; --i)
    layers.push_back({low - low * sin_deg(90.0 * i / n), low - low * cos_deg(90.0 * i / n), 0});
  layers.push_back({low, 0, 0});
  if (low + high < h) layers.push_back({h - high, 0, 1});
  const int m = high > 0 ? quarter_steps(high, o.facets) : 0;
  for (int i = 1; i <= m; ++i) {
    layers.push_back(
        {h - high + high * sin_deg(90.0 * i / m), high - high * cos_deg(90.0 * i / m), 1});
  }
  return layers;
}

class RoundedExtruder {
 public:
  RoundedExtruder(const Shape2D& shape, const ShrinkingOutlines& outlines,
                  std::vector<Layer> layers, double bottom)
      : shape_(shape), outlines_(outlines), layers_(std::move(layers)), bottom_(bottom) {}

  PolygonMesh build() {
    mesh_.kind = kRoundedExtrude;
    std::vector<std::vector<uint32_t>> first, last;  // per loop
    uint32_t surface = 0;
    for (size_t l = 0; l < shape_.loops().size(); ++l) {
      std::vector<std::vector<uint32_t>> rings;
      for (const Layer& layer : layers_) rings.push_back(add_ring(l, layer));
      add_bands(l, rings, surface);
      first.push_back(rings.front());
      last.push_back(rings.back());
    }
    add_cap(first, layers_.front().inset, true);
    add_cap(last, layers_.back().inset, false);
    return std::move(mesh_);
  }

 private:
  std::vector<uint32_t> add_ring(size_t l, const Layer& layer) {
    const Loop loop = outlines_.at(l, layer.inset), places = outlines_.collapsed(l, layer.inset);
    const auto base = static_cast<uint32_t>(mesh_.points.size());
    std::vector<uint32_t> ring;
    for (size_t i = 0; i < loop.size(); ++i)
      ring.push_back(
          base + static_cast<uint32_t>(places.empty() ? i : outlines_.place_of(places, loop[i])));
    for (const glm::dvec2& p : places.empty() ? loop : places)
      mesh_.points.emplace_back(p.x, p.y, bottom_ + layer.z);
    return ring;
  }

  /// `surface` is the last number given to a curved surface.
  void add_bands(size_t l, const std::vector<std::vector<uint32_t>>& rings, uint32_t& surface) {
    uint32_t chains = 0;
    const std::vector<uint32_t> chain = smooth_chains(shape_.loops()[l], chains);
    const size_t n = chain.size();
    const bool is_round = is_round_loop(n, chains);
    for (size_t i = 0; i + 1 < rings.size(); ++i) {
      const bool is_wall = layers_[i].inset == 0 && layers_[i + 1].inset == 0;
      const uint32_t own = is_round ? 1
                           : is_wall
                               ? 0
                               : 1 + (layers_[i].inset > 0 ? layers_[i].end : layers_[i + 1].end);
      for (size_t k = 0; k < n; ++k) {
        const size_t j = (k + 1) % n;
        std::vector<uint32_t> face;
        for (const uint32_t p : {rings[i][k], rings[i][j], rings[i + 1][j], rings[i + 1][k]}) {
          if (std::find(face.begin(), face.end(), p) == face.end()) face.push_back(p);
        }
        if (face.size() < 3) continue;
        mesh_.add_face(face, own == 0 ? 0 : surface + (own - 1) * chains + 1 + chain[k]);
      }
    }
    surface += is_round ? chains : 2 * chains;
  }

  void add_cap(const std::vector<std::vector<uint32_t>>& rings, double inset, bool downwards) {
    for (const Shape2D::Region& region : shape_.regions()) {
      if (!outlines_.collapsed(region.outer, inset).empty()) continue;
      std::vector<std::vector<uint32_t>> loops{rings[region.outer]};
      for (const uint32_t hole : region.holes) loops.push_back(rings[hole]);
      if (downwards) {
        for (std::vector<uint32_t>& loop : loops) std::reverse(loop.begin(), loop.end());
      }
      add_face_with_holes(mesh_, loops);
    }
  }

  const Shape2D& shape_;
  const ShrinkingOutlines& outlines_;
  std::vector<Layer> layers_;
  double bottom_;
  PolygonMesh mesh_;
};

/// The layers of the bottom's end or of the top's, from the outline inwards.
InsetEnd end_of(const std::vector<Layer>& layers, uint32_t end, double bottom) {
  InsetEnd result;
  for (const Layer& layer : layers) {
    const bool is_outline = layer.inset == 0;
    if (layer.end != end && !(is_outline && end == 1)) continue;
    if (is_outline && end == 1) result.clear();  // the wall's upper edge is the last of them
    result.push_back({layer.inset, bottom + layer.z});
  }
  if (end == 0) std::reverse(result.begin(), result.end());
  return result;
}

}  // namespace

MeshResult rounded_extrude(const Shape2D& shape, const LinearExtrudeOptions& options,
                           const glm::dvec3& height) {
  if (options.twist != 0 || options.scale != glm::dvec2(1))
    return invalid_argument("linear_extrude: round goes without twist and scale");
  if (height.x != 0 || height.y != 0)
    return invalid_argument("linear_extrude: round goes with a direction along Z only");
  const auto [low, high] = options.round;
  if (low + high > height.z) {
    return invalid_argument(
        "linear_extrude: round must leave room at the bottom and at the top: " + number_text(low) +
        " and " + number_text(high) + " are more than the height of " + number_text(height.z));
  }
  double outline = 0;
  for (const Loop& loop : shape.loops()) outline += static_cast<double>(loop.size());
  const double steps =
      std::max(low, high) > 0 ? 2.0 * quarter_steps(std::max(low, high), options.facets) + 2 : 2;
  if (steps * outline > kMostPoints)
    return too_many_points(kRoundedExtrude, steps, steps * outline);
  const ShrinkingOutlines outlines(shape);
  const std::vector<Layer> layers = layers_of(options, height.z);
  const double bottom = options.center ? height.z / -2 : 0;
  const bool fits = std::all_of(layers.begin(), layers.end(), [&](const Layer& layer) {
    return layer.inset == 0 || outlines.fits(layer.inset);
  });
  if (!fits)
    return extrude_inset_bands(shape, end_of(layers, 0, bottom), end_of(layers, 1, bottom));
  return RoundedExtruder(shape, outlines, layers, bottom).build();
}

}  // namespace csgrun
