// Results that are moved without a job, against rationals and against the job.
#include "engine/bsp/boundary_mesh.h"

#include <gtest/gtest.h>

#include "engine/bsp/untouched.h"
#include "tests/support/convex_operand.h"
#include "tests/support/exact_measures.h"
#include "tests/support/exact_solid.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"

namespace csgrun::boundary_mesh_test {
namespace {

using namespace test;  // NOLINT: a test

TEST(BoundaryMesh, MovesByWholeSteps) {
  Random random(41);
  size_t off_grid = 0;
  for (int i = 0; i < 40; ++i) {
    const auto built = evaluate(less({leaf(0), leaf(1)}),
                                {operand_of(random_leaf(random)), operand_of(random_leaf(random))});
    ASSERT_TRUE(built) << text(built.error());
    Operand operand;
    operand.boundary = *built;
    for (int64_t& t : operand.translation) t = random.integer(-70, 70);
    const BoundaryMesh moved = translated(**built, operand.translation);
    const ExactSolid from = exact_solid(**built), to = exact_solid(moved);
    ASSERT_EQ(to.points.size(), from.points.size());
    for (size_t p = 0; p < to.points.size(); ++p) {
      for (int k = 0; k < 3; ++k) {
        const mpq_class& c = to.points[p][k];
        ASSERT_EQ(c, from.points[p][k] + static_cast<long>(operand.translation[k]));
        ASSERT_TRUE(is_correctly_rounded(c, moved.point_rounded[p][k]));
        off_grid += c.get_den() != 1;
      }
    }
    const auto by_job = evaluate(leaf(0), {operand});
    ASSERT_TRUE(by_job) << text(by_job.error());
    EXPECT_EQ(moved.faces.size(), (*by_job)->faces.size());
    EXPECT_EQ(moved.corners.size(), (*by_job)->corners.size());
    EXPECT_EQ(volume(moved), volume(**by_job));
  }
  EXPECT_GT(off_grid, 50u);
}

/// A result with nothing but two triangles of a leaf, untouched, and one of them of another colour.
BoundaryMesh untouched_triangles(std::optional<uint32_t> appearance) {
  auto leaf = std::make_shared<LeafGeometry>(
      *make_leaf({{{0, 0, 0}, {9, 1, 0}, {2, 8, 3}}, {{1, 1, 1}, {5, 5, 5}, {0, -4, 7}}}));
  leaf->appearance = std::vector<uint32_t>{3, 4};
  BoundaryMesh mesh;
  UntouchedPart& part = mesh.parts.emplace_back();
  part.leaf = leaf;
  part.translation = {100, 200, 300};
  part.faces = {0, 1};
  part.appearance = appearance;
  return mesh;
}

TEST(BoundaryMesh, BoundingBoxHoldsEveryPointAndLittleMore) {
  Random random(42);
  size_t off_grid = 0;
  for (int i = 0; i < 20; ++i) {
    const auto built = evaluate(less({leaf(0), leaf(1)}),
                                {operand_of(random_leaf(random)), operand_of(random_leaf(random))});
    ASSERT_TRUE(built) << text(built.error());
    if (is_empty(**built)) continue;
    const GridBox box = bounding_box(**built);
    const ExactSolid solid = exact_solid(**built);
    for (int k = 0; k < 3; ++k) {
      mpq_class lo = solid.points[0][k], hi = lo;
      for (const Rational3& p : solid.points) {
        lo = std::min(lo, p[k]), hi = std::max(hi, p[k]);
        off_grid += p[k].get_den() != 1;
      }
      ASSERT_LT(static_cast<long>(box.lo[k]), lo);
      ASSERT_GT(static_cast<long>(box.hi[k]), hi);
      ASSERT_GE(static_cast<long>(box.lo[k]) + 1, lo - 1);
      ASSERT_LE(static_cast<long>(box.hi[k]) - 1, hi + 1);
    }
  }
  EXPECT_GT(off_grid, 50u);
  const GridBox whole = bounding_box(untouched_triangles({}));
  EXPECT_EQ(whole.lo, (IVec3{99, 195, 299}));
  EXPECT_EQ(whole.hi, (IVec3{110, 209, 308}));
  // Moved, parts and all.
  const GridBox moved = bounding_box(translated(untouched_triangles({}), {5, -6, 7}));
  EXPECT_EQ(moved.lo, (IVec3{104, 189, 306}));
  EXPECT_EQ(moved.hi, (IVec3{115, 203, 315}));
  const GridBox none = bounding_box({}), fresh;
  EXPECT_EQ(none.lo, fresh.lo);
  EXPECT_EQ(none.hi, fresh.hi);
}

// Of parts on the grid the translation is what moves; whole steps of the world are none in a frame,
// so that parts in one are spelled out.
TEST(BoundaryMesh, MovesPartsByWholeSteps) {
  const IVec3 step{5, -6, 7};
  const BoundaryMesh on_grid = translated(untouched_triangles({}), step);
  ASSERT_EQ(on_grid.parts.size(), 1u);
  EXPECT_EQ(on_grid.parts[0].translation, (IVec3{105, 194, 307}));
  EXPECT_EQ(on_grid.parts[0].faces.size(), 2u);

  Random random(43);
  for (int i = 0; i < 10; ++i) {
    Operand operand = octahedron({30, 20, 10}, 25);
    do operand.frame = random_frame(random);
    while (mirrors(operand.frame));
    KernelOptions options;
    options.name_untouched = true;
    const auto built = evaluate(leaf(0), {operand}, options);
    ASSERT_TRUE(built) << text(built.error());
    ASSERT_EQ((*built)->parts.size(), 1u);
    const ExactSolid from = exact_solid(*expanded(*built)),
                     to = exact_solid(
                         *expanded(std::make_shared<BoundaryMesh>(translated(**built, step))));
    ASSERT_EQ(from.points.size(), 6u);
    ASSERT_EQ(to.points.size(), 6u);
    for (size_t p = 0; p < 6; ++p) {
      for (size_t k = 0; k < 3; ++k) {
        ASSERT_EQ(to.points[p][k], from.points[p][k] + static_cast<long>(step[k]));
      }
    }
    EXPECT_EQ(to.faces.size(), 8u);
  }
}

TEST(BoundaryMesh, OnlyAppearanceIsThatOfAllFaces) {
  EXPECT_EQ(only_appearance(untouched_triangles({})), std::nullopt);
  EXPECT_EQ(only_appearance(untouched_triangles(5)), 5u);
  EXPECT_EQ(only_appearance({}), std::nullopt);
  BoundaryMesh mesh = untouched_triangles(5);
  mesh.faces.resize(2);
  mesh.faces[0].label.appearance = mesh.faces[1].label.appearance = 5;
  EXPECT_EQ(only_appearance(mesh), 5u);
  mesh.faces[0].label.appearance = 6;
  EXPECT_EQ(only_appearance(mesh), std::nullopt);
  mesh.parts.clear();
  mesh.faces.resize(3);
  mesh.faces[2].label.appearance = 6;  // as the first, but not the second
  EXPECT_EQ(only_appearance(mesh), std::nullopt);
  mesh.faces[1].label.appearance = 6;
  EXPECT_EQ(only_appearance(mesh), 6u);
}

TEST(BoundaryMesh, MemoryGrowsByWhatIsAdded) {
  BoundaryMesh mesh;
  size_t before = memory_bytes(mesh);
  EXPECT_GE(before, sizeof mesh);
  const auto grew_by = [&](size_t bytes) {
    const size_t now = memory_bytes(mesh), growth = now - before;
    before = now;
    return growth == bytes;
  };
  mesh.planes.resize(7);
  EXPECT_TRUE(grew_by(7 * sizeof mesh.planes[0]));
  mesh.point_planes.resize(7), mesh.point_rounded.resize(7);
  EXPECT_TRUE(grew_by(7 * (sizeof mesh.point_planes[0] + sizeof mesh.point_rounded[0])));
  mesh.faces.resize(7);
  EXPECT_TRUE(grew_by(7 * sizeof mesh.faces[0]));
  mesh.loop_starts.resize(mesh.loop_starts.size() + 7);
  EXPECT_TRUE(grew_by(7 * sizeof mesh.loop_starts[0]));
  mesh.corners.resize(7);
  EXPECT_TRUE(grew_by(7 * sizeof mesh.corners[0]));
  mesh.touches.resize(7);
  EXPECT_TRUE(grew_by(7 * sizeof mesh.touches[0]));
  mesh.parts.resize(2);
  EXPECT_TRUE(grew_by(2 * sizeof mesh.parts[0]));
  mesh.parts[1].faces.resize(7);
  EXPECT_TRUE(grew_by(7 * sizeof mesh.parts[1].faces[0]));
  mesh.parts[0].shared.resize(7);
  EXPECT_TRUE(grew_by(7 * sizeof mesh.parts[0].shared[0]));
  mesh.parts[1].world.resize(7);
  EXPECT_TRUE(grew_by(7 * sizeof mesh.parts[1].world[0]));
}

}  // namespace
}  // namespace csgrun::boundary_mesh_test
