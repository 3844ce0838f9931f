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

namespace csgrun {

/// What a node came to. Empty ones have no dimension. A shape has one colour: that of the first of
/// those that it was made of.
struct Item {
  enum class Kind { kEmpty, kFlat, kSolid };
  Kind kind = Kind::kEmpty;
  Shape2D shape;
  std::optional<Appearance> appearance;  ///< of the shape or sheet; faces of solids have their own
  NodePtr solid;
  CsgSheet sheet;  ///< beside the solid, which is then perhaps empty

  static Item of(Shape2D shape, const std::optional<Appearance>& appearance = {}) {
    Item item;
    if (shape.empty()) return item;
    item.kind = Kind::kFlat;
    item.shape = std::move(shape);
    item.appearance = appearance;
    return item;
  }
  static Item of(NodePtr solid) {
    Item item;
    if (solid->kind() == NodeKind::kEmpty) return item;
    item.kind = Kind::kSolid;
    item.solid = std::move(solid);
    return item;
  }
  /// A solid, or nothing, with a sheet of that colour beside it.
  static Item with_sheet(Item item, CsgSheet sheet, const std::optional<Appearance>& appearance) {
    if (sheet.empty()) return item;
    if (item.kind == Kind::kEmpty) item.solid = Node::empty();
    item.kind = Kind::kSolid;
    item.sheet = std::move(sheet);
    item.appearance = appearance;
    return item;
  }
};

/// What a node makes of children that enclose nothing: of meshes that are open, and of what a
/// matrix flattens.
enum class OfSheets {
  kNothing,  ///< open ones are errors, flat ones are empty
  kCorners,  ///< their corners count: hull, and what hands on to it
  kFaces     ///< their faces count: projection without a cut, and what hands on to it
};

/// A call that is open, and what its children came to so far.
struct CsgFrame {
  CsgCall call;
  bool background = false;              ///< it, or a node around it, is marked with %
  OfSheets asked = OfSheets::kNothing;  ///< by the node around it
  OfSheets asks = OfSheets::kNothing;   ///< of its children
  std::vector<Item> children;
};

/// What a call asks of its children when the node around it asks for `asked`.
inline OfSheets asked_of_children(const CsgCall& call, OfSheets asked) {
  const std::string& name = call.name;
  if (name == "hull") return OfSheets::kCorners;
  if (name == "projection") {
    const CsgValue* cut = call.find("cut");
    return cut != nullptr && cut->boolean ? OfSheets::kNothing : OfSheets::kFaces;
  }
  const bool hands_on = name == "union" || name == "group" || name == "render" ||
                        name == "multmatrix" || name == "color";
  return hands_on ? asked : OfSheets::kNothing;
}

}  // namespace csgrun
