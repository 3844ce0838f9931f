// Many faces on several threads: each is covered once, whichever thread does it.
#include "engine/mesh/triangulate_faces.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "engine/base/parallel.h"

namespace csgrun::triangulate_faces_test {
namespace {

/// Squares of side 2 in the plane z = 0, some with corners in the middle of sides, others with a
/// hole.
struct Squares {
  static constexpr int kRow = 70;

  Squares() {
    support = planes.intern({0, 0, 1, 0});
    // Points by x, then y: they are numbered in lexicographic order.
    for (int x = 0; x <= kSize; ++x) {
      for (int y = 0; y <= kSize; ++y) {
        geometry.add_point({support.index(), planes.intern({1, 0, 0, -x}).index(),
                            planes.intern({0, 1, 0, -y}).index()});
      }
    }
    for (int i = 0; i < kRow; ++i) {
      for (int j = 0; j < kRow; ++j) add(4 * i, 4 * j, (i * kRow + j) % 5);
    }
  }

  static constexpr int kSize = 4 * kRow;
  static uint32_t point(int x, int y) { return static_cast<uint32_t>(x * (kSize + 1) + y); }
  static std::array<int64_t, 2> at(uint32_t p) { return {p / (kSize + 1), p % (kSize + 1)}; }

  void add(int x, int y, int kind) {
    constexpr int kSide = 3;
    std::vector<std::array<int, 2>> outer{
        {x, y}, {x + kSide, y}, {x + kSide, y + kSide}, {x, y + kSide}};
    if (kind > 1) outer.insert(outer.begin() + 1, {x + 1, y});
    if (kind > 2) outer.insert(outer.begin() + 2, {x + 2, y});
    std::vector<std::vector<DirectedEdge>> loops{loop_of(outer)};
    if (kind == 4) {
      loops.push_back(loop_of({{x + 1, y + 1}, {x + 1, y + 2}, {x + 2, y + 2}, {x + 2, y + 1}}));
    }
    faces.push_back({support, 0, 0, 0, false, FaceLoops(loops)});
    twice_area += 2 * (kSide * kSide - (kind == 4 ? 1 : 0));
  }
  static std::vector<DirectedEdge> loop_of(const std::vector<std::array<int, 2>>& corners) {
    std::vector<DirectedEdge> loop;
    for (size_t i = 0; i < corners.size(); ++i) {
      const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
      loop.push_back({point(a[0], a[1]), point(b[0], b[1]), 0});
    }
    return loop;
  }

  PlaneTable planes;
  CellGeometry geometry{planes, nullptr};
  PlaneId support;
  std::vector<MergedFace> faces;
  int64_t twice_area = 0;
};

TEST(TriangulateFaces, OnAnyNumberOfThreads) {
  const Squares squares;
  std::vector<std::array<uint32_t, 3>> first;
  for (const unsigned threads : {1u, 2u, 5u}) {
    const auto made = with_threads(threads, [&] {
      return triangulate_faces(squares.faces, squares.geometry, squares.planes,
                               squares.geometry.point_count());
    });
    ASSERT_TRUE(made);
    ASSERT_TRUE(std::is_sorted(made->face.begin(), made->face.end()));
    ASSERT_EQ(made->face.back() + 1, squares.faces.size());
    int64_t twice_area = 0;
    for (const auto& t : made->triangles) {
      const auto a = Squares::at(t[0]), b = Squares::at(t[1]), c = Squares::at(t[2]);
      const int64_t twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
      ASSERT_GT(twice, 0);
      twice_area += twice;
    }
    EXPECT_EQ(twice_area, squares.twice_area);
    if (first.empty()) first = made->triangles;
    EXPECT_EQ(made->triangles, first);
  }
}

TEST(TriangulateFaces, OneThatIsNoneIsAnError) {
  Squares squares;
  auto& loop = squares.faces[3000].loops[0];
  std::swap(loop[0].from, loop[1].from);
  for (const unsigned threads : {1u, 2u}) {
    const auto made = with_threads(threads, [&] {
      return triangulate_faces(squares.faces, squares.geometry, squares.planes, 0);
    });
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, ErrorCode::kInternal);
  }
}

}  // namespace
}  // namespace csgrun::triangulate_faces_test
