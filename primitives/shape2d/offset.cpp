// Offset: the shape united with a rectangle along each edge and a fan at each corner.
//
// Written as boundaries, rectangles and fans share their spokes, so their sum is one closed curve
// for each loop: the moved edges, joined by the fan's rim where the outline turns outwards, and
// through the corner itself where it turns inwards. Every piece winds counter-clockwise, so the
// winding number of the sum is nowhere negative and positive exactly in the union. Inwards, the
// same is done to the outside: loops turned over wind by -1 inside, and what stays below 0 is left.
#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include <csgrun/primitives/shape_operations.h>
#include <csgrun/primitives/trig.h>

#include "primitives/base/text.h"
#include "primitives/shape2d/noise_corners.h"
#include "primitives/shape2d/shape_factory.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

/// A mitre reaches at most so many distances from its corner, as in OpenSCAD.
constexpr double kMitreLimit = 1e6;
/// The cosine of 1.5 degrees. An arc at a corner makes two corners of half the turn, or more, so
/// outlines that are offset again and again would have twice as many points each time. A corner of
/// less than that, and of no more than a step of the arc, is mitred instead: that is farther out
/// than the arc by less than the sides of the arc are farther in.
constexpr double kArcIsMitre = 0.99965732497555726;

class OffsetCurve {
 public:
  /// turned_over: what was the edge before a corner is the later one of the loops that come here.
  OffsetCurve(double distance, OffsetJoin join, double mitre_limit, const Facets& facets,
              bool turned_over)
      : join_(join),
        turned_over_(turned_over),
        distance_(distance),
        mitre_limit_(mitre_limit),
        fragments_(facets.fragments(distance_)) {}
  explicit OffsetCurve(const StrokeOptions& pen)
      : join_(pen.join),
        bevels_long_mitres_(!pen.cut_square),
        distance_(pen.width / 2),
        mitre_limit_(std::max(pen.mitre_limit, 1.0)),
        fragments_(pen.facets.fragments(distance_)) {}

  /// Forth along a line and back, with caps where it turns.
  [[nodiscard]] Shape2D::Loop along(const Shape2D::Loop& line, StrokeCap cap) const {
    Shape2D::Loop there_and_back = line;
    there_and_back.insert(there_and_back.end(), line.rbegin() + 1, line.rend() - 1);
    const size_t n = there_and_back.size();
    const std::vector<glm::dvec2> normals = normals_of(there_and_back);
    Shape2D::Loop curve;
    for (size_t i = 0; i < n && static_cast<double>(curve.size()) <= kMostPoints; ++i) {
      const glm::dvec2 &p = there_and_back[i], &a = normals[(i + n - 1) % n], &b = normals[i];
      if (i != 0 && i + 1 != line.size()) {
        add_corner(p, a, b, curve);
      } else if (cap == StrokeCap::kRound) {
        add_arc(p, a, b, 180, curve);
        curve.push_back(p + distance_ * b);
      } else {
        const glm::dvec2 beyond = cap == StrokeCap::kSquare ? glm::dvec2(-a.y, a.x) : glm::dvec2(0);
        curve.push_back(p + distance_ * (a + beyond));
        curve.push_back(p + distance_ * (b + beyond));
      }
    }
    return curve;
  }

  [[nodiscard]] Shape2D::Loop around(const Shape2D::Loop& loop) const {
    const size_t n = loop.size();
    const std::vector<glm::dvec2> normals = normals_of(loop);
    Shape2D::Loop curve;
    for (size_t i = 0; i < n; ++i) {
      const glm::dvec2 &a = normals[(i + n - 1) % n], &b = normals[i];
      if (join_ == OffsetJoin::kRound && is_within_a_step(a, b)) {
        add_mitre(loop[i], a, b, curve);
      } else {
        add_corner(loop[i], a, b, curve);
      }
    }
    return curve;
  }

  /// No fewer points than around() gives.
  [[nodiscard]] double count_around(const Shape2D::Loop& loop) const {
    const size_t n = loop.size();
    const std::vector<glm::dvec2> normals = normals_of(loop);
    double count = kMostBesideArcs * static_cast<double>(n);
    for (size_t i = 0; i < n && join_ == OffsetJoin::kRound; ++i) {
      const glm::dvec2 &a = normals[(i + n - 1) % n], &b = normals[i];
      const double sine = a.x * b.y - a.y * b.x;
      if (sine > 0) count += atan2_deg(sine, glm::dot(a, b)) * fragments_ / 360;
    }
    return count;
  }

  /// That no outline of so many corners has more.
  [[nodiscard]] double most_around(double corners) const {
    return corners * (kMostBesideArcs + fragments_ / 2.0);
  }

  [[nodiscard]] int fragments() const { return fragments_; }

 private:
  /// Whether the outline turns outwards, by so little that a mitre will do for an arc.
  [[nodiscard]] bool is_within_a_step(const glm::dvec2& a, const glm::dvec2& b) const {
    const double sine = a.x * b.y - a.y * b.x, cosine = glm::dot(a, b);
    return sine > 0 && cosine > kArcIsMitre &&
           atan2_deg(sine, cosine) * fragments_ / 360 <= 1 + kNoise;
  }

  void add_mitre(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b,
                 Shape2D::Loop& curve) const {
    curve.push_back(p + distance_ * ((a + b) / (1 + glm::dot(a, b))));
  }

  /// Outward unit normals of the edges, for loops with the shape on their left.
  static std::vector<glm::dvec2> normals_of(const Shape2D::Loop& loop) {
    const size_t n = loop.size();
    std::vector<glm::dvec2> normals(n);
    for (size_t i = 0; i < n; ++i) {
      const glm::dvec2 d = loop[(i + 1) % n] - loop[i];
      const double length = std::sqrt(glm::dot(d, d));
      normals[i] = glm::dvec2(d.y / length, -d.x / length);
    }
    return normals;
  }

  /// The join at p from the edge with outward normal `a` to that with normal `b`.
  void add_corner(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b,
                  Shape2D::Loop& curve) const {
    const double sine = a.x * b.y - a.y * b.x, cosine = glm::dot(a, b);
    const auto add = [&](const glm::dvec2& direction) {
      curve.push_back(p + distance_ * direction);
    };
    if (sine <= 0) {  // inwards, or straight on: then all three lie on one spoke
      add(a);
      curve.push_back(p);
      add(b);
      return;
    }
    constexpr double kAlmostStraight = 0.999;  // a chamfer of less than 2.6 degrees is a mitre
    // A mitre is 1 / cos(turn / 2) distances long.
    const double limit = 2 / (mitre_limit_ * mitre_limit_) - 1;
    const bool mitred = join_ == OffsetJoin::kMitre
                            ? cosine > limit
                            : join_ == OffsetJoin::kChamfer && cosine > kAlmostStraight;
    if (mitred) {
      add_mitre(p, a, b, curve);
      return;
    }
    if (join_ == OffsetJoin::kRound) {
      add_arc(p, a, b, atan2_deg(sine, cosine), curve);
    } else if (join_ == OffsetJoin::kBevel || bevels_long_mitres_) {
      add(a);
    } else {
      // The line at the distance, square to the bisector: tan(turn / 4) beyond both moved edges.
      const double t = tan_deg(atan2_deg(sine, cosine) / 4);
      add(a + t * glm::dvec2(-a.y, a.x));
      add(b + t * glm::dvec2(b.y, -b.x));
      return;
    }
    add(b);
  }

  /// From direction `a`, `turn` degrees counter-clockwise to `b`; the last point is the caller's.
  /// Whole steps begin at the edge before the corner, as in OpenSCAD, which is the later one here
  /// if loops are turned over.
  void add_arc(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b, double turn,
               Shape2D::Loop& curve) const {
    // What is more than anybody can have is not made; the caller counts and says so.
    const double wanted = std::min(std::ceil(turn * fragments_ / 360 - kNoise), kMostPoints + 1);
    const int steps = std::max(static_cast<int>(wanted), 1);
    curve.push_back(p + distance_ * a);
    for (int i = 1; i < steps; ++i) {
      const glm::dvec2& from = turned_over_ ? b : a;
      const double degrees = 360.0 * (turned_over_ ? i - steps : i) / fragments_;
      const double c = cos_deg(degrees), s = sin_deg(degrees);
      curve.push_back(p + distance_ * glm::dvec2(c * from.x - s * from.y, s * from.x + c * from.y));
    }
  }

  /// In steps: a turn of whole ones must not get one more for the noise of its angle, which is
  /// between edges with ends on a grid, or of six digits.
  static constexpr double kNoise = 0.01;
  static constexpr double kMostBesideArcs = 3;  ///< points at a corner, besides steps of an arc

  OffsetJoin join_;
  bool turned_over_ = false;
  bool bevels_long_mitres_ = false;
  double distance_, mitre_limit_;
  int fragments_;
};

/// Where the curves wind around a point the right way.
Result<Shape2D> united(const std::vector<Shape2D::Loop>& curves, const char* function,
                       bool inwards) {
  double corners = 0;
  for (const Shape2D::Loop& curve : curves) corners += static_cast<double>(curve.size());
  if (corners > kMostPoints) return too_many_points(function, corners, corners);
  if (!all_finite(curves)) {
    return invalid_argument(std::string(function) + ": a coordinate would not be finite");
  }
  const Result<Grid2D> grid = grid_for(extent_of(curves));
  if (!grid) return grid.error();
  std::vector<Segment2D> segments;
  for (const Shape2D::Loop& curve : curves)
    add_outline(snap_loop(*grid, curve), kRestOfOperands, segments);
  return Shape2DFactory::arranged(*grid, std::move(segments), [inwards](int32_t, int32_t sum) {
    return inwards ? sum < 0 : sum > 0;
  });
}

/// `mirrored`: the shape is the mirror image of what is meant.
Result<Shape2D> offset_loops(const Shape2D& shape, const OffsetOptions& options, bool mirrored) {
  const bool inwards = options.distance < 0;
  const OffsetCurve maker(std::fabs(options.distance), options.join, kMitreLimit, options.facets,
                          inwards != mirrored);
  // Beside a corner that is noise hairs would be left inside, as long as the distance.
  std::vector<Shape2D::Loop> loops = loops_without_noise(shape);
  double corners = 0;
  for (Shape2D::Loop& loop : loops) {
    if (inwards) std::reverse(loop.begin(), loop.end());
    corners += static_cast<double>(loop.size());
  }
  if (maker.most_around(corners) > kMostPoints) {
    double points = 0;
    for (const Shape2D::Loop& loop : loops) points += maker.count_around(loop);
    if (points > kMostPoints) return too_many_points("offset", maker.fragments(), points);
  }
  std::vector<Shape2D::Loop> curves;
  for (const Shape2D::Loop& loop : loops) curves.push_back(maker.around(loop));
  return united(curves, "offset", inwards);
}

}  // namespace

Result<Shape2D> offset_shape(const Shape2D& shape, const OffsetOptions& options) {
  if (!std::isfinite(options.distance)) return not_finite("offset", "distance", options.distance);
  if (shape.empty() || options.distance == 0) return shape;
  const auto before = Shape2DFactory::before_turn(shape);
  if (!before) return offset_loops(shape, options, false);
  const auto& m = before->motion.m;
  const bool mirrored = m[0][0] * m[1][1] - m[0][1] * m[1][0] < 0;
  const Result<Shape2D> result = offset_loops(before->shape, options, mirrored);
  return result ? result->transformed(before->motion) : result;
}

Result<Shape2D> stroke_shape(const Shape2D::Loop& line, const StrokeOptions& options) {
  if (!std::isfinite(options.width)) return not_finite("stroke", "width", options.width);
  if (!(options.width > 0)) return not_positive("stroke", "width", options.width);
  Shape2D::Loop points;
  for (const glm::dvec2& p : line) {
    if (points.empty() || p != points.back()) points.push_back(p);
  }
  if (points.size() < 2) return Shape2D();
  const OffsetCurve maker(options);
  return united({maker.along(points, options.cap)}, "stroke", false);
}

}  // namespace csgrun
