// Pieces are not closed at their corners (one may lie in the middle of another's edge), so that
// cutting digits is bounded for each triangle by itself. With u the unit of the last digit, each
// corner of det(a, b, c) = a . (b - a) x (c - a) moves by less than u along each axis: the
// determinant changes by less than u N + 12 u M L + 24 u^2 M, with N the sum of the normal's
// coordinates, L the sum of the two edges' greatest coordinates, and M the extent.
#include "engine/mesh/pieces_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "engine/mesh/boundary_volume.h"
#include "engine/mesh/fixed_sums.h"
#include "engine/mesh/measure.h"
#include "engine/mesh/to_millimetres.h"

namespace csgrun {
namespace {

constexpr int kFraction = 64;
using Fixed = std::array<Int<2>, 3>;

class Summer {
 public:
  explicit Summer(PieceStore& store) : store_(store) {}

  /// The sums below a node, which keeps them; null when a point is out of range.
  const PieceSums* sums(const PieceTree::Node& node) {
    if (node.has_sums) return &node.sums;
    PieceSums own;
    Int128 near_sum = 0;  // less than 2^34 determinants of less than 93 bits
    for (const uint32_t p : node.pieces) {
      if (const auto near = near_determinant(p)) {
        near_sum += *near;
      } else if (const PieceSums* cut = cut_sums(p)) {
        add(*cut, own);
      } else {
        return nullptr;
      }
    }
    if (near_sum != 0) {
      own.six_volumes += Int<6>::from(Int<2>::from_int128(near_sum)).shifted_left(3 * kFraction);
    }
    for (const PieceTree::NodePtr& child : node.child) {
      if (!child) continue;
      const PieceSums* below = sums(*child);
      if (!below) return nullptr;
      add(*below, own);
    }
    node.sums = own;
    node.has_sums = true;
    return &node.sums;
  }

 private:
  static void add(const PieceSums& more, PieceSums& sums) {
    sums.six_volumes += more.six_volumes;
    sums.twice_area += more.twice_area;
    sums.edges += more.edges;
    sums.triangles += more.triangles;
  }

  /// Of a piece all of whose corners are whole and near the origin; nothing for others.
  std::optional<Int128> near_determinant(uint32_t piece) {
    if (store_.is_group(piece)) return near_determinant_of_group(piece);
    near_.clear();
    for (const uint32_t point : store_.corners(piece)) {
      if (store_.point_planes(point)[0] != PieceStore::kNoNumber) return std::nullopt;
      Near& near = near_.emplace_back();
      for (size_t k = 0; k < 3; ++k) {
        near[k] = static_cast<int64_t>(store_.rounded(point)[k]) - store_.origin()[k];
        if (std::abs(near[k]) >= kNearLimit) return std::nullopt;
      }
    }
    Int128 sum = 0;
    store_.each_loop(piece,
                     [&](uint32_t begin, uint32_t end) { sum += near_determinant(begin, end); });
    return sum;
  }

  /// Straight from the leaf.
  [[nodiscard]] std::optional<Int128> near_determinant_of_group(uint32_t piece) const {
    const PieceStore::Piece& group = store_.piece(piece);
    const PieceBox& box = store_.box(piece);  // exact: of grid points
    for (size_t k = 0; k < 3; ++k) {
      const auto origin = static_cast<double>(store_.origin()[k]);
      if (box.lo[k] - origin <= -kNearLimit || box.hi[k] - origin >= kNearLimit) {
        return std::nullopt;
      }
    }
    const Operand& operand = store_.operands()[group.operand];
    const LeafGeometry& leaf = *operand.leaf;
    IVec3 origin = store_.origin();
    for (size_t k = 0; k < 3; ++k) origin[k] -= operand.translation[k];
    const auto at = [&](uint32_t corner) {
      const IVec3& v = leaf.vertices[leaf.corners[corner]];
      return Near{v[0] - origin[0], v[1] - origin[1], v[2] - origin[2]};
    };
    Int128 sum = 0;
    for (const uint32_t f : store_.group_faces(piece)) {
      const uint32_t first = leaf.face_starts[f], end = leaf.face_starts[f + 1];
      const Near a = at(first);
      Near b = at(first + 1);
      for (uint32_t i = first + 2; i < end; ++i) {
        const Near c = at(i);
        sum += determinant(a, b, c);
        b = c;
      }
    }
    return group.is_flipped ? -sum : sum;
  }

  static Int128 determinant(const Near& a, const Near& b, const Near& c) {
    const auto n = normal_of(a, b, c);
    Int128 sum = 0;
    for (size_t k = 0; k < 3; ++k) sum += static_cast<Int128>(n[k]) * a[k];
    return sum;
  }

  /// Of a fan from the first corner of a loop.
  [[nodiscard]] Int128 near_determinant(size_t begin, size_t end) const {
    Int128 sum = 0;
    for (size_t i = begin + 1; i + 1 < end; ++i) {
      sum += determinant(near_[begin], near_[i], near_[i + 1]);
    }
    return sum;
  }

  /// What another piece adds, which the store keeps; null when a corner is out of range.
  const PieceSums* cut_sums(uint32_t piece) {
    PieceStore::PieceSum& known = store_.piece_sum(piece);
    if (!known.is_known) {
      if (!find_cut(piece, known.sums)) return nullptr;
      known.is_known = true;
    }
    return &known.sums;
  }

  bool find_cut(uint32_t piece, PieceSums& out) {
    bool is_in_range = true;
    store_.each_face(piece, [&](std::span<const uint32_t> corners) {
      bool cut = false;
      fixed_.resize(corners.size());
      for (size_t i = 0; i < corners.size() && is_in_range; ++i) {
        is_in_range = take(corners[i], fixed_[i], cut);
      }
      if (!is_in_range) return;
      if (store_.is_group(piece)) {
        add_fan(fixed_, out);
      } else {
        store_.each_loop(piece, [&](uint32_t begin, uint32_t end) {
          add_fan(std::span(fixed_).subspan(begin, end - begin), out);
        });
      }
      if (cut) out.triangles += corners.size();
    });
    return is_in_range;
  }

  /// A fan from the first corner of a loop, the normals of which add up before they meet that
  /// corner: to the sum of x_i (y_i+1 - y_i-1) along each axis. The bound of the area need not be
  /// close: it takes the two products of a cross product for as large as they may be.
  static void add_fan(std::span<const Fixed> corners, PieceSums& out) {
    const Fixed& a = corners[0];
    std::array<Int<4>, 3> normal;
    std::array<double, 3> last{};
    double edges = 0, area = 0;
    for (size_t i = 1; i < corners.size(); ++i) {
      const Fixed &before = corners[i - 1], &after = i + 1 < corners.size() ? corners[i + 1] : a;
      Fixed own, step;
      std::array<double, 3> length{};
      for (size_t k = 0; k < 3; ++k) {
        own[k] = corners[i][k] - a[k];
        step[k] = after[k] - before[k];
        length[k] = std::fabs(to_double(own[k]));
      }
      double sum = 0;
      for (size_t k = 0; k < 3; ++k) {
        const size_t x = (k + 1) % 3, y = (k + 2) % 3;
        normal[k] += full_product(own[x], step[y]);
        area += last[x] * length[y] + last[y] * length[x];
        sum += length[k];
      }
      edges += 2 * sum;  // the first and the last are in one triangle only
      last = length;
    }
    for (size_t k = 0; k < 3; ++k) out.six_volumes += full_product(normal[k], a[k]);
    out.edges += std::ldexp(edges, -kFraction);
    out.twice_area += std::ldexp(area, -2 * kFraction);
  }

  /// Where a point is, cut to the fraction; the store keeps it.
  bool take(uint32_t point, Fixed& fixed, bool& cut) {
    PieceStore::CutPoint& known = store_.cut_point(point);
    if (!known.is_known) {
      if (!find(point, known)) return false;
      known.is_known = true;
    }
    fixed = known.at;
    cut = cut || known.is_cut;
    return true;
  }

  bool find(uint32_t point, PieceStore::CutPoint& found) const {
    const Point p = store_.exact(point);
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<size_t>(k);
      if (!fixed_point<1>(coordinate(p, k), p.w, found.at[axis], found.is_cut)) return false;
      found.at[axis] -= Int<2>(store_.origin()[axis]).shifted_left(kFraction);
    }
    return true;
  }

  PieceStore& store_;
  std::vector<Near> near_;
  std::vector<Fixed> fixed_;
};

/// Finds the extent of a node for a step.
void find_extent(const PieceTree::Node& node, const PieceStore& store, const GridStep& step,
                 const ToMillimetres& to_millimetres) {
  if (node.extent_step == step) return;
  node.extent_step = step;
  node.extent[0].fill(HUGE_VAL);
  node.extent[1].fill(-HUGE_VAL);
  const auto add = [&](size_t axis, double lo, double hi) {
    node.extent[0][axis] = std::min(node.extent[0][axis], lo);
    node.extent[1][axis] = std::max(node.extent[1][axis], hi);
  };
  for (const PieceTree::NodePtr& child : node.child) {
    if (!child) continue;
    find_extent(*child, store, step, to_millimetres);
    for (size_t k = 0; k < 3; ++k) add(k, child->extent[0][k], child->extent[1][k]);
  }
  for (const uint32_t piece : node.pieces) {
    store.each_face(piece, [&](std::span<const uint32_t> corners) {
      for (const uint32_t p : corners) {
        // Rounding is monotone: what is furthest has the furthest rounded coordinate.
        const auto& at = store.rounded(p);
        std::array<bool, 3> is_end{};
        for (size_t k = 0; k < 3; ++k) {
          is_end[k] = at[k] == node.box.lo[k] || at[k] == node.box.hi[k];
        }
        if (!is_end[0] && !is_end[1] && !is_end[2]) continue;
        glm::dvec3 mm;
        std::array<float, 3> single{};
        to_millimetres.position(store.exact(p), mm, single);
        for (size_t k = 0; k < 3; ++k) {
          if (is_end[k]) add(k, mm[static_cast<int>(k)], mm[static_cast<int>(k)]);
        }
      }
    });
  }
}

/// x * 2^shift as a whole number that is no less.
Natural whole_above(double x, int shift) {
  int exponent = 0;
  const double m = std::frexp(x, &exponent);
  const Natural leading = natural(static_cast<UInt128>(std::ldexp(m, 53)) + 1);
  const int up = exponent - 53 + shift;
  return up >= 0 ? shift_left(leading, up) : leading;
}

}  // namespace

Result<double> pieces_volume(const ResultPieces& pieces, const GridStep& step) {
  const PieceTree::NodePtr& root = pieces.tree.root();
  if (!root) return 0.0;
  if (const PieceSums* known = Summer(*pieces.store).sums(*root)) {
    const PieceSums& sums = *known;
    double extent = 0;
    for (size_t k = 0; k < 3; ++k) {
      const auto origin = static_cast<double>(pieces.store->origin()[k]);
      extent = std::max(
          {extent, std::fabs(root->box.lo[k] - origin), std::fabs(root->box.hi[k] - origin)});
    }
    extent += 1;
    // In steps^2 times the unit; far more than rounding may have taken from it.
    const double bound = sums.triangles == 0 ? 0
                                             : (sums.twice_area + 12 * extent * sums.edges +
                                                extent * static_cast<double>(sums.triangles)) *
                                                   (1 + 0x1p-16);
    const Sum six_volumes{signed_value(sums.six_volumes),
                          bound > 0 ? whole_above(bound, 2 * kFraction) : Natural()};
    if (const auto volume = round_volume(six_volumes, kFraction, step)) return *volume;
  }
  auto boundary = assemble_pieces(pieces, false);
  if (!boundary) return boundary.error();
  return boundary_volume(**boundary, step);
}

std::optional<std::array<glm::dvec3, 2>> pieces_box(const ResultPieces& pieces,
                                                    const GridStep& step) {
  const PieceTree::NodePtr& root = pieces.tree.root();
  if (!root) return std::nullopt;
  find_extent(*root, *pieces.store, step, ToMillimetres(step));
  const auto point = [](const std::array<double, 3>& p) { return glm::dvec3(p[0], p[1], p[2]); };
  return std::array{point(root->extent[0]), point(root->extent[1])};
}

}  // namespace csgrun
