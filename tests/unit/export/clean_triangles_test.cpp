// What is known of the triangles of one mesh, used on the next: the same crossings, and fewer
// triangles to look at.
#include "export/clean_triangles.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "export/defects.h"
#include "tests/support/seeded.h"

namespace csgrun::clean_triangles_test {
namespace {

using test::Random;

glm::dvec3 random_point(Random& random, int64_t least, int64_t most) {
  const auto coordinate = [&] { return static_cast<double>(random.integer(least, most)) / 4; };
  return {coordinate(), coordinate(), coordinate()};
}

/// Small triangles by themselves, all of one face.
RoundedMesh soup(Random& random, uint32_t count) {
  RoundedMesh mesh;
  for (uint32_t t = 0; t < count; ++t) {
    const glm::dvec3 at = random_point(random, 0, 70);
    for (int k = 0; k < 3; ++k) mesh.positions.push_back(at + random_point(random, 0, 8));
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  mesh.triangle_face.assign(count, 0);
  return mesh;
}

TEST(CleanTriangles, TellTheCrossingsOfTheNextMesh) {
  const std::vector<glm::dvec3> directions{{0, 0, 1}};
  size_t looked_at = 0, crossings = 0, before = 0;
  constexpr uint32_t kCount = 300;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Random random(900 + seed);
    RoundedMesh mesh = soup(random, kCount);
    const Defects first = find_defects(mesh, directions);
    const CleanTriangles clean(mesh, first.crossings);
    EXPECT_FALSE(clean.none());
    // Others in between, some moved, and all from other corners.
    for (glm::dvec3& p : mesh.positions) {
      if (random.integer(0, 30) == 0) p += random_point(random, -8, 8);
    }
    for (int i = 0; i < 5; ++i) {  // one upon another
      const auto from = 3 * static_cast<size_t>(random.integer(0, kCount - 1)),
                 to = 3 * static_cast<size_t>(random.integer(0, kCount - 1));
      for (size_t k = 0; k < 3; ++k) mesh.positions[to + k] = mesh.positions[from + k];
    }
    for (auto& t : mesh.triangles)
      std::rotate(t.begin(), t.begin() + random.integer(0, 2), t.end());
    for (size_t i = mesh.triangles.size(); i > 1; --i) {
      std::swap(
          mesh.triangles[i - 1],
          mesh.triangles[static_cast<size_t>(random.integer(0, static_cast<int64_t>(i) - 1))]);
    }
    const Defects known = find_defects(mesh, directions, clean),
                  all = find_defects(mesh, directions);
    ASSERT_EQ(known.crossings.size(), all.crossings.size());
    for (size_t i = 0; i < all.crossings.size(); ++i) {
      EXPECT_EQ(known.crossings[i].triangles, all.crossings[i].triangles);
      EXPECT_EQ(known.crossings[i].place, all.crossings[i].place);
    }
    looked_at += clean.others(mesh).size();
    crossings += all.crossings.size();
    before += first.crossings.size();
  }
  EXPECT_GT(before, 200u);
  EXPECT_GT(crossings, 200u);
  EXPECT_LT(looked_at, 20 * kCount / 2);
}

TEST(CleanTriangles, AreThoseWithoutACrossing) {
  RoundedMesh mesh;
  mesh.positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1},
                    {1, 2, 1}, {9, 9, 9}, {9, 8, 9}, {8, 9, 9}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  mesh.triangle_face = {0, 0, 0};
  const CleanTriangles clean(mesh,
                             find_defects(mesh, std::vector<glm::dvec3>{{0, 0, 1}}).crossings);
  EXPECT_EQ(clean.others(mesh), (std::vector<uint32_t>{0, 1}));
  mesh.triangles[2] = {6, 8, 7};  // seen from the other side
  EXPECT_EQ(clean.others(mesh), (std::vector<uint32_t>{0, 1, 2}));
  mesh.triangles[2] = {8, 6, 7};
  EXPECT_EQ(clean.others(mesh), (std::vector<uint32_t>{0, 1}));
  EXPECT_TRUE(CleanTriangles().none());
  // One that is laid upon a clean one.
  mesh.triangles = {{6, 7, 8}, {0, 1, 2}, {8, 6, 7}};
  EXPECT_EQ(clean.others(mesh), (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_EQ(find_defects(mesh, std::vector<glm::dvec3>{{0, 0, 1}}, clean).crossings.size(), 1u);
}

}  // namespace
}  // namespace csgrun::clean_triangles_test
