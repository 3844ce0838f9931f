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
inline void reduce(Point& p) {
  mpz_class common = 0;
  for (const auto& c : p) common = gcd(common, c);
  if (p[3] < 0) common = -common;
  if (common == 1) return;
  for (auto& c : p) mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), common.get_mpz_t());
}

/// a x + b y + c z + d = 0, reduced, its largest normal component positive: seen from there is
/// "up".
struct Plane {
  std::array<mpz_class, 4> c;
  int axis = 0;  ///< of the largest normal component; the plane is drawn in the other two
  bool operator<(const Plane& o) const { return c < o.c; }
};

/// The plane of a face, and whether the face looks down. Empty text, or what is wrong with the
/// face.
inline std::string plane_of(const std::vector<Point>& points, const Face& face, Plane& plane,
                            bool& down) {
  // The area vector: sum of (p - o) x (q - o) over the edges, as one integer vector times a factor.
  const Point& o = points[face.loops[0][0]];
  std::array<mpq_class, 3> normal{0, 0, 0};
  const auto from = [&](uint32_t i) {
    std::array<mpq_class, 3> r;
    for (int k = 0; k < 3; ++k) {
      r[k] = mpq_class(points[i][k] * o[3] - o[k] * points[i][3], points[i][3]);
      r[k].canonicalize();
    }
    return r;
  };
  for (const auto& loop : face.loops) {
    std::array<mpq_class, 3> p = from(loop.back());
    for (const uint32_t i : loop) {
      const std::array<mpq_class, 3> q = from(i);
      for (int k = 0; k < 3; ++k) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        normal[k] += p[u] * q[v] - p[v] * q[u];
      }
      p = q;
    }
  }
  mpz_class common = o[3];
  for (const auto& n : normal) common *= n.get_den();
  plane.c[3] = 0;
  for (int k = 0; k < 3; ++k) {
    plane.c[k] = mpq_class(normal[k] * common).get_num();
    plane.c[3] -= plane.c[k] * o[k];
  }
  for (int k = 0; k < 3; ++k) plane.c[k] *= o[3];
  plane.axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (abs(plane.c[k]) > abs(plane.c[plane.axis])) plane.axis = k;
  }
  if (plane.c[plane.axis] == 0) return "a face without area";
  down = plane.c[plane.axis] < 0;
  mpz_class divisor = 0;
  for (const auto& c : plane.c) divisor = gcd(divisor, c);
  if (down) divisor = -divisor;
  for (auto& c : plane.c) c /= divisor;
  for (const auto& loop : face.loops) {
    for (const uint32_t i : loop) {
      const Point& p = points[i];
      if (plane.c[0] * p[0] + plane.c[1] * p[1] + plane.c[2] * p[2] + plane.c[3] * p[3] != 0) {
        return "a face that is not planar";
      }
    }
  }
  return "";
}

}  // namespace csgrun::reference
