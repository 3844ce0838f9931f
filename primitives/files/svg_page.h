// The page of an SVG in mm, and viewports.
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <pugixml.hpp>

#include <csgrun/engine/error.h>

#include "primitives/files/svg_notes.h"
#include "primitives/files/svg_path.h"
#include "primitives/files/svg_style_sheet.h"
#include "primitives/files/svg_units.h"

namespace csgrun {

/// A viewBox; empty when there is none. Errors: kMalformedFile.
Result<std::vector<double>> svg_view_box(const std::string& name, const pugi::xml_node& node,
                                         const SvgNotes& notes);

/// From a viewBox to a viewport at the origin, as preserveAspectRatio has it.
SvgMap svg_fitted(const pugi::xml_node& node, const std::vector<double>& box,
                  const glm::dvec2& size);

struct SvgPage {
  SvgMap map;  ///< from user units to mm, with Y upwards
  SvgUnits units;
};

/// Of the root. Its size is that of its attributes: what CSS says of it is noted. Errors:
/// kMalformedFile.
Result<SvgPage> svg_page(const std::string& name, const pugi::xml_node& root,
                         const SvgElementStyle& own, double dpi, SvgNotes& notes);

}  // namespace csgrun
