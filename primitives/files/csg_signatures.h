// The names of the arguments of .csg nodes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <csgrun/primitives/solids.h>

#include "primitives/files/csg_parser.h"

namespace csgrun {

/// Gives the arguments of a call their names, as OpenSCAD does: what stands without a name takes
/// those of the node in order, but for those that were given by name before; other spellings get
/// the one that is read. Of a name that comes twice the last counts. `warnings` gets what is left
/// out: unknown names, and more values than names. $-variables are always known; so is what
/// OpenSCAD writes and nothing needs here (convexity, timestamp). Nodes that are not known stay as
/// they are.
void name_arguments(CsgCall& call, std::vector<std::string>& warnings);

/// The import that stands in an extrusion's arguments, of which it is taken out: OpenSCAD 2021.01
/// writes `linear_extrude(file = "a.dxf", ...)`, which is made of the drawing and of no children.
/// Its scale is the drawing's, and of a linear one the top's as well.
std::optional<CsgCall> take_import(CsgCall& extrusion);

/// Gives a call the $fn, $fa and $fs that differ from OpenSCAD's own, where it has none.
void add_facets(CsgCall& call, const Facets& facets);

/// Gives $fa and $fs of a call the least value that OpenSCAD takes for what is below it, which is
/// 0.01, and `warnings` says so.
void clamp_facets(CsgCall& call, std::vector<std::string>& warnings);

/// Whether a node is made of its children, if it is known at all.
bool takes_children(std::string_view node);

}  // namespace csgrun
