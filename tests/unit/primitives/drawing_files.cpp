#include "tests/unit/primitives/drawing_files.h"

#include <cmath>

#include <gtest/gtest.h>

namespace csgrun::testing {

double ngon(int n, double r) { return n / 2.0 * std::sin(2 * kPi / n) * r * r; }

std::vector<glm::dvec2> arc_points(int n, int first, int last) {
  std::vector<glm::dvec2> points;
  for (int i = first; i <= last; ++i)
    points.emplace_back(std::cos(2 * kPi * i / n), std::sin(2 * kPi * i / n));
  return points;
}

double area_on_grid(std::vector<glm::dvec2> points, double scale) {
  double twice = 0;
  for (glm::dvec2& p : points)
    p = {std::round(p.x * scale * 1024) / 1024, std::round(p.y * scale * 1024) / 1024};
  for (size_t i = 0; i < points.size(); ++i) {
    const glm::dvec2 &a = points[i], &b = points[(i + 1) % points.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

double ngon_on_grid(int n, double r) { return area_on_grid(arc_points(n, 0, n - 1), r); }

std::string page(const std::string& content) {
  return "<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='100mm' "
         "viewBox='0 0 100 100'>" +
         content + "</svg>";
}

FlatFileOptions with_fn(double fn) {
  FlatFileOptions options;
  options.facets.fn = fn;
  return options;
}

FlatFile read(const std::string& name, const std::string& text, const FlatFileOptions& options) {
  auto r = parse_flat(name, text, options);
  EXPECT_TRUE(r) << (r ? "" : r.error().message) << "\n" << text;
  return r ? *r : FlatFile();
}

std::string error(const std::string& name, const std::string& text,
                  const FlatFileOptions& options) {
  const auto r = parse_flat(name, text, options);
  return r ? "no error" : r.error().message;
}

}  // namespace csgrun::testing
