// Solids under a table of heights: OpenSCAD's surface().
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/primitives/solids.h>

namespace csgrun {

struct HeightMap {
  size_t columns = 0, rows = 0;
  std::vector<double> heights;       ///< mm, row by row; the first row is at y = 0
  std::optional<double> floor = {};  ///< z of the bottom; 1 mm below the least height if not given
};

/// Whether these bytes are a picture, or seem to be one: else they are a text.
bool is_png(std::string_view bytes);

/// A text of numbers, one row a line, `#` before comments; short rows are filled with 0. Its floor
/// is as OpenSCAD has it: 1 mm below the least number, but not above 0, whatever was filled in. Or
/// a PNG: heights are 100/255 of the luminance of its 8 bits, 0.2126 red + 0.7152 green + 0.0722
/// blue, the lowest row of the picture is the first; with `invert` 100/255 of 1 less the luminance,
/// as OpenSCAD has it. What it is the bytes say, not the name, which begins messages.
///
/// Errors: kMalformedFile with the line, or what is wrong with the picture; kLimit above 2^21
/// points. A picture is decoded row by row, whatever its file promises.
Result<HeightMap> parse_height_map(const std::string& name, std::string_view bytes, bool invert);

/// Columns are 1 mm apart along X, rows along Y. Each square of four points is four triangles
/// around its mean; the bottom is flat. `center` puts the middle of
/// the table on the Z axis. Errors: kInvalidArgument for fewer than two rows or columns, and for
/// heights that are not finite.
MeshResult make_surface(const HeightMap& map, bool center);

}  // namespace csgrun
