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
#include "engine/mesh/cut_points.h"
#include "engine/mesh/fixed_sums.h"
#include "engine/mesh/framed_volume.h"
#include "engine/mesh/measure.h"
#include "engine/mesh/to_millimetres.h"

namespace csgrun {
namespace {

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
    if (near_sum != 0) own.six_volumes += of_whole(near_sum);
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

  /// A sum of determinants of whole numbers in the unit of PieceSums.
  static Int<6> of_whole(Int128 sum) {
    return Int<6>::from(Int<2>::from_int128(sum)).shifted_left(3 * kFraction);
  }

  /// Of a piece all of whose corners are whole and near the origin; nothing for others, and for
  /// groups, which are worth keeping.
  std::optional<Int128> near_determinant(uint32_t piece) {
    if (store_.is_group(piece)) return std::nullopt;
    if (!take_near(store_, store_.corners(piece), near_)) return std::nullopt;
    Int128 sum = 0;
    store_.each_loop(piece,
                     [&](uint32_t begin, uint32_t end) { sum += near_determinant(begin, end); });
    return sum;
  }

  /// Of a group, straight from the leaf; false if that is in a frame, or too far from the origin.
  bool add_near(uint32_t piece, PieceSums& out) const {
    const PieceStore::Piece& group = store_.piece(piece);
    if (!store_.map(group.operand).is_identity()) return false;
    const PieceBox& box = store_.box(piece);  // exact: of grid points
    for (size_t k = 0; k < 3; ++k) {
      const auto origin = static_cast<double>(store_.origin()[k]);
      if (box.lo[k] - origin <= -kNearLimit || box.hi[k] - origin >= kNearLimit) return false;
    }
    Int128 sum = 0;
    each_triangle(piece, store_.origin(), [&](const Near& a, const Near& b, const Near& c) {
      sum += determinant(a, b, c);
    });
    out.six_volumes += of_whole(group.is_flipped ? -sum : sum);
    return true;
  }

  /// Calls f(a, b, c) for the triangles of a group, relative to a point of the leaf's frame.
  template <class F>
  void each_triangle(uint32_t piece, IVec3 origin, F&& f) const {
    const Operand& operand = store_.operands()[store_.piece(piece).operand];
    const LeafGeometry& leaf = *operand.leaf;
    for (size_t k = 0; k < 3; ++k) origin[k] -= operand.translation[k];
    const auto at = [&](uint32_t corner) {
      const IVec3& v = leaf.vertices[leaf.corners[corner]];
      return Near{v[0] - origin[0], v[1] - origin[1], v[2] - origin[2]};
    };
    for (const uint32_t face : store_.group_faces(piece)) {
      const uint32_t first = leaf.face_starts[face], end = leaf.face_starts[face + 1];
      const Near a = at(first);
      Near b = at(first + 1);
      for (uint32_t i = first + 2; i < end; ++i) {
        const Near c = at(i);
        f(a, b, c);
        b = c;
      }
    }
  }

  /// Of a group of a leaf in a frame, from its whole numbers there; false if it is in none, or they
  /// are too large.
  bool add_framed(uint32_t piece, PieceSums& out) const {
    const PieceStore::Piece& group = store_.piece(piece);
    if (store_.map(group.operand).is_identity()) return false;
    FramedSums sums;
    bool are_near = true;
    each_triangle(piece, {0, 0, 0}, [&](const Near& a, const Near& b, const Near& c) {
      for (const Near& p : {a, b, c}) {
        for (const int64_t x : p) are_near = are_near && std::abs(x) < kNearLimit;
      }
      if (!are_near) return;
      const auto n = normal_of(a, b, c);
      for (size_t k = 0; k < 3; ++k) {
        sums.determinants += static_cast<Int128>(n[k]) * a[k];
        sums.normals[k] += n[k];
      }
    });
    if (!are_near) return false;
    bool cut = false;
    const Int<6> world = framed_determinants(sums, store_.map(group.operand), store_.origin(), cut);
    out.six_volumes += group.is_flipped ? -world : world;
    out.triangles += cut;  // one unit less, where a triangle is allowed many
    return true;
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
    if (store_.is_group(piece) && (add_near(piece, out) || add_framed(piece, out))) return true;
    bool is_in_range = true;
    store_.each_face(piece, [&](std::span<const uint32_t> corners) {
      bool cut = false;
      fixed_.resize(corners.size());
      for (size_t i = 0; i < corners.size(); ++i) {
        const PieceStore::CutPoint* known =
            is_in_range ? find_cut_point(store_, corners[i]) : nullptr;
        is_in_range = known != nullptr;
        if (!known) return;
        fixed_[i] = known->at;
        cut = cut || known->is_cut;
      }
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
  /// corner: to the sum of x_i (y_i+1 - y_i-1) along each axis. The bounds need not be close:
  /// lengths are rounded up to whole steps, and the two products of a cross product taken for as
  /// large as they may be.
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
        length[k] = std::fabs(static_cast<double>(static_cast<int64_t>(own[k].limb[1]))) + 1;
      }
      double sum = 0;
      for (size_t k = 0; k < 3; ++k) {
        const size_t x = (k + 1) % 3, y = (k + 2) % 3;
        // Of a level face, as of the large one that is cut again and again, few products are not 0.
        if (!own[x].is_zero() && !step[y].is_zero()) normal[k] += full_product(own[x], step[y]);
        area += last[x] * length[y] + last[y] * length[x];
        sum += length[k];
      }
      edges += 2 * sum;  // the first and the last are in one triangle only
      last = length;
    }
    for (size_t k = 0; k < 3; ++k) out.six_volumes += full_product(normal[k], a[k]);
    out.edges += edges;
    out.twice_area += area;
  }

  PieceStore& store_;
  std::vector<Near> near_;
  std::vector<Fixed> fixed_;
};

/// The points of pieces at the ends of their box.
class PieceEnds {
 public:
  explicit PieceEnds(const PieceStore& store) : store_(store) {}

  /// A point that reaches as far along an axis as any of the pieces below a node; `end`: 0 down, 1
  /// up. Only what reaches as far as the node is looked at, and the node keeps what was found.
  uint32_t of(const PieceTree::Node& node, size_t end, size_t axis) {
    uint32_t& found = node.ends[end][axis];
    if (found != kNone) return found;
    bool is_found_there = false;  // and another one there reaches no farther
    // Rounding is monotone: what is furthest has the furthest rounded coordinate.
    const double furthest = at(node.box, end, axis);
    const auto add = [&](uint32_t point) {
      const bool is_there = is_at(point, axis, furthest);
      if (is_there && is_found_there) return;
      if (found != kNone) {
        const int after =
            compare_along(store_.exact(point), store_.exact(found), static_cast<int>(axis));
        if (end == 0 ? after >= 0 : after <= 0) return;
      }
      found = point;
      is_found_there = is_there;
    };
    for (const PieceTree::NodePtr& child : node.child) {
      if (child && at(child->box, end, axis) == furthest) add(of(*child, end, axis));
    }
    for (const uint32_t piece : node.pieces) {
      if (at(store_.box(piece), end, axis) != furthest) continue;
      store_.each_face(piece, [&](std::span<const uint32_t> corners) {
        for (const uint32_t p : corners) {
          if (p != found && store_.rounded(p)[axis] == furthest) add(p);
        }
      });
    }
    return found;
  }

 private:
  static double at(const PieceBox& box, size_t end, size_t axis) {
    return end == 0 ? box.lo[axis] : box.hi[axis];
  }
  /// Whether a point is seen to have its rounded coordinate, a whole number, exactly: the points of
  /// a level face, of which there may be many, do.
  [[nodiscard]] bool is_at(uint32_t point, size_t axis, double coordinate) const {
    if (store_.is_on_grid(point)) return true;
    const auto& meeting = store_.point_planes(point);
    if (meeting[0] == PieceStore::kNoNumber || std::fabs(coordinate) >= 0x1p53) return false;
    const auto whole = static_cast<int64_t>(coordinate);
    if (static_cast<double>(whole) != coordinate) return false;
    return std::any_of(meeting.begin(), meeting.end(), [&](uint32_t p) {
      const Plane& plane = store_.planes.plane(p);
      const std::array<Int128, 3> normal{plane.a, plane.b, plane.c};
      // Reduced planes along an axis through a whole number are x = whole.
      return normal[(axis + 1) % 3] == 0 && normal[(axis + 2) % 3] == 0 &&
             (normal[axis] == 1 ? plane.d == -whole : normal[axis] == -1 && plane.d == whole);
    });
  }

  const PieceStore& store_;
};

/// A coordinate of a point of a store that is moved by whole steps, in mm.
double millimetres(const PieceStore& store, const ToMillimetres& to_millimetres, uint32_t point,
                   size_t axis, int64_t moved) {
  Point p = store.exact(point);
  if (moved != 0) {
    auto& coordinate = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
    coordinate += multiply<kPointLimbs>(p.w, Int<1>(moved));
    normalise(p);
  }
  glm::dvec3 mm;
  std::array<float, 3> single{};
  to_millimetres.position(p, mm, single);
  return mm[static_cast<int>(axis)];
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
                                                    const GridStep& step, const IVec3& moved) {
  const PieceTree::NodePtr& root = pieces.tree.root();
  if (!root) return std::nullopt;
  PieceEnds ends(*pieces.store);
  const ToMillimetres to_millimetres(step);
  std::array<glm::dvec3, 2> box;
  for (size_t end = 0; end < 2; ++end) {
    for (size_t axis = 0; axis < 3; ++axis) {
      box[end][static_cast<int>(axis)] =
          millimetres(*pieces.store, to_millimetres, ends.of(*root, end, axis), axis, moved[axis]);
    }
  }
  return box;
}

}  // namespace csgrun
