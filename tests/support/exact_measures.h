// Exact measures of a solid from its loops, and a proof that a boundary is what it claims to be:
// planar, closed, oriented, with true corners only, correctly rounded and in order.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "engine/exact/fixed_int.h"
#include "tests/support/exact_solid.h"

namespace csgrun {
struct LeafGeometry;
}  // namespace csgrun

namespace csgrun::test {

/// Twice the area vector of a face: the sum over its loops of p x q, taken from one apex.
Rational3 area_vector(const ExactSolid& s, const ExactSolid::Face& face);

/// The volume, exactly: cones from the origin over the faces; a face with its holes is a bag of
/// directed edges, so nothing needs to be triangulated.
mpq_class volume(const ExactSolid& s);
mpq_class volume(const BoundaryMesh& mesh);

/// Whether a double is the rational correctly rounded (to nearest, ties to even).
bool is_correctly_rounded(const mpq_class& exact, double rounded);

/// Empty when everything holds that boundary_mesh.h promises; else what is wrong, and where.
std::string fault_in(const BoundaryMesh& mesh);

/// Prime moduli for volumes of solids whose rational has megabits.
constexpr std::array<uint64_t, 2> kPrimes{(1ull << 61) - 1, (1ull << 61) - 31};

/// Arithmetic modulo a prime below 2^61.
class Residues {
 public:
  explicit Residues(uint64_t prime) : p_(prime) {}
  [[nodiscard]] uint64_t of(Int128 v) const {
    const Int128 r = v % static_cast<Int128>(p_);
    return static_cast<uint64_t>(r < 0 ? r + static_cast<Int128>(p_) : r);
  }
  [[nodiscard]] uint64_t add(uint64_t a, uint64_t b) const { return (a + b) % p_; }
  [[nodiscard]] uint64_t subtract(uint64_t a, uint64_t b) const { return (a + p_ - b) % p_; }
  [[nodiscard]] uint64_t multiply(uint64_t a, uint64_t b) const {
    return static_cast<uint64_t>(static_cast<UInt128>(a) * b % p_);
  }
  [[nodiscard]] uint64_t inverse(uint64_t a) const {
    uint64_t r = 1;
    for (uint64_t e = p_ - 2; e; e >>= 1, a = multiply(a, a)) {
      if (e & 1) r = multiply(r, a);
    }
    return r;
  }

 private:
  uint64_t p_;
};

/// Six times the volume modulo kPrimes[which]. Linear; no fractions: points are X W^-1 modulo p.
uint64_t six_volumes_residue(const BoundaryMesh& mesh, int which);

/// The same of a leaf, in its frame: straight from its integers.
uint64_t six_volumes_residue(const LeafGeometry& leaf, int which);

}  // namespace csgrun::test
