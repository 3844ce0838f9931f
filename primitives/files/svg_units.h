// Lengths of SVG and CSS in user units.
#pragma once

#include <optional>
#include <string_view>

#include <glm/vec2.hpp>

namespace csgrun {

constexpr double kMmPerInch = 25.4;

/// For messages: what a length may be.
constexpr const char* kSvgLengthExpected =
    "expected a number, with one of the units px, mm, cm, in, Q, pt, pc, em, rem, ex, %, or none";

struct SvgUnits {
  double per_inch = 96;           ///< a px is a user unit whatever an inch is
  std::optional<double> em = 16;  ///< the size of the font; nothing: not known
  double rem = 16;
  glm::dvec2 viewport{0, 0};  ///< what percentages are of; 0: not known

  /// User units of a length that is this text and nothing else; percentages are of `whole`. Nothing
  /// for what is no length, and for a percentage or an em where what it is of is not known.
  [[nodiscard]] std::optional<double> length(std::string_view text, double whole) const;

  /// What percentages are of that are neither across nor along the page.
  [[nodiscard]] double diagonal() const;

  /// Takes over a `font-size` (in small letters).
  void set_font_size(std::string_view text);
};

}  // namespace csgrun
