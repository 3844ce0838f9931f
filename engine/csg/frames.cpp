#include "engine/csg/frames.h"

#include <algorithm>
#include <cmath>

#include "engine/base/double_double.h"

namespace csgrun {
namespace {

using Int128 = __int128;
using Column = std::array<DoubleDouble, 3>;

constexpr double kUnitNormTolerance = 0x1p-45;
constexpr double kRowTolerance = 0x1p-46;
constexpr double kLeastDeterminant = 0x1p-16;
constexpr double kLargestRowEntry = 0x1p16;  // so that entries of C stay within 2^56

Column cross(const Column& a, const Column& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Unlike |r|, negative zero must not make two rows of one.
double without_negative_zero(double x) { return x == 0 ? 0.0 : x; }

int64_t row_cell(double x) {
  // Rows beyond 2^16 have no frame, so the quotient fits: 2^16 2^46 = 2^62.
  return static_cast<int64_t>(std::floor(x / kRowTolerance));
}

bool rows_are_close(const Row& a, const Row& b) {
  for (int i = 0; i < 3; ++i) {
    if (std::fabs(a[i] - b[i]) > kRowTolerance) return false;
  }
  return true;
}

}  // namespace

LinearSplit split_linear(const Affine& map) {
  LinearSplit split;
  std::array<Column, 3> columns;
  for (int j = 0; j < 3; ++j) {
    double largest = 0;
    for (int i = 0; i < 3; ++i) largest = std::max(largest, std::fabs(map.m[i][j]));
    if (largest == 0) return split;
    // Scaled by a power of two, so that squares neither overflow nor vanish.
    const int exponent = std::ilogb(largest);
    Row c;
    for (int i = 0; i < 3; ++i) c[i] = std::ldexp(map.m[i][j], -exponent);
    const DoubleDouble squares = DoubleDouble::product(c[0], c[0]) +
                                 DoubleDouble::product(c[1], c[1]) +
                                 DoubleDouble::product(c[2], c[2]);
    const double norm = sqrt(squares).value();
    split.scale[j] = std::ldexp(norm, exponent);
    const bool unit = std::fabs(split.scale[j] - 1) <= kUnitNormTolerance;
    if (unit) split.scale[j] = 1;
    for (int i = 0; i < 3; ++i) {
      columns[j][i] = unit ? DoubleDouble(map.m[i][j]) : DoubleDouble(c[i]) / DoubleDouble(norm);
    }
  }
  const Column first = cross(columns[1], columns[2]);
  const DoubleDouble det =
      columns[0][0] * first[0] + columns[0][1] * first[1] + columns[0][2] * first[2];
  split.determinant = det.value();
  if (!(std::fabs(split.determinant) >= kLeastDeterminant)) return split;
  const std::array<Column, 3> adjugate{first, cross(columns[2], columns[0]),
                                       cross(columns[0], columns[1])};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      split.rows[i][j] = without_negative_zero((adjugate[i][j] / det).value());
      if (!(std::fabs(split.rows[i][j]) <= kLargestRowEntry)) return split;
    }
  }
  split.framed = true;
  return split;
}

RowTable::RowTable() {
  for (int i = 0; i < 3; ++i) {
    Row unit{0, 0, 0};
    unit[i] = 1;
    add(unit);
  }
}

size_t RowTable::RowHash::operator()(const std::array<int64_t, 3>& cell) const {
  uint64_t h = 0x9e3779b97f4a7c15ULL;
  for (int64_t c : cell) {
    h ^= static_cast<uint64_t>(c);
    h *= 0xff51afd7ed558ccdULL;
    h ^= h >> 32;
  }
  return static_cast<size_t>(h);
}

uint32_t RowTable::add(const Row& row) {
  const uint32_t handle = insert(row);
  if (handle + 1 == rows_.size()) {
    insert({without_negative_zero(-row[0]), without_negative_zero(-row[1]),
            without_negative_zero(-row[2])});
  }
  return handle;
}

uint32_t RowTable::insert(const Row& row) {
  std::array<int64_t, 3> cell;
  for (int i = 0; i < 3; ++i) cell[i] = row_cell(row[i]);
  std::vector<uint32_t>& here = cells_[cell];
  for (uint32_t other : here) {
    if (rows_[other] == row) return other;
  }
  const auto handle = static_cast<uint32_t>(rows_.size());
  rows_.push_back(row);
  parent_.push_back(handle);
  // Rows of one cell are within the tolerance by themselves, so one close row in a neighbouring
  // cell joins that whole cell.
  if (!here.empty()) join(here.front(), handle);
  here.push_back(handle);
  for (int64_t dx = -1; dx <= 1; ++dx) {
    for (int64_t dy = -1; dy <= 1; ++dy) {
      for (int64_t dz = -1; dz <= 1; ++dz) {
        if (dx == 0 && dy == 0 && dz == 0) continue;
        const auto found = cells_.find({cell[0] + dx, cell[1] + dy, cell[2] + dz});
        if (found == cells_.end() || root(found->second.front()) == root(handle)) continue;
        for (uint32_t other : found->second) {
          if (!rows_are_close(rows_[other], row)) continue;
          has_bridged_ = has_bridged_ || root(handle) != handle;
          join(other, handle);
          break;
        }
      }
    }
  }
  return handle;
}

uint32_t RowTable::root(uint32_t handle) {
  while (parent_[handle] != handle) {
    parent_[handle] = parent_[parent_[handle]];
    handle = parent_[handle];
  }
  return handle;
}

void RowTable::join(uint32_t a, uint32_t b) {
  a = root(a);
  b = root(b);
  // The lowest handle leads: it is the first in tree order, and rows of opposite clusters get
  // opposite representatives, as they are inserted in pairs.
  if (a != b) parent_[std::max(a, b)] = std::min(a, b);
}

Row RowTable::representative(uint32_t handle) { return rows_[root(handle)]; }

std::array<int64_t, 3> integer_row(const Row& row) {
  std::array<int64_t, 3> r;
  for (int i = 0; i < 3; ++i) r[i] = std::llround(std::ldexp(row[i], Frame::kShift));
  return r;
}

CanonicalFrame canonical_frame(const std::array<std::array<int64_t, 3>, 3>& rows) {
  CanonicalFrame result;
  // Signs first: the first of the largest entries is positive. A row and its negative agree.
  std::array<std::array<int64_t, 3>, 3> positive = rows;
  std::array<int8_t, 3> sign{1, 1, 1};
  for (int i = 0; i < 3; ++i) {
    int largest = 0;
    for (int j = 1; j < 3; ++j) {
      if (std::llabs(rows[i][j]) > std::llabs(rows[i][largest])) largest = j;
    }
    if (rows[i][largest] >= 0) continue;
    sign[i] = -1;
    for (int j = 0; j < 3; ++j) positive[i][j] = -rows[i][j];
  }
  // Then the order with the heaviest diagonal, which is the identity's for unit rows; ties go to
  // the largest matrix. Exact comparisons of integers: noise has no say.
  std::array<int8_t, 3> order{0, 1, 2}, best = order;
  Int128 best_weight = -1;
  std::array<std::array<int64_t, 3>, 3> best_matrix{};
  do {
    Int128 weight = 0;
    std::array<std::array<int64_t, 3>, 3> matrix;
    for (int i = 0; i < 3; ++i) {
      matrix[i] = positive[order[i]];
      weight += std::llabs(matrix[i][i]);
    }
    if (weight < best_weight || (weight == best_weight && matrix <= best_matrix)) continue;
    best = order;
    best_weight = weight;
    best_matrix = matrix;
  } while (std::next_permutation(order.begin(), order.end()));

  result.placement.frame.matrix = best_matrix;
  result.placement.frame.is_identity = best_matrix == world_frame().matrix;
  for (int i = 0; i < 3; ++i) {
    result.placement.permutation.axis[i] = best[i];
    result.placement.permutation.sign[i] = sign[best[i]];
  }
  // Clusters of rows may have pulled the rows of a nearly singular frame onto a plane.
  Column a, b, c;
  for (int j = 0; j < 3; ++j) {
    a[j] = std::ldexp(static_cast<double>(best_matrix[0][j]), -Frame::kShift);
    b[j] = std::ldexp(static_cast<double>(best_matrix[1][j]), -Frame::kShift);
    c[j] = std::ldexp(static_cast<double>(best_matrix[2][j]), -Frame::kShift);
  }
  const Column n = cross(b, c);
  const double det = (a[0] * n[0] + a[1] * n[1] + a[2] * n[2]).value();
  // Rows of Rn^-1 span at least the unit volume, as the columns of Rn are unit vectors.
  result.framed = std::fabs(det) >= 0.5;
  return result;
}

double carry_translation(const Row& row, const Affine& map) {
  return (DoubleDouble::product(row[0], map.m[0][3]) + DoubleDouble::product(row[1], map.m[1][3]) +
          DoubleDouble::product(row[2], map.m[2][3]))
      .value();
}

}  // namespace csgrun
