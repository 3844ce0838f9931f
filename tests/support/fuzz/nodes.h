// A case as a tree of the public interface.
#pragma once

#include <vector>

#include <csgrun/engine/csg_tree.h>

#include "tests/support/fuzz/case.h"
#include "tests/support/random_frames.h"

namespace csgrun::test {

/// Rotations with rational entries: their integer matrices are the same by whatever way one comes
/// to them, and so are the leaves below.
const std::vector<Matrix>& rational_turns();

/// Gives some leaves of an unframed case one of the rational turns: the frame is its transpose.
void put_in_turned_frames(Random& random, FuzzCase& c);

NodePtr leaf_node_of(const FuzzCase& c, const FuzzLeaf& l);

/// REQUIRES: frames are those of put_in_turned_frames.
NodePtr node_of(const FuzzCase& c, const FuzzNode& n);
NodePtr node_of(const FuzzCase& c);

}  // namespace csgrun::test
