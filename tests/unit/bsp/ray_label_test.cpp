// Whether a point is inside an operand, against winding numbers in rational arithmetic: what
// doubles tell must be true, however wrong the point may be, and they must tell where they can.
#include "engine/bsp/ray_label.h"

#include <algorithm>
#include <array>
#include <utility>

#include <gtest/gtest.h>

#include "engine/bsp/result_pieces.h"
#include "tests/support/exact_solid.h"
#include "tests/support/kernel_case.h"
#include "tests/support/oracle.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"

namespace csgrun::ray_label_test {
namespace {

using test::Query;

/// The directions of rays (ray_label.cpp): here so that rays can be sent through corners.
constexpr double kDirections[3][2] = {
    {0.0142578125, 0.0081787109375}, {0.0313720703125, 0.0117}, {0.0057373046875, 0.0427}};

struct Operands {
  explicit Operands(const Operand& operand)
      : list{operand},
        job(list),
        signs(job, true),
        boxes(job),
        oracle(test::exact_solid(operand)) {}
  explicit Operands(const std::vector<test::Loop>& loops)
      : Operands(test::operand_of(test::make_leaf(loops))) {}

  /// 1 inside, 0 outside, -1 not told.
  int label(const Query& at, double error = 0) {
    const Inside label = ray_label(job, signs, boxes, 0, at, error);
    return label == Inside::kUnknown ? -1 : label == Inside::kYes ? 1 : 0;
  }

  const std::vector<Operand> list;
  const Job job;
  VertexSigns signs;
  RayBoxes boxes;
  const test::Oracle oracle;
};

TEST(RayLabel, IsTheWindingNumber) {
  test::Random random(501);
  int inside = 0, outside = 0;
  for (int i = 0; i < 150; ++i) {
    Operands solid(test::random_loops(random));
    for (int k = 0; k < 60; ++k) {
      Query at;
      for (double& c : at) c = static_cast<double>(random.integer(-2, 24)) / 4 + 1. / 64;
      const auto truth = solid.oracle.winding(at);
      if (!truth) continue;
      ASSERT_EQ(solid.label(at), *truth) << at[0] << ' ' << at[1] << ' ' << at[2];
      ++(*truth ? inside : outside);
    }
  }
  EXPECT_GT(inside, 300);
  EXPECT_GT(outside, 500);
}

// Three corners that hardly turn do not hide what others tell.
TEST(RayLabel, OfFacesWithShortEdges) {
  constexpr int64_t kFar = 100'000;
  std::vector<IVec3> points;
  for (const int64_t x : {int64_t{0}, kFar}) {
    // The lowest corner, where loops begin, has a short edge on either side.
    for (const auto& [y, z] : {std::pair<int64_t, int64_t>{0, 0},
                               {1, 0},
                               {kFar, 10},
                               {kFar, kFar},
                               {10, kFar},
                               {0, 1}}) {
      points.push_back({x, y, z});
    }
  }
  Operands prism(test::hull_loops(points));
  test::Random random(511);
  for (int i = 0; i < 200; ++i) {
    Query at;
    for (double& c : at) c = static_cast<double>(random.integer(kFar / 4, kFar / 2)) + 1. / 64;
    for (const bool is_inside : {true, false}) {
      at[0] = is_inside ? at[0] : -at[0];
      ASSERT_EQ(prism.label(at, 0.001), is_inside ? 1 : 0) << i;
    }
  }
}

// Of an operand that many rays are sent through, bins are asked, and say the same.
TEST(RayLabel, OfManyRaysIsTheSame) {
  test::Random random(507);
  int told[2] = {}, binned = 0;
  for (int i = 0; i < 12; ++i) {
    // Bodies beside one another, on a small grid and a large one, some of them long.
    const int64_t step = i % 2 == 0 ? 12 : 3000, along = i % 3 == 0 ? 40 : 1;
    std::vector<test::Loop> loops;
    for (int64_t n = 0; n < 27; ++n) {
      std::vector<IVec3> points(8);
      for (IVec3& p : points) {
        p = {step * (n % 3), step * (n / 3 % 3), step * (n / 9)};
        for (int64_t& c : p) c += random.integer(0, step - 1);
        p[0] *= along;
      }
      for (test::Loop& loop : test::hull_loops(points)) loops.push_back(std::move(loop));
    }
    Operands many(loops);
    ASSERT_GT(many.boxes.face_count(0), 2 * RayBoxes::kEach);
    for (int k = 0; k < 600; ++k) {
      Query at;
      for (double& c : at) {
        c = static_cast<double>(random.integer(-step, 16 * step)) / 4 + 1. / 64;
      }
      at[0] *= static_cast<double>(along);
      const double error = k % 3 == 0 ? 0.875 : 0;
      RayBoxes few(many.job);
      const Inside expected = ray_label(many.job, many.signs, few, 0, at, error);
      ASSERT_EQ(ray_label(many.job, many.signs, many.boxes, 0, at, error), expected) << i << k;
      const auto near = many.boxes.along_first(0, at);
      ASSERT_EQ(near.has_value(), k >= 127) << "two rays each are counted here";
      binned += near && near->size() < many.boxes.face_count(0) / 2 ? 1 : 0;
      const auto truth = many.oracle.winding(at);
      if (!truth || error > 0 || expected == Inside::kUnknown) continue;
      ASSERT_EQ(expected == Inside::kYes, *truth == 1) << i << ' ' << k;
      ++told[*truth];
    }
  }
  EXPECT_GT(told[0], 500);
  EXPECT_GT(told[1], 100);
  EXPECT_GT(binned, 3000);
}

// A ray that passes through a corner says nothing; the next one does.
TEST(RayLabel, OfPointsWhoseRayPassesThroughACorner) {
  test::Random random(502);
  int inside = 0, outside = 0;
  for (int i = 0; i < 300; ++i) {
    auto loops = test::random_loops(random, 4);
    // A corner to the origin, near which doubles are exact.
    const auto& loop = loops[static_cast<size_t>(random.integer(0, loops.size() - 1))];
    test::GridMap map;
    for (int k = 0; k < 3; ++k) map.move[k] = -loop[0][k];
    Operands solid(test::mapped(loops, map));
    for (const auto& [y, z] : kDirections) {
      for (const double back : {0.5, 1.0, 2.0, 4.0}) {
        const Query at{-back, -back * y, -back * z};
        const auto truth = solid.oracle.winding(at);
        if (!truth) continue;
        ASSERT_EQ(solid.label(at), *truth) << i << ": " << back << ' ' << y;
        ++(*truth ? inside : outside);
      }
    }
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(outside, 500);
}

// The same in front of edges, where a ray meets two faces in one point.
TEST(RayLabel, OfPointsWhoseRayPassesThroughAnEdge) {
  test::Random random(503);
  int told = 0;
  for (int i = 0; i < 300; ++i) {
    auto loops = test::random_loops(random, 4);
    for (test::Loop& l : loops) {
      for (IVec3& p : l) {
        for (int64_t& c : p) c *= 2;
      }
    }
    const auto& loop = loops[static_cast<size_t>(random.integer(0, loops.size() - 1))];
    test::GridMap map;
    for (int k = 0; k < 3; ++k) map.move[k] = -(loop[0][k] + loop[1][k]) / 2;
    Operands solid(test::mapped(loops, map));
    for (const auto& [y, z] : kDirections) {
      for (const double back : {1.0, 4.0}) {
        const Query at{-back, -back * y, -back * z};
        const auto truth = solid.oracle.winding(at);
        if (!truth) continue;
        ASSERT_EQ(solid.label(at), *truth) << i << ": " << back << ' ' << y;
        ++told;
      }
    }
  }
  EXPECT_GT(told, 1000);
}

// A point may be anywhere around the one given: what is said must be true of all of them.
TEST(RayLabel, HoldsForAllPointsThatMayBeMeant) {
  test::Random random(504);
  int told = 0, open = 0;
  for (int i = 0; i < 600; ++i) {
    Operands solid(test::random_loops(random, 4));
    for (int k = 0; k < 60; ++k) {
      const double error = std::ldexp(1.0, -static_cast<int>(random.integer(0, 8))) * 0.9;
      Query at, meant;
      for (int c = 0; c < 3; ++c) {
        at[c] = static_cast<double>(random.integer(-8, 40)) / 8 + 1. / 64;
        meant[c] = at[c] + error * (random.integer(0, 1) ? 1 : -1) * (1 - random.unit() / 16);
      }
      const auto truth = solid.oracle.winding(meant);
      if (!truth) continue;
      const int label = solid.label(at, error);
      if (label >= 0) {
        ASSERT_EQ(label, *truth) << i << ' ' << k << " error " << error;
      }
      ++(label >= 0 ? told : open);
    }
  }
  EXPECT_GT(told, 10000);
  EXPECT_GT(open, 1000);
}

// The corners of a turned leaf are rounded; those of a very large one by much.
TEST(RayLabel, OfTurnedLeaves) {
  test::Random random(505);
  int told = 0, inside = 0, far = 0;
  for (int i = 0; i < 200; ++i) {
    Operand operand = test::operand_of(test::make_leaf(test::random_loops(random, 4)));
    operand.frame = test::random_frame(random);
    Operands solid(operand);
    for (int k = 0; k < 30; ++k) {
      const auto& points = solid.oracle.solid().points;
      const auto& p = points[static_cast<size_t>(random.integer(0, points.size() - 1))];
      Query at;
      const double scale = random.integer(0, 3) ? 2 : 1e-13;
      for (int c = 0; c < 3; ++c) at[c] = p[c].get_d() + scale * (random.unit() - 0.5);
      const auto truth = solid.oracle.winding(at);
      if (!truth) continue;
      const int label = solid.label(at);
      if (label >= 0) {
        ASSERT_EQ(label, *truth) << i << ' ' << k;
      }
      told += label >= 0;
      inside += label == 1;
      far += scale == 2 && label < 0;
    }
  }
  EXPECT_GT(told, 3000);
  EXPECT_GT(inside, 300);
  EXPECT_LT(far, 30);
}

// Boxes are clamped at 2^30: a leaf that reaches farther is met beyond, too.
TEST(RayLabel, OfLeavesThatReachBeyondBoxes) {
  const int64_t far = int64_t{1} << 36;
  Operands box(test::box_loops({-far, -far, -far}, {far, far, far}));
  Operands beside(test::box_loops({5, -far, -far}, {far, far, far}));
  Operands flat(test::box_loops({-far, -far, -5}, {far, far, 7}));
  for (const double x : {-0x1p29, -1000.25, 0.25, 4.75, 5.25, 0x1p29}) {
    EXPECT_EQ(box.label({x, 0.5, 0.25}), 1) << x;
    EXPECT_EQ(beside.label({x, 0.5, 0.25}), x > 5) << x;
    EXPECT_EQ(flat.label({0.25, x, -4.75}), 1) << x;
    EXPECT_EQ(flat.label({0.25, 0.5, x}), std::fabs(x) < 7 && x > -5) << x;
  }
  // Points that boxes do not reach are not told.
  for (int k = 0; k < 3; ++k) {
    for (const double c : {-0x1p30, 0x1p30, 0x1p33}) {
      Query at{0.5, 0.5, 0.5};
      at[k] = c;
      EXPECT_EQ(box.label(at), -1) << k << ' ' << c;
    }
    Query at{0.5, 0.5, 0.5};
    at[k] = 0x1p30 - 0.5;
    EXPECT_EQ(box.label(at), 1) << k;
    at[k] = -0x1p30 + 0.5;
    EXPECT_EQ(box.label(at), 1) << k;
  }
}

// What a ray meets there may have nothing of its box near the ray's start.
TEST(RayLabel, OfPolygonsThatAreWhollyBeyondBoxes) {
  // A bar that grows from near to far, closed by two triangles there, of which the ray meets the
  // one that lies where y is large.
  const int64_t far = int64_t{1} << 36, grows = int64_t{1} << 25;
  const std::array<IVec3, 4> near{{{-8, -64, 0}, {-8, 8, -64}, {-8, 64, 0}, {-8, 8, 64}}};
  std::array<IVec3, 4> end = near;
  for (IVec3& p : end) p = {far, p[1] * grows, p[2] * grows};
  std::vector<test::Loop> loops{
      {near[0], near[3], near[2], near[1]}, {end[0], end[1], end[3]}, {end[1], end[2], end[3]}};
  for (size_t i = 0; i < 4; ++i) {
    const size_t j = (i + 1) % 4;
    loops.push_back({near[i], near[j], end[j], end[i]});
  }
  Operands bar(loops);
  EXPECT_EQ(bar.label({0.25, 0.5, 0.25}), 1);
  EXPECT_EQ(bar.label({-9.25, 0.5, 0.25}), 0);
}

// The same as in the midst of the grid, where differences are rounded.
TEST(RayLabel, OfPointsWhoseRayPassesByACornerFarOut) {
  test::Random random(506);
  int told = 0;
  for (int i = 0; i < 400; ++i) {
    auto loops = test::random_loops(random, 4);
    const IVec3 corner = loops[static_cast<size_t>(random.integer(0, loops.size() - 1))][0];
    test::GridMap map;
    for (int k = 0; k < 3; ++k) map.move[k] = random.integer(1 << 20, 1 << 26);
    Operands solid(test::mapped(loops, map));
    for (const auto& [y, z] : kDirections) {
      const double back = std::ldexp(1 + random.unit(), static_cast<int>(random.integer(-2, 3)));
      const Query at{corner[0] + map.move[0] - back, corner[1] + map.move[1] - back * y,
                     corner[2] + map.move[2] - back * z};
      const auto truth = solid.oracle.winding(at);
      if (!truth) continue;
      ASSERT_EQ(solid.label(at), *truth) << i << ": " << back << ' ' << y;
      ++told;
    }
  }
  EXPECT_GT(told, 1000);
}

// Beside a straight angle the start of a face says nothing about its plane: other corners do.
TEST(RayLabel, OfFacesThatStartWithCornersInLine) {
  std::vector<test::Loop> loops = test::with_middles(test::box_loops({0, 0, 0}, {4, 4, 4}));
  for (int turn = 0; turn < 8; ++turn) {
    Operands box(loops);
    for (double x = -1.75; x < 6; x += 1) {
      EXPECT_EQ(box.label({x, 1.25, 2.75}), x > 0 && x < 4) << x;
    }
    for (test::Loop& loop : loops) std::rotate(loop.begin(), loop.begin() + 1, loop.end());
  }
}

// Regions of a result in pieces have holes and corners that turn right.
TEST(RayLabel, OfRegions) {
  test::Random random(508);
  int inside = 0, outside = 0;
  size_t regions = 0, loops = 0;
  for (int i = 0; i < 150; ++i) {
    // A box with holes and notches.
    std::vector<Operand> operands{test::operand_of(test::box_leaf({0, 0, 0}, {5, 5, 5}))};
    for (int k = 0; k < 2; ++k) {
      operands.push_back(test::operand_of(test::make_leaf(test::random_loops(random, 4))));
      for (int64_t& t : operands.back().translation) t = random.integer(-1, 3);
    }
    if (i % 3 == 0) operands[1].frame = test::random_frame(random);
    EvaluateStats stats;
    const auto made = evaluate_pieces(operands, test::flat_expression(BooleanOp::kDifference, 3),
                                      test::region_of(operands), {}, stats);
    ASSERT_TRUE(made);
    if (!*made) continue;
    PieceStore& store = *(*made)->store;
    (*made)->tree.each([](const PieceBox&) { return true; },
                       [&](uint32_t p) {
                         regions += store.is_region(p);
                         store.each_loop(p, [&](uint32_t, uint32_t) { ++loops; });
                         if (!store.is_region(p)) --loops;
                       });
    std::vector<Operand> list{test::operand_of(test::box_leaf({50, 50, 50}, {51, 51, 51})), {}};
    list[1].pieces = std::make_shared<PieceOperand>(PieceOperand{(*made)->store, (*made)->tree});
    const Job job(list, &store.planes);
    VertexSigns signs(job, true);
    RayBoxes boxes(job);
    std::vector<test::Oracle> oracles;
    for (const Operand& o : operands) oracles.emplace_back(test::exact_solid(o));
    for (int k = 0; k < 60; ++k) {
      Query at;
      for (double& c : at) c = static_cast<double>(random.integer(-2, 24)) / 4 + 1. / 64;
      std::array<std::optional<int>, 3> windings;
      for (size_t o = 0; o < 3; ++o) windings[o] = oracles[o].winding(at);
      if (!windings[0] || !windings[1] || !windings[2]) continue;
      const bool truth = *windings[0] == 1 && *windings[1] == 0 && *windings[2] == 0;
      const Inside label = ray_label(job, signs, boxes, 1, at, 0);
      if (label == Inside::kUnknown) continue;
      ASSERT_EQ(label == Inside::kYes, truth) << i << ": " << at[0] << ' ' << at[1] << ' ' << at[2];
      ++(truth ? inside : outside);
    }
  }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(outside, 3000);
  EXPECT_GT(regions, 300u);
  EXPECT_GT(loops, regions + 10);
}

// From the second point on boxes around sixteen polygons each leave out most.
TEST(RayLabel, IsTheWindingNumberOfMuch) {
  test::Random random(509);
  int inside = 0, outside = 0;
  size_t runs = 0, polygons = 0;
  for (int i = 0; i < 40; ++i) {
    std::vector<test::Loop> loops;
    for (int64_t k = 0; k < 8; ++k) {
      for (test::Loop& loop : test::random_loops(random)) {
        for (IVec3& p : loop) p[0] += 6 * k;
        loops.push_back(std::move(loop));
      }
    }
    Operands solid(loops);
    for (int k = 0; k < 100; ++k) {
      Query at;
      for (double& c : at) c = static_cast<double>(random.integer(-2, 24)) / 4 + 1. / 64;
      at[0] += static_cast<double>(6 * random.integer(0, 7));
      const auto truth = solid.oracle.winding(at);
      if (!truth) continue;
      // Beside a ray there is nothing where it is told.
      const uint64_t before = solid.signs.filtered;
      ASSERT_EQ(solid.label(at), *truth) << at[0] << ' ' << at[1] << ' ' << at[2];
      RayBoxes none(solid.job);
      const uint64_t asked = solid.signs.filtered - before;
      ASSERT_EQ(ray_label(solid.job, solid.signs, none, 0, at, 0),
                *truth != 0 ? Inside::kYes : Inside::kNo);
      ASSERT_EQ(solid.signs.filtered - before, 2 * asked);
      ++(*truth ? inside : outside);
    }
    runs += solid.boxes.of(0).size();
    polygons += solid.job.polygons().size();
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(outside, 300);
  EXPECT_GE(runs * RayBoxes::kEach, polygons);
}

/// Whether a ray from the origin meets a polygon ahead, its edges included.
bool ray_meets(const test::Loop& loop, const double (&direction)[2]) {
  int left = 0, right = 0;
  const auto sheared = [&](const IVec3& p, int k) {
    return mpq_class(mpq_class(mpz_class(p[k])) - mpq_class(direction[k - 1]) * mpz_class(p[0]));
  };
  for (size_t i = 0; i < loop.size(); ++i) {
    const IVec3 &p = loop[i], &q = loop[(i + 1) % loop.size()];
    const int turn = sgn(mpq_class(sheared(p, 1) * sheared(q, 2) - sheared(p, 2) * sheared(q, 1)));
    left += turn > 0, right += turn < 0;
  }
  return left == 0 || right == 0;
}

// Far out a ray passes by the edge of a small triangle, or by the long edge of one that has a
// corner farther away, at a distance that rounding hides: it may be told that it misses, or
// nothing.
TEST(RayLabel, CountsNothingThatRaysMissBarely) {
  test::Random random(507);
  std::array<int, 2> missed{};
  for (int i = 0; i < 6000; ++i) {
    // A place that the first ray hits but for the rounding of its direction: 73 / 5120, 67 / 8192.
    const int64_t times = random.integer(4000, 13000);
    const IVec3 middle{40960 * times, 584 * times, 335 * times};
    const auto step = [&] {
      return IVec3{random.integer(-3, 3), random.integer(-3, 3), random.integer(-3, 3)};
    };
    const IVec3 along = step(), beside = step();
    if (test::cross_of(along, beside) == IVec3{0, 0, 0}) continue;
    const auto beyond = [&](int64_t a, int64_t b) {
      IVec3 p = middle;
      for (size_t k = 0; k < 3; ++k) p[k] += a * along[k] + b * beside[k];
      return p;
    };
    const bool is_long = i % 2 != 0;
    const int64_t far = is_long ? random.integer(1 << 14, 1 << 17) : random.integer(1, 3);
    test::Loop loop{beyond(0, random.integer(1, 3)), beyond(-random.integer(1, 3), 0),
                    beyond(far, 0)};
    if (!is_long) std::rotate(loop.begin(), loop.begin() + random.integer(0, 2), loop.end());
    if (std::any_of(std::begin(kDirections), std::end(kDirections),
                    [&](const auto& direction) { return ray_meets(loop, direction); })) {
      continue;
    }
    ++missed[is_long];
    test::Loop near = loop;
    for (IVec3& p : near) p = test::sub(p, middle);
    Operand operand = test::operand_of(test::make_leaf({near}));
    operand.translation = middle;
    const std::vector<Operand> operands{operand};
    const Job job(operands);
    VertexSigns signs(job, true);
    RayBoxes boxes(job);
    ASSERT_EQ(ray_label(job, signs, boxes, 0, {0, 0, 0}, 0), Inside::kNo) << i;
  }
  for (const int n : missed) EXPECT_GT(n, 1000);
}

}  // namespace
}  // namespace csgrun::ray_label_test
