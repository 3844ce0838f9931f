// The orientation of four points: never wrong, and told wherever it can be. In GMP.
#include "engine/bsp/vertex_signs.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/bsp/grid_planes.h"
#include "engine/bsp/piece_store.h"
#include "engine/bsp/result_pieces.h"
#include "tests/support/exact_solid.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"

namespace csgrun::vertex_signs_test {
namespace {

using test::Rational3;

int sign_of(const std::array<IVec3, 4>& p) {
  std::array<Rational3, 3> way;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) way[i][k] = mpz_class(p[i + 1][k] - p[0][k]);
  }
  return sgn(test::dot(way[0], test::cross(way[1], way[2])));
}

std::array<double, 3> rounded(const IVec3& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

/// Four points within 2^bits along each axis, in one plane or next to one, mostly.
std::array<IVec3, 4> random_points(test::Random& random, const std::array<int, 3>& bits) {
  const auto vector = [&](int less) {
    IVec3 v;
    for (int k = 0; k < 3; ++k) {
      const int64_t reach = int64_t{1} << std::max(1, bits[k] - less);
      v[k] = random.integer(-reach, reach);
    }
    return v;
  };
  std::array<IVec3, 4> p{vector(3)};
  const IVec3 u = vector(3);
  IVec3 v = vector(3);
  if (random.integer(0, 3) == 0) {  // nearly along u
    for (int k = 0; k < 3; ++k) v[k] = u[k] + random.integer(-1, 1);
  }
  for (int k = 0; k < 3; ++k) {
    p[1][k] = p[0][k] + u[k], p[2][k] = p[0][k] + v[k];
    p[3][k] = p[0][k] + u[k] + v[k] * (random.integer(0, 1) ? 1 : -1) +
              (random.integer(0, 2) ? random.integer(-1, 1) : 0);
  }
  if (random.integer(0, 5) == 0) p[3] = vector(3);
  return p;
}

TEST(VertexSigns, OnTheGridAreExact) {
  test::Random random(51);
  const std::vector<Operand> operands{test::operand_of(test::box_leaf({0, 0, 0}, {1, 1, 1}))};
  VertexSigns signs(Job(operands), false);
  EXPECT_EQ(signs.error(0), 0);
  size_t zeros = 0;
  for (int i = 0; i < 20000; ++i) {
    std::array<int, 3> bits;
    for (int& b : bits) b = static_cast<int>(random.integer(4, i % 2 ? 40 : 12));
    const auto p = random_points(random, bits);
    const uint64_t filtered = signs.filtered, exact = signs.exact;
    const int expected = sign_of(p);
    ASSERT_EQ(signs.orient(rounded(p[0]), rounded(p[1]), rounded(p[2]), rounded(p[3]), 0),
              expected);
    ASSERT_EQ(signs.filtered + signs.exact, filtered + exact + 1);
    if (expected == 0) {
      ASSERT_EQ(signs.exact, exact + 1);
    }
    zeros += expected == 0;
  }
  EXPECT_GT(zeros, 500u);
  EXPECT_GT(signs.filtered, 5000u);
  EXPECT_GT(signs.exact, zeros + 50);
}

TEST(VertexSigns, OfFarPointsAreToldByDoublesOrNotAtAll) {
  const std::vector<Operand> operands{test::operand_of(test::box_leaf({0, 0, 0}, {1, 1, 1}))};
  VertexSigns signs(Job(operands), false);
  const double far = 0x1p40;
  // In one plane: exact below 2^40 only.
  EXPECT_EQ(signs.orient({0, 0, 0}, {far - 1, 0, 0}, {0, 1, 0}, {5, 5, 0}, 0), 0);
  EXPECT_EQ(signs.orient({0, 0, 0}, {far, 0, 0}, {0, 1, 0}, {5, 5, 0}, 0), kUnsure);
  EXPECT_EQ(signs.orient({0, 0, 0}, {4, 0, 0}, {0, far, 0}, {5, 5, 0}, 0), kUnsure);
  EXPECT_EQ(signs.orient({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {far, 5, 0}, 0), kUnsure);
  EXPECT_EQ(signs.orient({0, 0, 0}, {far, 0, 0}, {0, 1, 0}, {5, 5, 9}, 0), 1);
  EXPECT_EQ(signs.orient({0, 0, 0}, {far, 0, 0}, {0, 1, 0}, {5, 5, -9}, 0), -1);
}

// Coordinates are off by an error: what is told is told of the true points, too.
TEST(VertexSigns, OfRoundedPointsAreNeverWrong) {
  test::Random random(52);
  const std::vector<Operand> operands{test::operand_of(test::box_leaf({0, 0, 0}, {1, 1, 1}))};
  VertexSigns signs(Job(operands), false);
  size_t told = 0, unsure = 0;
  for (int i = 0; i < 20000; ++i) {
    std::array<int, 3> bits;
    for (int& b : bits) b = static_cast<int>(random.integer(4, 24));
    const auto p = random_points(random, bits);
    const double error = std::ldexp(1, static_cast<int>(random.integer(-12, 2)));
    std::array<std::array<double, 3>, 4> off;
    for (size_t k = 0; k < 4; ++k) {
      off[k] = rounded(p[k]);
      for (double& c : off[k]) c += error * static_cast<double>(random.integer(-1, 1));
    }
    const int sign = signs.orient(off[0], off[1], off[2], off[3], error);
    if (sign == kUnsure) {
      ++unsure;
    } else {
      ASSERT_EQ(sign, sign_of(p)) << "case " << i;
      ++told;
    }
  }
  EXPECT_GT(told, 2000u);
  EXPECT_GT(unsure, 2000u);
}

TEST(VertexSigns, ErrorsAreHalfAUnitInTheLastPlaceOfTheLargestCoordinate) {
  test::Random random(53);
  for (int i = 0; i < 20; ++i) {
    std::vector<Operand> operands;
    for (int o = 0; o < 3; ++o) {
      operands.push_back(
          test::operand_of(test::box_leaf({0, 0, 0}, {3, 4 + o, 900 >> (o * i % 7)})));
      if (random.integer(0, 2)) operands.back().frame = test::random_frame(random);
    }
    const Job job(operands);
    const VertexSigns signs(job, false);
    for (uint32_t o = 0; o < operands.size(); ++o) {
      double largest = 0;
      for (const Rational3& p : test::exact_solid(operands[o]).points) {
        for (const mpq_class& c : p) largest = std::max(largest, std::fabs(c.get_d()));
      }
      if (operands[o].frame.is_identity) {
        EXPECT_EQ(signs.error(o), 0);
      } else {
        EXPECT_NEAR(signs.error(o), largest * 0x1p-53, largest * 0x1p-70);
      }
    }
  }
}

TEST(VertexSigns, OfResultsAreRoundedEvenOnTheGrid) {
  const std::vector<Operand> boxes{test::operand_of(test::box_leaf({0, 0, 0}, {4, 4, 4})),
                                   test::operand_of(test::box_leaf({2, 2, 2}, {6, 7, 8}))};
  const auto result = test::evaluate(test::join({test::leaf(0), test::leaf(1)}), boxes);
  ASSERT_TRUE(result);
  std::vector<Operand> operands(1);
  operands[0].boundary = *result;
  EXPECT_GE(VertexSigns(Job(operands), false).error(0), 8 * 0x1p-53);
}

// Pieces near the tool may all be on the grid when others, which rays meet, are not.
TEST(VertexSigns, OfPiecesAreExactWhereTheJobHasThemOnTheGrid) {
  // A box less one that leans: corners off the grid at one end only.
  std::vector<Operand> operands{test::operand_of(test::box_leaf({0, 0, 0}, {60, 10, 10})),
                                test::operand_of(test::box_leaf({50, 3, 3}, {64, 7, 8}))};
  operands[1].frame = test::frame_of(test::turn_about(0, 1));
  const GridBox region{{-99, -99, -99}, {99, 99, 99}};
  EvaluateStats stats;
  const auto version = evaluate_pieces(operands, test::flat_expression(BooleanOp::kDifference, 2),
                                       region, {}, stats);
  ASSERT_TRUE(version && *version);
  const auto error = [&](const IVec3& lo, const IVec3& hi, bool whole_results) {
    Operand pieces;
    pieces.pieces =
        std::make_shared<PieceOperand>(PieceOperand{(*version)->store, (*version)->tree});
    const std::vector<Operand> both{test::operand_of(test::box_leaf(lo, hi)), pieces};
    const Job job(both, &(*version)->store->planes);
    EXPECT_GT(job.polygon_start(2), job.polygon_start(1));
    return VertexSigns(job, whole_results).error(1);
  };
  EXPECT_EQ(error({-1, 2, 2}, {3, 4, 4}, false), 0);
  EXPECT_GT(error({-1, 2, 2}, {3, 4, 4}, true), 0);
  EXPECT_GT(error({55, 2, 2}, {70, 4, 4}, false), 0);
}

TEST(GridPlanes, PassThroughTheirPointsAndHaveALongestAxis) {
  test::Random random(54);
  const auto at = [](const Plane& s, const IVec3& p) {
    return s.a * p[0] + s.b * p[1] + s.c * p[2] + s.d;
  };
  for (int i = 0; i < 500; ++i) {
    const int64_t reach = int64_t{1} << random.integer(1, 26);
    std::array<IVec3, 4> p;
    for (IVec3& v : p) {
      for (int64_t& c : v) c = random.integer(-reach, reach);
    }
    const Plane s = plane_through(p[0], p[1], p[2]);
    for (int k = 0; k < 3; ++k) ASSERT_EQ(at(s, p[k]), 0);
    const Int128 value = at(s, p[3]);
    ASSERT_EQ((value > 0) - (value < 0), sign_of(p));
    const std::array<Int128, 3> n{s.a, s.b, s.c};
    const auto size = [](Int128 v) { return v < 0 ? -v : v; };
    for (int k = 0; k < 3; ++k) ASSERT_LE(size(n[k]), size(n[dominant_axis(s)]));
    const int axis = static_cast<int>(random.integer(0, 2));
    const Plane edge = edge_plane(p[0], p[1], axis);
    ASSERT_EQ((std::array<Int128, 3>{edge.a, edge.b, edge.c})[axis], 0);
    ASSERT_EQ(at(edge, p[0]), 0);
    ASSERT_EQ(at(edge, p[1]), 0);
  }
}

// Straight angles anywhere, in planes along the axes and others.
TEST(GridPlanes, OfLoopsWithStraightCorners) {
  const std::vector<IVec3> flat{{0, 0, 0}, {1, 0, 0}, {4, 0, 0}, {4, 2, 0}, {4, 3, 0},
                                {2, 3, 0}, {1, 3, 0}, {0, 3, 0}, {0, 2, 0}};
  for (int axis = 0; axis < 3; ++axis) {
    for (const int64_t slope : {0, 1, -2}) {
      for (size_t start = 0; start < flat.size(); ++start) {
        for (size_t count = 3; count <= flat.size(); ++count) {
          // A convex loop of so many of the corners, some of them straight.
          std::vector<IVec3> loop;
          for (size_t i = 0; i < count; ++i) {
            IVec3 p = flat[(start + i) % flat.size()];
            p[2] = slope * (p[0] + 2 * p[1]);
            std::rotate(p.begin(), p.begin() + axis, p.end());
            loop.push_back(p);
          }
          const bool is_line = [&] {
            for (size_t i = 0; i < count; ++i) {
              const Plane s = plane_through(loop[i], loop[(i + 1) % count], loop[(i + 2) % count]);
              if (s.a != 0 || s.b != 0 || s.c != 0) return false;
            }
            return true;
          }();
          if (is_line) continue;
          const Plane s =
              support_of_loop(static_cast<uint32_t>(count),
                              [&](uint32_t i) -> const IVec3& { return loop[i % count]; });
          ASSERT_FALSE(s.a == 0 && s.b == 0 && s.c == 0) << start << ' ' << count;
          for (const IVec3& p : loop) ASSERT_TRUE(s.a * p[0] + s.b * p[1] + s.c * p[2] + s.d == 0);
          // Left turns, seen from the third axis.
          const Int128 up = axis == 0 ? s.c : axis == 1 ? s.b : s.a;
          ASSERT_TRUE(up > 0);
        }
      }
    }
  }
}

}  // namespace
}  // namespace csgrun::vertex_signs_test
