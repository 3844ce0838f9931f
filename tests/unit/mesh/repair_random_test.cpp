// Repair of random meshes with random damage, whose volume before is known.
#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/mesh/soup.h"

namespace csgrun::test::repair_random_test {
namespace {

/// Damages that repair undoes exactly: faces turned, doubled, doubled on their back, taken apart,
/// spikes, and unused points.
TEST(Repair, RandomDamageThatLosesNothing) {
  Random random(7);
  for (int round = 0; round < 300; ++round) {
    int64_t volume = 0;
    Soup soup = random_cells(random, 5, 40, volume);
    ASSERT_EQ(signed_volume(soup.mesh()), static_cast<double>(volume));
    const size_t count = soup.faces.size();
    const auto any = [&] { return soup.faces[random.integer(0, static_cast<int64_t>(count) - 1)]; };
    for (int i = 0; i < 3; ++i) {
      Face again = any();
      if (random.integer(0, 1) == 0) std::reverse(again.begin(), again.end());
      std::rotate(again.begin(), again.begin() + 1, again.end());
      soup.faces.push_back(again);
      again = any();
      again[1] = again[0];
      soup.faces.push_back(again);
    }
    const bool turned = random.integer(0, 1) == 1;
    if (turned) soup.turn();
    soup = unwelded(soup);
    soup.points.push_back({1e6, 1e6, 1e6});
    Lines said;
    EXPECT_EQ(repaired_volume(soup, {}, &said), static_cast<double>(volume)) << "round " << round;
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(Repair, RandomFacesTurned) {
  Random random(8);
  for (int round = 0; round < 300; ++round) {
    int64_t volume = 0;
    Soup soup = random_cells(random, 6, 25, volume);
    for (Face& face : soup.faces) {
      if (random.integer(0, 2) == 0) std::reverse(face.begin(), face.end());
    }
    EXPECT_EQ(repaired_volume(soup, {}), static_cast<double>(volume)) << "round " << round;
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(Repair, RandomFacesMissing) {
  Random random(9);
  for (int round = 0; round < 300; ++round) {
    int64_t volume = 0;
    Soup soup = random_cells(random, 6, 25, volume);
    // Single triangles that do not touch: what is missing is known.
    std::set<uint32_t> touched;
    std::vector<Face> kept;
    int missing = 0;
    for (const Face& face : soup.faces) {
      const bool apart =
          std::none_of(face.begin(), face.end(), [&](uint32_t v) { return touched.count(v) > 0; });
      if (apart && random.integer(0, 3) == 0) {
        touched.insert(face.begin(), face.end());
        ++missing;
      } else {
        kept.push_back(face);
      }
    }
    soup.faces = kept;
    Lines said;
    EXPECT_EQ(repaired_volume(soup, filling(), &said), static_cast<double>(volume))
        << "round " << round;
    EXPECT_EQ(said.size(), missing > 0 ? 1u : 0u);
    if (::testing::Test::HasFailure()) return;
  }
}

/// A point in the middle of one face's edge, or a corner moved a little in one face only.
TEST(Repair, RandomCracks) {
  Random random(10);
  for (int round = 0; round < 200; ++round) {
    int64_t volume = 0;
    Soup soup = unwelded(random_cells(random, 6, 25, volume));
    for (Face& face : soup.faces) {
      if (random.integer(0, 4) == 0) {
        const glm::dvec3 middle = 0.5 * (soup.points[face[0]] + soup.points[face[1]]);
        face.insert(face.begin() + 1, static_cast<uint32_t>(soup.points.size()));
        soup.points.push_back(middle);
      }
    }
    EXPECT_EQ(repaired_volume(soup, {}), static_cast<double>(volume)) << "round " << round;
    for (glm::dvec3& p : soup.points) {
      for (int i = 0; i < 3; ++i) p[i] += 1e-5 * (random.unit() - 0.5);
    }
    RepairOptions options;
    options.weld = 1e-4;
    EXPECT_NEAR(repaired_volume(soup, options), static_cast<double>(volume), 0.05);
    if (::testing::Test::HasFailure()) return;
  }
}

/// Whatever is thrown at it: an answer that is closed, or an error, and the same one twice.
TEST(Repair, RandomGarbage) {
  Random random(11);
  int good = 0;
  for (int round = 0; round < 2400; ++round) {
    Soup soup;
    const int64_t points = random.integer(1, 9), faces = random.integer(1, 14);
    for (int64_t i = 0; i < points; ++i) {
      soup.points.emplace_back(random.integer(0, 2), random.integer(0, 2), random.integer(0, 2));
    }
    for (int64_t f = 0; f < faces; ++f) {
      Face face;
      for (int64_t k = random.integer(3, 5); k > 0; --k) {
        face.push_back(static_cast<uint32_t>(random.integer(0, points - 1)));
      }
      soup.faces.push_back(face);
    }
    RepairOptions options;
    options.fill_holes = random.integer(0, 3) > 0;
    options.orient = random.integer(0, 7) > 0;
    options.drop_duplicates = random.integer(0, 3) > 0;
    options.drop_degenerate = random.integer(0, 3) > 0;
    options.weld = random.integer(0, 3) == 0 ? 1.2 : 0;
    const Result<PolygonMesh> once = repair_mesh(soup.mesh(), options, nullptr);
    const Result<PolygonMesh> twice = repair_mesh(soup.mesh(), options, nullptr);
    ASSERT_EQ(once.has_value(), twice.has_value());
    if (!once) {
      EXPECT_EQ(once.error().code, ErrorCode::kInvalidMesh) << once.error().message;
      EXPECT_EQ(once.error().message, twice.error().message);
      continue;
    }
    ++good;
    EXPECT_EQ(once->corners, twice->corners);
    EXPECT_TRUE(is_balanced(*once)) << "round " << round;
  }
  EXPECT_GT(good, 500);
}

}  // namespace
}  // namespace csgrun::test::repair_random_test
