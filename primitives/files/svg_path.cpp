#include "primitives/files/svg_path.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include <glm/geometric.hpp>

#include <csgrun/primitives/trig.h>

#include "primitives/files/text_scanner.h"

namespace csgrun {
namespace {

/// Reads numbers where "1-2", "1.5.5" and flags without blanks between are each several.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }
  void skip_separators() {
    while (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == ',')) ++at_;
  }
  [[nodiscard]] size_t at() const { return at_; }
  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  [[nodiscard]] char peek() const { return at_end() ? '\0' : text_[at_]; }
  char take() { return text_[at_++]; }

  std::optional<double> number() {
    skip_separators();
    size_t begin = at_;
    if (peek() == '+') begin = ++at_;
    double value = 0;
    const char* const first = text_.data() + begin;
    const bool starts =
        at_ < text_.size() && (peek() == '-' || peek() == '.' || (peek() >= '0' && peek() <= '9'));
    if (!starts) return std::nullopt;
    const auto [rest, error] = std::from_chars(first, text_.data() + text_.size(), value);
    if (rest == first || !std::isfinite(value)) return std::nullopt;
    if (error != std::errc() && !is_too_small({first, static_cast<size_t>(rest - first)})) {
      return std::nullopt;
    }
    at_ = begin + static_cast<size_t>(rest - first);
    return value;
  }

  std::optional<bool> flag() {
    skip_separators();
    if (peek() != '0' && peek() != '1') return std::nullopt;
    return take() == '1';
  }

  std::string_view word() {
    const size_t begin = at_;
    while (at_ < text_.size() &&
           ((peek() >= 'a' && peek() <= 'z') || (peek() >= 'A' && peek() <= 'Z') || peek() == '%'))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }

 private:
  static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
  }
  std::string_view text_;
  size_t at_ = 0;
};

double length_of(const glm::dvec2& v) { return std::sqrt(glm::dot(v, v)); }

class PathReader {
 public:
  PathReader(std::string_view data, const SvgSteps& steps) : scan_(data), steps_(steps) {}

  std::vector<Chain> chains;
  size_t segment_begin = 0;  ///< of the last one

  bool read() {
    char command = '\0';
    for (;;) {
      scan_.skip_separators();
      if (scan_.at_end()) return true;
      segment_begin = scan_.at();
      const char c = scan_.peek();
      const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
      if (letter) {
        command = scan_.take();
        if (chains.empty() && command != 'M' && command != 'm') return false;
      } else if (command == '\0' || command == 'z' || command == 'Z') {
        return false;
      }
      if (!segment(command)) return false;
      if (total_ > kMostDrawingPoints) return false;
      if (command == 'M') command = 'L';
      if (command == 'm') command = 'l';
    }
  }

 private:
  std::optional<glm::dvec2> point(bool relative) {
    const auto x = scan_.number();
    const auto y = x ? scan_.number() : std::nullopt;
    if (!y) return std::nullopt;
    return glm::dvec2(*x, *y) + (relative ? at_ : glm::dvec2(0));
  }

  /// The chain that a segment goes on with: after a closed one a new one begins in its start.
  std::vector<glm::dvec2>& current() {
    if (chains.back().closed) chains.push_back({{start_}, false});
    return chains.back().points;
  }

  bool segment(char command) {
    const bool relative = command >= 'a';
    const char kind = static_cast<char>(relative ? command - 'a' + 'A' : command);
    glm::dvec2 handle = at_;  // for S and T: the mirrored control point of the next one
    bool good = true;
    switch (kind) {
      case 'Z':
        chains.back().closed = true;
        at_ = start_;
        break;
      case 'M': {
        const auto p = point(relative);
        if (!p) return false;
        at_ = start_ = handle = *p;
        chains.push_back({{at_}, false});
        break;
      }
      case 'L':
      case 'H':
      case 'V': {
        std::optional<glm::dvec2> p;
        if (kind == 'L') {
          p = point(relative);
        } else if (const auto x = scan_.number()) {
          p = at_;
          double& moved = kind == 'H' ? p->x : p->y;
          moved = *x + (relative ? moved : 0);
        }
        if (!p) return false;
        current().push_back(*p);
        ++total_;
        at_ = handle = *p;
        break;
      }
      case 'C':
      case 'S':
      case 'Q':
      case 'T':
        good = curve(kind, relative, handle);
        break;
      case 'A':
        good = arc(relative);
        handle = at_;
        break;
      default:
        return false;
    }
    const bool cubic = kind == 'C' || kind == 'S', quadratic = kind == 'Q' || kind == 'T';
    cubic_handle_ = cubic ? handle : at_;
    quadratic_handle_ = quadratic ? handle : at_;
    return good;
  }

  bool curve(char kind, bool relative, glm::dvec2& handle) {
    std::vector<glm::dvec2> control{at_};
    if (kind == 'S') control.push_back(cubic_handle_);
    if (kind == 'T') control.push_back(quadratic_handle_);
    const size_t count = kind == 'C' || kind == 'S' ? 4 : 3;
    while (control.size() < count) {
      const auto p = point(relative);
      if (!p) return false;
      control.push_back(*p);
    }
    double length = 0;
    for (size_t i = 1; i < control.size(); ++i) length += length_of(control[i] - control[i - 1]);
    const int steps = steps_.of_bezier(length);
    append_bezier(control, steps, current());
    total_ += static_cast<size_t>(steps);
    at_ = control.back();
    handle = 2.0 * at_ - control[control.size() - 2];
    return true;
  }

  /// From the ends to the centre, as in the appendix of SVG's specification (B.2.4).
  bool arc(bool relative) {
    const auto rx = scan_.number(), ry = rx ? scan_.number() : std::nullopt;
    const auto turn = ry ? scan_.number() : std::nullopt;
    const auto large = turn ? scan_.flag() : std::nullopt;
    const auto sweep = large ? scan_.flag() : std::nullopt;
    const auto end = sweep ? point(relative) : std::nullopt;
    if (!end) return false;
    const glm::dvec2 from = at_;
    at_ = *end;
    if (from == *end) return true;
    double a = std::fabs(*rx), b = std::fabs(*ry);
    if (a == 0 || b == 0) {
      current().push_back(*end);
      ++total_;
      return true;
    }
    const double c = cos_deg(*turn), s = sin_deg(*turn);
    const glm::dvec2 half = (from - *end) * 0.5;
    const glm::dvec2 p(c * half.x + s * half.y, -s * half.x + c * half.y);
    const double over = p.x * p.x / (a * a) + p.y * p.y / (b * b);
    if (over > 1) {
      a *= std::sqrt(over);
      b *= std::sqrt(over);
    }
    const double rest = std::max(1 / std::min(over, 1.0) - 1, 0.0);
    const double factor = (*large == *sweep ? -1 : 1) * std::sqrt(rest);
    const glm::dvec2 q(factor * a * p.y / b, -factor * b * p.x / a);
    const glm::dvec2 center =
        glm::dvec2(c * q.x - s * q.y, s * q.x + c * q.y) + (from + *end) * 0.5;
    const double first = atan2_deg((p.y - q.y) / b, (p.x - q.x) / a);
    double angle = atan2_deg((-p.y - q.y) / b, (-p.x - q.x) / a) - first;
    if (*sweep && angle <= 0) angle += 360;
    if (!*sweep && angle >= 0) angle -= 360;
    const int steps = steps_.of_arc(std::max(a, b), angle);
    std::vector<glm::dvec2> points;
    append_ellipse(center, {c * a, s * a}, {-s * b, c * b}, first, angle, steps, points);
    std::vector<glm::dvec2>& chain = current();
    for (size_t i = 1; i + 1 < points.size(); ++i) chain.push_back(points[i]);
    chain.push_back(*end);
    total_ += points.size();
    return true;
  }

  Scanner scan_;
  const SvgSteps& steps_;
  glm::dvec2 at_{}, start_{}, cubic_handle_{}, quadratic_handle_{};
  size_t total_ = 0;
};

}  // namespace

SvgMap SvgMap::after(const SvgMap& inner) const {
  SvgMap r;
  r.a = a * inner.a + c * inner.b;
  r.b = b * inner.a + d * inner.b;
  r.c = a * inner.c + c * inner.d;
  r.d = b * inner.c + d * inner.d;
  r.e = a * inner.e + c * inner.f + e;
  r.f = b * inner.e + d * inner.f + f;
  return r;
}

double SvgMap::scale() const { return std::sqrt(std::fabs(a * d - b * c)); }

double SvgMap::largest_scale() const {
  const double sum = a * a + b * b + c * c + d * d, det = a * d - b * c;
  return std::sqrt((sum + std::sqrt(std::max(sum * sum - 4 * det * det, 0.0))) / 2);
}

double SvgMap::smallest_scale() const {
  const double largest = largest_scale();
  return largest > 0 ? std::fabs(a * d - b * c) / largest : 0;
}

bool SvgMap::is_flat() const { return !(smallest_scale() > 1e-12 * largest_scale()); }

bool SvgMap::is_similarity() const {
  const double noise = 1e-12 * largest_scale();
  const auto same = [&](double p, double q) { return std::fabs(p - q) <= noise; };
  return (same(a, d) && same(b, -c)) || (same(a, -d) && same(b, c));
}

std::optional<SvgMap> parse_svg_transform(std::string_view text) {
  SvgMap map;
  Scanner scan(text);
  for (;;) {
    scan.skip_separators();
    if (scan.at_end()) return map;
    const std::string_view name = scan.word();
    scan.skip_blanks();
    if (scan.peek() != '(') return std::nullopt;
    scan.take();
    std::vector<double> v;
    while (const auto number = scan.number()) {
      v.push_back(*number);
      if (v.size() > 6) return std::nullopt;
    }
    scan.skip_blanks();
    if (scan.peek() != ')') return std::nullopt;
    scan.take();
    SvgMap next;
    const size_t n = v.size();
    if (name == "matrix" && n == 6) {
      next = {v[0], v[1], v[2], v[3], v[4], v[5]};
    } else if (name == "translate" && (n == 1 || n == 2)) {
      next.e = v[0];
      next.f = n == 2 ? v[1] : 0;
    } else if (name == "scale" && (n == 1 || n == 2)) {
      next.a = v[0];
      next.d = v[n - 1];
    } else if (name == "rotate" && (n == 1 || n == 3)) {
      const double c = cos_deg(v[0]), s = sin_deg(v[0]);
      const glm::dvec2 p = n == 3 ? glm::dvec2(v[1], v[2]) : glm::dvec2(0);
      next = {c, s, -s, c, p.x - c * p.x + s * p.y, p.y - s * p.x - c * p.y};
    } else if (name == "skewX" && n == 1) {
      next.c = tan_deg(v[0]);
    } else if (name == "skewY" && n == 1) {
      next.b = tan_deg(v[0]);
    } else {
      return std::nullopt;
    }
    map = map.after(next);
  }
}

std::optional<std::vector<double>> parse_svg_numbers(std::string_view text) {
  std::vector<double> numbers;
  Scanner scan(text);
  for (;;) {
    scan.skip_separators();
    if (scan.at_end()) return numbers;
    const auto number = scan.number();
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
}

std::vector<glm::dvec2> parse_svg_points(std::string_view text, size_t& mistake) {
  std::vector<glm::dvec2> points;
  Scanner scan(text);
  for (;;) {
    scan.skip_separators();
    mistake = scan.at();
    if (scan.at_end()) return points;
    const auto x = scan.number();
    const auto y = x ? scan.number() : std::nullopt;
    if (!y) return points;
    points.emplace_back(*x, *y);
  }
}

std::optional<SvgLength> parse_svg_length(std::string_view text) {
  Scanner scan(text);
  SvgLength length;
  const auto number = scan.number();
  if (!number) return std::nullopt;
  length.number = *number;
  length.unit = scan.word();
  scan.skip_blanks();
  if (!scan.at_end()) return std::nullopt;
  return length;
}

std::vector<Chain> parse_svg_path(std::string_view data, const SvgSteps& steps, bool& good,
                                  size_t* mistake) {
  PathReader reader(data, steps);
  good = reader.read();
  if (mistake != nullptr) *mistake = reader.segment_begin;
  return std::move(reader.chains);
}

}  // namespace csgrun
