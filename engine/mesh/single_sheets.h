// Where a surface is a single sheet over a plane: its faces meet nothing there.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

/// The faces of a closed surface that may meet others in more than corners and edges that both
/// have, in order: no face that is left out does. Nothing if the leaf has no use for the method,
/// which wants many faces of about the same size.
///
/// Space is divided into cubes, two to four times as wide as a face. A *column* is a run of cubes
/// along an axis that boxes of faces reach, between two that none does. Say that all faces whose
/// boxes reach into it face up, or all down. A line along the column then crosses the surface
/// always in the same sense, and as often as the winding numbers of its ends differ; these stand in
/// empty cubes, so lines all over the column cross it equally often. If that is once, the surface
/// is the graph of a function there. Two faces that met would be crossed twice by lines beside the
/// place: the surface goes on around each of them, as it is closed, and faces the same way.
/// (Faces around a common edge or vertex may have that in common, and nothing else, since they are
/// parts of one sheet.) So faces that meet do so in a cube that is in no such column, and both are
/// named.
///
/// REQUIRES: planar convex faces over distinct vertices, none degenerate; every directed edge as
/// often as its reverse. Exact. O(n), on as many threads as the calling arena has, with the same
/// result for any number.
std::optional<std::vector<uint32_t>> faces_off_single_sheets(const LeafGeometry& leaf);

}  // namespace csgrun
