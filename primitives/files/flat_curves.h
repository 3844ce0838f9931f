// Curves of drawings as chains of points, by OpenSCAD's rule of facets.
#pragma once

#include <array>
#include <vector>

#include <glm/vec2.hpp>

#include <csgrun/primitives/solids.h>

namespace csgrun {

/// An open or closed run of points.
struct Chain {
  std::vector<glm::dvec2> points;
  bool closed = false;
};

/// More points than this in one drawing are a mistake, or meant ill.
constexpr size_t kMostDrawingPoints = 1 << 20;

/// Steps of a curve whose control polygon has this length, in mm: as many as an arc of about that
/// length would have.
int curve_steps(double length, const Facets& facets);

/// How many steps the curves of an SVG have. Lengths and radii are in user units.
struct SvgSteps {
  Facets facets;
  double mm_per_unit = 1;
  bool as_openscad = false;  ///< by its floors, and by user units as if they were millimetres

  [[nodiscard]] int of_bezier(double length) const;
  [[nodiscard]] int of_arc(double radius, double degrees) const;
  [[nodiscard]] int of_ellipse(double radius) const;
};

/// The points after the first of a Bezier curve of two, three or four control points.
void append_bezier(const std::vector<glm::dvec2>& control, int steps,
                   std::vector<glm::dvec2>& points);

/// The points of an ellipse at center + cos(t) * u + sin(t) * v for t from `from` by `sweep`
/// degrees (either way), both ends included, in `steps` steps; the last is left out of a full turn.
void append_ellipse(const glm::dvec2& center, const glm::dvec2& u, const glm::dvec2& v, double from,
                    double sweep, int steps, std::vector<glm::dvec2>& points);

/// The chain after the first point `a` to b, an arc whose bulge is tan(angle / 4), positive
/// counter-clockwise.
void append_bulge(const glm::dvec2& a, const glm::dvec2& b, double bulge, const Facets& facets,
                  std::vector<glm::dvec2>& points);

}  // namespace csgrun
