#include "primitives/shape2d/extrude_facets.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include <glm/geometric.hpp>

#include <csgrun/primitives/trig.h>

#include "primitives/shape2d/noise_corners.h"
#include "primitives/shape2d/shape_factory.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

constexpr double kRadian = 3.14159265358979323846 / 180;

/// ln(x) for x > 0 from plain arithmetic: the numbers of slices must not depend on a libm.
double natural_log(double x) {
  int exponent = 0;
  const double m = std::frexp(x, &exponent);      // in [1/2, 1)
  const double t = (m - 1) / (m + 1), u = t * t;  // ln m = 2 (t + t^3/3 + ...), |t| <= 1/3
  double sum = 0;
  for (int k = 39; k >= 1; k -= 2) sum = sum * u + 1.0 / k;
  return 2 * t * sum + exponent * 0.69314718055994530942;
}

/// Length of the Archimedean spiral r = a t from 0 to t.
double spiral_length(double a, double t) {
  const double root = std::sqrt(1 + t * t);
  return a / 2 * (t * root + natural_log(t + root));
}

double farthest_radius(const Shape2D& shape) {
  double squared = 0;
  for (const Shape2D::Loop& loop : shape.loops()) {
    for (const glm::dvec2& p : loop) squared = std::max(squared, glm::dot(p, p));
  }
  return std::sqrt(squared);
}

double fs_of(const LinearExtrudeOptions& o) { return std::max(o.facets.fs, 0.01); }
double fa_of(const LinearExtrudeOptions& o) { return std::max(o.facets.fa, 0.01); }

/// Slices for an uneven scale: by the longest way from the bottom to the top.
double diagonal_slices(const Shape2D& shape, const LinearExtrudeOptions& o, double height) {
  if (o.facets.fn > 0) return std::max(std::floor(o.facets.fn), 1.0);
  double squared = 0;
  for (const Shape2D::Loop& loop : shape.loops()) {
    for (const glm::dvec2& p : loop) {
      const glm::dvec2 move = p - p * o.scale;
      squared = std::max(squared, glm::dot(move, move));
    }
  }
  return std::max(std::ceil(std::sqrt(squared + height * height) / fs_of(o)), 1.0);
}

/// Slices for a twist so that the way of a point at that radius stays within fe of its helix.
double helix_slices_by_error(const LinearExtrudeOptions& o, double radius) {
  const double twist = std::fabs(o.twist);
  const double least = std::max(std::ceil(twist / 120), 1.0);
  if (o.facets.fe >= radius) return least;
  return std::max(std::ceil(twist / (2 * acos_deg(1 - o.facets.fe / radius))), least);
}

/// Slices for a twist, along a helix of the given length.
double helix_slices(const LinearExtrudeOptions& o, double length) {
  const double twist = std::fabs(o.twist);
  const double least = std::max(std::ceil(twist / 120), 1.0);
  if (o.facets.fn > 0) return std::max(std::ceil(twist / 360 * o.facets.fn), least);
  return std::max(std::min(std::ceil(twist / fa_of(o)), std::ceil(length / fs_of(o))), least);
}

double helix_length(double radius, const LinearExtrudeOptions& o, double height) {
  const double turn = std::fabs(o.twist) * kRadian;
  return std::sqrt(turn * radius * turn * radius + height * height);
}

double conical_helix_length(double radius, const LinearExtrudeOptions& o, double height) {
  const double turn = std::fabs(o.twist) * kRadian, s = o.scale.x;
  const double end = s > 1 ? turn * s / (s - 1) : turn / (1 - s);
  const double a = radius / end;
  const double arc = spiral_length(a, end) - spiral_length(a, end - turn);
  return std::sqrt(arc * arc + height * height);
}

/// For each edge of a loop the longest that it gets at any slice.
std::vector<double> longest_lengths(const LinearExtrudeOptions& o, const Shape2D::Loop& loop,
                                    int slices) {
  const size_t n = loop.size();
  std::vector<double> lengths(n, 0.0);
  const auto edge = [&](size_t i) { return loop[(i + 1) % n] - loop[i]; };
  if (o.scale.x == o.scale.y) {  // turning changes no length, but for the noise of doubles
    for (size_t i = 0; i < n; ++i) {
      lengths[i] = std::sqrt(glm::dot(edge(i), edge(i))) * std::max(1.0, o.scale.x);
    }
    return lengths;
  }
  for (int s = 0; s <= slices; ++s) {
    const Slice slice(o, s, slices);
    for (size_t i = 0; i < n; ++i) {
      const glm::dvec2 moved = slice.point(edge(i));
      lengths[i] = std::max(lengths[i], glm::dot(moved, moved));
    }
  }
  for (double& length : lengths) length = std::sqrt(length);
  return lengths;
}

/// Pieces for each edge, at most `count` in all: again and again one more for the edges whose
/// pieces are longest, as long as all of those can have one. What is compared lies between the
/// length of the pieces and their length with one more; edges within a thousandth of one another
/// are alike, so that a regular outline stays regular.
std::vector<int> pieces_by_count(const std::vector<double>& lengths, double count) {
  constexpr double kAlike = 0.999;
  std::vector<int> pieces(lengths.size(), 1);
  using Entry = std::pair<double, size_t>;
  std::priority_queue<Entry> longest;
  const auto push = [&](size_t i) { longest.emplace(lengths[i] / (pieces[i] + 0.5), i); };
  for (size_t i = 0; i < lengths.size(); ++i) push(i);
  std::vector<size_t> alike;
  for (auto total = static_cast<double>(lengths.size()); total < count;) {
    const double least = longest.top().first * kAlike;
    for (alike.clear(); !longest.empty() && longest.top().first >= least; longest.pop())
      alike.push_back(longest.top().second);
    total += static_cast<double>(alike.size());
    if (total > count) break;
    for (const size_t i : alike) {
      ++pieces[i];
      push(i);
    }
  }
  return pieces;
}

std::vector<int> pieces_of(const std::vector<double>& lengths, const LinearExtrudeOptions& o) {
  if (o.segments) return pieces_by_count(lengths, *o.segments);
  if (o.facets.fn > 0)
    return pieces_by_count(lengths, std::min(std::floor(o.facets.fn), kMostPoints));
  const double most = std::ceil(360 / fa_of(o));
  std::vector<int> pieces(lengths.size());
  double total = 0;
  for (size_t i = 0; i < lengths.size(); ++i) {
    // An edge of 10 mm makes 5 pieces of 2 mm, also when it is a hair longer by rounding.
    constexpr double kNoise = 1e-12;
    const double wanted = std::max(std::ceil(lengths[i] / fs_of(o) * (1 - kNoise)), 1.0);
    total += wanted;
    pieces[i] = static_cast<int>(std::min(wanted, kMostPoints));
  }
  return total >= most ? pieces_by_count(lengths, most) : pieces;
}

}  // namespace

Slice::Slice(const LinearExtrudeOptions& options, int i, int n) : turned_(options.twist != 0) {
  if (turned_) {
    const double angle = -options.twist * i / n;
    cos_ = cos_deg(angle);
    sin_ = sin_deg(angle);
  }
  // Exact at both ends.
  const auto factor = [&](double scale) { return i == n ? scale : 1 - (1 - scale) * i / n; };
  scale_ = {factor(options.scale.x), factor(options.scale.y)};
}

glm::dvec2 Slice::point(const glm::dvec2& p) const {
  const glm::dvec2 q = turned_ ? glm::dvec2(cos_ * p.x - sin_ * p.y, sin_ * p.x + cos_ * p.y) : p;
  return {q.x * scale_.x + 0.0, q.y * scale_.y + 0.0};
}

double slices_of(const Shape2D& shape, const LinearExtrudeOptions& options, double height) {
  if (options.slices) return *options.slices;
  const bool even = options.scale.x == options.scale.y;
  if (options.twist == 0) return even ? 1 : diagonal_slices(shape, options, height);
  const double radius = farthest_radius(shape);
  if (even && options.scale.x != 1)
    return helix_slices(options, conical_helix_length(radius, options, height));
  const double slices = options.facets.by_error()
                            ? helix_slices_by_error(options, radius)
                            : helix_slices(options, helix_length(radius, options, height));
  return even ? slices : std::max(diagonal_slices(shape, options, height), slices);
}

bool is_cut_from_first(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                       const glm::dvec3& d, bool of_equal) {
  const double to_c = std::sqrt(glm::dot(c - a, c - a)), to_d = std::sqrt(glm::dot(d - b, d - b));
  return std::fabs(to_c - to_d) > 1e-5 * (to_c + to_d) / 2 ? to_c < to_d : of_equal;
}

std::vector<Shape2D::Loop> split_outlines(const Shape2D& shape, const LinearExtrudeOptions& options,
                                          int slices) {
  const bool bends = options.twist != 0 || options.scale.x != options.scale.y;
  const bool split = options.segments ? *options.segments > 0 : bends;
  // An edge of 10 mm makes 5 pieces of 2 mm, also where rounding made it longer at both ends.
  const double noise = Shape2DFactory::noise_of(shape) *
                       std::max({1.0, std::fabs(options.scale.x), std::fabs(options.scale.y)});
  if (!split) return bends ? loops_without_noise(shape) : shape.loops();
  std::vector<Shape2D::Loop> result;
  for (const Shape2D::Loop& loop : loops_without_noise(shape)) {
    const size_t n = loop.size();
    std::vector<double> lengths = longest_lengths(options, loop, slices);
    for (double& length : lengths) length = std::max(length - noise, 0.0);
    const std::vector<int> pieces = pieces_of(lengths, options);
    Shape2D::Loop& fine = result.emplace_back();
    for (size_t i = 0; i < n; ++i) {
      const glm::dvec2 a = loop[i], b = loop[(i + 1) % n];
      for (int k = 0; k < pieces[i]; ++k) {
        const glm::dvec2 p = a + (b - a) * (static_cast<double>(k) / pieces[i]);
        if (k == 0 || p != fine.back()) fine.push_back(p);
      }
    }
  }
  return result;
}

}  // namespace csgrun
