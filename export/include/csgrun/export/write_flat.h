// Writing 2D shapes: SVG and DXF, in millimetres.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include <csgrun/engine/error.h>

namespace csgrun {

/// One named part of a drawing: outlines free of crossings, holes among them in any order.
struct FlatPart {
  std::string name;
  std::vector<std::vector<glm::dvec2>> loops;
  std::optional<std::array<float, 4>> color;  ///< red, green, blue, alpha from 0 to 1
};

/// "svg", "dxf" or empty when the ending of `path` is none of these.
std::string flat_format_of(const std::string& path);

/// The bytes of a drawing. Coordinates are written so that they read back as the same doubles; in
/// an SVG Y points down, so their sign is changed, and the page is the bounding box. A part is one
/// path of an SVG (filled by the even-odd rule), and the closed polylines of a layer of a DXF.
/// Errors: kInvalidArgument for another format.
Result<std::string> encode_flat(const std::string& format, const std::vector<FlatPart>& parts);

}  // namespace csgrun
