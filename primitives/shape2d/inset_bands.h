// Extrusions whose ends are rounded further than their outline keeps its form.
//
// The straight skeleton's roof over the outline is as high everywhere as the edges have to move
// inwards to be there. Its faces, cut at the insets of an end's layers, are the bands of that end:
// only their heights change.
#pragma once

#include <vector>

#include <csgrun/primitives/shape2d.h>

namespace csgrun {

/// An end of an extrusion, from the outline inwards: how high it is where the edges have moved by
/// `inset`; between layers, linearly; beyond the last, as high as there. The first inset is 0,
/// others are greater than those before.
struct InsetLayer {
  double inset, z;  ///< mm
};
using InsetEnd = std::vector<InsetLayer>;

/// REQUIRES: a shape that is not empty, top[0].z >= bottom[0].z. Errors: kInvalidArgument, with the
/// inset that would do, when a piece of the shape has no place as far inwards as the last layer of
/// an end; kLimit and kInternal as make_roof. O(n^2 + n x layers).
MeshResult extrude_inset_bands(const Shape2D& shape, const InsetEnd& bottom, const InsetEnd& top);

}  // namespace csgrun
