#include "primitives/files/svg_units.h"

#include <cmath>
#include <string>
#include <utility>

#include "primitives/files/svg_css.h"
#include "primitives/files/svg_path.h"

namespace csgrun {

std::optional<double> SvgUnits::length(std::string_view text, double whole) const {
  const auto length = parse_svg_length(text);
  if (!length) return std::nullopt;
  const double n = length->number;
  const std::string unit = css_lower(length->unit);
  if (unit.empty() || unit == "px") return n;
  if (unit == "%") return whole > 0 ? std::optional(n / 100 * whole) : std::nullopt;
  if (unit == "rem") return n * rem;
  if (unit == "em" || unit == "ex") {
    // Half of the size of the font, as CSS has it where nothing is known of the font.
    if (em) return n * (unit == "ex" ? *em / 2 : *em);
    return std::nullopt;
  }
  constexpr std::pair<const char*, double> kUnitsOfInch[] = {
      {"in", 1}, {"mm", 25.4}, {"cm", 2.54}, {"q", 101.6}, {"pt", 72}, {"pc", 6}};
  for (const auto& [name, per] : kUnitsOfInch) {
    if (unit == name) return n / per * per_inch;
  }
  return std::nullopt;
}

double SvgUnits::diagonal() const {
  return std::sqrt((viewport.x * viewport.x + viewport.y * viewport.y) / 2);
}

void SvgUnits::set_font_size(std::string_view text) {
  constexpr std::pair<const char*, double> kWords[] = {
      {"initial", 16}, {"medium", 16},  {"small", 13},    {"large", 18},    {"x-small", 10},
      {"x-large", 24}, {"xx-small", 9}, {"xx-large", 32}, {"xxx-large", 48}};
  for (const auto& [word, size] : kWords) {
    if (text == word) {
      em = size;
      return;
    }
  }
  em = text == "larger" && em    ? std::optional(*em * 1.2)
       : text == "smaller" && em ? std::optional(*em / 1.2)
                                 : length(text, em.value_or(0));
}

}  // namespace csgrun
