// Frames: where the leaves of turned, mirrored and sheared parts are quantised, so that what is
// flush before a common transform is flush after it (docs/numerics.md, "Frames").
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <csgrun/engine/csg_tree.h>

#include "engine/bsp/operand.h"
#include "engine/csg/signed_permutation.h"

namespace csgrun {

using Row = std::array<double, 3>;

/// The linear part R of a leaf's total transform, split as Rn D: D the diagonal of column norms (a
/// norm within 2^-45 of 1 is 1), Rn with unit columns.
struct LinearSplit {
  /// False when |det Rn| < 2^-16 or an entry of Rn^-1 exceeds 2^16: there is no frame, the leaf is
  /// quantised in the world.
  bool framed = false;
  std::array<double, 3> scale{1, 1, 1};  ///< D
  std::array<Row, 3> rows{};             ///< of Rn^-1, correctly rounded but for double rounding
  double determinant = 0;                ///< of Rn
};

/// Splits a finite transform. Computed with about 100 bits, so that the noise in the rows is that
/// of the transform's own entries.
LinearSplit split_linear(const Affine& map);

/// Makes one row of rows that differ by noise. Rows within 2^-46 of one another (largest difference
/// of an entry), transitively, up to sign, are one row, represented by the first that was added;
/// unit rows come before all others.
class RowTable {
 public:
  RowTable();
  /// Adds a row (in tree order) and returns its handle.
  uint32_t add(const Row& row);
  /// The representative of a row's cluster, given all rows that were added so far.
  [[nodiscard]] Row representative(uint32_t handle);
  /// Whether a row joined two clusters, so that one of them has another representative since.
  [[nodiscard]] bool has_bridged() const { return has_bridged_; }

 private:
  struct RowHash {
    size_t operator()(const std::array<int64_t, 3>& cell) const;
  };
  uint32_t insert(const Row& row);
  uint32_t root(uint32_t handle);
  void join(uint32_t a, uint32_t b);

  std::vector<Row> rows_;         // row 2i + 1 is row 2i negated
  std::vector<uint32_t> parent_;  // union-find; a root is the lowest handle of its cluster
  bool has_bridged_ = false;
  std::unordered_map<std::array<int64_t, 3>, std::vector<uint32_t>, RowHash> cells_;
};

/// A row as integers: round(2^40 row), ties away from zero.
std::array<int64_t, 3> integer_row(const Row& row);

/// How a leaf stands in the world: X = scale v + rows t in its local axes, q = permutation X in the
/// axes of its frame.
struct Placement {
  Frame frame;                    ///< canonical: one of 48 for the same three rows up to sign
  SignedPermutation permutation;  ///< local axes -> axes of the frame
};

/// The frame of three integer rows (local axes). It is a function of the set of the rows up to
/// sign: parts that differ by 90-degree turns and mirrors share it, and it is the identity when the
/// rows are the unit rows. `framed` is false when the rows do not span space.
struct CanonicalFrame {
  bool framed = false;
  Placement placement;
};
CanonicalFrame canonical_frame(const std::array<std::array<int64_t, 3>, 3>& rows);

/// rows[axis] . t in the world of millimetres, rounded once.
double carry_translation(const Row& row, const Affine& map);

}  // namespace csgrun
