// Along which diagonal OpenSCAD cuts a face of four corners that is bent.
#include "primitives/solids/bent_quads.h"

#include <array>
#include <string>

#include <gtest/gtest.h>

#include <csgrun/primitives/csg_file.h>
#include <csgrun/primitives/mesh_file.h>

#include "tests/unit/primitives/mesh_measures.h"

namespace csgrun {
namespace {

struct Case {
  std::array<std::array<int, 3>, 4> corners;
  uint32_t end;  ///< of the diagonal: this corner and the next but one
};

// What the tessellator of OpenSCAD (libtess2, constrained Delaunay triangles, the rule for odd
// windings) makes of them. Where the shadow is a square both diagonals are Delaunay's.
constexpr Case kCases[] = {
    {{{{0, 0, 0}, {1, 1, 1}, {0, 1, 0}, {1, 0, 0}}}, 1},
    {{{{1, 0, 1}, {1, 0, 0}, {0, 0, 0}, {1, 1, 1}}}, 1},
    {{{{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {0, 1, 0}}}, 0},
    {{{{1, 1, 0}, {1, 0, 0}, {0, 0, 0}, {0, 0, 1}}}, 1},
    {{{{0, 1, 0}, {1, 1, 1}, {1, 0, 0}, {0, 0, 0}}}, 1},
    {{{{1, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}}}, 1},
    {{{{0, 1, 1}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}}, 0},
    {{{{1, 1, 1}, {0, 1, 0}, {0, 0, 0}, {0, 1, 1}}}, 1},
    {{{{0, 0, 0}, {0, 1, 1}, {0, 0, 1}, {1, 1, 1}}}, 3},
    {{{{0, 1, 0}, {0, 1, 1}, {1, 0, 1}, {0, 0, 1}}}, 0},
    {{{{1, 1, 0}, {0, 1, 0}, {0, 0, 0}, {1, 1, 1}}}, 1},
    {{{{1, 0, 1}, {0, 0, 1}, {1, 0, 0}, {1, 1, 1}}}, 1},
    {{{{1, 0, 1}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 1},
    {{{{0, 1, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 1}}}, 0},
    {{{{1, 1, 1}, {0, 1, 1}, {1, 1, 0}, {1, 0, 1}}}, 1},
    {{{{0, 1, 0}, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}}}, 1},
    {{{{1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 0, 0}}}, 1},
    {{{{0, 1, 0}, {1, 1, 1}, {1, 0, 0}, {1, 1, 0}}}, 1},
    {{{{0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {1, 1, 0}}}, 0},
    {{{{0, 1, 0}, {1, 1, 1}, {1, 0, 1}, {0, 1, 1}}}, 1},
    {{{{1, 1, 1}, {1, 1, 0}, {0, 1, 0}, {1, 0, 1}}}, 1},
    {{{{0, 1, 0}, {1, 1, 1}, {0, 0, 1}, {1, 0, 0}}}, 0},
    {{{{1, 1, 1}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, 0},
    {{{{0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {1, 1, 0}}}, 1},
    {{{{1, 1, 1}, {1, 1, 0}, {0, 0, 0}, {1, 0, 1}}}, 0},
    {{{{1, 1, 1}, {0, 0, 1}, {0, 0, 0}, {0, 1, 0}}}, 1},
    {{{{-1, 1, 1}, {0, 1, 0}, {-1, 0, 0}, {-1, 0, 1}}}, 0},
    {{{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {1, 1, 1}}}, 1},
    {{{{0, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 0, 0}}}, 1},
    {{{{0, 0, 0}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}}}, 1},
    {{{{-1, 1, -1}, {0, 0, -1}, {-1, 0, 0}, {-1, 1, 0}}}, 1},
    {{{{0, 0, -1}, {0, 0, 0}, {1, -1, 0}, {0, -1, -1}}}, 0},
    {{{{0, 1, 1}, {0, 1, 0}, {1, 1, 0}, {1, 0, 1}}}, 1},
    {{{{1, 1, 1}, {1, 1, 0}, {0, 0, 0}, {1, 0, 1}}}, 0},
    {{{{0, -1, -1}, {0, -1, 0}, {0, 0, 0}, {1, 0, -1}}}, 0},
    {{{{1, 0, 1}, {1, 1, 0}, {0, 1, 0}, {0, 1, 1}}}, 1},
    {{{{0, 0, 0}, {0, 0, 1}, {-1, -1, 1}, {0, -1, 0}}}, 0},
    {{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 1, 1}}}, 0},
    {{{{5, 0, 5}, {0, 0, 3}, {6, 3, 0}, {5, 1, 6}}}, 0},
    {{{{1, 2, 0}, {0, 2, 2}, {2, 1, 2}, {2, 1, 1}}}, 1},
    {{{{5, 2, 2}, {2, 3, 2}, {2, 0, 0}, {1, 6, 3}}}, 1},
    {{{{2, 4, 0}, {2, 2, 3}, {3, 2, 2}, {5, 0, 5}}}, 0},
    {{{{2, 2, 2}, {2, 2, 0}, {1, 2, 0}, {0, 1, 2}}}, 0},
    {{{{4, 4, 3}, {4, 1, 3}, {4, 0, 2}, {1, 6, 3}}}, 1},
    {{{{1, 3, 0}, {1, 0, 2}, {0, 2, 2}, {2, 3, 3}}}, 0},
    {{{{1, 1, 0}, {0, 0, 0}, {3, 2, 2}, {3, 2, 1}}}, 0},
    {{{{2, 6, 4}, {6, 2, 4}, {4, 2, 2}, {1, 6, 0}}}, 0},
    {{{{0, 1, 0}, {1, 0, 1}, {2, 2, 1}, {1, 2, 1}}}, 1},
    {{{{1, 1, 1}, {3, 0, 0}, {2, 0, 3}, {2, 3, 3}}}, 0},
    {{{{3, 2, 6}, {2, 2, 4}, {0, 1, 2}, {4, 0, 3}}}, 1},
    {{{{1, 5, 2}, {3, 0, 4}, {0, 1, 4}, {4, 4, 5}}}, 0},
    {{{{2, 2, 2}, {6, 3, 0}, {2, 5, 6}, {4, 1, 5}}}, 0},
    {{{{5, 3, 5}, {6, 0, 6}, {4, 2, 1}, {2, 0, 4}}}, 0},
    {{{{1, 2, 0}, {2, 0, 2}, {0, 0, 0}, {2, 1, 0}}}, 1},
    {{{{6, 0, 3}, {4, 6, 4}, {5, 1, 3}, {1, 4, 5}}}, 0},
    {{{{4, 5, 5}, {0, 4, 1}, {2, 5, 5}, {2, 3, 6}}}, 0},
};

TEST(BentQuads, AreCutAsOpenScadCutsThem) {
  for (const Case& c : kCases) {
    for (const double scale : {1.0, 1024.0}) {
      PolygonMesh mesh;
      for (const auto& p : c.corners) mesh.points.emplace_back(p[0], p[1], p[2]);
      // Exact, so every tie stays one.
      for (glm::dvec3& p : mesh.points) p *= scale;
      mesh.add_face(std::array<uint32_t, 4>{0, 1, 2, 3}, 5);
      mesh.appearance_of = {2};
      cut_bent_quads(mesh);
      ASSERT_EQ(mesh.face_count(), 2u);
      EXPECT_EQ(mesh.surface, (std::vector<uint32_t>{5, 5}));
      EXPECT_EQ(mesh.appearance_of, (std::vector<uint32_t>{2, 2}));
      const uint32_t a = mesh.corners[0], b = mesh.corners[2];
      EXPECT_EQ(a % 2, c.end % 2) << ::testing::PrintToString(c.corners);
      EXPECT_EQ((a + 2) % 4, b);
      EXPECT_EQ(mesh.corners[3], a);
      EXPECT_EQ(mesh.corners[4], b);
    }
  }
}

TEST(BentQuads, FlatOnesAndOthersStay) {
  PolygonMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 1e-9}, {0, 1, 0},
                 {2, 0, 1}, {2, 1, 0}, {3, 3, 3},    {1, 1, 0}};
  mesh.add_face(std::array<uint32_t, 4>{0, 1, 2, 3});
  mesh.add_face(std::array<uint32_t, 3>{0, 1, 4});
  mesh.add_face(std::array<uint32_t, 5>{0, 1, 4, 5, 6});
  const PolygonMesh before = mesh;
  cut_bent_quads(mesh);
  EXPECT_EQ(mesh.corners, before.corners);
  mesh.add_face(std::array<uint32_t, 4>{1, 4, 5, 7});  // bent
  cut_bent_quads(mesh);
  EXPECT_EQ(mesh.face_count(), 5u);
}

/// A unit cube whose top has one corner pulled up by 1: the volume tells the diagonal.
TEST(BentQuads, GiveTheVolumesOfOpenScad) {
  const std::string start =
      "polyhedron(points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, ";
  const std::string faces =
      "faces = [[0, 1, 2, 3], [4, 5, 1, 0], [7, 6, 5, 4], [5, 6, 2, 1], [6, 7, 3, 2], [7, 4, 0, "
      "3]], "
      "convexity = 1);";
  const auto volume = [&](const std::string& heights) {
    const auto model = parse_csg("m.csg", start + heights + "]], " + faces);
    EXPECT_TRUE(model) << (model ? "" : model.error().message);
    return model ? testing::volume(*model->solid->mesh()) : 0;
  };
  // One corner of the top is pulled up. It is seen along X, where two of its corners are one.
  EXPECT_DOUBLE_EQ(volume("2], [1, 0, 1], [1, 1, 1], [0, 1, 1"), 1 + 1.0 / 3);
  EXPECT_DOUBLE_EQ(volume("1], [1, 0, 2], [1, 1, 1], [0, 1, 1"), 1 + 1.0 / 3);
  EXPECT_DOUBLE_EQ(volume("1], [1, 0, 1], [1, 1, 2], [0, 1, 1"), 1 + 1.0 / 6);
  EXPECT_DOUBLE_EQ(volume("1], [1, 0, 1], [1, 1, 1], [0, 1, 2"), 1 + 1.0 / 3);
}

TEST(BentQuads, OfMeshFilesAreCutAlike) {
  const std::string off =
      "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 2\n1 1 1\n0 1 1\n4 3 2 1 0\n4 0 1 5 4\n"
      "4 4 5 6 7\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  auto mesh = parse_mesh("a.off", off);
  ASSERT_TRUE(mesh);
  auto solid = make_solid_mesh(*mesh, nullptr);
  ASSERT_TRUE(solid);
  EXPECT_DOUBLE_EQ(testing::volume(*solid), 1 + 1.0 / 3);
  std::vector<std::string> notes;
  auto repaired = repair_solid_mesh(*mesh, {}, &notes);
  ASSERT_TRUE(repaired);
  EXPECT_DOUBLE_EQ(testing::volume(*repaired), 1 + 1.0 / 3);
}

}  // namespace
}  // namespace csgrun
