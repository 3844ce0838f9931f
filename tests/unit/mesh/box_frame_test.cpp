#include "engine/mesh/box_frame.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "engine/mesh/leaf_check.h"

namespace csgrun::box_frame_test {
namespace {

/// A round plate of `count` (even) corners, its top and bottom in long triangles side by side; then
/// `map`, whose rows are perpendicular and of one length, and `move`.
LeafGeometry plate(int count, const std::array<IVec3, 3>& map, const IVec3& move = {0, 0, 0}) {
  LeafGeometry leaf;
  const auto add = [&](int64_t x, int64_t y, int64_t z) {
    IVec3 q = move;
    for (size_t r = 0; r < 3; ++r) q[r] += map[r][0] * x + map[r][1] * y + map[r][2] * z;
    leaf.vertices.push_back(q);
  };
  for (const int64_t z : {0, 40}) {
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * M_PI * i / count;
      add(std::lround(1000 * std::cos(angle)), std::lround(1000 * std::sin(angle)), z);
    }
  }
  leaf.face_starts = {0};
  const auto face = [&](uint32_t a, uint32_t b, uint32_t c) {
    leaf.corners.insert(leaf.corners.end(), {a, b, c});
    leaf.face_starts.push_back(static_cast<uint32_t>(leaf.corners.size()));
  };
  const auto n = static_cast<uint32_t>(count);
  const auto both = [&](uint32_t a, uint32_t b, uint32_t c) {
    face(c, b, a);
    face(n + a, n + b, n + c);
  };
  for (uint32_t i = 0; i < n / 2; ++i) {
    const uint32_t across = (n - i) % n, next_across = n - i - 1;
    if (i > 0) both(i, i + 1, across);
    if (i + 1 < n / 2) both(i + 1, next_across, across);
  }
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t next = (i + 1) % n;
    face(i, next, n + next);
    face(i, n + next, n + i);
  }
  return leaf;
}

constexpr std::array<IVec3, 3> kUpright{{{15, 0, 0}, {0, 15, 0}, {0, 0, 15}}};
/// A rotation, 15 times as large: rows (2, 10, 11), (14, -5, 2), (5, 10, -10) / 15.
constexpr std::array<IVec3, 3> kAslant{{{2, 10, 11}, {14, -5, 2}, {5, 10, -10}}};

bool overlap(const FloatBox& a, const FloatBox& b) {
  bool all = true;
  for (size_t k = 0; k < 3; ++k) all = all && a.lo[k] <= b.hi[k] && b.lo[k] <= a.hi[k];
  return all;
}

size_t overlaps(const std::vector<FloatBox>& boxes) {
  size_t count = 0;
  for (size_t f = 0; f < boxes.size(); ++f) {
    for (size_t g = 0; g < f; ++g) count += overlap(boxes[f], boxes[g]) ? 1 : 0;
  }
  return count;
}

TEST(BoxFrame, IsAlongTheNormalsOfFlatSides) {
  const LeafGeometry leaf = plate(200, kAslant);
  const auto frame = find_box_frame(leaf);
  ASSERT_TRUE(frame);
  double to_normal = 0;  // the third column
  for (size_t k = 0; k < 3; ++k) to_normal += (*frame)[0][k] * kAslant[k][2] / 15.0;
  EXPECT_NEAR(std::fabs(to_normal), 1, 1e-12);
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j <= i; ++j) {
      double product = 0;
      for (size_t k = 0; k < 3; ++k) product += (*frame)[i][k] * (*frame)[j][k];
      EXPECT_NEAR(product, i == j ? 1 : 0, 1e-12) << i << j;
    }
  }
  EXPECT_LT(2 * overlaps(face_boxes(leaf, frame)), overlaps(face_boxes(leaf, std::nullopt)));
}

TEST(BoxFrame, IsNoneWhereNothingIsGained) {
  EXPECT_FALSE(find_box_frame(plate(200, kUpright)));
  EXPECT_FALSE(find_box_frame(LeafGeometry{}));
  LeafGeometry needle;  // without area
  needle.vertices = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
  needle.corners = {0, 1, 2};
  needle.face_starts = {0, 3};
  EXPECT_FALSE(find_box_frame(needle));
}

// Far from the origin, where a float is 2^7 grid steps and more and a sum of doubles is rounded.
TEST(BoxFrame, BoxesOfFacesWithACornerInCommonOverlap) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 20; ++round) {
    IVec3 move;
    for (int64_t& m : move) m = static_cast<int64_t>(random() % (1u << 31)) - (1 << 30);
    const LeafGeometry leaf = plate(30, kAslant, move);
    const auto frame = find_box_frame(leaf);
    ASSERT_TRUE(frame);
    const std::vector<FloatBox> boxes = face_boxes(leaf, frame);
    size_t common = 0;
    for (size_t f = 0; f < leaf.face_count(); ++f) {
      for (size_t g = 0; g < f; ++g) {
        for (size_t i = 0; i < 9; ++i) {
          if (leaf.corners[3 * f + i / 3] != leaf.corners[3 * g + i % 3]) continue;
          ++common;
          ASSERT_TRUE(overlap(boxes[f], boxes[g])) << round << ": " << f << ", " << g;
        }
      }
    }
    EXPECT_GT(common, 800u);
  }
}

TEST(BoxFrame, LongTrianglesAreToldFromOthers) {
  EXPECT_TRUE(has_long_triangles(plate(200, kAslant)));
  EXPECT_FALSE(has_long_triangles(LeafGeometry{}));
  // One in eight of so many is not enough, one in seven is; squares do not count.
  for (const uint32_t others : {6u, 7u}) {
    LeafGeometry leaf;
    leaf.vertices = {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {1000, 1, 0}};
    leaf.corners = {0, 1, 4};
    leaf.face_starts = {0, 3};
    for (uint32_t i = 0; i < others; ++i) {
      leaf.corners.insert(leaf.corners.end(), {0, 1, 2, 0, 1, 2, 3});
      leaf.face_starts.push_back(static_cast<uint32_t>(leaf.corners.size()) - 4);
      leaf.face_starts.push_back(static_cast<uint32_t>(leaf.corners.size()));
    }
    EXPECT_EQ(has_long_triangles(leaf), others == 6);
  }
}

TEST(BoxFrame, DiagonalsOfFacesWithACornerInCommonOverlapAndFewOthersDo) {
  std::mt19937_64 random(6);
  for (int round = 0; round < 20; ++round) {
    IVec3 move;
    for (int64_t& m : move) m = static_cast<int64_t>(random() % (1u << 31)) - (1 << 30);
    const LeafGeometry leaf = plate(100, kAslant, move);
    const auto diagonals = face_diagonals(leaf);
    const std::vector<FloatBox> boxes = face_boxes(leaf, std::nullopt);
    size_t along_axes = 0, left = 0;
    for (size_t f = 0; f < leaf.face_count(); ++f) {
      for (size_t g = 0; g < f; ++g) {
        const bool are_near =
            overlap(diagonals[0][f], diagonals[0][g]) && overlap(diagonals[1][f], diagonals[1][g]);
        along_axes += overlap(boxes[f], boxes[g]);
        left += overlap(boxes[f], boxes[g]) && are_near;
        for (size_t i = 0; i < 9; ++i) {
          if (leaf.corners[3 * f + i / 3] != leaf.corners[3 * g + i % 3]) continue;
          ASSERT_TRUE(are_near) << round << ": " << f << ", " << g;
        }
      }
    }
    EXPECT_LT(2 * left, along_axes);
  }
}

/// The faces of both.
LeafGeometry together(LeafGeometry a, const LeafGeometry& b) {
  const auto before = static_cast<uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const uint32_t c : b.corners) a.corners.push_back(c + before);
  const uint32_t first = a.face_starts.back();
  for (size_t f = 1; f < b.face_starts.size(); ++f) {
    a.face_starts.push_back(first + b.face_starts[f]);
  }
  return a;
}

// What is turned crosses itself where it did before.
TEST(BoxFrame, LeavesCrossingsWhatTheyAre) {
  const auto moved = [](const std::array<IVec3, 3>& map, const IVec3& by) {
    IVec3 move{0, 0, 0};
    for (size_t r = 0; r < 3; ++r) {
      for (size_t c = 0; c < 3; ++c) move[r] += map[r][c] * by[c];
    }
    return plate(90, map, move);
  };
  for (const int64_t z : {20, 300}) {  // through the other one, above it
    const IVec3 by{600, 500, z};
    const LeafGeometry one = together(plate(90, kUpright), moved(kUpright, by)),
                       other = together(plate(90, kAslant), moved(kAslant, by));
    ASSERT_FALSE(find_box_frame(one));
    ASSERT_TRUE(find_box_frame(other));
    const auto expected = find_self_intersections(one);
    EXPECT_EQ(expected.empty(), z == 300);
    EXPECT_EQ(find_self_intersections(other), expected);
    EXPECT_EQ(check_surface(other).crossings, expected);
    EXPECT_EQ(check_surface(other).bounds_solid, z == 300);
  }
}

}  // namespace
}  // namespace csgrun::box_frame_test
