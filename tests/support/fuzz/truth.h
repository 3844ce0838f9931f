// A case in the terms of the reference: its leaves at exact points of the world, and the kernel's
// result as a claim. GMP throughout; from the kernel come integers only.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <gmpxx.h>

#include "tests/support/fuzz/case.h"
#include "tests/support/reference/faults.h"
#include "tests/support/reference/solids.h"

namespace csgrun::test {

/// x = matrix q / denominator takes a frame's coordinates to the world's.
struct ExactMap {
  std::array<std::array<mpz_class, 3>, 3> matrix;
  mpz_class denominator = 1;
  bool mirrors = false;

  explicit ExactMap(const Frame& frame);

  [[nodiscard]] reference::Point operator()(const IVec3& q) const;
};

reference::Claim claim_of(const BoundaryMesh& mesh);

/// The expression of a case for the reference.
struct Truth {
  std::string fault;  ///< the reference is at a loss
  std::vector<reference::Leaf> leaves;
  reference::Tree tree;
};

/// With a deliberate fault in what is decided about hulls.
Truth truth_of(const FuzzCase& c, reference::Fault fault = reference::Fault::kNone);

}  // namespace csgrun::test
