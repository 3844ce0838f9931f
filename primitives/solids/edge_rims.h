// Rims of holes: chosen edges all around a convex opening of a side.
#pragma once

#include <cstdint>
#include <vector>

#include "primitives/solids/edge_frames.h"

namespace csgrun {

/// The chosen edges that go all the way around an opening, as numbers of frames, each in one list
/// at most: their common side turns inwards at each corner, where three edges meet, on their other
/// sides no cut follows, and all walls are equally steep. O(frames).
std::vector<std::vector<uint32_t>> hole_rims(const EdgeFrames& frames);

}  // namespace csgrun
