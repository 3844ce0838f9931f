// Where an element of an SVG stands: its transform, as an attribute or as properties of CSS.
#pragma once

#include <pugixml.hpp>

#include <csgrun/engine/error.h>

#include "primitives/files/svg_notes.h"
#include "primitives/files/svg_path.h"
#include "primitives/files/svg_style_sheet.h"
#include "primitives/files/svg_units.h"

namespace csgrun {

/// From the coordinates in an element to those around it: `transform` (CSS over the attribute),
/// `translate`, `rotate` and `scale`, about the `transform-origin`. Properties that are not known
/// are noted. Errors: kMalformedFile for an attribute that is no transform.
Result<SvgMap> svg_transform_of(const std::string& name, const pugi::xml_node& node,
                                const SvgElementStyle& own, const SvgUnits& units, SvgNotes& notes);

}  // namespace csgrun
