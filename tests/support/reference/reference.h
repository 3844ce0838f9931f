// What the tests ask the reference: does a claimed boundary equal an expression, and what does an
// expression measure?
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/support/reference/faults.h"
#include "tests/support/reference/solids.h"

namespace csgrun::reference {

/// Finds the planes of all faces. Empty, or what is wrong.
std::string gather_planes(const std::vector<Leaf>& leaves, const Claim* claim, Planes& planes);

/// Empty when `claim` is the boundary of the expression: everywhere, on the right side, with the
/// right labels. Else the first difference. Cost: the sum over all planes of (segments in it)^2 at
/// worst.
std::string difference(const std::vector<Leaf>& leaves, const Tree& tree, const Claim& claim,
                       Fault fault = Fault::kNone);

/// What an expression measures.
struct Measured {
  std::string fault;  ///< what is wrong with the leaves, if anything
  mpq_class volume = 0;
  /// Of the boundary by plane, whether it looks up, and leaf: its area as drawn along the plane's
  /// axis.
  struct Side {
    Plane plane;
    bool up;
    uint32_t leaf;
    bool operator<(const Side& o) const {
      if (plane < o.plane || o.plane < plane) return plane < o.plane;
      return up != o.up ? o.up : leaf < o.leaf;
    }
  };
  std::map<Side, mpq_class> areas;
};

Measured measure(const std::vector<Leaf>& leaves, const Tree& tree, Fault fault = Fault::kNone);

}  // namespace csgrun::reference
