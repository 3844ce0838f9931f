// Marching tetrahedra on a lattice, layer by layer.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <csgrun/primitives/freeform.h>

#include "primitives/base/none.h"
#include "primitives/base/text.h"
#include "primitives/solids/finish_solid.h"

namespace csgrun {
namespace {

using Field = std::function<Result<double>(const glm::dvec3&)>;

/// The most points of a lattice: minutes of calls of a script.
constexpr double kMostLatticePoints = 0x1p28;
/// And of two of its layers, all that is kept at a time: 700 MB.
constexpr double kMostLayerPoints = 0x1p23;
/// Of an edge of the lattice: what rounding makes of a function's value there, and less than any
/// grid tells from nothing. And what the coordinates of a point on it are wrong by, of these.
constexpr double kNoise = 1e-10, kRounding = 0x1p-48;

/// The six tetrahedra of a cell: on the way from its lowest corner to the greatest, along one axis
/// after the other. Corners are masks: bit k is one step along axis k.
struct Tetrahedron {
  std::array<uint8_t, 4> corners;
  bool is_positive;  ///< (c1 - c0, c2 - c0, c3 - c0) is right-handed
};
constexpr std::array<Tetrahedron, 6> kTetrahedra{{
    {{0, 1, 3, 7}, true},
    {{0, 2, 6, 7}, true},
    {{0, 4, 5, 7}, true},
    {{0, 2, 3, 7}, false},
    {{0, 4, 6, 7}, false},
    {{0, 1, 5, 7}, false},
}};

/// Points 1 to n + 1 of each axis are the lattice. Points 0 and n + 2 lie in the same places as
/// their neighbours, and outside of the solid: so the sides of the box close what reaches them.
class Polygonizer {
 public:
  Polygonizer(const Field& field, const LevelSetOptions& options,
              const std::array<size_t, 3>& parts)
      : field_(field), options_(options), parts_(parts), row_(parts[0] + 3) {
    for (int k = 0; k < 3; ++k) {
      const double low = options.low[k], high = options.high[k];
      const double edge = (high - low) / static_cast<double>(parts[static_cast<size_t>(k)]);
      noise_ = std::max(noise_, kRounding * std::max(std::fabs(low), std::fabs(high)) / edge);
    }
    for (Layer& layer : layers_) {
      layer.values.resize(row_ * (parts[1] + 3));
      layer.own_point.resize(layer.values.size());
      layer.edge_points.resize(layer.values.size());
    }
  }

  MeshResult run() {
    std::optional<Error> error = fill_layer(0);
    for (size_t z = 0; !error && z <= parts_[2] + 1; ++z) {
      error = fill_layer(z + 1);
      if (error) break;
      for (size_t y = 0; y <= parts_[1] + 1; ++y) {
        for (size_t x = 0; x <= parts_[0] + 1; ++x) cut_cell({x, y, z});
      }
    }
    if (error) return *std::move(error);
    for (const auto& side : sides_) mesh_.add_face(side);
    mesh_.surface.assign(mesh_.face_count(), 1);
    return std::move(mesh_);
  }

 private:
  using Cell = std::array<size_t, 3>;
  /// What is known of the lattice points of one z.
  struct Layer {
    std::vector<double> values;
    std::vector<uint32_t> own_point;  ///< of the mesh, where the surface goes through the corner
    std::vector<std::array<uint32_t, 8>> edge_points;  ///< of the edges that go up, by direction
  };

  [[nodiscard]] double coordinate(size_t axis, size_t i) const {
    const int k = static_cast<int>(axis);
    const double low = options_.low[k], high = options_.high[k];
    if (i <= 1) return low;
    if (i > parts_[axis]) return high;
    return low + (high - low) * (static_cast<double>(i - 1) / static_cast<double>(parts_[axis]));
  }
  [[nodiscard]] glm::dvec3 place(const Cell& c) const {
    return {coordinate(0, c[0]), coordinate(1, c[1]), coordinate(2, c[2])};
  }
  [[nodiscard]] bool is_outside_box(const Cell& c) const {
    bool any = false;
    for (size_t k = 0; k < 3; ++k) any |= c[k] == 0 || c[k] == parts_[k] + 2;
    return any;
  }

  std::optional<Error> fill_layer(size_t z) {
    Layer& layer = layers_[z % 2];
    std::fill(layer.own_point.begin(), layer.own_point.end(), kNone);
    std::array<uint32_t, 8> none{};
    none.fill(kNone);
    std::fill(layer.edge_points.begin(), layer.edge_points.end(), none);
    for (size_t y = 0; y <= parts_[1] + 2; ++y) {
      for (size_t x = 0; x <= parts_[0] + 2; ++x) {
        const Cell cell{x, y, z};
        double& value = layer.values[y * row_ + x];
        value = 1;
        if (is_outside_box(cell)) continue;
        const Result<double> given = field_(place(cell));
        if (!given) return given.error();
        if (!std::isfinite(*given)) return not_finite("levelset", "the function's value", *given);
        value = *given - options_.level;
      }
    }
    return std::nullopt;
  }

  static Cell corner(const Cell& cell, unsigned mask) {
    return {cell[0] + (mask & 1), cell[1] + (mask >> 1 & 1), cell[2] + (mask >> 2 & 1)};
  }
  [[nodiscard]] size_t index(const Cell& c) const { return c[1] * row_ + c[0]; }
  [[nodiscard]] double value(const Cell& c) const { return layers_[c[2] % 2].values[index(c)]; }

  uint32_t add_point(uint32_t& number, const glm::dvec3& p) {
    if (number == kNone) {
      number = static_cast<uint32_t>(mesh_.points.size());
      mesh_.points.push_back(p);
    }
    return number;
  }

  /// Where the surface meets the edge from the corner `inside` to `outside`, masks of `cell`.
  uint32_t cut_edge(const Cell& cell, unsigned inside, unsigned outside) {
    const Cell a = corner(cell, inside), b = corner(cell, outside);
    const double va = value(a), vb = value(b);
    // Outside the box there is nothing to go between.
    if (is_outside_box(b)) return own_point(a);
    const Cell& low = inside < outside ? a : b;  // one mask contains the other
    uint32_t& number = layers_[low[2] % 2].edge_points[index(low)][inside ^ outside];
    if (number != kNone) return number;  // other cells know the edge, too
    // Surface that passes a corner at the distance of noise passes through it, or several points
    // would be in one place, or on a line. Where the value is 0 is inside.
    const double t = 1 / (1 - vb / va);  // va / (va - vb), which may overflow
    const double nothing = noise_ * scale_;
    if (-va <= nothing || t < noise_) return number = own_point(a);
    if (vb <= nothing || t > 1 - noise_) return number = own_point(b);
    return add_point(number, place(a) + t * (place(b) - place(a)));
  }
  uint32_t own_point(const Cell& c) {
    const uint32_t point = add_point(layers_[c[2] % 2].own_point[index(c)], place(c));
    is_corner_.resize(mesh_.points.size());
    is_corner_[point] = true;
    return point;
  }

  void add_triangle(uint32_t a, uint32_t b, uint32_t c, bool flip) {
    if (a == b || b == c || c == a) return;
    if (flip) std::swap(b, c);
    is_corner_.resize(mesh_.points.size());
    if (is_corner_[a] && is_corner_[b] && is_corner_[c]) {
      add_side(a, b, c);
    } else {
      mesh_.add_face(std::array<uint32_t, 3>{a, b, c});
    }
  }

  /// Of a tetrahedron: what is inside may end there from both sides, and is nothing then.
  void add_side(uint32_t a, uint32_t b, uint32_t c) {
    const auto from_least = [](std::array<uint32_t, 3> t) {
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      return t;
    };
    if (sides_.erase(from_least({a, c, b})) == 0) sides_.insert(from_least({a, b, c}));
  }

  void cut_cell(const Cell& cell) {
    unsigned inside = 0;
    scale_ = 0;
    for (unsigned mask = 0; mask < 8; ++mask) {
      const double v = value(corner(cell, mask));
      inside |= (v <= 0) << mask;
      if (!is_outside_box(corner(cell, mask))) scale_ = std::max(scale_, std::fabs(v));
    }
    if (inside == 0 || inside == 0xff) return;
    for (const Tetrahedron& t : kTetrahedra) cut_tetrahedron(cell, t, inside);
  }

  void cut_tetrahedron(const Cell& cell, const Tetrahedron& t, unsigned inside) {
    // Corners inside first; each exchange of neighbours turns the orientation.
    std::array<uint8_t, 4> c = t.corners;
    bool flip = !t.is_positive;
    size_t count = 0;
    for (size_t i = 0; i < 4; ++i) {
      if ((inside >> c[i] & 1) == 0) continue;
      for (size_t j = i; j > count; --j) std::swap(c[j], c[j - 1]), flip = !flip;
      ++count;
    }
    if (count == 1) {
      add_triangle(cut_edge(cell, c[0], c[1]), cut_edge(cell, c[0], c[2]),
                   cut_edge(cell, c[0], c[3]), flip);
    } else if (count == 2) {
      const uint32_t ac = cut_edge(cell, c[0], c[2]), ad = cut_edge(cell, c[0], c[3]),
                     bd = cut_edge(cell, c[1], c[3]), bc = cut_edge(cell, c[1], c[2]);
      add_triangle(ac, ad, bd, flip);
      add_triangle(ac, bd, bc, flip);
    } else if (count == 3) {
      add_triangle(cut_edge(cell, c[0], c[3]), cut_edge(cell, c[1], c[3]),
                   cut_edge(cell, c[2], c[3]), flip);
    }
  }

  const Field& field_;
  const LevelSetOptions& options_;
  const std::array<size_t, 3> parts_;
  const size_t row_;
  double noise_ = kNoise;
  double scale_ = 0;             ///< of the values at the corners of the cell at hand
  std::vector<bool> is_corner_;  ///< per point of the mesh, whether it is one of the lattice
  std::set<std::array<uint32_t, 3>> sides_;
  std::array<Layer, 2> layers_;
  PolygonMesh mesh_;
};

}  // namespace

MeshResult make_level_set(const Field& function, const LevelSetOptions& options) {
  if (!std::isfinite(options.step)) return not_finite("levelset", "step", options.step);
  if (!(options.step > 0)) return not_positive("levelset", "step", options.step);
  if (!std::isfinite(options.level)) return not_finite("levelset", "level", options.level);
  std::array<size_t, 3> parts{};
  double points = 1;
  for (int k = 0; k < 3; ++k) {
    const double length = options.high[k] - options.low[k];
    if (!std::isfinite(length) || !(length > 0)) {
      return invalid_argument("levelset: the bounds must be finite and increase along each axis");
    }
    // A side that is a whole number of steps long is not cut once more for the noise of doubles.
    const double count = std::ceil(length / options.step * (1 - 1e-12));
    points *= count + 3;
    const double most = k < 2 ? kMostLayerPoints : kMostLatticePoints;
    if (points > most) {
      return Error{ErrorCode::kLimit,
                   std::string("levelset: the bounds hold more than ") + number_text(most) +
                       " samples" + (k < 2 ? " of one height" : "") + " at this step",
                   {}};
    }
    parts[static_cast<size_t>(k)] = static_cast<size_t>(count);
  }
  auto mesh = Polygonizer(function, options, parts).run();
  if (!mesh || mesh->face_count() == 0) return mesh;
  mesh->kind = "levelset";
  std::string note;
  return finish_solid(*std::move(mesh), "levelset", &note);
}

}  // namespace csgrun
