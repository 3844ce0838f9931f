// A solid as loops over exact rational points, by GMP: what the kernel's operands and results are
// read into before anything is said about them. Shares no arithmetic with the kernel.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <gmpxx.h>

namespace csgrun {
struct BoundaryMesh;
struct Frame;
struct Operand;
struct Plane;
}  // namespace csgrun

namespace csgrun::test {

using Rational3 = std::array<mpq_class, 3>;

Rational3 minus(const Rational3& a, const Rational3& b);
Rational3 cross(const Rational3& a, const Rational3& b);
mpq_class dot(const Rational3& a, const Rational3& b);

struct ExactSolid {
  struct Face {
    std::vector<std::vector<uint32_t>> loops;  ///< interior on the left, seen from outside
  };
  std::vector<Rational3> points;
  std::vector<Face> faces;
};

/// Where three planes meet, by Cramer's rule in GMP. The planes must meet in one point.
Rational3 meeting_point(const Plane& p, const Plane& q, const Plane& r);

/// The solid that a BoundaryMesh stands for.
ExactSolid exact_solid(const BoundaryMesh& mesh);

/// World coordinates of a point of a frame: the solution x of (matrix / 2^40) x = q.
Rational3 to_world(const Frame& frame, const Rational3& q);

bool mirrors(const Frame& frame);

/// The solid that an operand stands for, in the world.
ExactSolid exact_solid(const Operand& operand);

}  // namespace csgrun::test
