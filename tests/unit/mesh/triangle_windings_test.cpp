// Winding numbers in front of triangles of meshes over doubles, against counting of boxes.
#include <random>

#include <gtest/gtest.h>

#include <csgrun/engine/exact_triangles.h>

namespace csgrun::triangle_windings_test {
namespace {

struct TestBox {
  std::array<int, 3> low, high;
  int sign;  ///< 1 outwards, -1 inwards
};

/// Boxes within boxes, and beside one another, in [low, high]; none touches another.
void fill(std::mt19937_64& random, const std::array<int, 3>& low, const std::array<int, 3>& high,
          std::vector<TestBox>& boxes) {
  if (high[0] - low[0] < 3 || high[1] - low[1] < 3 || high[2] - low[2] < 3) return;
  if (random() % 3 == 0) {
    const size_t axis = random() % 3;
    auto left = high, right = low;
    left[axis] = right[axis] = low[axis] + (high[axis] - low[axis]) / 2;
    fill(random, low, left, boxes);
    fill(random, right, high, boxes);
    return;
  }
  TestBox box{low, high, random() % 2 == 0 ? 1 : -1};
  for (size_t k = 0; k < 3; ++k) {
    const auto room = static_cast<uint64_t>(high[k] - low[k] - 2);
    box.low[k] += 1 + static_cast<int>(random() % 2 % room);
    box.high[k] -= 1;
  }
  boxes.push_back(box);
  fill(random, box.low, box.high, boxes);
}

bool contains(const TestBox& outer, const TestBox& inner) {
  for (size_t k = 0; k < 3; ++k) {
    if (outer.low[k] >= inner.low[k] || outer.high[k] <= inner.high[k]) return false;
  }
  return true;
}

TEST(Windings, InFrontOfNestedBoxesAreWhatCountingSays) {
  constexpr std::array<std::array<uint32_t, 4>, 6> kSides{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}};
  std::array<uint64_t, 3> seen{};  // less than 0, 0, more
  for (uint64_t seed = 1; seed <= 200; ++seed) {
    std::mt19937_64 random(seed);
    std::vector<TestBox> boxes;
    fill(random, {0, 0, 0}, {40, 37, 41}, boxes);
    // Far from the origin and in thirds: sums of coordinates do not come out even.
    const double step = seed % 2 == 0 ? 1 : 1.0 / 3, far = seed % 3 == 0 ? 1e6 : 0;
    std::vector<glm::dvec3> points;
    std::vector<std::array<uint32_t, 3>> triangles;
    for (const TestBox& box : boxes) {
      const auto first = static_cast<uint32_t>(points.size());
      for (uint32_t i = 0; i < 8; ++i) {
        points.emplace_back(far + step * (i & 1 ? box.high[0] : box.low[0]),
                            step * (i & 2 ? box.high[1] : box.low[1]),
                            step * (i & 4 ? box.high[2] : box.low[2]));
      }
      for (const auto& s : kSides) {
        for (const std::array<uint32_t, 3>& t : {std::array{s[0], s[1], s[2]}, {s[0], s[2], s[3]}})
          triangles.push_back(
              {first + t[0], first + t[box.sign > 0 ? 1 : 2], first + t[box.sign > 0 ? 2 : 1]});
      }
    }
    std::vector<uint32_t> all(triangles.size());
    for (uint32_t t = 0; t < all.size(); ++t) all[t] = t;
    const std::vector<int> windings = windings_in_front({points, triangles}, all);
    for (size_t t = 0; t < all.size(); ++t) {
      const TestBox& own = boxes[t / 12];
      int expected = own.sign > 0 ? 0 : -1;  // the front of a void is inside its box
      for (const TestBox& box : boxes) expected += contains(box, own) ? box.sign : 0;
      ASSERT_EQ(windings[t], expected) << "seed " << seed << ", triangle " << t;
      ++seen[expected < 0 ? 0 : expected == 0 ? 1 : 2];
    }
  }
  for (const uint64_t count : seen) EXPECT_GT(count, 1000u);
}

}  // namespace
}  // namespace csgrun::triangle_windings_test
