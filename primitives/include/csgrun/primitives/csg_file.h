// OpenSCAD's .csg files: the tree that `openscad model.scad -o model.csg` writes.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/error.h>
#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/text.h>

namespace csgrun {

/// What a .csg file describes: a solid, or (when all its nodes are flat) a 2D shape. The top level
/// is an implicit union, as in OpenSCAD.
struct CsgModel {
  NodePtr solid;  ///< never null; an empty node when is_2d, or when nothing is left
  Shape2D shape;  ///< used when is_2d
  bool is_2d = false;
  /// "model.csg:12: cube: size.x must be positive, got 0": what was left out, in the file's order.
  std::vector<std::string> warnings;
};

/// What a .csg file may ask for beside its own text.
struct CsgEnvironment {
  FontBook* fonts = nullptr;  ///< null: what is shipped
  /// The bytes of a file that an import names; null: there are none.
  std::function<Result<std::string>(const std::string& path)> read;
};

/// Reads cube, sphere, cylinder, polyhedron, square, circle, polygon, text, import, linear_extrude,
/// rotate_extrude, multmatrix, color, union, difference, intersection, group and render, and with
/// 2D children offset, hull, minkowski, fill and resize, with the modifiers % (left out, not even
/// an operand) and # (nothing). As in OpenSCAD, an empty node is an operand, primitives of
/// impossible size are empty, and where 2D and 3D mix the first child that is not empty decides;
/// each is said in a warning. Unknown arguments are passed over; arguments are matched by name.
///
/// Errors have `where` set to the line and a message without it: kMalformedFile for what is not a
/// .csg file, kInvalidArgument for nodes that csgrun does not build (surface, projection ...;
/// without children they are empty, and no error), kInvalidMesh for polyhedra that are not closed.
/// Depth is limited by memory only.
Result<CsgModel> parse_csg(const std::string& name, std::string_view text,
                           const CsgEnvironment& environment = {});

/// Reads a regular file and parses it.
Result<CsgModel> read_csg_file(const std::string& path);

}  // namespace csgrun
