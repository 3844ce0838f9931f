#include "engine/csg/frames.h"

#include <algorithm>
#include <cmath>

#include "engine/base/double_double.h"

namespace csgrun {
namespace {

using Int128 = __int128;
using Column = std::array<DoubleDouble, 3>;

constexpr double kUnitNormTolerance = 0x1p-45;
constexpr double kRowTolerance = 0x1p-46, kLengthTolerance = 0x1p-40;
constexpr double kLeastDeterminant = 0x1p-16;
constexpr double kLargestRowEntry = 0x1p16;  // so that entries of C stay within 2^56
/// Of Rn: half a step along a column moves a point by so many of them (scene_nodes.cpp, enclose).
constexpr double kLongestColumn = 32;

Column cross_product(const Column& a, const Column& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double snapped_to_one(double scale) {
  return std::fabs(scale - 1) <= kUnitNormTolerance ? 1 : scale;
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

/// What a row of Rn^-1 becomes where it is longer than 1, as a shear makes it. One along an axis of
/// the world becomes a unit row, and D measures along that axis: planes across it, which the shear
/// does not move, are on the grid of the world as those of all others are. Of others it is noted.
void shorten(int j, Column& row, LinearSplit& split) {
  const DoubleDouble length = sqrt(row[0] * row[0] + row[1] * row[1] + row[2] * row[2]);
  if (length.value() <= 1 + kUnitNormTolerance || length.value() > kLongestColumn) return;
  split.longest_column = std::max(split.longest_column, length.value());
  const DoubleDouble before(split.scale[j]);
  const double scale = snapped_to_one((before / length).value());
  const DoubleDouble factor = DoubleDouble(scale) / before;
  int across = 0;  // entries that are noise
  for (int k = 0; k < 3; ++k) {
    const double entry = (row[k] * factor).value();
    split.directions[j][k] = without_negative_zero(entry);
    across += std::fabs(entry) <= kRowTolerance ? 1 : 0;
  }
  if (across == 2) {
    for (DoubleDouble& entry : row) entry = entry * factor;
    split.scale[j] = scale;
  } else {
    split.lengths[j] = length.value();
    split.direction_scale[j] = scale;
  }
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
    split.scale[j] = snapped_to_one(std::ldexp(norm, exponent));
    const bool unit = split.scale[j] == 1;
    for (int i = 0; i < 3; ++i) {
      columns[j][i] = unit ? DoubleDouble(map.m[i][j]) : DoubleDouble(c[i]) / DoubleDouble(norm);
    }
  }
  const Column first = cross_product(columns[1], columns[2]);
  const DoubleDouble det =
      columns[0][0] * first[0] + columns[0][1] * first[1] + columns[0][2] * first[2];
  split.determinant = det.value();
  if (!(std::fabs(split.determinant) >= kLeastDeterminant)) return split;
  std::array<Column, 3> inverse{first, cross_product(columns[2], columns[0]),
                                cross_product(columns[0], columns[1])};
  for (int i = 0; i < 3; ++i) {
    for (DoubleDouble& entry : inverse[i]) entry = entry / det;
    shorten(i, inverse[i], split);
    for (int j = 0; j < 3; ++j) {
      split.rows[i][j] = without_negative_zero(inverse[i][j].value());
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

void RowTable::Cluster::include(const Cluster& other) {
  first_row = std::min(first_row, other.first_row);
  has_other_length |= other.has_other_length;
  if (other.length == 0) return;
  if (length == 0) length = other.length;
  has_other_length |= std::fabs(length - other.length) > kLengthTolerance * length;
}

uint32_t RowTable::add(const Row& row) { return add(row, Cluster{0, 0, false}); }

RowTable::Handle RowTable::add(const LinearSplit& split, int row) {
  Handle handle;
  handle.row = add(split.rows[row]);
  if (split.lengths[row] == 1) return handle;
  handle.direction = add(split.directions[row], Cluster{kNone, split.lengths[row], false});
  return handle;
}

/// `known.first_row` stands for the row's own handle, unless it is none.
uint32_t RowTable::add(const Row& row, const Cluster& known) {
  const uint32_t handle = insert(row);
  if (handle + 1 == rows_.size()) {
    insert({without_negative_zero(-row[0]), without_negative_zero(-row[1]),
            without_negative_zero(-row[2])});
  }
  for (const uint32_t either : {handle, handle ^ 1}) {
    Cluster own = known;
    if (own.first_row != kNone) own.first_row = either;
    note(either, own);
  }
  return handle;
}

void RowTable::note(uint32_t handle, const Cluster& known) {
  Cluster& cluster = clusters_[root(handle)];
  const bool had_long = cluster.length != 0, took_direction = cluster.takes_direction();
  cluster.include(known);
  has_bridged_ |= had_long && !took_direction && cluster.takes_direction();
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
  clusters_.emplace_back();
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
  if (a == b) return;
  parent_[std::max(a, b)] = std::min(a, b);
  clusters_[std::min(a, b)].include(clusters_[std::max(a, b)]);
}

Row RowTable::representative(uint32_t handle) { return rows_[clusters_[root(handle)].first_row]; }

RowTable::Represented RowTable::representative(const Handle& handle) {
  if (handle.direction != kNone) {
    const uint32_t lowest = root(handle.direction);
    const Cluster& cluster = clusters_[lowest];
    if (cluster.takes_direction()) {
      return {rows_[cluster.first_row != kNone ? cluster.first_row : lowest], true};
    }
  }
  return {representative(handle.row), false};
}

std::array<int64_t, 3> integer_row(const Row& row) {
  std::array<int64_t, 3> r;
  for (int i = 0; i < 3; ++i) r[i] = std::llround(std::ldexp(row[i], Frame::kShift));
  return r;
}

CanonicalFrame canonical_frame(const std::array<std::array<int64_t, 3>, 3>& rows, double least) {
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
  const Column n = cross_product(b, c);
  const double det = (a[0] * n[0] + a[1] * n[1] + a[2] * n[2]).value();
  result.framed = std::fabs(det) >= least / 2;
  return result;
}

double carry_translation(const Row& row, const Affine& map) {
  return (DoubleDouble::product(row[0], map.m[0][3]) + DoubleDouble::product(row[1], map.m[1][3]) +
          DoubleDouble::product(row[2], map.m[2][3]))
      .value();
}

}  // namespace csgrun
