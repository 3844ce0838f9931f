// What the nodes of a .csg tree come to while it is built, and the calls that are open.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/primitives/shape2d.h>

#include "primitives/files/csg_parser.h"
#include "primitives/files/csg_sheets.h"
#include "primitives/files/uncut_mesh.h"

namespace csgrun {

/// What a node came to. Something empty may have a dimension all the same, and where 2D and 3D mix
/// the first child that has one decides, as in OpenSCAD. Empty primitives have one, and so has what
/// came out empty of operands that are not (kNothing is what has none). A shape has one colour:
/// that of the first of those that it was made of.
struct Item {
  enum class Kind { kNothing, kFlat, kSolid };
  Kind kind = Kind::kNothing;
  Shape2D shape;                         ///< of a flat one
  std::optional<Appearance> appearance;  ///< of the shape or sheet; faces of solids have their own
  NodePtr solid;                         ///< of a solid one, then not null
  CsgSheet sheet;                        ///< beside the solid, which is then perhaps empty
  UncutPtr uncut;                        ///< of a solid that is one mesh with bent faces, else null

  [[nodiscard]] bool is_empty() const {
    if (kind == Kind::kSolid) return solid->kind() == NodeKind::kEmpty && sheet.empty();
    return kind == Kind::kNothing || shape.empty();
  }

  static Item of(Shape2D shape, const std::optional<Appearance>& appearance = {}) {
    Item item;
    item.kind = Kind::kFlat;
    item.shape = std::move(shape);
    if (!item.shape.empty()) item.appearance = appearance;
    return item;
  }
  static Item of(NodePtr solid) {
    Item item;
    item.kind = Kind::kSolid;
    item.solid = std::move(solid);
    return item;
  }
  /// Empty, but of that kind.
  static Item empty(Kind kind) {
    if (kind == Kind::kFlat) return of(Shape2D());
    return kind == Kind::kSolid ? of(Node::empty()) : Item();
  }
  /// A solid, perhaps an empty one or null, with a sheet of that colour beside it.
  static Item with_sheet(NodePtr solid, CsgSheet sheet, const std::optional<Appearance>& appearance,
                         UncutPtr uncut = nullptr) {
    if (!solid && sheet.empty()) return {};
    Item item = of(solid ? std::move(solid) : Node::empty());
    item.uncut = std::move(uncut);
    if (sheet.empty()) return item;
    item.sheet = std::move(sheet);
    item.appearance = appearance;
    return item;
  }
};

/// The kind of the first child that has one; children of the other kind become nothing, and the
/// notes say so of those that were not empty.
Item::Kind settle_kind(std::vector<Item>& children, std::vector<std::string>& notes);

/// The colour of the first shape among the children of a node. Where they have several that would
/// be seen, the notes say that others are lost.
std::optional<Appearance> colour_of_first(const std::string& node,
                                          const std::vector<Item>& children,
                                          std::vector<std::string>& notes);

/// One child alone, which is empty. (OpenSCAD forgets the dimension of such a shape.)
bool is_one_empty(const std::vector<Item>& children);
/// The children's shapes, empty ones too.
std::vector<Shape2D> take_shapes(std::vector<Item>& children);
/// Their solids that are not empty.
std::vector<NodePtr> take_solids(std::vector<Item>& children);
/// Their sheets together, and the colour of the first.
CsgSheet take_sheets(std::vector<Item>& children, std::optional<Appearance>& colour);

/// Cuts the bent faces of what is no longer handed on as it is.
void settle_cuts(Item& item);
/// What a Boolean hands on uncut, as OpenSCAD does: the mesh of its only child, or of the only one
/// under a union that is not empty. All others are settled.
UncutPtr hand_on_or_settle(BooleanOp op, std::vector<Item>& children);

/// Solids under a Boolean: null where they come to nothing of no dimension, an empty node where to
/// something empty. A first operand that is empty leaves nothing of a difference, and any nothing
/// of an intersection. One alone comes back as it is, also if it is empty, and so does an empty
/// first one of the two.
NodePtr combine_solids(BooleanOp op, std::vector<Item>& children, const SourceRef& where);

/// OpenSCAD's rule for 2D children of a Minkowski sum that are empty: later ones are left out, but
/// for the sum of one shape and nothing else. (Of solids all empty ones are left out.)
bool sum_of_shapes_is_empty(const std::vector<Item>& children);

/// What a node makes of children that enclose nothing: of meshes that are open, and of what a
/// matrix flattens.
enum class OfSheets {
  kNothing,  ///< open ones are errors, flat ones are empty
  kCorners,  ///< their corners count: hull, and what hands on to it
  kFaces,    ///< their faces count: projection without a cut, and what hands on to it
  kParts     ///< flat ones count, as they are: minkowski, and what hands on to it; open ones are
             ///< errors
};

/// Whether open meshes are taken.
inline bool takes_open_ones(OfSheets asked) {
  return asked == OfSheets::kCorners || asked == OfSheets::kFaces;
}

/// A call that is open, and what its children came to so far.
struct CsgFrame {
  CsgCall call;
  std::optional<CsgCall> import;        ///< of an extrusion that names a file, instead of children
  bool background = false;              ///< it, or a node around it, is marked with %
  OfSheets asked = OfSheets::kNothing;  ///< by the node around it
  OfSheets asks = OfSheets::kNothing;   ///< of its children
  std::vector<Item> children;
};

/// What a call asks of its children when the node around it asks for `asked`.
inline OfSheets asked_of_children(const CsgCall& call, OfSheets asked) {
  const std::string& name = call.name;
  if (name == "hull") return OfSheets::kCorners;
  if (name == "minkowski") return OfSheets::kParts;
  if (name == "projection") {
    const CsgValue* cut = call.find("cut");
    return cut != nullptr && cut->boolean ? OfSheets::kNothing : OfSheets::kFaces;
  }
  const bool hands_on = name == "union" || name == "group" || name == "render" ||
                        name == "multmatrix" || name == "color";
  return hands_on ? asked : OfSheets::kNothing;
}

}  // namespace csgrun
