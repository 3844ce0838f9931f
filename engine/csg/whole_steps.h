// Moves by whole steps of the grid: what is on it stays on it.
#pragma once

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/evaluate.h>

namespace csgrun {

/// `map` with its translation rounded to whole steps, along the axes in which leaves under it are
/// on the grid, and as they are rounded there. As it is, if it has no such axes (it is nearly
/// singular), or leads beyond the grid.
Affine by_whole_steps(const Affine& map, const GridStep& step);

}  // namespace csgrun
