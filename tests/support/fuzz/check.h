// Runs one case through the kernel and compares everything with the reference.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/bsp/result_pieces.h"
#include "engine/bsp/self_resolution.h"
#include "tests/support/fuzz/case.h"

namespace csgrun::test {

/// Evaluates the tree of a case by the kernel.
class FuzzEvaluator {
 public:
  explicit FuzzEvaluator(const FuzzCase& c);

  BoundaryResult run();
  [[nodiscard]] const EvaluateStats& stats() const { return stats_; }
  /// How many faces were named in results.
  [[nodiscard]] size_t named() const { return named_; }

 private:
  static size_t named_count(const BoundaryMesh& mesh);

  struct Parts {
    std::vector<Operand> operands;
    Expression expression;
    GridBox region{{0, 0, 0}, {0, 0, 0}};
  };

  BoundaryResult evaluate(const FuzzNode& n);

  /// One operand after another: each result is in pieces, and goes on from the one before.
  Result<PiecesPtr> pieces_of(const FuzzNode& n);

  /// A single operand in pieces; a leaf that cannot be, by its boundary.
  Result<PiecesPtr> in_pieces(const Parts& parts);

  static Operand boundary_operand(Boundary boundary);

  static void hold(GridBox& box, const PieceBox& pieces);

  static void hold(GridBox& box, const std::array<double, 3>& p);

  static uint32_t add_operand(Parts& parts, Operand operand);

  static InsideRule inside_rule(FillRule fill);

  static InsideRule inside_rule(const OuterHull& hull);

  Result<uint32_t> leaf(uint32_t index, const std::optional<OuterHull>& hull, Parts& parts);

  Result<uint32_t> hull(const FuzzNode& n, Parts& parts);

  /// The number of the node that stands for `n`. A root is never made on its own.
  Result<uint32_t> put(const FuzzNode& n, Parts& parts, bool root);

  const FuzzCase& case_;
  KernelOptions options_;
  uint32_t source_ = 0;
  size_t named_ = 0;
  int inner_ = 0;
  EvaluateStats stats_;
};

struct FuzzOutcome {
  std::string failure;      ///< empty: kernel and reference agree
  bool meets_zero = false;  ///< a sign was zero that no plane's name tells
  bool empty = false;       ///< the result has no points
  size_t named = 0;         ///< faces that results named
};

/// The kernel's boundary against the reference; and when `forms`, whether the boundary is in its
/// canonical form, and the arrays made from it are a closed manifold that fills its faces.
FuzzOutcome check_case(const FuzzCase& c, bool forms = true);

}  // namespace csgrun::test
