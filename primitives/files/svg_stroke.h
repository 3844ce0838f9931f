// The area of an open line that an SVG strokes.
#pragma once

#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/shape_operations.h>

#include "primitives/files/svg_path.h"

namespace csgrun {

struct SvgPen {
  StrokeOptions stroke;        ///< its width in user units
  std::vector<double> dashes;  ///< dash, gap, dash, gap ... in user units; empty: none
  double dash_offset = 0;      ///< where in the dashes the line begins
  /// With vector-effect="non-scaling-stroke" the mm of a unit of the pen, whatever the map says;
  /// else 0.
  double fixed_unit = 0;
};

/// Appends the area, in mm, of a pen that is moved along the line in user units: the map makes an
/// ellipse of its round tip where it is no similarity, and leaves nothing where it is flat. Dashes
/// have the caps of lines; those of no length, and lines of none, are dots if caps are round or
/// square. `points` counts those that were made. Errors: kOutOfRange, kLimit for more points than a
/// drawing may have.
Status stroke_svg_line(const Shape2D::Loop& line, const SvgMap& map, const SvgPen& pen,
                       std::vector<Shape2D>& shapes, size_t& points);

}  // namespace csgrun
