#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <csgrun/engine/validate.h>

namespace csgrun::test::validate_test {
namespace {

PolygonMesh cube() {
  PolygonMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.points.push_back({i & 1, i >> 1 & 1, i >> 2});
  const std::array<std::array<uint32_t, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}};
  for (const auto& face : faces) mesh.add_face(face);
  return mesh;
}

TEST(Validate, CubeIsSound) {
  const MeshReport report = check_mesh(cube());
  EXPECT_TRUE(report.ok());
  EXPECT_TRUE(report.first_places.empty());
  EXPECT_EQ(report.text(), "");
  EXPECT_EQ(signed_volume(cube()), 1);
}

TEST(Validate, EmptyMeshIsSound) {
  PolygonMesh mesh;
  EXPECT_TRUE(check_mesh(mesh).ok());
  EXPECT_EQ(signed_volume(mesh), 0);
  weld_points(mesh);
  reverse_faces(mesh);
}

TEST(Validate, OpenEdges) {
  PolygonMesh mesh = cube();
  mesh.points[7] = {0.1 + 0.2, 1e300, -2.5};
  mesh.corners.resize(20);
  mesh.loop_starts.pop_back();
  mesh.face_starts.pop_back();
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.open_edges, 4u);
  EXPECT_EQ(report.misoriented_edges, 0u);
  EXPECT_FALSE(report.ok());
  ASSERT_EQ(report.first_places.size(), 4u);
  EXPECT_EQ(report.first_places[0], "open edge (0, 0, 0) - (0, 1, 0)");
  EXPECT_EQ(report.text(), "4 open edges (first: (0, 0, 0) - (0, 1, 0))");
}

TEST(Validate, NumbersAreShortestAndReadBack) {
  PolygonMesh mesh = cube();
  for (auto& p : mesh.points) p *= 0.1;
  mesh.corners.resize(20);
  mesh.loop_starts.pop_back();
  mesh.face_starts.pop_back();
  mesh.points[2].y = 0.1 + 0.2;
  EXPECT_EQ(check_mesh(mesh).first_places.at(0),
            "open edge (0, 0, 0) - (0, 0.30000000000000004, 0)");
}

TEST(Validate, FlippedFace) {
  PolygonMesh mesh = cube();
  std::reverse(mesh.corners.begin() + 4, mesh.corners.begin() + 8);
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.misoriented_edges, 4u);
  EXPECT_EQ(report.open_edges, 0u);
  EXPECT_EQ(report.first_places.size(), 4u);
}

TEST(Validate, EdgesOfFourFacesAreBalanced) {
  // Two cubes that share the points of one edge.
  PolygonMesh mesh = cube();
  const auto base = static_cast<uint32_t>(mesh.points.size());
  PolygonMesh other = cube();
  for (auto& p : other.points) p += glm::dvec3(1, 1, 0);
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (size_t f = 0; f < 6; ++f) {
    std::vector<uint32_t> face;
    for (int k = 0; k < 4; ++k) face.push_back(base + other.corners[4 * f + k]);
    mesh.add_face(face);
  }
  weld_points(mesh);
  EXPECT_EQ(mesh.points.size(), 14u);
  EXPECT_TRUE(check_mesh(mesh).ok());
}

TEST(Validate, ThreeFacesAtAnEdge) {
  PolygonMesh mesh = cube();
  mesh.points.push_back({-1, -1, 0});
  mesh.add_face(std::array<uint32_t, 3>{0, 1, 8});
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.open_edges, 3u);
}

TEST(Validate, DegenerateFaces) {
  PolygonMesh mesh;
  mesh.points = {{0, 0, 0}, {0.1, 0.2, 0.3}, {0.2, 0.4, 0.6}, {1, 0, 0}, {0, 0, 0}};
  mesh.add_face(std::array<uint32_t, 3>{0, 1, 2});     // collinear
  mesh.add_face(std::array<uint32_t, 2>{0, 1});        // two corners
  mesh.add_face(std::array<uint32_t, 4>{0, 1, 1, 3});  // a corner twice in a row
  mesh.add_face(std::array<uint32_t, 3>{0, 3, 4});     // equal points of two numbers
  mesh.add_face(std::array<uint32_t, 3>{0, 3, 1});
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.degenerate_faces, 4u);
  EXPECT_EQ(report.first_places.at(0), "degenerate face 0 at (0, 0, 0)");
}

TEST(Validate, FacesWhoseAreaCancelsAreNotDegenerate) {
  PolygonMesh mesh;  // a bow-tie
  mesh.points = {{0, 0, 0}, {10, 10, 1}, {10, 0, 0}, {0, 10, 1}};
  mesh.add_face(std::array<uint32_t, 4>{0, 1, 2, 3});
  EXPECT_EQ(check_mesh(mesh).degenerate_faces, 0u);
}

TEST(Validate, ThinFacesAreNotDegenerate) {
  PolygonMesh mesh;
  mesh.points = {{1e6, 1e6, 0}, {1e6 + 1, 1e6, 0}, {1e6 + 0.5, 1e6 + 1e-9, 0}};
  mesh.add_face(std::array<uint32_t, 3>{0, 1, 2});
  EXPECT_EQ(check_mesh(mesh).degenerate_faces, 0u);
}

TEST(Validate, BadNumbers) {
  PolygonMesh mesh = cube();
  mesh.corners[5] = 77;
  mesh.points[2].z = std::numeric_limits<double>::quiet_NaN();
  mesh.points[3].x = std::numeric_limits<double>::infinity();
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.bad_indices, 1u);
  EXPECT_EQ(report.non_finite_points, 2u);
  EXPECT_EQ(report.degenerate_faces, 0u);
  EXPECT_EQ(report.first_places.at(0), "bad index 77 of 8 points");
  weld_points(mesh);
  EXPECT_EQ(check_mesh(mesh).bad_indices, 1u);

  mesh.loop_starts.back() = 1000;
  EXPECT_GT(check_mesh(mesh).bad_indices, 0u);
}

TEST(Validate, AtMostFivePlacesAKind) {
  PolygonMesh mesh;
  for (int i = 0; i < 300; ++i) {
    mesh.points.push_back({i, i % 3, i % 2});
    if (i % 3 == 2)
      mesh.add_face(std::array<uint32_t, 3>{mesh.face_starts.back() * 3,
                                            mesh.face_starts.back() * 3 + 1,
                                            mesh.face_starts.back() * 3 + 2});
  }
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.open_edges, 300u);
  EXPECT_EQ(report.first_places.size(), 5u);
}

TEST(Validate, WeldMergesAndDrops) {
  PolygonMesh mesh;
  mesh.points = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, -0.0}, {0, 0, 1}, {1, 0, 0}};
  mesh.add_face(std::array<uint32_t, 3>{1, 3, 2});
  mesh.add_face(std::array<uint32_t, 3>{4, 6, 5});
  mesh.add_face(std::array<uint32_t, 3>{2, 3, 5});
  mesh.add_face(std::array<uint32_t, 3>{3, 1, 5});
  EXPECT_EQ(check_mesh(mesh).open_edges, 6u);
  weld_points(mesh);
  EXPECT_EQ(mesh.points.size(), 4u);
  EXPECT_TRUE(check_mesh(mesh).ok()) << check_mesh(mesh).text();
  EXPECT_DOUBLE_EQ(signed_volume(mesh), 1.0 / 6);
  reverse_faces(mesh);
  EXPECT_DOUBLE_EQ(signed_volume(mesh), -1.0 / 6);
  EXPECT_TRUE(check_mesh(mesh).ok());
}

TEST(Validate, HolesCount) {
  // A cube with a square tunnel: two faces have a hole each.
  PolygonMesh mesh;
  for (int ring = 0; ring < 2; ++ring) {
    for (int z = 0; z < 2; ++z) {
      const double r = ring ? 1 : 2;
      for (const auto& [x, y] : {std::pair(-r, -r), {r, -r}, {r, r}, {-r, r}}) {
        mesh.points.push_back({x, y, 3 * z});
      }
    }
  }
  for (uint32_t i = 0; i < 4; ++i) {
    const uint32_t j = (i + 1) % 4;
    mesh.add_face(std::array<uint32_t, 4>{i, j, 4 + j, 4 + i});
    mesh.add_face(std::array<uint32_t, 4>{8 + j, 8 + i, 12 + i, 12 + j});
  }
  const auto ring_face = [&](std::array<uint32_t, 4> outer, std::array<uint32_t, 4> hole) {
    mesh.add_face(outer);
    mesh.corners.insert(mesh.corners.end(), hole.begin(), hole.end());
    mesh.loop_starts.push_back(static_cast<uint32_t>(mesh.corners.size()));
    mesh.face_starts.back() = static_cast<uint32_t>(mesh.loop_count());
  };
  ring_face({3, 2, 1, 0}, {8, 9, 10, 11});
  ring_face({4, 5, 6, 7}, {15, 14, 13, 12});
  EXPECT_TRUE(check_mesh(mesh).ok()) << check_mesh(mesh).text();
  EXPECT_DOUBLE_EQ(signed_volume(mesh), 3 * (16 - 4));
}

}  // namespace
}  // namespace csgrun::test::validate_test
