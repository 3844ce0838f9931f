#include "primitives/files/flat_curves.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include <csgrun/primitives/trig.h>

namespace csgrun {

int curve_steps(double length, const Facets& facets) {
  constexpr double kQuarterControlLength = 1.66;  // of a quarter of a circle of radius 1
  return std::max((facets.fragments(length / kQuarterControlLength) + 3) / 4, 2);
}

int SvgSteps::of_bezier(double length) const {
  if (!as_openscad) return curve_steps(length * mm_per_unit, facets);
  constexpr double kFewest = 20;
  return static_cast<int>(std::max(std::isfinite(facets.fn) ? facets.fn : 0, kFewest));
}

int SvgSteps::of_arc(double radius, double degrees) const {
  if (!as_openscad) return facets.fragments(radius * mm_per_unit, degrees);
  const int fewest = static_cast<int>(std::fabs(degrees) / 18 + 4);
  return std::max(facets.fragments(radius, degrees), fewest);
}

int SvgSteps::of_ellipse(double radius) const {
  if (!as_openscad) return facets.fragments(radius * mm_per_unit);
  constexpr int kFewest = 40;
  return std::max(facets.fragments(radius), kFewest);
}

void append_bezier(const std::vector<glm::dvec2>& control, int steps,
                   std::vector<glm::dvec2>& points) {
  for (int i = 1; i < steps; ++i) {
    const double t = double(i) / steps, s = 1 - t;
    std::vector<glm::dvec2> p = control;  // de Casteljau
    for (size_t n = p.size(); n > 1; --n) {
      for (size_t k = 0; k + 1 < n; ++k) p[k] = s * p[k] + t * p[k + 1];
    }
    points.push_back(p[0]);
  }
  points.push_back(control.back());
}

void append_ellipse(const glm::dvec2& center, const glm::dvec2& u, const glm::dvec2& v, double from,
                    double sweep, int steps, std::vector<glm::dvec2>& points) {
  const int last = std::fabs(sweep) >= 360 ? steps - 1 : steps;
  for (int i = 0; i <= last; ++i) {
    const double t = from + sweep * i / steps;
    points.push_back(center + cos_deg(t) * u + sin_deg(t) * v);
  }
}

void append_bulge(const glm::dvec2& a, const glm::dvec2& b, double bulge, const Facets& facets,
                  std::vector<glm::dvec2>& points) {
  const glm::dvec2 chord = b - a;
  const double length = std::sqrt(glm::dot(chord, chord));
  if (bulge == 0 || length == 0 || !std::isfinite(bulge)) {
    points.push_back(b);
    return;
  }
  const double angle = 4 * atan_deg(std::fabs(bulge));
  const double radius = length * (1 + bulge * bulge) / (4 * std::fabs(bulge));
  // The centre lies (1 - bulge^2) / (4 bulge) chords to the left of the chord's middle.
  const glm::dvec2 center =
      (a + b) * 0.5 + glm::dvec2(-chord.y, chord.x) * ((1 - bulge * bulge) / (4 * bulge));
  const int steps = facets.fragments(radius, angle);
  std::vector<glm::dvec2> arc;
  const glm::dvec2 u = a - center;
  append_ellipse(center, u, glm::dvec2(-u.y, u.x), 0, bulge > 0 ? angle : -angle, steps, arc);
  points.insert(points.end(), arc.begin() + 1, arc.end() - 1);
  points.push_back(b);
}

}  // namespace csgrun
