// 2D shapes from files: SVG and DXF.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

#include <csgrun/engine/error.h>
#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/solids.h>

namespace csgrun {

struct FlatFileOptions {
  std::optional<std::string> layer;  ///< only this layer
  std::optional<std::string> id;     ///< SVG: only the element of that id, and what is in it
  double dpi = 72;      ///< SVG: user units an inch, where a viewBox has a size without a unit
  glm::dvec2 origin{};  ///< DXF: this point of the drawing becomes (0, 0)
  double scale = 1;     ///< DXF
  bool center = false;  ///< the middle of the bounding box becomes (0, 0)
  Facets facets;        ///< of arcs and curves
  bool parts = false;   ///< fills FlatFile::parts, and not its shape; not with a layer or an id
  /// As an OpenSCAD tree means it: an SVG is drawn by OpenSCAD's rules, and a layer or id that is
  /// not there is an empty shape with a note.
  bool as_openscad = false;
};

/// What has a name in a drawing: in an SVG an element of the outermost level (its title, else the
/// label that Inkscape gives it, else its id), in a DXF a layer.
struct FlatFilePart {
  std::string name;  ///< may be empty
  Shape2D shape;     ///< not empty
};

struct FlatFile {
  Shape2D shape;
  std::vector<FlatFilePart> parts;  ///< each name once, in the order of the file
  std::vector<std::string> notes;   ///< what was left out, counted
};

/// An SVG in mm, its page's lower left corner in the origin: paths, basic shapes, groups, use,
/// switch, transforms (of CSS, too), viewBox, sizes in units. What is filled or closed is area by
/// its fill rule; open lines that are only stroked give the area of their stroke, in dashes where
/// they have them. What is not read, or cannot be, is noted with its line. A DXF as drawn: LINE,
/// LWPOLYLINE and POLYLINE with bulges, CIRCLE, ARC, ELLIPSE, SPLINE, INSERT; ends that round to
/// the same 1/1024 are joined, and the loops filled by the even-odd rule; what stays open is closed
/// by a straight line. What is invisible, in paper space or a mesh is left out. A DXF that is cut
/// off or has values that are no numbers is an error, unless it is read as OpenSCAD does.
///
/// Errors: kMalformedFile with line or byte, kLimit for files that unfold to too much (nested
/// references, millions of points), kInvalidArgument for a layer or id that is not in the file.
/// Files are never followed to other files; XML entities are refused.
Result<FlatFile> parse_flat(const std::string& name, std::string_view bytes,
                            const FlatFileOptions& options);

/// "svg", "dxf" or empty: the lower-case ending of a path when it is readable here.
std::string flat_file_format_of(const std::string& path);

}  // namespace csgrun
