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
/// norm within 2^-45 of 1 is 1), Rn with unit columns. But where a shear leaves the planes across
/// an axis of the world parallel, D measures along that axis: the row of Rn^-1 is a unit row.
struct LinearSplit {
  /// False when |det Rn| < 2^-16 or an entry of Rn^-1 exceeds 2^16: there is no frame, the leaf is
  /// quantised in the world.
  bool framed = false;
  std::array<double, 3> scale{1, 1, 1};  ///< D
  std::array<Row, 3> rows{};             ///< of Rn^-1, correctly rounded but for double rounding
  /// For rows that a shear made longer than 1, up to a limit: their directions, and the entries of
  /// D with which these are the rows. The lengths are 1 for all others.
  std::array<double, 3> lengths{1, 1, 1}, direction_scale{1, 1, 1};
  std::array<Row, 3> directions{};
  double longest_column = 1;  ///< of Rn, at most, whichever of these are taken
  double determinant = 0;     ///< of Rn, its columns made unit vectors
};

/// Splits a finite transform. Computed with about 100 bits, so that the noise in the rows is that
/// of the transform's own entries.
LinearSplit split_linear(const Affine& map);

/// Makes one row of rows that differ by noise. Rows within 2^-46 of one another (largest difference
/// of an entry), transitively, up to sign, are one row, represented by the first that was added;
/// unit rows come before all others.
///
/// Rows that are longer than 1 are their directions where other leaves have planes across these,
/// whose rows are not as long: what is flush with a sheared part is flush whatever turns both.
class RowTable {
 public:
  /// Of a row that was added, and of its direction if it is a long one.
  struct Handle {
    uint32_t row = 0, direction = kNone;
  };
  struct Represented {
    Row row;
    bool is_direction;  ///< of the row that was added
  };

  RowTable();
  /// Adds a row (in tree order) and returns its handle.
  uint32_t add(const Row& row);
  /// The same of a row of a split, which may be a long one.
  Handle add(const LinearSplit& split, int row);
  /// The representative of a row's cluster, given all rows that were added so far.
  [[nodiscard]] Row representative(uint32_t handle);
  [[nodiscard]] Represented representative(const Handle& handle);
  /// Whether a row joined two clusters, or told that long ones are to be their directions, so that
  /// an earlier one has another representative since.
  [[nodiscard]] bool has_bridged() const { return has_bridged_; }

 private:
  static constexpr uint32_t kNone = ~0u;
  struct RowHash {
    size_t operator()(const std::array<int64_t, 3>& cell) const;
  };
  /// What is known of a cluster.
  struct Cluster {
    uint32_t first_row = kNone;     ///< the lowest handle that is not only a direction
    double length = 0;              ///< of the long rows with this direction; 0: there are none
    bool has_other_length = false;  ///< they are not all as long

    [[nodiscard]] bool takes_direction() const {
      return length != 0 && (first_row != kNone || has_other_length);
    }
    void include(const Cluster& other);
  };
  uint32_t add(const Row& row, const Cluster& known);
  uint32_t insert(const Row& row);
  uint32_t root(uint32_t handle);
  void join(uint32_t a, uint32_t b);
  void note(uint32_t handle, const Cluster& known);

  std::vector<Row> rows_;          // row 2i + 1 is row 2i negated
  std::vector<uint32_t> parent_;   // union-find; a root is the lowest handle of its cluster
  std::vector<Cluster> clusters_;  // by root
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
/// rows are the unit rows. `framed` is false when the rows do not span space: their determinant is
/// less than half of what it was, at least, when they were split from transforms (`least`).
struct CanonicalFrame {
  bool framed = false;
  Placement placement;
};
CanonicalFrame canonical_frame(const std::array<std::array<int64_t, 3>, 3>& rows, double least = 1);

/// rows[axis] . t in the world of millimetres, rounded once.
double carry_translation(const Row& row, const Affine& map);

}  // namespace csgrun
