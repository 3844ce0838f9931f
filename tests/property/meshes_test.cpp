// Meshes from the wild against turned and shifted copies of themselves, with identities as
// residues. A few per run; CSGRUN_MESHES=all takes all, CSGRUN_MESHES=bunny the one with this in
// its name.
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include <csgrun/primitives/mesh_file.h>

#include "engine/bsp/untouched.h"
#include "engine/csg/quantise.h"
#include "tests/support/exact_measures.h"
#include "tests/support/kernel_case.h"
#include "tests/support/kernel_checks.h"
#include "tests/support/random_frames.h"

namespace csgrun::meshes_test {
namespace {

using namespace test;  // NOLINT: a test

constexpr const char* kModels[] = {"c3_nefertiti.obj",        "lg_armadillo.obj", "lg_bunny.off",
                                   "lg_decimated-knight.off", "lg_elephant.obj",  "lg_fandisk.off",
                                   "lg_fertility.off",        "th_112932.stl",    "th_1514499.stl",
                                   "th_472042.stl",           "th_65004.stl"};

std::filesystem::path mesh_folder() {
  const char* given = std::getenv("CSGRUN_SHARED");
  return (given ? std::filesystem::path(given)
                : std::filesystem::path(CSGRUN_SOURCE_DIR).parent_path() / "shared") /
         "meshes";
}

/// The points of a mesh turned and scaled into |c| < 2^26, whole.
std::vector<IVec3> grid_points(const PolygonMesh& mesh, const Matrix& turn) {
  std::vector<std::array<double, 3>> points;
  std::array<double, 3> lo{HUGE_VAL, HUGE_VAL, HUGE_VAL}, hi{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (const glm::dvec3& p : mesh.points) {
    auto& q = points.emplace_back();
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
      q[k] = p[k];
    }
  }
  const double extent = std::max({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]});
  const double scale = 0x1p26 / extent;  // half of it each way, and room for the turn
  std::vector<IVec3> whole;
  for (const auto& p : points) {
    auto& w = whole.emplace_back();
    for (int k = 0; k < 3; ++k) {
      double sum = 0;
      for (int j = 0; j < 3; ++j) sum += turn[k][j] * (p[j] - (lo[j] + hi[j]) / 2);
      w[k] = std::llround(sum * scale);
    }
  }
  return whole;
}

Leaf prepared(const PolygonMesh& mesh, const std::vector<IVec3>& points, const std::string& name) {
  const std::vector<uint32_t> appearance(mesh.face_count(), 0);
  const PreparedLeaf leaf = prepare_leaf(mesh, points, false, appearance);
  if (leaf.status == PreparedLeaf::Status::kGood) return leaf.geometry;
  std::printf("%s is left out: not sound on the grid (status %d)\n", name.c_str(),
              static_cast<int>(leaf.status));
  return nullptr;
}

/// Six times the volume of a leaf in its frame, and of the frame's image, modulo a prime.
uint64_t leaf_residue(const LeafGeometry& leaf, const Frame& frame, int which) {
  const Residues r(kPrimes[which]);
  uint64_t total = 0;
  for (const Loop& l : loops_of(leaf)) {
    for (size_t i = 1; i + 1 < l.size(); ++i) {
      const auto minor = [&](int a, int b) {
        return static_cast<Int128>(l[i][a]) * l[i + 1][b] -
               static_cast<Int128>(l[i][b]) * l[i + 1][a];
      };
      total =
          r.add(total, r.of(l[0][0] * minor(1, 2) + l[0][1] * minor(2, 0) + l[0][2] * minor(0, 1)));
    }
  }
  if (frame.is_identity) return total;
  const auto& m = frame.matrix;
  uint64_t det = 0;
  for (int j = 0; j < 3; ++j) {
    const int a = (j + 1) % 3, b = (j + 2) % 3;
    const Int128 minor =
        static_cast<Int128>(m[1][a]) * m[2][b] - static_cast<Int128>(m[1][b]) * m[2][a];
    det = r.add(det, r.multiply(r.of(m[0][j]), r.of(minor)));
  }
  for (int k = 0; k < 3; ++k) total = r.multiply(total, r.of(Int128{1} << Frame::kShift));
  return r.multiply(total, r.inverse(det));
}

void check_pair(const std::vector<Operand>& leaves) {
  const Tree trees[4] = {join({leaf(0), leaf(1)}), meet({leaf(0), leaf(1)}),
                         less({leaf(0), leaf(1)}), differ({leaf(0), leaf(1)})};
  // Boxes by doubles are enough for a region; exact points of so many vertices are slow.
  GridBox region{{-(1 << 28), -(1 << 28), -(1 << 28)}, {1 << 28, 1 << 28, 1 << 28}};
  std::array<Boundary, 4> results;
  for (int t = 0; t < 4; ++t) {
    Expression e;
    e.nodes = {{true, {}, 0, 0, 0}, {true, {}, 1, 0, 0}, {false, trees[t].op, 0, 0, 2}};
    e.children = {0, 1};
    EvaluateStats stats;
    const auto r = evaluate_boolean(leaves, e, region, {}, stats);
    ASSERT_TRUE(r) << trees[t].text() << ": " << text(r.error());
    results[t] = *r;
    const auto solid = present(**r, test_context());
    ASSERT_TRUE(solid) << trees[t].text() << ": " << text(solid.error());
    ASSERT_EQ(fault_in(**solid), "") << trees[t].text();
    // What is untouched may be named: the same value, and the same arrays.
    KernelOptions options;
    options.name_untouched = true;
    const auto naming = evaluate_boolean(leaves, e, region, options, stats);
    ASSERT_TRUE(naming) << trees[t].text() << ": " << text(naming.error());
    ASSERT_EQ(difference_between(**r, *expanded(*naming)), "") << trees[t].text();
    const auto same = present(**naming, test_context());
    ASSERT_TRUE(same) << trees[t].text() << ": " << text(same.error());
    ASSERT_EQ(difference_between(**solid, **same), "") << trees[t].text();
    ASSERT_EQ((*solid)->measures.volume, (*same)->measures.volume) << trees[t].text();
    ASSERT_EQ((*solid)->measures.genus, (*same)->measures.genus) << trees[t].text();
  }
  for (int which = 0; which < 2; ++which) {
    const Residues r(kPrimes[which]);
    uint64_t v[4];
    for (int t = 0; t < 4; ++t) v[t] = six_volumes_residue(*results[t], which);
    const uint64_t a = leaf_residue(*leaves[0].leaf, leaves[0].frame, which);
    const uint64_t b = leaf_residue(*leaves[1].leaf, leaves[1].frame, which);
    ASSERT_EQ(r.add(v[0], v[1]), r.add(a, b));
    ASSERT_EQ(v[2], r.subtract(a, v[1]));
    ASSERT_EQ(v[3], r.subtract(v[0], v[1]));
  }
}

TEST(Meshes, IdentitiesAgainstTurnedAndShiftedCopies) {
  if (!std::filesystem::exists(mesh_folder())) {
    GTEST_SKIP() << "no meshes in " << mesh_folder() << " (set CSGRUN_SHARED)";
  }
  Random random(21);
  const char* asked = std::getenv("CSGRUN_MESHES");
  std::vector<std::string> models(std::begin(kModels), std::end(kModels));
  const bool all = asked && std::string(asked) == "all";
  if (asked && !all) {
    std::erase_if(models, [&](const std::string& m) { return m.find(asked) == std::string::npos; });
  } else if (!all) {
    // The smaller ones, one of them at random.
    std::erase_if(models, [](const std::string& m) {
      return std::filesystem::file_size(mesh_folder() / m) > 450'000;
    });
    models = {
        models[static_cast<size_t>(random.integer(0, static_cast<int64_t>(models.size()) - 1))]};
  }
  for (const std::string& name : models) {
    SCOPED_TRACE(name);
    auto read = read_mesh_file((mesh_folder() / name).string());
    ASSERT_TRUE(read) << text(read.error());
    std::string note;
    const auto mesh = make_solid_mesh(*std::move(read), &note);
    if (!mesh) {
      std::printf("%s is left out: %s\n", name.c_str(), mesh.error().message.c_str());
      continue;
    }
    const Leaf a = prepared(*mesh, grid_points(*mesh, turn_about(0, 0)), name);
    if (!a) continue;
    std::printf("%s: %zu faces\n", name.c_str(), a->face_count());
    const int axis = static_cast<int>(random.integer(0, 2));
    const double angle = static_cast<double>(random.integer(1, 89));
    // Turned by its frame, exactly.
    std::vector<Operand> leaves{operand_of(a), operand_of(a)};
    leaves[1].first_source = 1;
    leaves[1].frame =
        frame_of(times(turn_about((axis + 1) % 3, angle / 3), turn_about(axis, angle)));
    check_pair(leaves);
    if (HasFatalFailure()) return;
    // Turned vertex by vertex, and rounded.
    if (const Leaf b =
            prepared(*mesh, grid_points(*mesh, turn_about(axis, angle)), name + " turned")) {
      leaves[1] = operand_of(b);
      leaves[1].first_source = 1;
      check_pair(leaves);
      if (HasFatalFailure()) return;
    }
    // Shifted: by a little along one axis, so that much is nearly coplanar, and by nothing.
    for (const int64_t shift : {int64_t{1}, random.integer(1, 1 << 24), int64_t{0}}) {
      leaves[1] = operand_of(a);
      leaves[1].first_source = 1;
      leaves[1].translation[static_cast<size_t>(axis)] = shift;
      check_pair(leaves);
      if (HasFatalFailure()) return;
    }
  }
}

}  // namespace
}  // namespace csgrun::meshes_test
