// How two polygons meet, against rationals: the part of each on the line of both planes.
#include "engine/bsp/pair_test.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "engine/exact/forced_tier.h"
#include "tests/support/exact_solid.h"
#include "tests/support/kernel_case.h"
#include "tests/support/pair_truth.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"

namespace csgrun::pair_test_test {
namespace {

using namespace test;  // NOLINT: a test

TEST(PairTest, AgainstIntervalsInRationals) {
  Random random(411);
  Seen seen;
  for (int i = 0; i < 60; ++i) {
    check_pairs({operand_of(random_leaf(random)), operand_of(random_leaf(random))}, i % 2 == 0,
                seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen.apart, 1000);
  EXPECT_GT(seen.plain, 100);
  EXPECT_GT(seen.touching, 100);
  EXPECT_GT(seen.coplanar, 10);
}

/// Triangles of one plane, some of which have corners in common.
Loop flat_triangle(Random& random, const IVec3& u, const IVec3& v) {
  Loop loop;
  do {
    loop.clear();
    for (int i = 0; i < 3; ++i) {
      const int64_t s = random.integer(-4, 4), t = random.integer(-4, 4);
      loop.push_back({s * u[0] + t * v[0], s * u[1] + t * v[1], s * u[2] + t * v[2]});
    }
  } while (cross_of(sub(loop[1], loop[0]), sub(loop[2], loop[0])) == IVec3{0, 0, 0});
  return loop;
}

// Polygons in one plane: those apart are seen to be so, and those with one corner in common.
TEST(PairTest, InOnePlane) {
  Random random(421);
  Seen seen;
  for (int i = 0; i < 200; ++i) {
    // Planes along one axis and two, and others; far out, too, where doubles have few bits left.
    const int64_t size = i % 5 == 4 ? int64_t{1} << 24 : 1;
    const IVec3 u{size, i % 3 == 1 ? 3 : 0, i % 3 == 2 ? -2 : 0}, v{0, size, i % 3 == 2 ? 5 : 0};
    std::vector<Operand> operands;
    for (int o = 0; o < 2; ++o) {
      std::vector<Loop> loops;
      for (int t = 0; t < 6; ++t) loops.push_back(flat_triangle(random, u, v));
      // Quadrilaterals with a straight corner.
      Loop& last = loops.back();
      IVec3 middle{};
      for (size_t k = 0; k < 3; ++k) {
        for (IVec3& corner : last) corner[k] *= 2;
        middle[k] = (last[0][k] + last[1][k]) / 2;
      }
      last.insert(last.begin() + 1, middle);
      for (Loop& loop : loops) {
        for (IVec3& corner : loop)
          std::rotate(corner.begin(), corner.begin() + i % 4 % 3, corner.end());
      }
      operands.push_back(operand_of(make_leaf(loops)));
    }
    check_pairs(operands, i % 2 == 0, seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_EQ(seen.plain + seen.touching, 0);
  EXPECT_GT(seen.flat_apart, 1000);
  EXPECT_GT(seen.flat_corner, 50);
  EXPECT_GT(seen.coplanar, 1000);
}

// Rounded corners leave much open, which corners in the frame tell, where both are in one.
TEST(PairTest, InFrames) {
  Random random(415);
  Seen seen;
  for (int i = 0; i < 8; ++i) {
    std::vector<Operand> operands{operand_of(make_leaf(random_loops(random, 3))),
                                  operand_of(make_leaf(random_loops(random, 3)))};
    operands[1].frame = random_frame(random);
    if (i % 2) operands[0].frame = operands[1].frame;  // touching, mostly
    if (i % 4 == 2) operands[0].frame = random_frame(random);
    check_pairs(operands, i % 3 != 0, seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen.plain, 20);
  EXPECT_GT(seen.touching, 20);
  EXPECT_EQ(seen.unsure, 0);
}

/// An integer map of determinant 1 with large entries: what is far apart has small volumes.
GridMap large_shear(Random& random) {
  GridMap map;
  for (size_t k = 0; k < 3; ++k) {
    const size_t other = (k + (random.integer(0, 1) ? 1 : 2)) % 3;
    const int64_t by = random.integer(100, 255);
    for (size_t c = 0; c < 3; ++c) map.rows[k][c] += by * map.rows[other][c];
  }
  return map;
}

// There doubles do not tell most signs.
TEST(PairTest, InFramesBesideOneAnotherByNextToNothing) {
  Random random(422);
  Seen seen;
  for (int i = 0; i < 24; ++i) {
    const GridMap map = large_shear(random);
    std::vector<Operand> operands;
    for (int o = 0; o < 2; ++o) {
      operands.push_back(operand_of(make_leaf(mapped(random_loops(random, 3), map))));
    }
    operands[0].frame = random_frame(random);
    if (i % 2) {  // one that mirrors
      for (int64_t& v : operands[0].frame.matrix[0]) v = -v;
    }
    operands[1].frame = operands[0].frame;
    check_pairs(operands, false, seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen.apart, 100);
  EXPECT_GT(seen.plain, 40);
  EXPECT_GT(seen.touching, 40);
  EXPECT_EQ(seen.unsure, 0);
}

// Three corners of a face that are in line say nothing of its plane.
TEST(PairTest, OfFacesWithStraightCorners) {
  Random random(416);
  Seen seen;
  for (int i = 0; i < 40; ++i) {
    std::vector<Loop> loops = box_loops({0, 0, 0}, {4, 2 + i % 3 * 2, 4});
    for (Loop& loop : loops) {
      Loop with_middles;
      for (size_t c = 0; c < loop.size(); ++c) {
        const IVec3 &a = loop[c], &b = loop[(c + 1) % loop.size()];
        with_middles.push_back(a);
        with_middles.push_back({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
      }
      std::rotate(with_middles.begin(), with_middles.begin() + i % 8, with_middles.end());
      loop = with_middles;
    }
    std::vector<Operand> operands{operand_of(make_leaf(loops)),
                                  operand_of(make_leaf(random_loops(random, 7)))};
    IVec3 move{};
    for (int64_t& c : move) c = random.integer(-9, 9);
    operands[0].translation = operands[1].translation = move;
    check_pairs(operands, false, seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen.plain, 50);
}

/// A polygon with most of its corners in line, and triangles about it.
std::vector<Operand> mostly_in_line(Random& random) {
  const auto vector = [&](int64_t reach) {
    return IVec3{random.integer(-reach, reach), random.integer(-reach, reach),
                 random.integer(-reach, reach)};
  };
  IVec3 u{}, v{};
  do {
    u = vector(3), v = vector(3);
  } while (cross_of(u, v) == IVec3{0, 0, 0});
  const IVec3 origin = vector(20);
  const auto at = [&](int64_t a, int64_t b) {
    IVec3 p = origin;
    for (size_t k = 0; k < 3; ++k) p[k] += a * u[k] + b * v[k];
    return p;
  };
  Loop loop;
  const int64_t length = random.integer(2, 8);
  for (int64_t i = 0; i <= length; ++i) loop.push_back(at(i, 0));
  if (random.integer(0, 1)) {
    loop.push_back(at(random.integer(0, length), random.integer(1, 3)));
  } else {
    loop.push_back(at(length, 1));
    loop.push_back(at(0, random.integer(1, 2)));
  }
  std::rotate(loop.begin(), loop.begin() + random.integer(0, static_cast<int64_t>(loop.size()) - 1),
              loop.end());
  std::vector<Loop> others;
  while (others.size() < 8) {
    const Loop other{vector(30), vector(30), vector(30)};
    if (cross_of(sub(other[1], other[0]), sub(other[2], other[0])) != IVec3{0, 0, 0}) {
      others.push_back(other);
    }
  }
  return {operand_of(make_leaf({loop})), operand_of(make_leaf(others))};
}

// The three corners that stand for a plane are not in line, wherever a loop starts.
TEST(PairTest, OfFacesMostlyInLine) {
  Random random(417);
  Seen seen;
  for (int i = 0; i < 400; ++i) {
    check_pairs(mostly_in_line(random), i % 2 == 0, seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen.plain, 100);
}

/// Coordinates that no double has, with edges that meet edges all the same.
Frame thirds() {
  Frame frame;
  frame.is_identity = false;
  for (size_t k = 0; k < 3; ++k) frame.matrix[k][k] = int64_t{3} << Frame::kShift;
  return frame;
}

TEST(PairTest, OfTheGridAndThirdsOfIt) {
  Random random(418);
  Seen seen;
  for (int i = 0; i < 60; ++i) {
    std::vector<Operand> operands{operand_of(random_leaf(random)), operand_of(random_leaf(random))};
    operands[i % 2].frame = thirds();
    if (i % 3 == 0) operands[1 - i % 2].frame = thirds();
    check_pairs(operands, i % 4 != 3, seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen.plain, 100);
  EXPECT_GT(seen.touching, 100);
}

// All is asked of planes, as a tier that is forced wants it.
TEST(PairTest, ByPlanesOnly) {
  forced_tier = 0;
  Random random(419);
  Seen seen;
  for (int i = 0; i < 12; ++i) {
    std::vector<Operand> operands{operand_of(random_leaf(random)), operand_of(random_leaf(random))};
    if (i % 3 == 1) operands[i % 2].frame = random_frame(random);
    check_pairs(operands, true, seen);
    if (HasFatalFailure()) break;
  }
  forced_tier = -1;
  EXPECT_GT(seen.plain, 20);
  EXPECT_GT(seen.touching, 20);
}

// Faces of results may lie in planes of one coordinate, too; others are decided by planes.
TEST(PairTest, OfResults) {
  Random random(420);
  Seen seen;
  for (int i = 0; i < 80; ++i) {
    const auto box = [&] {
      IVec3 lo{}, hi{};
      for (size_t k = 0; k < 3; ++k) {
        lo[k] = random.integer(-6, 3), hi[k] = lo[k] + random.integer(1, 6);
      }
      return operand_of(box_leaf(lo, hi));
    };
    std::vector<Operand> parts{box(), i % 2 ? box() : operand_of(random_leaf(random))};
    if (i % 4 == 3) parts[1].frame = thirds();
    const auto result =
        evaluate(i % 3 ? join({leaf(0), leaf(1)}) : less({leaf(0), leaf(1)}), parts);
    ASSERT_TRUE(result);
    Operand first;
    first.boundary = *result;
    std::vector<Operand> operands{first, i % 5 ? operand_of(random_leaf(random)) : first};
    operands[1].translation = {random.integer(-2, 2), random.integer(-2, 2), 0};
    if (i % 2) std::swap(operands[0], operands[1]);
    check_pairs(operands, i % 4 != 1, seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen.plain, 50);
  EXPECT_GT(seen.touching, 50);
  EXPECT_GT(seen.coplanar, 10);
  EXPECT_GT(seen.unsure, 100);
}

// Of a result's face in a plane of one coordinate no plane is asked: a square that stands on it,
// and is longer, is known to touch it.
TEST(PairTest, OfResultsOfBoxesWithoutPlanes) {
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const int64_t side : {-1, 1}) {
      const auto turned = [&](Loop loop) {
        for (IVec3& p : loop) {
          p[2] *= side;
          std::rotate(p.begin(), p.begin() + axis, p.end());
        }
        return loop;
      };
      const Loop ends = turned({{0, 0, -9}, {4, 8, 0}});
      IVec3 lo{}, hi{};
      for (size_t k = 0; k < 3; ++k) {
        lo[k] = std::min(ends[0][k], ends[1][k]), hi[k] = std::max(ends[0][k], ends[1][k]);
      }
      std::vector<Operand> operands(2);
      operands[0].leaf = make_leaf({turned({{2, -1, 0}, {2, 9, 0}, {2, 9, 3}, {2, -1, 3}})});
      operands[1].boundary = *evaluate(leaf(0), {operand_of(box_leaf(lo, hi))});
      const Job job(operands);
      PairTest test(job);
      int contacts = 0;
      for (uint32_t q = 1; q < job.polygons().size(); ++q) {
        const auto corners = job.corners(job.polygons()[q]);
        const size_t level = (5 - axis) % 3;  // where the third coordinate has gone
        if (std::any_of(corners.begin(), corners.end(),
                        [&](uint32_t v) { return job.rounded(v)[level] != 0; })) {
          continue;
        }
        Contact contact;
        EXPECT_EQ(test.run(0, q, nullptr, contact), Meeting::kContact) << axis << ' ' << side;
        EXPECT_FALSE(contact.is_plain);
        ++contacts;
      }
      EXPECT_EQ(contacts, 1) << axis << ' ' << side;
    }
  }
}

// A face that leans by less than rounding shows is not level, though its corners are as doubles.
TEST(PairTest, OfFacesThatLeanByLessThanRounding) {
  const int64_t height = int64_t{1} << 22;
  int undecided = 0, contacts = 0;
  for (int i = 0; i < 6; ++i) {
    const size_t axis = i / 2;
    IVec3 lo{0, 0, 0}, hi{8, 8, 8}, far_lo{4, 4, 4}, far_hi{12, 12, 12};
    hi[axis] = far_lo[axis] = height;
    far_hi[axis] = height + 8;
    std::vector<Operand> operands{operand_of(box_leaf(lo, hi)),
                                  operand_of(box_leaf(far_lo, far_hi))};
    Frame& frame = operands[0].frame;
    frame.is_identity = false;
    for (size_t k = 0; k < 3; ++k) {
      frame.matrix[k] = {0, 0, 0};
      frame.matrix[k][k] = int64_t{1} << Frame::kShift;
    }
    frame.matrix[axis][(axis + 1) % 3] = i % 2 ? 1 : -1;
    const Job job(operands);
    PairTest test(job);
    for (uint32_t p = 0; p < job.polygon_start(1); ++p) {
      for (uint32_t q = job.polygon_start(1); q < job.polygons().size(); ++q) {
        Contact contact;
        const Meeting met = test.run(p, q, nullptr, contact);
        undecided += met == Meeting::kUndecided;
        if (met != Meeting::kContact) continue;
        ++contacts;
        const Corners a = corners_of(job, p), b = corners_of(job, q);
        const Rational3 d = cross(normal_of(a), normal_of(b));
        EXPECT_EQ(contact.is_coplanar, dot(d, d) == 0);
        if (contact.is_coplanar) continue;
        const Sides of_p = sides_of(a, b), of_q = sides_of(b, a);
        EXPECT_EQ(contact.p_front, of_p.front > 0);
        EXPECT_EQ(contact.p_back, of_p.back > 0);
        EXPECT_EQ(contact.q_front, of_q.front > 0) << axis;
        EXPECT_EQ(contact.q_back, of_q.back > 0) << axis;
      }
    }
  }
  EXPECT_GT(undecided + contacts, 12);
}

// A square clearly in front of another one: four signs say so.
TEST(PairTest, CountsItsSigns) {
  const std::vector<Operand> operands{
      operand_of(make_leaf({{{0, 0, 5}, {4, 0, 5}, {4, 4, 5}, {0, 4, 5}}})),
      operand_of(make_leaf({{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}}))};
  const Job job(operands);
  PairTest test(job);
  Contact contact;
  EXPECT_EQ(test.run(0, 1, nullptr, contact), Meeting::kApart);
  EXPECT_EQ(test.signs().filtered, 4u);
  EXPECT_EQ(test.signs().exact, 0u);
}

}  // namespace
}  // namespace csgrun::pair_test_test
