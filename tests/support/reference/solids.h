// What the reference is told: leaves and a claimed result as loops over exact points, in GMP. The
// reference takes nothing from the kernel but numbers.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <gmpxx.h>

#include <csgrun/engine/csg_tree.h>

namespace csgrun::reference {

/// The point (x, y, z) / w, w > 0.
using Point = std::array<mpz_class, 4>;

/// Source, facet, surface, appearance of a face.
using Label = std::array<uint32_t, 4>;

struct Face {
  std::vector<std::vector<uint32_t>> loops;  ///< counter-clockwise from outside; planar
  Label label{};
};

/// A closed surface: directed edges are balanced. It may cross itself; `rule` says what it
/// encloses.
struct Leaf {
  std::vector<Point> points;
  std::vector<Face> faces;
  FillRule rule = FillRule::kNonZero;
  /// When not empty: where faces of the result may come from, if from this leaf. Else their label
  /// is that of the leaf's face.
  std::vector<uint32_t> sources;
};

/// A Boolean expression over leaves. Folded from the left, two at a time.
struct Tree {
  int leaf = -1;
  BooleanOp op = BooleanOp::kUnion;
  std::vector<Tree> children;
};

/// A claimed boundary: at most one face for each (plane, side, label), any number of loops.
struct Claim {
  std::vector<Point> points;
  std::vector<Face> faces;
};

/// Divides by the greatest common divisor and makes w positive.
void reduce(Point& p);

/// a x + b y + c z + d = 0, reduced, its largest normal component positive: seen from there is
/// "up".
struct Plane {
  std::array<mpz_class, 4> c;
  int axis = 0;  ///< of the largest normal component; the plane is drawn in the other two
  bool operator<(const Plane& o) const { return c < o.c; }
};

/// The plane of a face, and whether the face looks down. Empty text, or what is wrong with the
/// face.
std::string plane_of(const std::vector<Point>& points, const Face& face, Plane& plane, bool& down);

/// All faces of the leaves and of the claim by plane.
struct Planes {
  struct Use {
    uint32_t plane;
    bool down;
  };
  std::vector<Plane> planes;
  std::vector<std::vector<Use>> of_leaf;  ///< by leaf and face
  std::vector<Use> of_claim;
};

}  // namespace csgrun::reference
