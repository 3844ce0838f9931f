#include "primitives/files/svg_stroke.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include <glm/geometric.hpp>

#include <csgrun/primitives/trig.h>

namespace csgrun {
namespace {

/// A piece of a line, and the way that it goes where it has no length.
struct Dash {
  Shape2D::Loop line;
  glm::dvec2 direction{1, 0};
};

Error too_many_dashes() {
  return Error{
      ErrorCode::kLimit,
      "a stroke-dasharray makes more than " + std::to_string(kMostDrawingPoints) + " dashes",
      {}};
}

/// The dashes of a line in steps of a pattern whose sum is positive.
class Dasher {
 public:
  Dasher(const std::vector<double>& pattern, double offset) : pattern_(pattern) {
    const double sum = std::accumulate(pattern.begin(), pattern.end(), 0.0);
    double into = std::fmod(offset, sum);
    if (into < 0) into += sum;
    while (into >= pattern_[at_] && into > 0) {
      into -= pattern_[at_];
      at_ = (at_ + 1) % pattern_.size();
    }
    left_ = std::max(pattern_[at_] - into, 0.0);
  }

  std::vector<Dash> cut(const Shape2D::Loop& line) {
    double length = 0;
    for (size_t i = 1; i < line.size(); ++i) length += glm::length(line[i] - line[i - 1]);
    // What is shorter is a dash, or goes around a corner, by rounding only.
    const double noise = 1e-10 * length;
    double before = 0;
    for (size_t i = 1; i < line.size(); ++i) {
      const glm::dvec2 &a = line[i - 1], &b = line[i];
      const double side = glm::length(b - a);
      if (side == 0) continue;
      direction_ = (b - a) / side;
      if (is_dash() && !open_) begin(a);
      double along = 0;
      while (side - along > left_ + noise) {
        along += left_;
        if (before + along >= length - noise) break;
        const glm::dvec2 p = a + along * direction_;
        if (is_dash()) end(p);
        at_ = (at_ + 1) % pattern_.size();
        left_ = pattern_[at_];
        if (is_dash()) begin(p);
      }
      left_ -= side - along;
      if (left_ <= noise) left_ = 0;
      if (open_) dashes_.back().line.push_back(b);
      before += side;
    }
    return std::move(dashes_);
  }

 private:
  [[nodiscard]] bool is_dash() const { return at_ % 2 == 0; }
  void begin(const glm::dvec2& p) {
    dashes_.push_back({{p}, direction_});
    open_ = true;
  }
  void end(const glm::dvec2& p) {
    dashes_.back().line.push_back(p);
    open_ = false;
  }

  const std::vector<double>& pattern_;
  size_t at_ = 0;      ///< in the pattern; even: a dash
  double left_ = 0;    ///< of that
  bool open_ = false;  ///< whether the last dash goes on
  glm::dvec2 direction_{1, 0};
  std::vector<Dash> dashes_;
};

/// What a pen leaves that is put down and not moved.
Result<Shape2D> dot(const glm::dvec2& p, const glm::dvec2& direction, const StrokeOptions& pen) {
  const double r = pen.width / 2;
  const bool round = pen.cap == StrokeCap::kRound;
  if (!round && pen.cap != StrokeCap::kSquare) return Shape2D();
  const int corners = round ? pen.facets.fragments(r) : 4;
  Shape2D::Loop loop;
  for (int i = 0; i < corners; ++i) {
    const double degrees = round ? 360.0 * i / corners : 90.0 * i;
    const double c = cos_deg(degrees), s = sin_deg(degrees);
    const glm::dvec2 way(c * direction.x - s * direction.y, s * direction.x + c * direction.y);
    const glm::dvec2 beside = round ? glm::dvec2(0) : glm::dvec2(-way.y, way.x);
    loop.push_back(p + r * (way + beside));
  }
  return Shape2D::from_outlines({loop}, FillRule::kNonZero);
}

}  // namespace

Status stroke_svg_line(const Shape2D::Loop& line, const SvgMap& map, const SvgPen& pen,
                       std::vector<Shape2D>& shapes, size_t& points) {
  if (map.is_flat() || line.size() < 2) return std::monostate();
  // The pen is moved in coordinates of about the size of the result, for the grid and the facets
  // of round caps: where it stays round, in those of the result.
  const bool stays_round = pen.fixed_unit > 0 || map.is_similarity();
  const double enlarged = map.largest_scale();
  const SvgMap to_pen = stays_round ? map : SvgMap{enlarged, 0, 0, enlarged, 0, 0};
  const double scale = pen.fixed_unit > 0 ? pen.fixed_unit : stays_round ? map.scale() : enlarged;
  Shape2D::Loop drawn;
  for (const glm::dvec2& p : line) drawn.push_back(to_pen.apply(p));
  StrokeOptions stroke = pen.stroke;
  stroke.width *= scale;
  if (!(stroke.width > 0)) return std::monostate();
  std::vector<Dash> dashes;
  double length = 0;
  for (size_t i = 1; i < drawn.size(); ++i) length += glm::length(drawn[i] - drawn[i - 1]);
  std::vector<double> pattern = pen.dashes;
  double gaps = 0, sum = 0;
  for (size_t i = 0; i < pattern.size(); ++i) {
    pattern[i] *= scale;
    sum += pattern[i];
    if (i % 2 == 1) gaps += pattern[i];
  }
  if (gaps > 0 && std::isfinite(sum) && length > 0) {
    // Asked for before any of them are made.
    const double count = length / sum * static_cast<double>(pattern.size()) / 2;
    if (!(count + static_cast<double>(points) <= static_cast<double>(kMostDrawingPoints)))
      return too_many_dashes();
    dashes = Dasher(pattern, pen.dash_offset * scale).cut(drawn);
  } else {
    dashes.push_back({std::move(drawn), {1, 0}});
  }
  Affine back;
  back.m[0] = {map.a / enlarged, map.c / enlarged, 0, map.e};
  back.m[1] = {map.b / enlarged, map.d / enlarged, 0, map.f};
  for (const Dash& dash : dashes) {
    const bool has_length = std::any_of(dash.line.begin(), dash.line.end(),
                                        [&](const auto& p) { return p != dash.line[0]; });
    Result<Shape2D> shape =
        has_length ? stroke_shape(dash.line, stroke) : dot(dash.line[0], dash.direction, stroke);
    if (shape && !stays_round) shape = shape->transformed(back);
    if (!shape) return shape.error();
    points += dash.line.size();
    if (points > kMostDrawingPoints) return too_many_dashes();
    if (!shape->empty()) shapes.push_back(*std::move(shape));
  }
  return std::monostate();
}

}  // namespace csgrun
