// The collapse of closed surfaces whose points meet, against invariants that know nothing of it:
// the result is a manifold by index, and the volume of the merged surface does not change (what is
// left out has none).
#include "export/collapse.h"

#include <random>

#include <gtest/gtest.h>

#include "tests/unit/export/torus.h"

namespace csgrun::collapse_test {
namespace {

using Place = std::array<int64_t, 3>;

int64_t six_volumes(const std::vector<Triangle>& triangles, const std::vector<Place>& at) {
  int64_t sum = 0;
  for (const Triangle& t : triangles) {
    const Place &a = at[t[0]], &b = at[t[1]], &c = at[t[2]];
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum;
}

/// A sphere: poles and n rings of m vertices.
std::vector<Triangle> sphere(uint32_t n, uint32_t m) {
  std::vector<Triangle> triangles;
  const uint32_t south = n * m, north = n * m + 1;
  for (uint32_t j = 0; j < m; ++j) {
    const uint32_t k = (j + 1) % m;
    triangles.push_back({south, k, j});
    for (uint32_t i = 0; i + 1 < n; ++i) {
      triangles.push_back({i * m + j, i * m + k, (i + 1) * m + k});
      triangles.push_back({i * m + j, (i + 1) * m + k, (i + 1) * m + j});
    }
    triangles.push_back({(n - 1) * m + j, (n - 1) * m + k, north});
  }
  return triangles;
}

struct Totals {
  uint64_t dropped = 0, cancelled = 0, survivors = 0, split = 0;
};

void check_collapse(const std::vector<Triangle>& triangles, const std::vector<Place>& at, int range,
                    Totals& totals) {
  std::vector<uint32_t> place;
  for (const Place& p : at) {
    place.push_back(static_cast<uint32_t>((p[0] * range + p[1]) * range + p[2]));
  }
  const auto twins = manifold_twins(triangles, at.size());
  ASSERT_TRUE(twins) << twins.error().message;
  const CollapsedSurface s = collapse(triangles, *twins, place);

  const auto new_twins = manifold_twins(s.vertices, s.origin.size());
  ASSERT_TRUE(new_twins) << new_twins.error().message;
  EXPECT_EQ(*new_twins, s.twins);
  EXPECT_EQ(s.triangles.size() + s.dropped + s.cancelled, triangles.size());
  std::vector<Place> new_at;
  for (const uint32_t v : s.origin) new_at.push_back(at[v]);
  EXPECT_EQ(six_volumes(s.vertices, new_at), six_volumes(triangles, at));
  std::vector<bool> seen(at.size(), false);
  for (size_t t = 0; t < s.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(new_at[s.vertices[t][i]], at[triangles[s.triangles[t]][i]]);
    }
    EXPECT_NE(place[triangles[s.triangles[t]][0]], place[triangles[s.triangles[t]][1]]);
  }
  for (const uint32_t v : s.origin) {
    if (seen[v]) ++totals.split;
    seen[v] = true;
  }
  totals.dropped += s.dropped;
  totals.cancelled += s.cancelled;
  totals.survivors += s.triangles.size();
}

TEST(Collapse, RandomMergesStayClosedAndKeepTheirVolume) {
  std::mt19937 random(20240607);
  Totals totals;
  for (int round = 0; round < 3000; ++round) {
    const uint32_t n = 3 + random() % 5, m = 3 + random() % 5;
    const std::vector<Triangle> mesh = random() % 2 ? test::torus(n, m) : sphere(n, m);
    const int range = 2 + static_cast<int>(random() % 3);
    std::vector<Place> at(n * m + 2);
    for (Place& p : at) {
      for (int64_t& c : p) c = static_cast<int64_t>(random() % range);
    }
    check_collapse(mesh, at, range, totals);
    if (HasFailure()) FAIL() << "round " << round;
  }
  // Not vacuous: every kind of event happened often.
  EXPECT_GT(totals.dropped, 10000u);
  EXPECT_GT(totals.cancelled, 1000u);
  EXPECT_GT(totals.survivors, 10000u);
  EXPECT_GT(totals.split, 100u);
}

TEST(Collapse, NothingMetNothingChanges) {
  const std::vector<Triangle> mesh = test::torus(4, 5);
  std::vector<uint32_t> place(20);
  for (uint32_t v = 0; v < 20; ++v) place[v] = 19 - v;
  const auto twins = manifold_twins(mesh, 20);
  ASSERT_TRUE(twins);
  const CollapsedSurface s = collapse(mesh, *twins, place);
  EXPECT_EQ(s.vertices, mesh);
  EXPECT_EQ(s.twins, *twins);
  EXPECT_EQ(s.dropped + s.cancelled, 0u);
}

}  // namespace
}  // namespace csgrun::collapse_test
