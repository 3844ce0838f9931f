// Random cases: expressions of up to twelve leaves on a grid of a few steps, where everything meets
// everything in planes, edges and vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/support/fuzz/case.h"
#include "tests/support/seeded.h"

namespace csgrun::test {

/// What a case may hold.
struct FuzzKinds {
  bool frames = true;
  bool crossing = true;  ///< leaves that cross themselves, under all fill rules
  bool hulls = true;
};

class FuzzMaker {
 public:
  FuzzMaker(Random& random, FuzzKinds kinds) : random_(random), kinds_(kinds) {}

  FuzzCase make();

 private:
  bool one_in(int64_t n) { return random_.integer(1, n) == 1; }
  IVec3 point();

  void make_frames(FuzzCase& c);

  /// A map with small fractions as entries: mirrors, shears, 90-degree turns, in which much meets
  /// what stands in the world.
  Frame small_frame();

  FuzzLeaf leaf(const FuzzCase& c, int64_t count);

  std::vector<Loop> simple_loops(int64_t count);

  std::vector<Loop> crossing_loops();

  /// Two prisms of triangles that have an edge in common and lie on one side of it.
  std::vector<Loop> touching_wedges();

  /// Nothing when a triangle has no area: a leaf has none.
  static std::vector<Loop> without_slivers(std::vector<Loop> loops);

  FuzzNode node(const FuzzCase& c, int first, int last);

  Random& random_;
  FuzzKinds kinds_;
  int64_t size_ = 5;
  bool centred_ = false;
};

}  // namespace csgrun::test
