// Pieces of a plane against the unit squares that they are made of: which hang together, and what
// is left of their edges.
#include "engine/mesh/connected_pieces.h"

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace csgrun::connected_pieces_test {
namespace {

constexpr int kSide = 7;  // squares
using Corner = std::array<int, 2>;

/// A sloping plane with a lattice of points in it, and several planes through each of its lines.
class Lattice {
 public:
  Lattice() {
    support = planes.intern({1, 2, -1, 0});
    for (int i = 0; i <= kSide; ++i) {
      for (int k = 0; k < 2; ++k) {
        lines_[k][i][0] = line(k, i, 0);
        lines_[k][i][1] = line(k, i, 3);
      }
    }
    for (int y = 0; y <= kSide; ++y) {
      for (int x = 0; x <= kSide; ++x) {
        geometry.add_point({support.index(), lines_[0][x][0], lines_[1][y][0]});
      }
    }
  }

  static uint32_t point(Corner c) { return static_cast<uint32_t>(c[1] * (kSide + 1) + c[0]); }
  static Corner corner(uint32_t point) {
    return {static_cast<int>(point) % (kSide + 1), static_cast<int>(point) / (kSide + 1)};
  }

  /// An edge along an axis, by one of two planes.
  [[nodiscard]] DirectedEdge edge(Corner from, Corner to, unsigned which) const {
    const int k = from[0] == to[0] ? 0 : 1;
    return {point(from), point(to), lines_[k][from[k]][which % 2]};
  }

  PlaneTable planes;
  CellGeometry geometry{planes, nullptr};
  PlaneId support;

 private:
  /// The line at x = i or y = i as a plane: that plane, or one turned towards the support.
  uint32_t line(int axis, int i, int turn) {
    Plane p{turn, 2 * turn, -turn, -i};
    (axis == 0 ? p.a : p.b) += 1;
    return planes.intern(p).index();
  }

  std::array<std::array<std::array<uint32_t, 2>, kSide + 1>, 2> lines_{};
};

struct Pieces {
  std::vector<PieceEdge> edges;
  std::array<std::array<uint32_t, kSide>, kSide> of_square{};  ///< by y, x; kNone: none
  uint32_t count = 0;
};

/// Rectangles that do not overlap, some of them with corners in the middle of a side.
Pieces random_pieces(const Lattice& lattice, std::mt19937& random) {
  Pieces pieces;
  for (auto& row : pieces.of_square) row.fill(kNone);
  const unsigned share = 2 + random() % 4;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const auto is_free = [&](int i, int j) {
        return i < kSide && j < kSide && pieces.of_square[j][i] == kNone;
      };
      if (!is_free(x, y) || random() % share == 0) continue;
      int x1 = x + 1, y1 = y + 1;
      while (random() % 2 == 0 && is_free(x1, y)) ++x1;
      while (random() % 2 == 0) {
        bool all = true;
        for (int i = x; i < x1; ++i) all = all && is_free(i, y1);
        if (!all) break;
        ++y1;
      }
      for (int j = y; j < y1; ++j) {
        for (int i = x; i < x1; ++i) pieces.of_square[j][i] = pieces.count;
      }
      // Seen from outside, where the normal (1, 2, -1) points, x to y turns right.
      const std::array<Corner, 4> corners{{{x, y}, {x, y1}, {x1, y1}, {x1, y}}};
      for (size_t c = 0; c < 4; ++c) {
        const Corner from = corners[c], to = corners[(c + 1) % 4];
        Corner middle = to;
        for (size_t k = 0; k < 2; ++k) middle[k] = (from[k] + to[k]) / 2;
        const auto which = static_cast<unsigned>(random());
        if (middle != from && middle != to && random() % 3 == 0) {
          pieces.edges.push_back({lattice.edge(from, middle, which), pieces.count});
          pieces.edges.push_back({lattice.edge(middle, to, which / 2), pieces.count});
        } else {
          pieces.edges.push_back({lattice.edge(from, to, which), pieces.count});
        }
      }
      ++pieces.count;
    }
  }
  return pieces;
}

using Steps = std::map<std::pair<Corner, Corner>, uint32_t>;

/// Steps of length one, with the piece on their left, of all edges of squares that have no piece,
/// or none there, on the other side.
Steps steps_of(const Pieces& pieces) {
  Steps steps;
  const auto at = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < kSide && y < kSide ? pieces.of_square[y][x] : kNone;
  };
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const uint32_t own = at(x, y);
      if (own == kNone) continue;
      if (at(x - 1, y) == kNone) steps[{{x, y}, {x, y + 1}}] = own;
      if (at(x, y + 1) == kNone) steps[{{x, y + 1}, {x + 1, y + 1}}] = own;
      if (at(x + 1, y) == kNone) steps[{{x + 1, y + 1}, {x + 1, y}}] = own;
      if (at(x, y - 1) == kNone) steps[{{x + 1, y}, {x, y}}] = own;
    }
  }
  return steps;
}

TEST(ConnectedPieces, AreThoseOfTheirSquares) {
  std::mt19937 random(7);
  size_t together = 0, apart = 0;
  for (int round = 0; round < 1000; ++round) {
    Lattice lattice;
    Pieces pieces = random_pieces(lattice, random);
    std::shuffle(pieces.edges.begin(), pieces.edges.end(), random);
    UnionFind joined(pieces.count), expected(pieces.count);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const auto& of = pieces.of_square;
        if (of[y][x] == kNone) continue;
        if (x > 0 && of[y][x - 1] != kNone) expected.join(of[y][x], of[y][x - 1]);
        if (y > 0 && of[y - 1][x] != kNone) expected.join(of[y][x], of[y - 1][x]);
      }
    }
    PointView points(lattice.geometry);
    ASSERT_TRUE(join_neighbours(lattice.support, pieces.edges, points, lattice.planes, joined));
    for (uint32_t p = 0; p < pieces.count; ++p) {
      ASSERT_EQ(joined.find(p), expected.find(p)) << "round " << round;
      ++(joined.find(p) == p ? apart : together);
    }
    Steps left;
    for (const PieceEdge& e : pieces.edges) {
      Corner at = Lattice::corner(e.edge.from);
      const Corner to = Lattice::corner(e.edge.to);
      ASSERT_EQ(lattice.geometry.side(e.edge.plane, e.edge.from), 0);
      ASSERT_EQ(lattice.geometry.side(e.edge.plane, e.edge.to), 0);
      while (at != to) {
        Corner next = at;
        for (size_t k = 0; k < 2; ++k) next[k] += (to[k] > at[k]) - (to[k] < at[k]);
        ASSERT_TRUE(left.emplace(std::pair(at, next), e.piece).second) << "round " << round;
        at = next;
      }
    }
    ASSERT_EQ(left, steps_of(pieces)) << "round " << round;
  }
  EXPECT_GT(together, 500u);
  EXPECT_GT(apart, 500u);
}

}  // namespace
}  // namespace csgrun::connected_pieces_test
