// Random Boolean expressions over random small leaves, for tests of the kernel. Vertices come from
// few values, so that touching, coplanar and equal faces are the normal case.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "engine/bsp/operand.h"
#include "tests/support/seeded.h"

namespace csgrun::test {

/// What the leaves and expressions look like.
struct TreeShape {
  int64_t size = 5;  ///< vertices have coordinates k * unit, 0 <= k <= size
  int64_t unit = 1;
  int operands = 3;
  int depth = 2;
  bool frames = false;  ///< some operands are turned, mirrored or sheared
  bool known = false;   ///< leaves say which edges are opposite, and whether they are convex
};

struct RandomTree {
  std::vector<Operand> operands;
  Expression expression;
  GridBox region;
};

class TreeMaker {
 public:
  explicit TreeMaker(Random& random) : random_(random) {}

  RandomTree make(const TreeShape& shape);

  /// A box of grid steps around all leaves.
  static GridBox region_of(const std::vector<Operand>& operands);

  /// A vertex of an operand's leaf in the world, nearly.
  static std::array<double, 3> world(const Operand& o, const IVec3& q);

 private:
  using Loops = std::vector<std::vector<uint32_t>>;

  bool one_in(int64_t n) { return random_.integer(1, n) == 1; }
  int64_t coordinate() { return random_.integer(0, shape_.size); }
  IVec3 vector() { return {coordinate(), coordinate(), coordinate()}; }

  static IVec3 minus(const IVec3& a, const IVec3& b);
  static int64_t det(const IVec3& a, const IVec3& b, const IVec3& c);

  void add_faces(LeafGeometry& leaf, const std::vector<IVec3>& points, Loops loops, bool reverse);

  /// A prism over a base of convex pieces in the coordinates of u and v, moved along w.
  void add_prism(LeafGeometry& leaf, const IVec3& origin, const IVec3& u, const IVec3& v,
                 const IVec3& w, const std::vector<std::array<int64_t, 2>>& base,
                 const Loops& pieces, bool reverse);

  void add_box(LeafGeometry& leaf, const IVec3& lo, const IVec3& hi, bool reverse);

  std::pair<IVec3, IVec3> box();

  void fill(LeafGeometry& leaf);

  std::shared_ptr<const LeafGeometry> leaf();

  /// Whether no vertex is in front of a face. The first three corners of a face are no line.
  static bool is_convex(const LeafGeometry& leaf);

  Frame frame();

  uint32_t add_node(RandomTree& tree, int depth, bool root);

  Random& random_;
  TreeShape shape_;
  int64_t next_operand_ = 0;
};

}  // namespace csgrun::test
