// What the elements of an SVG hand down to those in them: fill, stroke, lengths.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "primitives/files/svg_notes.h"
#include "primitives/files/svg_style_sheet.h"
#include "primitives/files/svg_units.h"

namespace csgrun {

/// Whether a property says what is area.
bool is_svg_property(std::string_view property);

struct SvgStyle {
  std::string fill = "black", stroke = "none", fill_rule = "nonzero";
  std::string cap = "butt", join = "miter";
  double stroke_width = 1, mitre_limit = 4;
  std::vector<double> dashes;  ///< dash, gap, dash, gap ... in user units; empty: none
  double dash_offset = 0;
  bool visible = true;
  std::array<bool, 3> markers{};  ///< at the start, in the middle, at the end
  SvgUnits units;

  [[nodiscard]] bool is_filled() const { return fill != "none"; }
  /// A stroke of no width is none.
  [[nodiscard]] bool is_stroked() const { return stroke != "none" && stroke_width > 0; }

  /// Takes over what this element says; what cannot be read is noted, and as if it did not stand
  /// there.
  void read(const pugi::xml_node& node, const SvgElementStyle& own, SvgNotes& notes);
};

}  // namespace csgrun
