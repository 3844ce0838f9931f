// A mesh less a copy that is shifted by one unit in the last place (Campen & Kobbelt 2010, chapter
// 7), against the reference: every face of the difference, on the right side, and its volume.
#include "tests/bench/shift.h"

#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include <csgrun/primitives/mesh_file.h>

#include "engine/csg/quantise.h"
#include "tests/bench/models.h"
#include "tests/support/exact_measures.h"
#include "tests/support/exact_solid.h"
#include "tests/support/fuzz/truth.h"
#include "tests/support/kernel_case.h"
#include "tests/support/kernel_checks.h"
#include "tests/support/reference/reference.h"

namespace csgrun::shift_test {
namespace {

using namespace test;  // NOLINT: a test

Leaf leaf_of(const PolygonMesh& mesh, const std::vector<IVec3>& points) {
  const std::vector<uint32_t> appearance(mesh.face_count(), 0);
  const PreparedLeaf leaf = prepare_leaf(mesh, points, false, appearance);
  return leaf.status == PreparedLeaf::Status::kGood ? leaf.geometry : nullptr;
}

reference::Leaf truth_of(const LeafGeometry& leaf, uint32_t source) {
  reference::Leaf truth;
  for (const IVec3& v : leaf.vertices) {
    truth.points.push_back({mpz_class(v[0]), mpz_class(v[1]), mpz_class(v[2]), 1});
  }
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    reference::Face& face = truth.faces.emplace_back();
    face.label = {source, leaf.facet[f], leaf.surface[f], leaf.appearance[f]};
    face.loops.emplace_back(leaf.corners.begin() + leaf.face_starts[f],
                            leaf.corners.begin() + leaf.face_starts[f + 1]);
  }
  return truth;
}

void check_shift(PolygonMesh mesh) {
  mesh = bench::scaled_to_128(std::move(mesh));
  const auto points = round_points(mesh, LeafRounding{}, Quantiser(bench::shift_step()));
  ASSERT_TRUE(points);
  std::vector<IVec3> moved = *points;
  for (IVec3& p : moved) p[0] += bench::float_ulp_in_steps(p[0]);
  const Leaf a = leaf_of(mesh, *points), b = leaf_of(mesh, moved);
  ASSERT_TRUE(a && b);
  std::vector<Operand> operands{operand_of(a), operand_of(b)};
  operands[1].first_source = 1;
  const auto difference = evaluate(less({leaf(0), leaf(1)}), operands);
  const auto common = evaluate(meet({leaf(0), leaf(1)}), operands);
  ASSERT_TRUE(difference && common);
  ASSERT_FALSE((*difference)->faces.empty());
  const auto solid = present(**difference, test_context());
  ASSERT_TRUE(solid) << text(solid.error());
  EXPECT_EQ(fault_in(**solid), "");
  EXPECT_EQ(volume(**difference), volume(exact_solid(operands[0])) - volume(**common));

  const std::vector<reference::Leaf> leaves{truth_of(*a, 0), truth_of(*b, 1)};
  const reference::Tree tree{-1, BooleanOp::kDifference, {{0, {}, {}}, {1, {}, {}}}};
  EXPECT_EQ(reference::difference(leaves, tree, claim_of(**difference)), "");
  const reference::Measured measured = reference::measure(leaves, tree);
  EXPECT_EQ(measured.fault, "");
  EXPECT_EQ(measured.volume, volume(**difference));
}

TEST(Shift, OfOurModelsByOneUnitInTheLastPlace) {
  for (const char* name : {"statue", "ring", "twins"}) {
    SCOPED_TRACE(name);
    check_shift(bench::polygon_mesh(bench::model(name, 128), true));
  }
}

TEST(Shift, OfAModelFromTheWildByOneUnitInTheLastPlace) {
  const char* given = std::getenv("CSGRUN_SHARED");
  const auto folder = (given ? std::filesystem::path(given)
                             : std::filesystem::path(CSGRUN_SOURCE_DIR).parent_path() / "shared") /
                      "meshes";
  for (const char* name : {"lg_decimated-knight.off", "th_65004.stl"}) {
    SCOPED_TRACE(name);
    if (!std::filesystem::exists(folder / name)) {
      GTEST_SKIP() << folder / name << " is not there (set CSGRUN_SHARED)";
    }
    auto read = read_mesh_file((folder / name).string());
    ASSERT_TRUE(read) << text(read.error());
    std::string note;
    auto mesh = make_solid_mesh(*std::move(read), &note);
    ASSERT_TRUE(mesh) << text(mesh.error());
    check_shift(*std::move(mesh));
  }
}

}  // namespace
}  // namespace csgrun::shift_test
