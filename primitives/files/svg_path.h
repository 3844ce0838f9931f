// The data of SVG: path commands, numbers, transforms, lengths.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

#include <csgrun/primitives/solids.h>

#include "primitives/files/flat_curves.h"

namespace csgrun {

/// x' = a x + c y + e, y' = b x + d y + f, as SVG's matrix(a b c d e f).
struct SvgMap {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;
  [[nodiscard]] glm::dvec2 apply(const glm::dvec2& p) const {
    return {a * p.x + c * p.y + e, b * p.x + d * p.y + f};
  }
  /// First `inner`, then this.
  [[nodiscard]] SvgMap after(const SvgMap& inner) const;
  /// How much it enlarges lengths, on average.
  [[nodiscard]] double scale() const;
  /// The largest and the smallest factor of a length, in any direction.
  [[nodiscard]] double largest_scale() const;
  [[nodiscard]] double smallest_scale() const;
  /// Whether it leaves nothing of areas, but for rounding.
  [[nodiscard]] bool is_flat() const;
  /// Whether it enlarges all directions alike, but for rounding.
  [[nodiscard]] bool is_similarity() const;
};

/// Nothing when the text is no list of transforms.
std::optional<SvgMap> parse_svg_transform(std::string_view text);

/// Numbers separated by blanks and commas; nothing when there is anything else.
std::optional<std::vector<double>> parse_svg_numbers(std::string_view text);

/// The points of a <polygon>. As SVG wants, what stands before a mistake is taken; `mistake` then
/// is where it begins, and else the end of the text.
std::vector<glm::dvec2> parse_svg_points(std::string_view text, size_t& mistake);

/// A number with a unit ("mm", "%", "" ...).
struct SvgLength {
  double number = 0;
  std::string_view unit;
};
std::optional<SvgLength> parse_svg_length(std::string_view text);

/// The subpaths of path data, with curves in steps. As SVG wants, what stands before a mistake is
/// drawn; `good` then is false, and the segment with the mistake begins at `mistake`.
std::vector<Chain> parse_svg_path(std::string_view data, const SvgSteps& steps, bool& good,
                                  size_t* mistake = nullptr);

}  // namespace csgrun
