// Meshes as they are found that cross themselves: what is inside by each rule, at random points,
// against winding numbers by solid angles.
#include <cmath>
#include <filesystem>
#include <random>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>
#include <csgrun/engine/validate.h>
#include <csgrun/primitives/mesh_file.h>

#include "tests/support/source_folder.h"

namespace csgrun::crossing_models_test {
namespace {

std::filesystem::path mesh_folder() { return test::shared_folder() / "meshes"; }

/// The sum of the solid angles of triangles over 4 pi, by van Oosterom and Strackee.
double winding(const PolygonMesh& mesh, const glm::dvec3& q) {
  double sum = 0;
  for (size_t loop = 0; loop < mesh.loop_count(); ++loop) {
    const uint32_t begin = mesh.loop_starts[loop], end = mesh.loop_starts[loop + 1];
    for (uint32_t c = begin + 1; c + 1 < end; ++c) {
      const glm::dvec3 a = mesh.points[mesh.corners[begin]] - q,
                       b = mesh.points[mesh.corners[c]] - q,
                       d = mesh.points[mesh.corners[c + 1]] - q;
      const auto dot = [](const glm::dvec3& u, const glm::dvec3& v) {
        return u.x * v.x + u.y * v.y + u.z * v.z;
      };
      const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), ld = std::sqrt(dot(d, d));
      const double volume = a.x * (b.y * d.z - b.z * d.y) + a.y * (b.z * d.x - b.x * d.z) +
                            a.z * (b.x * d.y - b.y * d.x);
      sum +=
          2 * std::atan2(volume, la * lb * ld + dot(a, b) * ld + dot(b, d) * la + dot(d, a) * lb);
    }
  }
  return sum / (4 * 3.14159265358979323846);
}

void check_model(const std::string& name) {
  SCOPED_TRACE(name);
  auto read = read_mesh_file((mesh_folder() / name).string());
  ASSERT_TRUE(read.has_value()) << read.error().message;
  std::string note;
  auto mesh = make_solid_mesh(*std::move(read), &note);
  ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
  EvaluateOptions options;
  options.threads = 2;
  Evaluator evaluator(options);
  std::array<NodePtr, 3> nodes;
  const FillRule rules[] = {FillRule::kNonZero, FillRule::kPositive, FillRule::kEvenOdd};
  std::array<double, 3> volume{};
  for (size_t i = 0; i < 3; ++i) {
    mesh->fill = rules[i];
    nodes[i] = Node::leaf(std::make_shared<PolygonMesh>(*mesh));
    const auto solid = evaluator.evaluate(nodes[i]);
    ASSERT_TRUE(solid.has_value()) << solid.error().message;
    EXPECT_TRUE((*solid)->measures.closed);
    volume[i] = (*solid)->measures.volume;
  }
  // Points near faces, where layers are.
  std::mt19937 random(17);
  std::uniform_real_distribution<double> spread(-0.02, 0.02);
  glm::dvec3 lo = mesh->points[mesh->corners[0]], hi = lo;
  for (const uint32_t c : mesh->corners) {
    lo = glm::min(lo, mesh->points[c]);
    hi = glm::max(hi, mesh->points[c]);
  }
  int tested = 0, most = 0;
  for (int i = 0; i < 120; ++i) {
    glm::dvec3 q = mesh->points[mesh->corners[random() % mesh->corners.size()]];
    for (int k = 0; k < 3; ++k) q[k] += spread(random) * (hi[k] - lo[k]);
    const double w = winding(*mesh, q);
    const int n = static_cast<int>(std::lround(w));
    if (std::fabs(w - n) > 1e-3) continue;
    ++tested;
    most = std::max(most, n);
    const bool expected[] = {n != 0, n > 0, n % 2 != 0};
    for (size_t r = 0; r < 3; ++r) {
      const auto inside = evaluator.contains(nodes[r], q);
      ASSERT_TRUE(inside.has_value());
      if (*inside != 0) {
        EXPECT_EQ(*inside > 0, expected[r]) << "rule " << r << ", winding number " << w;
      }
    }
  }
  EXPECT_GT(tested, 60);
  EXPECT_GT(most, 0);
  // The rule `positive` of the inverted mesh has the places of negative winding number.
  reverse_faces(*mesh);
  mesh->fill = FillRule::kPositive;
  const auto below = evaluator.evaluate(Node::leaf(std::make_shared<PolygonMesh>(*mesh)));
  ASSERT_TRUE(below.has_value()) << below.error().message;
  const double negative = (*below)->measures.volume;
  EXPECT_NEAR(volume[0], volume[1] + negative, 1e-12 * volume[0]);
  // The integral of the winding number, where that is from -1 to 2 but for next to nothing.
  EXPECT_NEAR(-signed_volume(*mesh), 2 * volume[0] - volume[2] - 2 * negative, 1e-6 * volume[0]);
}

TEST(CrossingModels, PointsByEveryRule) {
  const char* models[] = {"c3_cow.obj", "mf_self_intersectA.obj", "mf_self_intersectB.obj",
                          "tf_dragon-50k.stl"};
  if (!std::filesystem::exists(mesh_folder() / models[0])) {
    GTEST_SKIP() << "no meshes in " << mesh_folder() << " (set CSGRUN_SHARED)";
  }
  for (const char* model : models) check_model(model);
}

}  // namespace
}  // namespace csgrun::crossing_models_test
