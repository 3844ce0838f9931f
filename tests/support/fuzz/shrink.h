// Makes a failing case small: drops nodes, frames, moves and faces, and pulls coordinates together,
// greedily, as long as it still fails.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "tests/support/fuzz/case.h"

namespace csgrun::test {

/// Whether a leaf is one that the kernel takes: planar convex faces with area, balanced edges, and
/// no crossings unless it may have some.
bool is_valid(const FuzzLeaf& leaf);

class Shrinker {
 public:
  using Fails = std::function<bool(const FuzzCase&)>;

  /// `fails` is asked at most `budget` times.
  Shrinker(FuzzCase given, Fails fails, int budget = 4000)
      : best_(std::move(given)), fails_(std::move(fails)), budget_(budget) {}

  FuzzCase run();

 private:
  /// Takes a case if it fails as well.
  bool take(FuzzCase c);

  /// Leaves in the order of their mention, and only those; frames that somebody has.
  static void drop_unused(FuzzCase& c);

  bool simplify_options();

  /// All nodes that are not leaves, by the way to them from the root.
  static void inner_nodes(FuzzNode& n, std::vector<FuzzNode*>& out);

  bool shrink_tree();

  bool simplify_leaves();

  static std::vector<Loop> enclosing_box(const std::vector<Loop>& faces);

  /// Faces that hang together in corners.
  static std::vector<std::vector<Loop>> parts(const std::vector<Loop>& faces);

  static std::vector<Loop> merged(const std::vector<Loop>& faces, const IVec3& from,
                                  const IVec3& to);

  /// All coordinates beyond some value along an axis come one step nearer.
  bool pull_together();

  FuzzCase best_;
  Fails fails_;
  int budget_;
};

}  // namespace csgrun::test
