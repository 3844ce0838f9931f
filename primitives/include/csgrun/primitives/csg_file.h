// OpenSCAD's .csg files: the tree that `openscad model.scad -o model.csg` writes.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/error.h>
#include <csgrun/engine/evaluate.h>
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
  std::optional<Appearance> appearance = {};  ///< of the shape
};

/// What a .csg file may ask for beside its own text.
struct CsgEnvironment {
  FontBook* fonts = nullptr;  ///< null: what is shipped
  /// The bytes of a file that an import or a surface names; null: there are none.
  std::function<Result<std::string>(const std::string& path)> read;
  /// Evaluates what is projected; null: one with default options.
  Evaluator* evaluator = nullptr;
  bool* evaluation_failed = nullptr;  ///< set when an error is one of that, and not of the file
  /// What places of nodes share as the file's name; null: what is made of the name that is given.
  std::shared_ptr<const std::string> file = {};
  Facets facets = {};  ///< where a node has none of its own
};

/// Reads cube, sphere, cylinder, polyhedron, square, circle, polygon, text, import, surface,
/// linear_extrude, rotate_extrude, roof, projection, multmatrix, resize, color, union,
/// difference, intersection, hull, minkowski, offset, fill, group and render, with the modifiers
/// % (left out, not even an operand) and # (nothing). As in OpenSCAD, an empty node is an
/// operand, and primitives of impossible size are empty; each is said in a warning. Where 2D and
/// 3D mix the first child that has a dimension decides, be it empty. Meshes that are open or flat
/// have points for a hull and faces for a projection without a cut; flat ones are operands of a
/// Minkowski sum like any other. A shape has one colour, that of the first of the shapes it is made
/// of, and an extrusion has that of its shape. Arguments are matched by name, or by OpenSCAD's
/// order; unknown ones are left out with a warning. An extrusion may name a file instead of
/// children, as OpenSCAD 2021.01 writes it. A $fn above 100000 is a kLimit error of any
/// node that reads it.
///
/// Errors have `where` set to the line and a message without it: kMalformedFile for what is not a
/// .csg file, kInvalidMesh for polyhedra that are not closed, and those of the evaluation of what
/// is projected. Depth is limited by memory only.
Result<CsgModel> parse_csg(const std::string& name, std::string_view text,
                           const CsgEnvironment& environment = {});

/// Reads a regular file and parses it.
Result<CsgModel> read_csg_file(const std::string& path, const CsgEnvironment& environment = {});

}  // namespace csgrun
