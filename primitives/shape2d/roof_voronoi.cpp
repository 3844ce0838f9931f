// The roof over the Voronoi diagram of an outline's edges and corners: each cell is lifted to the
// distance from what it belongs to. Cells of edges are planar. Cells of corners that point inwards
// are parts of cones; they become triangles around the corner, with the borders of the cell divided
// into chords whose ends lie on the cone. A border belongs to two cells and is divided once, so the
// roof is closed by construction.
//
// This work is based on: Boost.Polygon, which computes the diagram of segments on integers with
// exact decisions (A. Sydorchuk 2010-2012).
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <boost/polygon/voronoi.hpp>
#include <glm/geometric.hpp>

#include <csgrun/primitives/trig.h>

#include "primitives/base/text.h"
#include "primitives/shape2d/roof_outline.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

using Diagram = boost::polygon::voronoi_diagram<double>;
using Cell = Diagram::cell_type;
using Edge = Diagram::edge_type;
using Vertex = Diagram::vertex_type;

/// The profile z(x) of a border that is not straight, over its foot x = 0, and where to divide it.
class BorderDivider {
 public:
  explicit BorderDivider(const Facets& facets, double step)
      : most_degrees_((facets.fn > 0 ? 360 / facets.fn : std::max(facets.fa, 0.01)) / 2),
        most_length_(facets.fn > 0 ? 0 : std::max(facets.fs, 0.01) / step) {}

  /// At least how many chords a curve will take from a to b, in steps: by its turn, by its length.
  template <class Slope>
  [[nodiscard]] double least_chords(double a, double b, Slope slope) const {
    const double turn = atan_deg(slope(b)) - atan_deg(slope(a));
    return std::max(turn / (2 * most_degrees_), most_length_ > 0 ? (b - a) / most_length_ : 0);
  }

  /// The places between a < b that divide a curve. A chord is halved at its far end until it is
  /// fine enough, as OpenSCAD has it.
  template <class Height, class Slope>
  [[nodiscard]] std::vector<double> divide(double a, double b, Height height, Slope slope) const {
    const auto too_coarse = [&](double x, double y) {
      const glm::dvec2 chord(y - x, height(y) - height(x));
      const glm::dvec2 tangent(1, slope(std::fabs(x) < std::fabs(y) ? x : y));
      const double turn =
          std::fabs(atan2_deg(chord.x * tangent.y - chord.y * tangent.x, glm::dot(chord, tangent)));
      return turn > most_degrees_ ||
             (most_length_ > 0 && glm::dot(chord, chord) > most_length_ * most_length_);
    };
    std::vector<double> places;
    for (double x = a;;) {
      double y = b;
      while (x < y && too_coarse(x, y)) y = (x + y) / 2;
      if (y == b || y <= x) return places;
      places.push_back(y);
      x = y;
    }
    return places;
  }

 private:
  double most_degrees_;
  double most_length_;  ///< in steps; 0: any
};

class VoronoiRoof {
 public:
  VoronoiRoof(const RoofOutline& outline, const RoofOptions& options)
      : outline_(outline),
        divider_(options.facets, outline.step),
        divide_between_corners_(options.divide_between_corners),
        mesh_(roof_floor(outline)) {}

  Result<PolygonMesh> build() {
    boost::polygon::voronoi_builder<int32_t> builder;
    for (size_t e = 0; e < outline_.edge_count(); ++e) {
      const Point2D &p = outline_.points[outline_.from[e]], &q = outline_.points[outline_.to[e]];
      builder.insert_segment(static_cast<int32_t>(p.x), static_cast<int32_t>(p.y),
                             static_cast<int32_t>(q.x), static_cast<int32_t>(q.y));
    }
    builder.construct(&diagram_);
    reflex_.assign(outline_.points.size(), false);
    for (uint32_t e = 0; e < outline_.edge_count(); ++e) {
      if (outline_.is_reflex_end(e)) reflex_[outline_.to[e]] = true;
    }
    number_vertices();
    divided_.resize(diagram_.edges().size() / 2);
    is_divided_.assign(divided_.size(), false);
    for (const Cell& cell : diagram_.cells()) {
      if (cell.is_degenerate()) continue;
      if (cell.contains_segment()) {
        add_plane(cell);
      } else if (reflex_[point_of(cell)]) {
        add_cone(cell);
      }
      if (points_ > kMostPoints) {
        return Error{ErrorCode::kLimit,
                     "roof: its curved faces would have more than " + number_text(kMostPoints) +
                         " points, which is the limit; take fewer facets (fn, fa, fs)",
                     {}};
      }
    }
    return closed_roof(outline_, std::move(mesh_));
  }

 private:
  /// Of a cell whose site is a point.
  [[nodiscard]] uint32_t point_of(const Cell& cell) const {
    const bool start =
        cell.source_category() == boost::polygon::SOURCE_CATEGORY_SEGMENT_START_POINT;
    return start ? outline_.from[cell.source_index()] : outline_.to[cell.source_index()];
  }

  [[nodiscard]] glm::dvec2 at(uint32_t point) const {
    return {static_cast<double>(outline_.points[point].x),
            static_cast<double>(outline_.points[point].y)};
  }
  static glm::dvec2 at(const Vertex& v) { return {v.x(), v.y()}; }

  /// How far p is from the line of an edge, positive on its left, in steps.
  [[nodiscard]] double height_over(size_t edge, const glm::dvec2& p) const {
    const glm::dvec2 a = at(outline_.from[edge]), d = at(outline_.to[edge]) - a;
    const glm::dvec2 r = p - a;
    return (d.x * r.y - d.y * r.x) / std::sqrt(glm::dot(d, d));
  }

  [[nodiscard]] double height_of(const Cell& cell, const glm::dvec2& p) const {
    if (cell.contains_segment()) return height_over(cell.source_index(), p);
    const glm::dvec2 r = p - at(point_of(cell));
    return std::sqrt(glm::dot(r, r));
  }

  uint32_t add_point(const glm::dvec2& p, double height) {
    mesh_.points.emplace_back(p.x * outline_.step, p.y * outline_.step, height * outline_.step);
    return static_cast<uint32_t>(mesh_.points.size() - 1);
  }

  [[nodiscard]] size_t index_of(const Vertex* v) const {
    return static_cast<size_t>(v - diagram_.vertices().data());
  }
  [[nodiscard]] size_t index_of(const Edge* e) const {
    return static_cast<size_t>(e - diagram_.edges().data());
  }

  /// Vertices of the diagram that are corners of the outline are those points; only the ends of
  /// secondary edges can be. Others get a point when a face asks for one.
  void number_vertices() {
    constexpr double kSame = 1e-3;  // of a step: far above the noise of Boost's coordinates
    number_.assign(diagram_.vertices().size(), kNone);
    for (const Edge& e : diagram_.edges()) {
      if (!e.is_secondary()) continue;
      const Cell& cell = e.cell()->contains_point() ? *e.cell() : *e.twin()->cell();
      const uint32_t corner = point_of(cell);
      for (const Vertex* v : {e.vertex0(), e.vertex1()}) {
        if (v == nullptr) continue;
        const glm::dvec2 r = at(*v) - at(corner);
        if (std::fabs(r.x) < kSame && std::fabs(r.y) < kSame) number_[index_of(v)] = corner;
      }
    }
  }

  uint32_t number_of(const Vertex* v) {
    uint32_t& number = number_[index_of(v)];
    if (number == kNone) number = add_point(at(*v), height_of(*v->incident_edge()->cell(), at(*v)));
    return number;
  }

  /// How high a vertex is over an edge; corners are where the outline has them.
  [[nodiscard]] double side_of(size_t edge, const Vertex* v) const {
    const uint32_t number = number_[index_of(v)];
    const bool corner = number != kNone && number < outline_.points.size();
    return height_over(edge, corner ? at(number) : at(*v));
  }

  /// Whether an edge of the diagram bounds the part of a segment's cell that is in the shape.
  [[nodiscard]] bool is_inside(size_t segment, const Edge* e) const {
    if (!e->is_finite()) return false;
    return std::max(side_of(segment, e->vertex0()), side_of(segment, e->vertex1())) > 1e-3 &&
           std::min(side_of(segment, e->vertex0()), side_of(segment, e->vertex1())) > -1e-3;
  }

  void add_plane(const Cell& cell) {
    const size_t segment = cell.source_index();
    // From the first edge that is inside, after one that is not: the outside has a part of the cell
    // too.
    const Edge* const first = cell.incident_edge();
    const Edge* e = first;
    while (!is_inside(segment, e) || is_inside(segment, e->prev())) {
      e = e->next();
      if (e == first) return;  // the roof will not close
    }
    std::vector<uint32_t> loop{outline_.from[segment], outline_.to[segment]};
    const auto append = [&](uint32_t point) {
      if (point != loop.back() && point != loop.front()) loop.push_back(point);
    };
    for (; is_inside(segment, e); e = e->next()) {
      append(number_of(e->vertex0()));
      for (const uint32_t point : between(e)) append(point);
      append(number_of(e->vertex1()));
    }
    if (loop.size() >= 3) mesh_.add_face(loop);
  }

  void add_cone(const Cell& cell) {
    const uint32_t corner = point_of(cell);
    const uint32_t surface = ++surfaces_;
    const Edge* e = cell.incident_edge();
    do {
      if (e->is_primary() && e->is_finite()) {
        std::vector<uint32_t> border{number_of(e->vertex0())};
        for (const uint32_t point : between(e)) border.push_back(point);
        border.push_back(number_of(e->vertex1()));
        for (size_t i = 1; i < border.size(); ++i) {
          if (border[i - 1] == corner || border[i] == corner) continue;
          mesh_.add_face(std::array<uint32_t, 3>{corner, border[i - 1], border[i]}, surface);
        }
      }
      e = e->next();
    } while (e != cell.incident_edge());
  }

  /// The points that divide an edge of the diagram, from its vertex0 to its vertex1.
  std::vector<uint32_t> between(const Edge* e) {
    const size_t pair = index_of(e) / 2;
    const bool with_corner = e->cell()->contains_point() || e->twin()->cell()->contains_point();
    if (e->is_secondary() || !with_corner) return {};
    // The pair is divided as its corner's cell sees it, of two corners as the first edge does.
    const Edge* seen = &diagram_.edges()[2 * pair];
    if (!seen->cell()->contains_point()) seen = seen->twin();
    if (!is_divided_[pair]) {
      is_divided_[pair] = true;
      divided_[pair] = divide(*seen);
    }
    std::vector<uint32_t> points = divided_[pair];
    if (e != seen) std::reverse(points.begin(), points.end());
    return points;
  }

  /// Divides a border of a corner's cell, which is on its left.
  std::vector<uint32_t> divide(const Edge& e) {
    const glm::dvec2 corner = at(point_of(*e.cell()));
    const Cell& other = *e.twin()->cell();
    // `up` points from the other site to the corner, which is `far` from it; the border goes to the
    // right of it.
    glm::dvec2 up;
    double far = 0;
    const bool parabola = other.contains_segment();
    if (parabola) {
      const glm::dvec2 d =
          at(outline_.to[other.source_index()]) - at(outline_.from[other.source_index()]);
      up = glm::dvec2(-d.y, d.x) / std::sqrt(glm::dot(d, d));
      far = height_over(other.source_index(), corner);
    } else {
      up = corner - at(point_of(other));
      far = std::sqrt(glm::dot(up, up));
      up /= far;
    }
    if (!(far > 0)) return {};
    const glm::dvec2 along(up.y, -up.x);
    const double a = glm::dot(at(*e.vertex0()) - corner, along);
    const double b = glm::dot(at(*e.vertex1()) - corner, along);
    if (!(a < b)) return {};
    if (parabola) {
      // Seen from above, from the corner: as far from it as from the line.
      const auto y = [far](double x) { return (x * x - far * far) / (2 * far); };
      return add_points(
          a, b, y, [far](double x) { return x / far; },
          [&](double x) { return add_point(corner + x * along + y(x) * up, y(x) + far); });
    }
    if (!divide_between_corners_) return {};
    // Seen from the side: a hyperbola over the line half way between the corners.
    const auto z = [far](double x) { return std::sqrt(x * x + far * far / 4); };
    return add_points(
        a, b, z, [z](double x) { return x / z(x); },
        [&](double x) { return add_point(corner + x * along - (far / 2) * up, z(x)); });
  }

  /// The points of a curve between a and b; none when they would be too many, which build() tells.
  template <class Height, class Slope, class Point>
  std::vector<uint32_t> add_points(double a, double b, Height height, Slope slope, Point point) {
    points_ += divider_.least_chords(a, b, slope);
    if (points_ > kMostPoints) return {};
    std::vector<uint32_t> points;
    for (const double x : divider_.divide(a, b, height, slope)) points.push_back(point(x));
    return points;
  }

  static constexpr uint32_t kNone = 0xffffffff;
  const RoofOutline& outline_;
  BorderDivider divider_;
  bool divide_between_corners_;
  PolygonMesh mesh_;
  Diagram diagram_;
  std::vector<bool> reflex_;      ///< per point of the outline: a cone stands on it
  std::vector<uint32_t> number_;  ///< per vertex of the diagram: its point of the mesh
  std::vector<std::vector<uint32_t>> divided_;  ///< per pair of edges: as its corner sees it
  std::vector<bool> is_divided_;
  double points_ = 0;  ///< at least so many are to be made
  uint32_t surfaces_ = 0;
};

}  // namespace

Result<PolygonMesh> voronoi_roof(const RoofOutline& outline, const RoofOptions& options) {
  return VoronoiRoof(outline, options).build();
}

}  // namespace csgrun
