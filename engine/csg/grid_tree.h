// Trees whose leaves are on the grid already: these may be moved by whole steps, and nothing of
// them is rounded once more.
#pragma once

#include <csgrun/engine/csg_tree.h>

#include "engine/csg/appearance_table.h"
#include "engine/csg/grid.h"
#include "engine/csg/leaf_store.h"
#include "engine/csg/normal_form.h"

namespace csgrun {

/// The solid of a normal form, with the points of its leaves where the grid has them. Were it moved
/// as it is, the doubles of a leaf would be rounded after the move, some of them otherwise than
/// before. Leaves in frames other than the world's stay as they are: no shift in the world is a
/// whole number of steps of theirs. O(points).
NodePtr tree_on_grid(const NormalForm& form, LeafStore& store, const AppearanceTable& appearances,
                     uint32_t root, const GridStep& step);

/// `map` with its translation rounded to whole steps, along the axes in which `tree` is on the grid
/// when it stands under `map`: rounded as leaves there are, so that what is flush with it and moved
/// with it by whole steps stays so. As it is, if it has no such axes, or is beyond the grid.
Affine by_whole_steps(const Affine& map, const GridStep& step);

}  // namespace csgrun
