// Points of a store of pieces are those of the jobs that they come from.
#include "engine/bsp/piece_store.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "engine/bsp/result_pieces.h"
#include "engine/exact/predicates.h"
#include "tests/support/kernel_case.h"
#include "tests/support/piece_planes.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"

namespace csgrun::piece_store_test {
namespace {

using test::Loop;

/// A box whose top is of two squares, so that its front and its rear have a corner that is straight
/// there; each loop starts anywhere.
std::vector<Loop> box_with_split_top(test::Random& random) {
  std::vector<Loop> loops{{{0, 0, 2}, {1, 0, 2}, {1, 2, 2}, {0, 2, 2}},
                          {{1, 0, 2}, {2, 0, 2}, {2, 2, 2}, {1, 2, 2}},
                          {{0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {2, 0, 0}},
                          {{0, 0, 0}, {2, 0, 0}, {2, 0, 2}, {1, 0, 2}, {0, 0, 2}},
                          {{2, 2, 0}, {0, 2, 0}, {0, 2, 2}, {1, 2, 2}, {2, 2, 2}},
                          {{0, 0, 0}, {0, 0, 2}, {0, 2, 2}, {0, 2, 0}},
                          {{2, 0, 0}, {2, 2, 0}, {2, 2, 2}, {2, 0, 2}}};
  for (Loop& loop : loops) {
    std::rotate(loop.begin(),
                loop.begin() + random.integer(0, static_cast<int64_t>(loop.size()) - 1),
                loop.end());
  }
  std::shuffle(loops.begin(), loops.end(),
               std::mt19937(static_cast<unsigned>(random.integer(0, 999))));
  return loops;
}

/// A whole face as a piece has the corners and planes that a job gives it, and each of its corners
/// is on the grid or where three planes meet.
void check_face(PieceStore& store, uint32_t piece, Job& job, uint32_t polygon, bool flip) {
  job.ensure_planes(polygon);
  const JobPolygon& p = job.polygons()[polygon];
  ASSERT_EQ(store.piece(piece).count, p.count);
  EXPECT_EQ(test::support_of(store, piece), flip ? p.support.flip() : p.support);
  for (uint32_t i = 0; i < p.count; ++i) {
    const uint32_t point = store.corners(piece)[i];
    EXPECT_EQ(point, job.corners(p)[corner_place(i, p.count, flip)]);
    EXPECT_EQ(test::edge_plane_of(store, piece, i),
              job.edge_planes(p)[edge_place(i, p.count, flip)]);
    EXPECT_TRUE(store.is_on_grid(point) || store.point_planes(point)[0] != PieceStore::kNoNumber);
  }
}

TEST(PieceStore, PointsAreThoseOfTheJob) {
  test::Random random(991);
  size_t constructed = 0, on_grid = 0;
  for (int round = 0; round < 60; ++round) {
    std::vector<Operand> operands(3);
    for (Operand& o : operands) {
      o.leaf = random.integer(0, 1) ? test::make_leaf(box_with_split_top(random))
                                    : test::random_leaf(random);
      o.translation = {random.integer(-9, 9), random.integer(-9, 9), random.integer(-9, 9)};
      if (random.integer(0, 3)) o.frame = test::random_frame(random);
    }
    if (round % 3 == 0) {
      const auto result = test::evaluate(test::leaf(0), {operands[1]});
      operands[1].leaf = nullptr;
      operands[1].boundary = *result;
      operands[1].frame = {};
      operands[1].translation = {0, 0, 0};
    }
    PieceStore store;
    Job job(operands, &store.planes);
    for (uint32_t o = 0; o < operands.size(); ++o) {
      ASSERT_EQ(store.add_operand(job, operands, o), o);
      ASSERT_EQ(store.operands().size(), o + 1);
      for (uint32_t v = job.vertex_start(o); v < job.vertex_start(o + 1); ++v) {
        const uint32_t p = store.first_point(o) + v - job.vertex_start(o);
        ASSERT_EQ(store.rounded(p), job.rounded(v));
        ASSERT_EQ(store.operand_of(p), o);
        ASSERT_EQ(store.exact(p).w.sign(), 1);  // its planes meet in one point
        ASSERT_EQ(compare(store.exact(p), job.exact(v)), 0) << "round " << round;
      }
      const bool flip = random.integer(0, 1);
      for (uint32_t f = 0; operands[o].leaf && f < operands[o].leaf->face_count(); ++f) {
        const uint32_t piece = store.add_face({o, f, 0, 0, PlaneId(), true, flip}, f);
        ASSERT_NO_FATAL_FAILURE(check_face(store, piece, job, job.polygon_start(o) + f, flip));
      }
    }
    for (uint32_t p = 0; p < store.point_count(); ++p) {
      const auto& planes = store.point_planes(p);
      ++(planes[0] == PieceStore::kNoNumber ? on_grid : constructed);
      if (planes[0] == PieceStore::kNoNumber) continue;
      ASSERT_EQ(compare(intersect(store.planes.plane(planes[0]), store.planes.plane(planes[1]),
                                  store.planes.plane(planes[2])),
                        job.exact(p)),
                0);
    }
    ASSERT_EQ(store.point_count(), job.vertex_count());
  }
  EXPECT_GT(constructed, 300u);
  EXPECT_GT(on_grid, 100u);
}

// In a frame a point needs three planes, of a face that turns there.
TEST(PieceStore, RefusesVerticesAtWhichNoFaceTurns) {
  test::Random random(992);
  Operand operand = test::operand_of(test::make_leaf(test::box_with_middle({0, 0, 0}, {2, 2, 2})));
  ASSERT_EQ(operand.leaf->vertices.size(), 9u);
  const auto number_of = [](const Operand& o) {
    const std::vector<Operand> operands{o};
    PieceStore store;
    Job job(operands, &store.planes);
    const uint32_t number = store.add_operand(job, operands, 0);
    EXPECT_EQ(store.operands().size(), number == PieceStore::kNoNumber ? 0u : 1u);
    EXPECT_EQ(store.point_count(), number == PieceStore::kNoNumber ? 0u : job.vertex_count());
    return number;
  };
  const auto pieces_of = [](const Operand& o) {
    const std::vector<Operand> operands{o, test::operand_of(test::box_leaf({1, 1, 1}, {5, 5, 5}))};
    EvaluateStats stats;
    const auto made = evaluate_pieces(operands, test::flat_expression(BooleanOp::kUnion, 2),
                                      test::region_of(operands), {}, stats);
    EXPECT_TRUE(made);
    return made && *made;
  };
  EXPECT_EQ(number_of(operand), 0u);
  EXPECT_TRUE(pieces_of(operand));
  operand.frame = test::random_frame(random);
  EXPECT_EQ(number_of(operand), PieceStore::kNoNumber);
  EXPECT_FALSE(pieces_of(operand));
}

// Whatever way the face lies.
TEST(PieceStore, TakesThePlanesOfFacesAlongAxes) {
  const Frame frame = test::frame_of(test::turn_about(1, 30));
  for (size_t axis = 0; axis < 3; ++axis) {
    test::Loop loop{{3, 0, 0}, {3, 5, 0}, {3, 0, 5}};
    for (IVec3& p : loop) std::rotate(p.begin(), p.end() - static_cast<long>(axis), p.end());
    Operand operand = test::operand_of(test::make_leaf({loop}));
    operand.frame = frame;
    const std::vector<Operand> operands{operand};
    PieceStore store;
    Job job(operands, &store.planes);
    ASSERT_EQ(store.add_operand(job, operands, 0), 0u) << axis;
    for (uint32_t v = 0; v < 3; ++v) {
      EXPECT_EQ(compare(store.exact(v), job.exact(v)), 0) << axis;
    }
  }
}

// Of whole faces of a leaf, as they are or turned over, in frames that mirror, too.
TEST(PieceStore, MakesThePlanesOfFacesInFramesWhenTheyAreAskedFor) {
  test::Random random(995);
  size_t faces = 0, mirrored = 0;
  for (int i = 0; i < 60; ++i) {
    Operand operand = test::operand_of(test::make_leaf(test::random_loops(random)));
    operand.frame = test::random_frame(random);
    const std::vector<Operand> operands{operand};
    PieceStore store;
    Job job(operands, &store.planes);
    if (store.add_operand(job, operands, 0) != 0) continue;
    mirrored += store.map(0).is_mirrored();
    for (uint32_t face = 0; face < operand.leaf->face_count(); ++face, ++faces) {
      for (const bool flip : {false, true}) {
        const uint32_t p = store.add_face({0, 0, 0, 0, PlaneId(), true, flip}, face);
        EXPECT_FALSE(store.piece(p).support.valid());
        const PlaneId support = test::support_of(store, p);
        EXPECT_EQ(store.piece(p).support, support);
        const Plane front = store.planes.oriented(support);
        const std::vector<uint32_t> corners(store.corners(p).begin(), store.corners(p).end());
        // Newell's sum of the corners, seen from the front.
        double along = 0;
        for (size_t c = 0; c < corners.size(); ++c) {
          ASSERT_EQ(exact_side(front, store.exact(corners[c])), 0);
          const auto &a = store.rounded(corners[c]),
                     &b = store.rounded(corners[(c + 1) % corners.size()]);
          along += static_cast<double>(front.a) * (a[1] * b[2] - a[2] * b[1]) +
                   static_cast<double>(front.b) * (a[2] * b[0] - a[0] * b[2]) +
                   static_cast<double>(front.c) * (a[0] * b[1] - a[1] * b[0]);
        }
        EXPECT_GT(along, 0);
        for (uint32_t c = 0; c < corners.size(); ++c) {
          const uint32_t edge = test::edge_plane_of(store, p, c);
          EXPECT_NE(edge, support.index());
          EXPECT_EQ(store.edges(p)[c], edge);
          for (const uint32_t end : {corners[c], corners[(c + 1) % corners.size()]}) {
            EXPECT_EQ(exact_side(store.planes.plane(edge), store.exact(end)), 0);
          }
        }
      }
    }
  }
  EXPECT_GT(faces, 300u);
  EXPECT_GT(mirrored, 10u);
}

// A point made of planes is the grid point that its coordinates name, or it is none.
TEST(PieceStore, TellsWhichPointsAreOnTheGrid) {
  test::Random random(993);
  PieceStore store;
  size_t on_grid = 0;
  for (int i = 0; i < 3000; ++i) {
    std::array<uint32_t, 3> meeting{};
    std::array<Plane, 3> planes;
    // Offsets that are large beside the normals: some points are near the grid, and not on it.
    const int64_t reach = i % 3 == 0 ? 3 : int64_t{1} << 20;
    for (size_t k = 0; k < 3; ++k) {
      Plane& p = planes[k];
      p.a = random.integer(-reach, reach), p.b = random.integer(-reach, reach);
      p.c = random.integer(-reach, reach);
      p.d = i % 2 == 0
                ? -(p.a * 7 + p.b * 8 + p.c * (i % 5)) + (i % 4 == 0 ? 0 : random.integer(0, 1))
                : random.integer(-reach, reach);
    }
    const Int128 determinant =
        planes[0].a * (planes[1].b * planes[2].c - planes[1].c * planes[2].b) -
        planes[0].b * (planes[1].a * planes[2].c - planes[1].c * planes[2].a) +
        planes[0].c * (planes[1].a * planes[2].b - planes[1].b * planes[2].a);
    if (determinant == 0) continue;
    for (size_t k = 0; k < 3; ++k) meeting[k] = store.planes.intern(planes[k]).index();
    const Point exact = intersect(planes[0], planes[1], planes[2]);
    const std::array<double, 3> at = rounded(exact);
    const uint32_t point = store.add_point(meeting, at);
    bool is_whole = true;
    for (const double c : at) is_whole &= c == std::floor(c);
    const bool is_on_grid =
        is_whole &&
        compare(exact, grid_point(static_cast<int64_t>(at[0]), static_cast<int64_t>(at[1]),
                                  static_cast<int64_t>(at[2]))) == 0;
    EXPECT_EQ(store.is_on_grid(point), is_on_grid);
    EXPECT_EQ(compare(store.exact(point), exact), 0);
    on_grid += is_on_grid;
  }
  EXPECT_GT(on_grid, 500u);
  // So near to the grid that doubles do not tell.
  const Int128 large = Int128{1} << 60;
  const uint32_t near = store.planes.intern({large, 0, 0, -7 * large - 1}).index(),
                 y = store.planes.intern({0, 1, 0, -5}).index(),
                 z = store.planes.intern({0, 0, 1, 4}).index(),
                 x = store.planes.intern({1, 0, 0, -7}).index();
  EXPECT_FALSE(store.is_on_grid(store.add_point({near, y, z}, {7, 5, -4})));
  EXPECT_TRUE(store.is_on_grid(store.add_point({x, y, z}, {7, 5, -4})));
}

// Room for what others sum up, made when it is asked for first, and kept.
TEST(PieceStore, KeepsWhatIsSaidOfPointsAndPieces) {
  PieceStore store;
  for (const Plane& p : {Plane{1, 0, 0, 0}, Plane{0, 1, 0, 0}, Plane{0, 0, 1, 0}}) {
    store.planes.intern(p);
  }
  for (int i = 0; i < 4; ++i) store.add_point({0, 1, 2}, {0, 0, 0});
  for (uint32_t i = 0; i < 3; ++i) store.add_piece({0, i, 0, 0, {}, false, false});
  EXPECT_FALSE(store.cut_point(2).is_known);
  store.cut_point(2).is_known = true;
  EXPECT_FALSE(store.cut_point(0).is_known);
  store.cut_point(0).at[1] = Int<2>(5);
  EXPECT_TRUE(store.cut_point(2).is_known);
  EXPECT_TRUE(store.cut_point(2).at[1].is_zero());
  EXPECT_EQ(store.cut_point(0).at[1], Int<2>(5));
  store.piece_sum(1).sums.triangles = 7;
  EXPECT_EQ(store.piece_sum(2).sums.triangles, 0u);
  EXPECT_EQ(store.piece_sum(1).sums.triangles, 7u);
  // More come later.
  store.add_point({0, 1, 2}, {4, 0, 0});
  EXPECT_FALSE(store.cut_point(4).is_known);
  EXPECT_TRUE(store.cut_point(2).is_known);
}

TEST(PieceStore, HasItsOriginAtTheFirstVertex) {
  const auto origin = [](const std::vector<Operand>& operands) {
    PieceStore store;
    Job job(operands, &store.planes);
    for (uint32_t o = 0; o < operands.size(); ++o) store.add_operand(job, operands, o);
    return store.origin();
  };
  const Operand nothing = test::operand_of(std::make_shared<LeafGeometry>()),
                box = test::operand_of(test::box_leaf({5, -6, 7}, {9, 9, 9})),
                other = test::operand_of(test::box_leaf({1, 2, 3}, {9, 9, 9}));
  EXPECT_EQ(origin({box}), (IVec3{5, -6, 7}));
  EXPECT_EQ(origin({box, other}), (IVec3{5, -6, 7}));
  EXPECT_EQ(origin({nothing}), (IVec3{0, 0, 0}));
  EXPECT_EQ(origin({nothing, other}), (IVec3{0, 0, 0}));
}

}  // namespace
}  // namespace csgrun::piece_store_test
