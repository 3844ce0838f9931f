// A piece is flat, so that its area is the length of the sum of its triangles' normals, whatever
// holes it has. Coordinates are whole, or cut to 64 fractional bits: with u the unit of the last
// digit and M the extent, twice the area of each triangle is wrong by less than 16 u M, in the
// presented solid, too (fixed_sums.h).
#include "engine/mesh/pieces_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "engine/base/double_double.h"
#include "engine/mesh/cut_points.h"
#include "engine/mesh/fixed_sums.h"
#include "engine/mesh/leading_bits.h"
#include "engine/mesh/measure.h"

namespace csgrun {
namespace {

class AreaSummer {
 public:
  explicit AreaSummer(PieceStore& store) : store_(store) {}

  /// The sums below a node, which keeps them; null when a point is out of range.
  const PieceArea* sums(const PieceTree::Node& node) {
    if (node.area) return node.area.get();
    auto own = std::make_unique<PieceArea>();
    for (const uint32_t piece : node.pieces) {
      if (!add_piece(piece, *own)) return nullptr;
    }
    for (const PieceTree::NodePtr& child : node.child) {
      if (!child) continue;
      const PieceArea* below = sums(*child);
      if (!below) return nullptr;
      own->twice_area = own->twice_area + below->twice_area;
      own->corners += below->corners;
      own->is_cut = own->is_cut || below->is_cut;
    }
    node.area = std::move(own);
    return node.area.get();
  }

 private:
  bool add_piece(uint32_t piece, PieceArea& out) {
    bool is_in_range = true;
    store_.each_face(piece, [&](std::span<const uint32_t> corners) {
      out.corners += corners.size();
      if (take_near(store_, corners, near_)) {
        std::array<Int128, 3> normal{};
        each_loop(piece, corners.size(), [&](uint32_t begin, uint32_t end) {
          for (uint32_t i = begin + 1; i + 1 < end; ++i) {
            const auto n = normal_of(near_[begin], near_[i], near_[i + 1]);
            for (size_t k = 0; k < 3; ++k) normal[k] += n[k];
          }
        });
        add_length({double_double(Int<2>::from_int128(normal[0])),
                    double_double(Int<2>::from_int128(normal[1])),
                    double_double(Int<2>::from_int128(normal[2]))},
                   out);
      } else if (take_fixed(corners, out)) {
        std::array<Int<4>, 3> normal;
        each_loop(piece, corners.size(), [&](uint32_t begin, uint32_t end) {
          for (uint32_t i = begin + 1; i + 1 < end; ++i) add_normal(begin, i, normal);
        });
        add_length({double_double(normal[0], -2), double_double(normal[1], -2),
                    double_double(normal[2], -2)},
                   out);
      } else {
        is_in_range = false;
      }
    });
    return is_in_range;
  }

  /// The loops of a piece; a face of a group has one.
  template <class F>
  void each_loop(uint32_t piece, size_t corners, F&& f) const {
    if (store_.is_group(piece)) {
      f(0u, static_cast<uint32_t>(corners));
    } else {
      store_.each_loop(piece, f);
    }
  }

  static void add_length(const std::array<DoubleDouble, 3>& n, PieceArea& out) {
    out.twice_area = out.twice_area + sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  }

  bool take_fixed(std::span<const uint32_t> corners, PieceArea& out) {
    fixed_.clear();
    for (const uint32_t point : corners) {
      const PieceStore::CutPoint* cut = find_cut_point(store_, point);
      if (!cut) return false;
      fixed_.push_back(cut->at);
      out.is_cut = out.is_cut || cut->is_cut;
    }
    return true;
  }

  void add_normal(size_t a, size_t b, std::array<Int<4>, 3>& normal) const {
    for (size_t k = 0; k < 3; ++k) {
      const size_t i = (k + 1) % 3, j = (k + 2) % 3;
      const auto side = [&](size_t to, size_t axis) { return fixed_[to][axis] - fixed_[a][axis]; };
      normal[k] += full_product(side(b, i), side(b + 1, j));
      normal[k] -= full_product(side(b + 1, i), side(b, j));
    }
  }

  PieceStore& store_;
  std::vector<Near> near_;
  std::vector<std::array<Int<2>, 3>> fixed_;
};

}  // namespace

std::optional<double> pieces_area(const ResultPieces& pieces, const GridStep& step) {
  const PieceTree::NodePtr& root = pieces.tree.root();
  if (!root) return 0.0;
  const PieceArea* sums = AreaSummer(*pieces.store).sums(*root);
  if (!sums) return std::nullopt;
  // What either sum may be away from the true one. The solid's triangles are fewer than the corners
  // here and those that T-junctions add, and it takes its points relative to one of them.
  double error = 0x1p-75 * sums->twice_area.hi;
  if (sums->is_cut) {
    double extent = 1;
    for (size_t k = 0; k < 3; ++k) extent = std::max(extent, root->box.hi[k] - root->box.lo[k] + 1);
    for (size_t k = 0; k < 3; ++k) {
      const auto origin = static_cast<double>(pieces.store->origin()[k]);
      extent = std::max({extent, std::fabs(root->box.lo[k] - origin) + 1,
                         std::fabs(root->box.hi[k] - origin) + 1});
    }
    constexpr double kTriangles = 8;  // a corner at most, and far more than there are
    error += std::ldexp(16 * extent * kTriangles * static_cast<double>(sums->corners), -kFraction);
  }
  const double low = round_area(sums->twice_area - error, step);
  if (low != round_area(sums->twice_area + error, step)) return std::nullopt;
  return low;
}

}  // namespace csgrun
