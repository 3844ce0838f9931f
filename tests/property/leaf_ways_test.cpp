// The two ways to a leaf on meshes from the wild, on fine grids and on coarse ones.
#include "tests/support/leaf_ways.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include <csgrun/primitives/mesh_file.h>

namespace csgrun::leaf_ways_test {
namespace {

using namespace test;  // NOLINT: a test

std::filesystem::path mesh_folder() {
  const char* given = std::getenv("CSGRUN_SHARED");
  return (given ? std::filesystem::path(given)
                : std::filesystem::path(CSGRUN_SOURCE_DIR).parent_path() / "shared") /
         "meshes";
}

/// The points on a grid of 2^bits steps.
std::vector<IVec3> on_grid(const PolygonMesh& mesh, int bits) {
  double reach = 0;
  for (const glm::dvec3& p : mesh.points) {
    for (int k = 0; k < 3; ++k) reach = std::max(reach, std::fabs(p[k]));
  }
  const double scale = std::ldexp(0.99, bits) / reach;
  std::vector<IVec3> points;
  for (const glm::dvec3& p : mesh.points) {
    points.push_back(
        {std::llround(p.x * scale), std::llround(p.y * scale), std::llround(p.z * scale)});
  }
  return points;
}

TEST(LeafWays, AgreeOnMeshesFromTheWild) {
  if (!std::filesystem::is_directory(mesh_folder())) GTEST_SKIP() << "no folder " << mesh_folder();
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(mesh_folder())) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  Tally tally;
  for (const auto& file : files) {
    const auto mesh = read_mesh_file(file.string());
    if (!mesh || mesh->points.empty()) continue;
    for (const int bits : {26, 12, 8}) {
      // Of a large mesh on a very coarse grid everything crosses everything.
      if (bits == 8 && mesh->face_count() > 20000) continue;
      SCOPED_TRACE(file.filename().string() + " on " + std::to_string(bits) + " bits");
      expect_same_both_ways(*mesh, on_grid(*mesh, bits), false, tally, int64_t{1} << (38 - bits));
    }
  }
  std::printf(
      "%zu good, %zu tangled, %zu open, %zu by the quick way, %zu with merged points; "
      "%zu crossings\n",
      tally.good, tally.tangled, tally.open, tally.quick, tally.merged, tally.crossings);
  EXPECT_GT(tally.good, 0u);
  EXPECT_GT(tally.quick, 0u);
}

}  // namespace
}  // namespace csgrun::leaf_ways_test
